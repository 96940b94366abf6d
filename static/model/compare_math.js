/**
 * What is read off the comparisons: the best of a column, the worse of two motors, how poles are dealt, and where Ĝ(jω)
 * is dominant. Pure.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {import('../contract.js').Dominance} Dominance
 * @typedef {import('../types.js').Metrics} Metrics
 * @typedef {import('../types.js').Margins} Margins
 */
import { complex, conjugates, forField, significant } from '../text/index.js';

/** @param {number} from @param {number} to @param {number} count @returns {number[]} */
export const logSpaced = (from, to, count) =>
  Array.from({ length: count }, (_, k) => Number((from * (to / from) ** (k / (count - 1))).toPrecision(9)));

/**
 * The rows whose figure is best: the least cost, and all that cost or read the same. Where most are alike, none stands
 * out.
 * @param {(number|undefined)[]} costs @param {string[]} texts @returns {Set<number>}
 */
export function best(costs, texts) {
  const known = costs.flatMap((c, i) => (c !== undefined && Number.isFinite(c) ? [i] : []));
  if (known.length < 2) return new Set();
  const first = known.reduce((a, b) => (/** @type {number} */ (costs[b]) < /** @type {number} */ (costs[a]) ? b : a));
  const alike = known.filter((i) => texts[i] === texts[first] || costs[i] === costs[first]);
  return new Set(2 * alike.length > known.length ? [] : alike);
}

/**
 * The smaller margins of both motors; a gain margin that is missing is infinite. Without any margin (unstable)
 * undefined.
 * @param {import('../contract.js').LoopMargins|undefined} margins
 * @returns {{gain: number, phase: number}|undefined}
 */
export function worseMargins(margins) {
  /** @type {Margins[]} */ const both = Object.values(margins ?? {});
  if (!both.length) return undefined;
  return {
    gain: Math.min(...both.map((m) => m.gain_margin ?? Infinity)),
    phase: Math.min(...both.map((m) => m.phase_margin ?? Infinity)),
  };
}

/**
 * Each motor over both single steps: the higher peak, the longer share of time at the limit.
 * @param {Partial<Record<import('../types.js').Axis, Metrics>>|undefined} steps
 */
export function hardest(steps) {
  /** @type {(Metrics|undefined)[]} */ const all = Object.values(steps ?? {});
  const of = (/** @type {import('../types.js').Motor} */ name) => {
    const both = all.map((s) => s?.[name]).filter((m) => m !== undefined);
    return both.length
      ? { peak: Math.max(...both.map((m) => m.peak)), saturated: Math.max(...both.map((m) => m.saturated ?? 0)) }
      : undefined;
  };
  return { V_p: of('V_p'), V_y: of('V_y') };
}

/** A pair in words. @param {readonly Complex[]} pair */
export const pairText = ([a, b]) => (a.im === 0 ? `${significant(a.re, 3)}, ${significant(b.re, 3)}` : conjugates(a));

/**
 * Conjugates first, so that any four poles stay two closed pairs, and in one order however they are dealt.
 * @param {readonly Complex[]} poles
 * @returns {Complex[]}
 */
export const inOrder = (poles) =>
  [...poles].sort(
    (a, b) => Number(a.im === 0) - Number(b.im === 0) || a.re - b.re || Math.abs(a.im) - Math.abs(b.im) || a.im - b.im,
  );

/**
 * Whether both deal the same poles to pitch, and so to yaw.
 * @param {readonly Complex[]} a
 * @param {readonly Complex[]} b
 */
export function sameSplit(a, b) {
  const text = (/** @type {readonly Complex[]} */ poles) =>
    [poles.slice(0, 2), poles.slice(2)].map((pair) =>
      pair
        .map((p) => complex(p, 9))
        .sort()
        .join(),
    );
  return text(a).join('|') === text(b).join('|');
}

/** The larger ratio at each frequency. @param {number[][]} ratios */
export const largest = (ratios) => ratios.map((pair) => Math.max(...pair.map((v) => v ?? Infinity)));

/** @param {number} v @param {number} [digits] */
const short = (v, digits = 2) => forField(Number(v.toPrecision(digits)));

/** Where one kind of ratio stays below 1. @param {number[]} w @param {number[]} ratio */
function where(w, ratio) {
  const bad = ratio.flatMap((v, i) => (v < 1 ? [] : [i]));
  const [first, last] = [bad[0], bad[bad.length - 1]];
  const at = (/** @type {number} */ i) => `${short(w[i])} rad/s`;
  if (!bad.length) return 'everywhere';
  if (bad.length === w.length) return 'nowhere';
  if (last === w.length - 1 && bad.length === last - first + 1) return `only below ${at(first)}`;
  if (first === 0 && bad.length === last + 1) return `only above ${at(last)}`;
  if (first === last) return `except at ${at(first)}`;
  return `except between ${at(first)} and ${at(last)}`;
}

/**
 * Whether Ĝ(jω) is diagonally dominant, as the paper says of its rig.
 * @param {number[]} w rad/s
 * @param {Dominance} dominance
 */
export function dominanceWords(w, dominance) {
  const kinds = [largest(dominance.rows), largest(dominance.columns)];
  const [rows, columns] = kinds.map((ratio) => where(w, ratio));
  const dominant = rows === 'everywhere' && columns === 'everywhere';
  const alike =
    rows === 'nowhere'
      ? 'nowhere diagonally dominant, neither by rows nor by columns'
      : `diagonally dominant ${rows}, by rows and by columns`;
  const told = rows === columns ? alike : `diagonally dominant by rows ${rows}, by columns ${columns}`;
  const [peak, i] = kinds
    .flatMap((ratio) => ratio.map((v, k) => /** @type {[number, number]} */ ([v, k])))
    .reduce((a, b) => (b[0] > a[0] ? b : a));
  const most = Number.isFinite(peak)
    ? ` The off-diagonal entries reach ${short(peak, 3)} of the diagonal ones, at ${short(w[i])} rad/s.`
    : '';
  const range = `Between ${forField(w[0])} and ${forField(w[w.length - 1])} rad/s`;
  return {
    dominant,
    text: `${range} Ĝ(jω) is ${told}${dominant ? ', as the paper says of its helicopter' : ''}.${most}`,
  };
}
