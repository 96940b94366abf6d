/** Round numbers for the ticks of an axis. */

/**
 * A step of 1, 2 or 5 times a power of ten, for about `count` steps in `span`.
 * @param {number} span
 * @param {number} count
 */
export function niceStep(span, count) {
  const raw = span / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const m = raw / power;
  return power * (m < 1.5 ? 1 : m < 3.5 ? 2 : m < 7.5 ? 5 : 10);
}

/** @param {number} low @param {number} high @param {number} step */
export function ticks(low, high, step) {
  const out = [];
  for (let k = Math.ceil(low / step); k * step <= high; k++) out.push(Number((k * step).toPrecision(10)));
  return out;
}
