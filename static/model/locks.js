/**
 * What a link can lock, for a class: parts of the design that keep the values with which the link opened. Pure.
 * @typedef {import('../types.js').Design} Design
 * @typedef {{name: string, keys: (keyof Design)[], controls: string}} Lock controls: where the page changes them, as a
 *   selector; empty: nowhere
 */
import { OUTER, ROTORS, STRUCTURE } from './quantities.js';

/** @type {Record<string, Lock>} */
export const LOCKS = {
  preset: {
    name: 'rig',
    keys: ['preset', 'rig', 'parameters', 'limits', 'rotors', 'friction'],
    controls: '[data-testid=preset], #rig :is([data-field], [data-testid^=rig-reset])',
  },
  point: { name: 'operating point', keys: ['theta0'], controls: '[data-field^="operating_point"]' },
  poles: {
    name: 'poles',
    keys: ['poles', 'rotor_poles'],
    controls: '.pole:not(.observer), #poles input:not([type=checkbox]), [data-testid^="use-split"]',
  },
  method: {
    name: 'method',
    keys: ['method', ...STRUCTURE, ...ROTORS],
    controls: '[data-field=method], [data-field=place_rotors], [data-testid^="use-"]',
  },
  loops: {
    name: 'outer loops',
    keys: [...OUTER, 'loops'],
    controls:
      '#loops [data-testid^=outer-], #loops .pis input, [data-field=pairing], [data-field=decoupler], ' +
      '[data-testid=suggest-pi], [data-testid=pair-advised]',
  },
  weights: { name: 'weights', keys: ['weights'], controls: '[data-field^=weights]' },
  observer: { name: 'observer', keys: ['observer'], controls: '.pole.observer, [data-field^=observer]' },
  scenario: { name: 'steps', keys: ['scenario'], controls: '#scenario [data-field^=scenario]' },
  requirements: { name: 'requirements', keys: [], controls: '.asked input' }, // they are no part of the design
  remarks: { name: 'remarks (hidden)', keys: [], controls: '' }, // what a class is to find out is not told
};

/** Whether remarks on the design are kept back. @param {{locks?: string[]}} state */
export const hidesRemarks = ({ locks }) => locks?.includes('remarks') === true;

/**
 * The change, but for what is locked; the design itself where nothing is left of the change.
 * @param {Design} before
 * @param {Design} after
 * @param {string[]} locks
 * @returns {Design}
 */
export function guarded(before, after, locks) {
  if (!locks.length || after === before) return after;
  const kept = { ...after };
  /** @template {keyof Design} K @param {K} key */
  const keep = (key) => {
    if (key in before || key in after) kept[key] = before[key];
  };
  for (const lock of locks) LOCKS[lock]?.keys.forEach(keep);
  const keys = /** @type {(keyof Design)[]} */ (Object.keys({ ...before, ...kept }));
  const same = keys.every((key) => kept[key] === before[key]);
  return same ? before : kept;
}

/** @param {string[]} locks */
export const lockNames = (locks) => locks.map((lock) => LOCKS[lock]?.name ?? lock).join(', ');
