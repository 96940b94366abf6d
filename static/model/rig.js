/**
 * The rig's parameters and limits: what they are, and how a design's differ from its preset's. Pure.
 *
 * A design holds only what differs from its preset, in the contract's names and SI units; here the pitch travel is in
 * degrees, as everywhere on the page.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {'parameters'|'limits'} Kind
 * @typedef {{kind: Kind, name: string, meaning: string, unit: string, min: number, max: number, scale: number, free:
 *   boolean}} Quantity in the unit shown; `scale` leads to it from SI; free: may be absent
 */
import { count, DEGREE } from '../text/index.js';
import { QUANTITIES } from './quantities.js';

/**
 * The contract's range of a quantity in the unit shown: `scale` leads to it. Ends in degrees are cut to two decimals.
 * @param {string} path in the contract
 */
export function allowed(path, scale = 1) {
  const { min = -Infinity, max = Infinity } = QUANTITIES[path] ?? {};
  const cut = (/** @type {number} */ v) => (scale === DEGREE ? Math.trunc(v * scale * 100) / 100 : v * scale);
  return { min: cut(min), max: cut(max) };
}

/**
 * What the quantities right below a path are unless someone says otherwise.
 * @template T as the contract has them
 * @param {string} path
 * @returns {T}
 */
export const standardOf = (path) =>
  /** @type {T} */ (
    Object.fromEntries(
      Object.entries(QUANTITIES)
        .filter(([own, quantity]) => own.replace(/\.\w+$/, '') === path && quantity?.standard !== undefined)
        .map(([own, quantity]) => [own.slice(path.length + 1), quantity?.standard]),
    )
  );

/** @param {Kind} kind @param {Record<string, import('../types.js').Range>} [infos] @returns {Quantity[]} */
const listed = (kind, infos = {}) =>
  Object.entries(infos).map(([name, { meaning, unit, minimum, maximum }]) => {
    const scale = unit === 'rad' ? DEGREE : 1;
    return {
      kind,
      name,
      meaning,
      unit: unit === 'rad' ? '°' : unit,
      min: minimum * scale,
      max: maximum * scale,
      scale,
      free: kind === 'limits' && name === 'theta',
    };
  });

/** All that can be changed of a rig, parameters first. @param {Preset} preset @returns {Quantity[]} */
export const quantities = (preset) => [
  ...listed('parameters', preset.parameter_info),
  ...listed('limits', preset.limit_info),
];

/** In SI units. @param {Preset} preset @param {Quantity} q @returns {number|undefined} undefined where it is free */
export const proposed = (preset, { kind, name }) =>
  /** @type {Record<string, number|undefined>} */ (preset[kind])[name];

/**
 * Without what a change of units leaves in the last digits.
 * @param {number|undefined} v
 * @param {Quantity} q as shown; NaN where it is free
 */
const shown = (v, { scale }) => (v === undefined ? NaN : Number((v * scale).toPrecision(12)));

/** @param {Preset} preset @param {Quantity} q as shown; NaN where it is free */
export const proposedShown = (preset, q) => shown(proposed(preset, q), q);

/** @param {Design} design @param {Preset} preset @param {Quantity} q as shown; NaN where it is free */
export function valueOf(design, preset, q) {
  const own = /** @type {Record<string, number|null|undefined>} */ (design[q.kind])[q.name];
  return own === undefined ? proposedShown(preset, q) : shown(own ?? undefined, q);
}

/** @param {Design} design @param {Quantity} q */
export const isChanged = (design, { kind, name }) => Object.hasOwn(design[kind], name);

/**
 * With one of them changed, or as the preset has it.
 * @param {Design} design
 * @param {Preset} preset
 * @param {Quantity} q
 * @param {number} v as shown; NaN: free
 * @returns {Design}
 */
export function withValue(design, preset, q, v) {
  if (Object.is(v, proposedShown(preset, q))) return without(design, q);
  return { ...design, [q.kind]: { ...design[q.kind], [q.name]: Number.isNaN(v) ? null : v / q.scale } };
}

/** Back to the preset's. @param {Design} design @param {Quantity} q @returns {Design} */
export function without(design, q) {
  if (!isChanged(design, q)) return design;
  return {
    ...design,
    [q.kind]: Object.fromEntries(Object.entries(design[q.kind]).filter(([name]) => name !== q.name)),
  };
}

/** The preset's rig. @param {Design} design @returns {Design} */
export const asProposed = (design) => ({ ...design, parameters: {}, limits: {} });

/** How many differ, in words; empty where none does. @param {Design} design */
export function changedWords({ parameters, limits }) {
  const [p, l] = [Object.keys(parameters).length, Object.keys(limits).length];
  if (!l) return p ? count(p, '{0} parameter changed', '{0} parameters changed') : '';
  if (!p) return count(l, '{0} limit changed', '{0} limits changed');
  return `${count(p, '{0} parameter', '{0} parameters')}, ${count(l, '{0} limit changed', '{0} limits changed')}`;
}
