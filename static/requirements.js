/**
 * What a designer asks of the placed poles: to settle soon enough and not to overshoot by more. Each is judged by one pair alone, as a second-order
 * system: settling to 2 % within 4/σ, overshoot e^(−πζ/√(1 − ζ²)). Pure.
 * @typedef {import('./types.js').Complex} Complex
 * @typedef {import('./types.js').Requirements} Requirements
 */
import { character } from './poles.js';

const SLACK = 1 + 1e-9; // a pole on the border itself is allowed

/** @type {Requirements} */
export const NONE = { settling: null, overshoot: null };

/** What can be asked: s, %. @type {Record<keyof Requirements, {min: number, max: number, positive: boolean}>} */
export const RANGES = { settling: { min: 0, max: 1e3, positive: true }, overshoot: { min: 0, max: 100, positive: false } };

/** With one of them changed. @param {Requirements} r @param {string} name @param {unknown} value @returns {Requirements|null} null where that cannot be asked */
export function asking(r, name, value) {
  if (name !== 'settling' && name !== 'overshoot') return null;
  const { min, max, positive } = RANGES[name];
  if (value === null) return { ...r, [name]: null };
  return typeof value === 'number' && value >= min && value <= max && !(positive && value === 0) ? { ...r, [name]: value } : null;
}

/** @param {Requirements} r */
export const isAsked = (r) => r.settling !== null || r.overshoot !== null;

/** The real part that no pole may exceed, rad/s. @param {Requirements} r @returns {number|undefined} */
export const fastestOf = ({ settling }) => (settling === null ? undefined : -4 / settling);

/** The damping ratio that no pole may fall short of. @param {Requirements} r @returns {number|undefined} */
export function leastDamping({ overshoot }) {
  if (overshoot === null) return undefined;
  if (overshoot <= 0) return 1;
  const log = Math.log(overshoot / 100);
  return -log / Math.hypot(Math.PI, log);
}

/** What a pole misses. One that grows never settles, and overshoots without end. @param {Complex} p @param {Requirements} r */
export function missed(p, { settling, overshoot }) {
  const it = character(p);
  return {
    settling: settling !== null && !((it.settling ?? Infinity) <= settling * SLACK),
    overshoot: overshoot !== null && !((it.settling === undefined ? Infinity : it.overshoot ?? 0) <= overshoot * SLACK),
  };
}

/** @param {Complex} p @param {Requirements} r @returns {string} empty where it meets them */
export function missedWords(p, r) {
  const m = missed(p, r);
  return [m.settling && 'too slow', m.overshoot && 'overshoots'].filter(Boolean).join(', ');
}

/**
 * The verdict on a pair: what it misses, by which pole where only one does.
 * @param {readonly Complex[]} poles @param {0|1} pair @param {Requirements} r
 * @returns {{met: boolean, text: string}}
 */
export function pairVerdict(poles, pair, r) {
  const words = [2 * pair, 2 * pair + 1].map((i) => missedWords(poles[i], r));
  if (!words[0] && !words[1]) return { met: true, text: 'meets the requirements' };
  if (words[0] === words[1]) return { met: false, text: words[0] };
  return { met: false, text: words.map((w, k) => w && `${2 * pair + k + 1} ${w}`).filter(Boolean).join('; ') };
}

/** What the readout adds for a pole. @param {Complex} p @param {Requirements} r */
export function readoutWords(p, r) {
  if (!isAsked(r)) return '';
  const words = missedWords(p, r);
  return words ? `✕ ${words}` : '✓ meets the requirements';
}

/**
 * The forbidden regions as polygons in the plane, large enough for what is seen: right of −4/T, and outside the wedge of least damping.
 * @param {{left: number, right: number, bottom: number, top: number}} seen @param {Requirements} r
 * @returns {{settling?: Complex[], overshoot?: Complex[]}}
 */
export function forbidden(seen, r) {
  /** @type {{settling?: Complex[], overshoot?: Complex[]}} */ const out = {};
  const edge = fastestOf(r);
  if (edge !== undefined && edge < seen.right) {
    const left = Math.max(edge, seen.left - 1);
    out.settling = [{ re: left, im: seen.bottom }, { re: left, im: seen.top }, { re: seen.right, im: seen.top }, { re: seen.right, im: seen.bottom }];
  }
  const zeta = leastDamping(r);
  if (zeta !== undefined) {
    const far = 2 * Math.hypot(Math.max(-seen.left, seen.right), Math.max(seen.top, -seen.bottom));
    const end = { re: -zeta * far, im: Math.sqrt(1 - zeta * zeta) * far };
    const around = [{ re: end.re, im: far }, { re: far, im: far }, { re: far, im: -far }, { re: end.re, im: -far }];
    out.overshoot = [{ re: 0, im: 0 }, end, ...around, { re: end.re, im: -end.im }];
  }
  return out;
}
