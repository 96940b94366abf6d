/**
 * A track as it is drawn: courses in the s-plane, in stretches of one kind. Pure.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {import('../contract.js').TrackReply} TrackReply
 * @typedef {{points: Complex[], stable: boolean}} Stretch
 */

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
 * From where to where the loop is stable: to where a pole crosses, or to the last value that is known to be so.
 * @param {Pick<TrackReply, 'values'|'stable'|'crossings'>} track
 * @returns {[number, number][]}
 */
export function stableRanges({ values, stable, crossings }) {
  /** @type {[number, number][]} */ const found = [];
  const edge = (/** @type {number} */ a, /** @type {number} */ b, /** @type {number} */ otherwise) =>
    crossings.find(({ value }) => value >= a && value <= b)?.value ?? otherwise;
  for (const [k, value] of values.entries()) {
    if (!stable[k]) continue;
    if (!stable[k - 1]) found.push([edge(values[k - 1], value, value), value]);
    found[found.length - 1][1] = k + 1 < values.length && !stable[k + 1] ? edge(value, values[k + 1], value) : value;
  }
  return found;
}
