/** Percentiles as NumPy has them by default, interpolated linearly between the two nearest values. Pure. */

/**
 * @param {Float64Array} sorted  not empty @param {number} percent
 * @returns {number}
 */
export function percentile(sorted, percent) {
  const place = (sorted.length - 1) * (percent / 100);
  const below = Math.floor(place);
  const share = place - below;
  const [a, b] = [sorted[below], sorted[Math.min(below + 1, sorted.length - 1)]];
  return share < 0.5 ? a + (b - a) * share : b - (b - a) * (1 - share);
}

/**
 * Bands of many responses, (3, times) each: at every time these percentiles of all that stayed finite.
 * @param {Float64Array} angles  (rigs, 2, times) @param {number} rigs  how many of them count @param {number} times
 * @param {readonly number[]} percents
 * @returns {Float64Array[][] | null}  of θ and of ψ, a row for each percentile; null where none stayed finite
 */
export function bandsOf(angles, rigs, times, percents) {
  /** @type {number[]} */ const kept = [];
  for (let i = 0; i < rigs; i++) {
    const at = 2 * times * i;
    // what is given up is so to its end
    if (Number.isFinite(angles[at + times - 1]) && Number.isFinite(angles[at + 2 * times - 1])) kept.push(at);
  }
  if (!kept.length) return null;
  const column = new Float64Array(kept.length);
  return [0, times].map((offset) => {
    const bands = percents.map(() => new Float64Array(times));
    for (let k = 0; k < times; k++) {
      for (let i = 0; i < kept.length; i++) column[i] = angles[kept[i] + offset + k];
      column.sort();
      bands.forEach((band, p) => (band[k] = percentile(column, percents[p])));
    }
    return bands;
  });
}
