/**
 * What a link or a lab's step can lock: parts of the design that keep the values with which it opened. Pure.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Lock} Lock
 * @typedef {Record<string, Record<string, object>>} Values
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
  observer: {
    name: 'observer',
    keys: ['observer'],
    controls: '.pole.observer, [data-field^=observer], .observer-placed input',
  },
  scenario: {
    name: 'steps',
    keys: ['scenario'],
    controls:
      '#scenario :is([data-field^=scenario], :is(input, [data-testid=experiment-reset])[data-testid^=experiment-])',
  },
  requirements: { name: 'requirements', keys: [], controls: '.asked input' }, // they are no part of the design
  remarks: { name: 'remarks (hidden)', keys: [], controls: '' }, // what a class is to find out is not told
};

/** Whether it is kept back, by a lab's step or a link. @param {Partial<State>} state @param {string} what */
export const hides = ({ locks, task }, what) =>
  Boolean(task?.hidden.includes(what) || (what === 'remarks' && locks?.includes(what)));

/** Whether remarks on the design are kept back. @param {Partial<State>} state */
export const hidesRemarks = (state) => hides(state, 'remarks');

/** What is remarked and may be told. @param {Partial<State>} state */
export const remarked = (state) =>
  (state.reply?.findings ?? []).filter(
    ({ code }) => !hidesRemarks(state) && !(code.startsWith('pairing_') && hides(state, 'rga')),
  );

/**
 * With what stands at a path in another; one of both where nothing differs.
 * @template {object} T
 * @param {T} to @param {T} from @param {string[]} path
 * @returns {T}
 */
function taking(to, from, [key, ...rest]) {
  const [own, theirs] = [to, from].map((of) => /** @type {Values} */ (of)[key]);
  const inner = rest.length && theirs && own !== theirs ? taking(own ?? {}, theirs, rest) : theirs;
  if (inner === own) return to;
  const out = /** @type {T & Values} */ (Array.isArray(to) ? [...to] : { ...to, [key]: inner });
  if (inner === undefined) delete (/** @type {Values} */ (out)[key]);
  else /** @type {Values} */ (out)[key] = inner;
  const keys = /** @type {(keyof T)[]} */ (Object.keys({ ...out, ...from }));
  return keys.every((name) => out[name] === from[name]) ? from : out;
}

/**
 * The change, but for what is locked; the design itself where nothing is left of the change.
 * @param {Design} before
 * @param {Design} after
 * @param {string[]} locks
 * @param {Lock[]} [free] what may change all the same
 * @returns {Design}
 */
export function guarded(before, after, locks, free = []) {
  const put = (/** @type {Design} */ to, /** @type {Design} */ from, /** @type {Lock[]} */ of) =>
    of.flatMap(({ keys }) => keys).reduce((design, key) => taking(design, from, key.split('.')), to);
  const fixed = locks.flatMap((name) => LOCKS[name] ?? []);
  return fixed.length ? put(put(after, before, fixed), after, free) : after;
}

/** @param {string[]} locks */
export const lockNames = (locks) => locks.map((name) => LOCKS[name]?.name ?? name).join(', ');
