/**
 * Between which values a map changes colour: round numbers in the unit that people read, few enough to be told apart.
 * Pure.
 */
import { niceStep } from '../model/index.js';

/** Bands that are wanted, about. */
const BANDS = 11;
/** Shares of all values that may lie below and above the levels: outliers must not make the rest one colour. */
const [LOW, HIGH] = [0.01, 0.93];
/** From this ratio on levels are multiples of each other. */
const WIDE = 30;

/** @param {number[]} sorted @param {number} share */
const quantile = (sorted, share) => sorted[Math.min(sorted.length - 1, Math.round(share * (sorted.length - 1)))];

/**
 * @param {ArrayLike<number>} values  in the unit that is shown; what is not finite does not count
 * @param {boolean} higher  whether more is better: then the low values are the outliers' side
 * @param {number} [finest]  values that differ by less are alike: all of them have the colour of what is best
 * @returns {number[]} ascending; at least one where there is any value
 */
export function levelsOf(values, higher, finest = 0) {
  const known = Array.from(values)
    .filter(Number.isFinite)
    .sort((a, b) => a - b);
  if (!known.length) return [];
  const [least, most] = higher
    ? [quantile(known, 1 - HIGH), quantile(known, 1 - LOW)]
    : [quantile(known, LOW), quantile(known, HIGH)];
  if (finest > 0 && most - least < finest)
    return [Number((finest * (higher ? Math.floor(least / finest) : Math.ceil(most / finest + 1e-9))).toPrecision(12))];
  if (least > 0 && most / least > WIDE) return decades(least, most);
  const span = most - least;
  if (!(span > 1e-9 * Math.max(Math.abs(least), Math.abs(most)))) return [Number(least.toPrecision(3))];
  const step = niceStep(span, BANDS);
  const first = Math.ceil(least / step - 1e-9);
  const levels = [];
  for (let k = first; k * step <= most + 1e-9 * step; k++)
    if (k * step > known[0]) levels.push(Number((k * step).toPrecision(12))); // below it there is no place
  return levels.length ? levels : [Number(((least + most) / 2).toPrecision(2))];
}

/** 1, 2, 5, 10 … @param {number} least @param {number} most */
function decades(least, most) {
  const levels = [];
  for (let e = Math.floor(Math.log10(least)); e <= Math.ceil(Math.log10(most)); e++)
    for (const m of [1, 2, 5]) levels.push(Number((m * 10 ** e).toPrecision(12)));
  return levels.filter((v) => v >= least && v <= most);
}
