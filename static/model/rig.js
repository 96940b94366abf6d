/**
 * The rig's parameters and limits: what they are, and how a design's differ from its preset's. Pure.
 *
 * A design holds only what differs from its preset, in the contract's names and SI units; here the pitch travel is in
 * degrees, as everywhere on the page.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {'parameters'|'limits'|'rotors.pitch'|'rotors.yaw'|'friction.pitch'|'friction.yaw'} Kind where it stands
 * @typedef {{kind: Kind, name: string, symbol: [string, string?], meaning: string, unit: string, min: number, max:
 *   number, scale: number, free: string, words?: string[]}} Quantity in the unit shown; `scale` leads to it from SI;
 *   free: what it means that it is absent, empty where it may not be; words: that it may be, in place of a number
 */
import { count, DEGREE, t } from '../text/index.js';
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
    const angle = kind === 'limits' && name === 'theta';
    const [base, index] = name.split('_');
    return {
      kind,
      name,
      symbol: angle ? ['θ', 'max'] : [base, index],
      meaning,
      unit: unit === 'rad' ? '°' : unit,
      min: minimum * scale,
      max: maximum * scale,
      scale,
      free: angle ? 'free' : '',
    };
  });

/** What the machine has beyond the paper's model. @type {[string, string, [string, string?], string, string?][]} */
const MACHINE = [
  ['rotors', 'tau', ['τ'], 'time constant of the rotor; 0: it follows at once'],
  ['rotors', 'curve', ['φ'], 'thrust by the rotor’s speed'],
  ['rotors', 'dead_zone', ['v', 'd'], 'quadratic thrust begins here'],
  ['rotors', 'matched_at', ['v', 'm'], 'where the curve meets the linear one', 'trim'],
  ['friction', 'coulomb', ['F', 'c'], 'Coulomb friction'],
  ['friction', 'static', ['F', 's'], 'stiction, held at rest', 'F_c'],
];

/** @returns {Quantity[]} of the rotors, then of the friction, pitch's before yaw's */
const ofMachine = () =>
  ['rotors', 'friction'].flatMap((top) =>
    ['pitch', 'yaw'].flatMap((axis) =>
      MACHINE.filter(([own]) => own === top).map(([, name, [base, index], meaning, free = '']) => {
        const kind = /** @type {Kind} */ (`${top}.${axis}`);
        const { unit = '', words } = QUANTITIES[`${kind}.${name}`] ?? {};
        return {
          kind,
          name,
          symbol: /** @type {[string, string?]} */ ([base, name === 'tau' ? axis[0] : index]),
          meaning: t(meaning),
          unit,
          ...allowed(`${kind}.${name}`),
          scale: 1,
          free,
          words,
        };
      }),
    ),
  );

/** All that can be changed of a rig, parameters first. @param {Preset} preset @returns {Quantity[]} */
export const quantities = (preset) => [
  ...listed('parameters', preset.parameter_info),
  ...listed('limits', preset.limit_info),
  ...ofMachine(),
];

/** @typedef {Record<string, number|string|null|undefined>} Values  of quantities, by name */

/** The values that stand in one place. @param {Design|Preset} of @param {Kind} kind @returns {Values} */
const standing = (of, kind) =>
  /** @type {Values} */ (
    kind
      .split('.')
      .reduce((inner, key) => /** @type {Record<string, object>} */ (inner)?.[key], /** @type {object} */ (of)) ?? {}
  );

/** In SI units. @param {Preset} preset @param {Quantity} q undefined where it is free */
export const proposed = (preset, { kind, name }) => standing(preset, kind)[name] ?? undefined;

/**
 * Without what a change of units leaves in the last digits.
 * @param {number|string|undefined} v
 * @param {Quantity} q as shown; NaN where it is free
 * @returns {number|string}
 */
const shown = (v, { scale }) =>
  v === undefined ? NaN : typeof v === 'string' ? v : Number((v * scale).toPrecision(12));

/** @param {Preset} preset @param {Quantity} q as shown; NaN where it is free */
export const proposedShown = (preset, q) => shown(proposed(preset, q), q);

/** @param {Design} design @param {Preset} preset @param {Quantity} q as shown; NaN where it is free */
export function valueOf(design, preset, q) {
  const own = standing(design, q.kind)[q.name];
  return own === undefined ? proposedShown(preset, q) : shown(own ?? undefined, q);
}

/** In SI units. @param {Design} design @param {Preset|undefined} preset @param {'pitch'|'yaw'} axis of a rotor */
export function lagOf(design, preset, axis) {
  const tau = Number(standing(design, `rotors.${axis}`).tau ?? (preset && standing(preset, `rotors.${axis}`).tau) ?? 0);
  return tau < AT_ONCE ? 0 : tau;
}
/** Below this a rotor follows at once, s: as the server has it. */
const AT_ONCE = 1e-6;

/** Whether a rotor takes time. @param {Design} design @param {Preset|undefined} preset */
export const lags = (design, preset) =>
  /** @type {const} */ (['pitch', 'yaw']).some((axis) => lagOf(design, preset, axis) > 0);

/** @param {Design} design @param {Quantity} q */
export const isChanged = (design, { kind, name }) => Object.hasOwn(standing(design, kind), name);

/** @param {Design} design @param {Kind} kind @param {Values} values @returns {Design} */
function withStanding(design, kind, values) {
  const [top, axis] = kind.split('.');
  if (!axis) return { ...design, [top]: values };
  const { [axis]: _old, ...others } = /** @type {Record<string, Values>} */ (design[/** @type {'rotors'} */ (top)]);
  return { ...design, [top]: Object.keys(values).length ? { ...others, [axis]: values } : others };
}

/**
 * With one of them changed, or as the preset has it.
 * @param {Design} design
 * @param {Preset} preset
 * @param {Quantity} q
 * @param {number|string} v as shown; NaN: free
 * @returns {Design}
 */
export function withValue(design, preset, q, v) {
  if (Object.is(v, proposedShown(preset, q))) return without(design, q);
  const own = typeof v === 'string' ? v : Number.isNaN(v) ? null : v / q.scale;
  return withStanding(design, q.kind, { ...standing(design, q.kind), [q.name]: own });
}

/** Back to the preset's. @param {Design} design @param {Quantity} q @returns {Design} */
export function without(design, q) {
  if (!isChanged(design, q)) return design;
  const { [q.name]: _own, ...others } = standing(design, q.kind);
  return withStanding(design, q.kind, others);
}

/** The preset's rig. @param {Design} design @returns {Design} */
export const asProposed = ({ rig: _own, ...design }) => ({
  ...design,
  parameters: {},
  limits: {},
  rotors: {},
  friction: {},
});

/** How many differ, in words; empty where none does. @param {Design} design */
export function changedWords({ parameters, limits, rotors, friction }) {
  const inner = [...Object.values(rotors), ...Object.values(friction)].flatMap((own) => Object.keys(own));
  const [p, l] = [Object.keys(parameters).length + inner.length, Object.keys(limits).length];
  if (!l) return p ? count(p, '{0} parameter changed', '{0} parameters changed') : '';
  if (!p) return count(l, '{0} limit changed', '{0} limits changed');
  return `${count(p, '{0} parameter', '{0} parameters')}, ${count(l, '{0} limit changed', '{0} limits changed')}`;
}

/** Whether a field, by its path in the contract, is one of the rig's. @param {string} [path] */
export const isOfRig = (path = '') => /^(parameters|limits|rotors|friction)(\.|$)/.test(path);
