/**
 * What a change in the air has done, in words: which parts of the design are others, and what the voltages would have
 * done had the new controller not been prepared. Pure.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('./craft.js').Takeover} Takeover
 *
 * @typedef {object} Change  one gesture of the hand, or one choice: several controllers may have taken over meanwhile
 * @property {number} from  s
 * @property {number} to  s
 * @property {string[]} parts  in words; empty: the controller took over from the sticks
 * @property {[number, number]} jump  largest sizes of V_p's and V_y's jumps, V
 * @property {[number, number]} without  what they would have been
 * @property {boolean} bumpless
 */
import { fixed, say, significant, t } from '../text/index.js';

const POLES = ['p₁', 'p₂', 'p₃', 'p₄'];
const MOTORS = ['V_p', 'V_y'];
/** Below this nobody sees a jump, V. */
const SEEN = 0.005;
/** What rounding leaves, V. */
const ROUNDING = 1e-9;

/** Parts of a design, and what they are called. @type {[words: string, keys: (keyof Design)[]][]} */
const PARTS = [
  ['the method', ['method', 'weights']],
  ['the observer', ['observer']],
  ['the rotors’ poles', ['rotor_poles']],
  ['the limits', ['limits']],
  ['the rig', ['parameters', 'rotors', 'friction']],
  ['the operating point', ['theta0']],
];

/** @param {unknown} a @param {unknown} b */
const same = (a, b) => a === b || JSON.stringify(a) === JSON.stringify(b);

/** Of an experiment, what matters in the air. @param {Design} design */
function flownIn({ scenario }) {
  const { reference: _asked, duration: _long, initial: _start, disturbance: _volts, ...own } = scenario;
  return own;
}

/**
 * What of a design is another.
 * @param {Design} before @param {Design} after
 * @returns {string[]} in words
 */
export function changedParts(before, after) {
  const poles = POLES.filter((_, i) => !same(before.poles[i], after.poles[i]));
  const loops = /** @type {const} */ ([
    ['pitch', 'pitch’s loop'],
    ['yaw', 'yaw’s loop'],
  ]).filter(([axis]) => !same(before.loops[axis], after.loops[axis]));
  const named = PARTS.filter(([, keys]) => keys.some((key) => !same(before[key], after[key])));
  const known = new Set(['poles', 'loops', 'scenario', ...PARTS.flatMap(([, keys]) => keys)]);
  const keys = /** @type {(keyof Design)[]} */ ([...new Set([...Object.keys(before), ...Object.keys(after)])]);
  const rest = keys.some((key) => !known.has(key) && !same(before[key], after[key]));
  return [
    ...poles,
    ...loops.map(([, words]) => t(words)),
    ...named.map(([words]) => t(words)),
    ...(same(flownIn(before), flownIn(after)) ? [] : [t('the sampling')]),
    ...(rest ? [t('the structure')] : []),
  ];
}

/** @param {Takeover} takeover @param {string[]} parts @returns {Change} */
export function changeOf({ time, jump, jumpWithout, bumpless }, parts) {
  const sizes = (/** @type {[number, number]} */ [a, b]) =>
    /** @type {[number, number]} */ ([Math.abs(a), Math.abs(b)]);
  return { from: time, to: time, parts, jump: sizes(jump), without: sizes(jumpWithout), bumpless };
}

/** Two of one gesture as one. @param {Change} first @param {Change} next @returns {Change} */
export function joined(first, next) {
  const larger = (/** @type {[number, number]} */ a, /** @type {[number, number]} */ b) =>
    /** @type {[number, number]} */ ([Math.max(a[0], b[0]), Math.max(a[1], b[1])]);
  return {
    from: first.from,
    to: next.to,
    parts: [...first.parts, ...next.parts.filter((part) => !first.parts.includes(part))],
    jump: larger(first.jump, next.jump),
    without: larger(first.without, next.without),
    bumpless: first.bumpless && next.bumpless,
  };
}

/** What was changed. @param {Change} change */
const title = ({ parts }) => (parts.length ? parts.join(', ') : t('hands off'));

/** When. @param {Change} change */
function when({ from, to }) {
  return to - from < 0.05 ? say`at ${fixed(from, 1)} s` : say`from ${fixed(from, 1)} to ${fixed(to, 1)} s`;
}

/** @param {number} volts */
const amount = (volts) => (volts < 0.1 ? significant(volts, 2) : fixed(volts, 1));

/** @param {Change} change @returns {string} a sentence */
export function changeWords(change) {
  const [what, at] = [title(change), when(change)];
  const head = change.parts.length ? say`${what} changed ${at}` : say`The controller took over from the sticks ${at}`;
  const motor = change.without[1] > change.without[0] ? 1 : 0;
  const left = change.jump[1] > change.jump[0] ? 1 : 0;
  const upTo = change.to > change.from ? `${t('up to')} ` : '';
  if (change.jump[left] > Math.max(ROUNDING, SEEN / 10)) {
    const [name, size] = [MOTORS[left], amount(change.jump[left])];
    return change.bumpless
      ? say`${head}: ${name} jumped by ${upTo}${size} V.`
      : say`${head}: ${name} jumped by ${upTo}${size} V. Without an integrator for each motor nothing prevents that.`;
  }
  if (change.without[motor] < SEEN) return say`${head}: no voltage would have jumped.`;
  const [name, size] = [MOTORS[motor], amount(change.without[motor])];
  return say`${head}: ${name} would have jumped by ${upTo}${size} V; it did not.`;
}
