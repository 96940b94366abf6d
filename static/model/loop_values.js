/**
 * What stands between the controllers and the inner loop, for the block diagrams. Pure.
 * @typedef {[[number, number], [number, number]]} Two  2×2
 */

/** @param {number[][]} m @returns {Two|undefined} nothing where it is singular */
export function inverseOf([[a, b], [c, d]]) {
  const det = a * d - b * c;
  return Math.abs(det) > 1e-12 * Math.max(Math.abs(a * d), Math.abs(b * c))
    ? [
        [d / det, -b / det],
        [-c / det, a / det],
      ]
    : undefined;
}

/**
 * Which controller's output reaches which command, rows v_p, v_y, columns pitch, yaw: the pairing with its signs, or
 * the static decoupler scaled so that each loop keeps the gain of the channel it is paired with.
 * @param {number[][]|undefined} G0
 * @param {'diagonal'|'cross'} pairing
 * @param {boolean} decoupler
 * @returns {Two|undefined}
 */
export function mixingOf(G0, pairing, decoupler) {
  if (pairing === 'diagonal' && !decoupler)
    return [
      [1, 0],
      [0, 1],
    ];
  if (!G0) return undefined;
  const paired = pairing === 'diagonal' ? [G0[0][0], G0[1][1]] : [G0[0][1], G0[1][0]];
  if (decoupler) {
    const inverse = inverseOf(G0);
    return inverse && /** @type {Two} */ (inverse.map((row) => row.map((v, j) => v * Math.abs(paired[j]))));
  }
  const [pitch, yaw] = paired.map((g) => (g < 0 ? -1 : 1));
  return [
    [0, yaw],
    [pitch, 0],
  ];
}
