/**
 * A track as it is drawn: courses in the s-plane, in stretches of one kind. Pure.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {import('../contract.js').TrackReply} TrackReply
 * @typedef {{points: Complex[], stable: boolean}} Stretch
 */
import { say, t } from '../text/index.js';

/** Where a pole lies in the s-plane: of a sampled loop ln z/Ts. @param {Complex} z @param {number} time  s */
export const equivalent = ({ re, im }, time) => ({
  re: Math.log(Math.hypot(re, im)) / time,
  im: Math.atan2(im, re) / time,
});

/**
 * The courses in the s-plane, per pole.
 * @param {Pick<TrackReply, 'plane'|'poles'|'values'>} track @returns {Complex[][]}
 */
export const coursesOf = ({ plane, poles, values }) =>
  plane === 's' ? poles : poles.map((course) => course.map((z, k) => equivalent(z, values[k])));

/** Crossings in the s-plane. @param {Pick<TrackReply, 'plane'|'crossings'>} track */
export const crossingsOf = ({ plane, crossings }) =>
  crossings.map(({ value, pole, outwards }) => ({
    value,
    outwards,
    pole: plane === 's' ? pole : { ...equivalent(pole, value), re: 0 },
  }));

/**
 * A course in parts that are stable or not; they meet where they change. A sampled loop's pole that has gone around at
 * half the sample rate comes back from the other side: there a new part begins.
 * @param {Complex[]} course @param {readonly number[]} starts
 * @returns {Stretch[]}
 */
export function stretches(course, starts) {
  /** @type {Stretch[]} */ const found = [];
  for (const [k, p] of course.entries()) {
    const last = found[found.length - 1];
    const stable = p.re < 0;
    const before = course[k - 1];
    const whole =
      before && !starts.includes(k) && Math.abs(p.im - before.im) <= Math.max(Math.abs(p.re), Math.abs(p.im));
    if (last && whole && last.stable === stable) last.points.push(p);
    else found.push({ stable, points: last && whole ? [last.points[last.points.length - 1], p] : [p] });
  }
  return found.filter(({ points }) => points.length > 1);
}

/**
 * The value whose poles come nearest to a place.
 * @param {Complex[][]} courses @param {(p: Complex) => number} distance
 * @returns {{index: number, away: number}}
 */
export function nearest(courses, distance) {
  let [index, away] = [-1, Infinity];
  for (const course of courses)
    for (const [k, p] of course.entries()) {
      const own = distance(p);
      if (own < away) [index, away] = [k, own];
    }
  return { index, away };
}

/** The position of the value that is nearest to one. @param {readonly number[]} values @param {number} value */
export const indexOf = (values, value) =>
  values.reduce((best, v, k) => (Math.abs(v - value) < Math.abs(values[best] - value) ? k : best), 0);

/**
 * How far along a range a value lies, 0 to 1, and back.
 * @param {readonly [number, number]} range @param {boolean} log
 */
export function along([low, high], log) {
  const [a, b] = log ? [Math.log(Math.abs(low)), Math.log(Math.abs(high))] : [low, high];
  const sign = log && low < 0 ? -1 : 1;
  return {
    share: (/** @type {number} */ v) => ((log ? Math.log(Math.abs(v)) : v) - a) / (b - a || 1),
    value: (/** @type {number} */ s) => (log ? sign * Math.exp(a + s * (b - a)) : a + s * (b - a)),
  };
}

/**
 * @typedef {object} End  of a stretch of stable values
 * @property {number} value
 * @property {'crossing'|'border'|'known'} by  a pole crosses there; poles only touch the border there, and the value
 *   itself is not stable; or no more is known
 */

/**
 * From where to where the loop is stable.
 * @param {Pick<TrackReply, 'values'|'starts'|'stable'|'on_border'|'crossings'>} track
 * @returns {[End, End][]}
 */
export function stableRanges(track) {
  const { values, starts, stable, on_border, crossings } = track;
  /** @type {[End, End][]} */ const found = [];
  /** @param {number} k stable @param {number} other  its neighbour, which is not @returns {End} */
  const edge = (k, other) => {
    const [a, b] = [Math.min(k, other), Math.max(k, other)];
    const apart = other < 0 || other >= values.length || starts.includes(b);
    const between = apart ? [] : crossings.filter(({ value }) => value >= values[a] && value <= values[b]);
    // of several poles that cross in one step the one that is nearest to what is stable
    const crossing = between.filter(({ outwards }) => outwards === k < other).at(k < other ? 0 : -1);
    if (crossing) return { value: crossing.value, by: 'crossing' };
    if (!apart && on_border[other]) return { value: values[other], by: 'border' };
    return { value: values[k], by: 'known' };
  };
  for (const k of values.keys()) {
    if (!stable[k]) continue;
    if (!stable[k - 1] || starts.includes(k)) found.push([edge(k, k - 1), { value: values[k], by: 'known' }]);
    if (!stable[k + 1] || starts.includes(k + 1)) found[found.length - 1][1] = edge(k, k + 1);
  }
  return found;
}

/**
 * Where the loop is stable, in words.
 * @param {Pick<TrackReply, 'plane'> & Parameters<typeof stableRanges>[0]} track
 * @param {(v: number) => string} text  of a value
 */
export function summary(track, text) {
  const { values, plane, stable, on_border } = track;
  if (stable.every(Boolean)) return t('stable throughout');
  const ranges = stableRanges(track);
  const border = plane === 's' ? t('the imaginary axis') : t('the unit circle');
  const touched = values.flatMap((value, k) => (on_border[k] ? [text(value)] : []));
  const words = ranges.length ? ranges.map((range) => rangeText(range, values, text)) : [t('never stable')];
  if (touched.length) words.push(say`at ${brief(touched)} poles on ${border}`);
  return words.join('; ');
}

/** A few of many. @param {string[]} texts */
const brief = (texts) => (texts.length > 2 ? `${texts[0]} … ${texts[texts.length - 1]}` : texts.join(', '));

/** @param {[End, End]} range @param {readonly number[]} values @param {(v: number) => string} text */
function rangeText([low, high], values, text) {
  const [from, to] = [text(low.value), text(high.value)];
  const whole = high.by === 'known' && high.value === values[values.length - 1];
  if (low.by === 'border' && whole) return say`stable for every value above ${from}, up to ${to}`;
  if (low.by === 'border') return say`stable above ${from}, up to ${ended(high, to)}`;
  return say`stable from ${ended(low, from)} to ${ended(high, to)}`;
}

/** @param {End} end @param {string} text */
const ended = ({ by }, text) =>
  by === 'crossing' ? say`${text} (a pole crosses)` : by === 'border' ? say`below ${text}` : text;
