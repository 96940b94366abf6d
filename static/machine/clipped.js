/**
 * The parts of a line within a box (Liang and Barsky 1984): dashes far outside take 250 ms.
 * @typedef {[number, number]} Point
 * @param {readonly Point[]} line @param {{width: number, height: number}} box
 * @returns {Point[][]}
 */
export function clipped(line, { width, height }) {
  /** @type {Point[][]} */ const parts = [];
  let open = false;
  line.slice(1).forEach((b, i) => {
    const a = line[i];
    let [from, to] = [0, 1]; // shares of a segment
    [width, height].forEach((size, k) => {
      const by = b[k] - a[k];
      const ends = by ? [-a[k] / by, (size - a[k]) / by] : a[k] < 0 || a[k] > size ? [1, 0] : [0, 1];
      if (by < 0) ends.reverse();
      from = Math.max(from, ends[0]);
      to = Math.min(to, ends[1]);
    });
    const at = (/** @type {number} */ s) => /** @type {Point} */ (a.map((v, k) => v + s * (b[k] - v)));
    if (from > to) open = false;
    else {
      if (open && from === 0) parts[parts.length - 1].push(at(to));
      else parts.push([at(from), at(to)]);
      open = to === 1;
    }
  });
  return parts;
}
