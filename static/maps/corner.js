/** Where in the s-plane the plane of a real pair hides least. Pure. */

/** What it takes of the lower half, with room beside it, px. */
const TAKEN = 170;

/**
 * On which side of the lower half; the upper one says the same of conjugate poles.
 * @param {[number, number][]} marks pixels
 * @param {{width: number, height: number}} view
 * @returns {'left'|'right'} right where both are alike: the unstable side needs no map
 */
export function emptierSide(marks, { width, height }) {
  const low = marks.filter(([, y]) => y >= height / 2 - 1 && y <= height);
  const left = low.filter(([x]) => x >= 0 && x <= TAKEN).length;
  const right = low.filter(([x]) => x <= width && x >= width - TAKEN).length;
  return left < right ? 'left' : 'right';
}
