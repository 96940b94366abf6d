/**
 * Lines of equal value in a grid of values: marching squares, linear between two nodes. Pure.
 * @typedef {{columns: number, rows: number, values: ArrayLike<number>}} Grid  row by row
 * @typedef {Float64Array} Line  x, y by turns, in columns and rows of the grid
 */

/**
 * The regions where the values are at least so high, as closed rings that also follow the grid's border: outer ones run
 * the one way round, holes the other.
 * @param {Grid} grid  all values finite
 * @param {number} level
 * @returns {Line[]}
 */
export const regions = (grid, level) => traced(padded(grid, level), level).map((ring) => inside(ring, grid));

/**
 * The lines alone, without the border.
 * @param {Line[]} rings  of `regions` @param {Grid} grid
 * @returns {Line[]} open where they end at the border, else with their first point once more at the end
 */
export function linesOf(rings, { columns, rows }) {
  /** @type {Line[]} */ const lines = [];
  for (const ring of rings) {
    const n = ring.length / 2;
    const onBorder = (/** @type {number} */ i, /** @type {number} */ j) =>
      [
        [0, 0],
        [0, columns - 1],
        [1, 0],
        [1, rows - 1],
      ].some(([k, edge]) => ring[2 * i + k] === edge && ring[2 * j + k] === edge);
    const breaks = [];
    for (let i = 0; i < n; i++) if (onBorder(i, (i + 1) % n)) breaks.push(i);
    if (!breaks.length) {
      lines.push(Float64Array.of(...ring, ring[0], ring[1]));
      continue;
    }
    for (const [k, from] of breaks.entries()) {
      const to = breaks[(k + 1) % breaks.length];
      const count = (to - from + n - 1) % n; // segments between two of the border's
      if (!count) continue;
      const line = new Float64Array(2 * (count + 1));
      for (let i = 0; i <= count; i++) line.set(ring.subarray(...pair((from + 1 + i) % n)), 2 * i);
      lines.push(line);
    }
  }
  return lines;
}

/** @param {number} i @returns {[number, number]} */
const pair = (i) => [2 * i, 2 * i + 2];

/**
 * The grid in a frame that is lower than the level, so that every region closes.
 * @param {Grid} grid @param {number} level
 */
function padded({ columns, rows, values }, level) {
  const out = new Float64Array((columns + 2) * (rows + 2)).fill(level - 1);
  for (let y = 0; y < rows; y++)
    for (let x = 0; x < columns; x++) out[(y + 1) * (columns + 2) + x + 1] = values[y * columns + x];
  return { columns: columns + 2, rows: rows + 2, values: out };
}

/** Out of the frame, onto the border. @param {number[]} ring @param {Grid} grid @returns {Line} */
function inside(ring, { columns, rows }) {
  const line = Float64Array.from(ring, (v, i) => Math.max(0, Math.min((i % 2 ? rows : columns) - 1, v - 1)));
  return line;
}

/**
 * Of a cell the edges (0 top, 1 right, 2 bottom, 3 left) by which lines come and go, high values to the right; by which
 * corners are high (1 top left, 2 top right, 4 bottom right, 8 bottom left). Where opposite corners are, the middle
 * decides.
 * @type {Record<number, [number, number][]>}
 */
const WAYS = {
  1: [[0, 3]],
  2: [[1, 0]],
  3: [[1, 3]],
  4: [[2, 1]],
  6: [[2, 0]],
  7: [[2, 3]],
  8: [[3, 2]],
  9: [[0, 2]],
  11: [[1, 2]],
  12: [[3, 1]],
  13: [[0, 1]],
  14: [[3, 0]],
};
/** @type {Record<number, [apart: [number, number][], joined: [number, number][]]>} */
const SADDLES = {
  5: [
    [
      [0, 3],
      [2, 1],
    ],
    [
      [0, 1],
      [2, 3],
    ],
  ],
  10: [
    [
      [1, 0],
      [3, 2],
    ],
    [
      [3, 0],
      [1, 2],
    ],
  ],
};

/** @param {Grid} grid whose border is low @param {number} level @returns {number[][]} closed rings */
function traced({ columns, rows, values }, level) {
  /** Where a line that enters at an edge leaves, both by their numbers. @type {Map<number, number>} */
  const next = new Map();
  // an edge is told by its upper or left node, and by whether it runs down
  const edge = (/** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ side) =>
    2 * ((y + Number(side === 2)) * columns + x + Number(side === 1)) + Number(side % 2);
  for (let y = 0; y < rows - 1; y++) {
    const [from, to] = [y * columns, (y + 1) * columns];
    let [above, below] = [values[from] >= level, values[to] >= level];
    for (let x = 0; x < columns - 1; x++) {
      const [a, d] = [above, below];
      above = values[from + x + 1] >= level;
      below = values[to + x + 1] >= level;
      if (a === above && a === d && a === below) continue;
      const kind = Number(a) + 2 * Number(above) + 4 * Number(below) + 8 * Number(d);
      const middle = (values[from + x] + values[from + x + 1] + values[to + x + 1] + values[to + x]) / 4;
      for (const [come, go] of WAYS[kind] ?? SADDLES[kind][Number(middle >= level)])
        next.set(edge(x, y, come), edge(x, y, go));
    }
  }
  /** @type {number[][]} */ const rings = [];
  for (const begin of next.keys()) {
    /** @type {number[]} */ const ring = [];
    for (let at = begin, to = next.get(at); to !== undefined; at = to, to = next.get(at)) {
      next.delete(at);
      const node = at >> 1;
      const [x, y, down] = [node % columns, Math.floor(node / columns), at % 2];
      const [p, q] = [values[node], values[node + (down ? columns : 1)]];
      const share = (level - p) / (q - p);
      ring.push(x + (down ? 0 : share), y + (down ? share : 0));
    }
    if (ring.length > 4) rings.push(ring);
  }
  return rings;
}

/** The value between nodes. @param {Grid} grid @param {number} x @param {number} y in columns and rows */
export function between({ columns, rows, values }, x, y) {
  const [i, j] = [Math.min(columns - 2, Math.floor(x)), Math.min(rows - 2, Math.floor(y))];
  const [s, t] = [x - i, y - j];
  const at = (/** @type {number} */ di, /** @type {number} */ dj) => values[(j + dj) * columns + i + di];
  return (1 - t) * ((1 - s) * at(0, 0) + s * at(1, 0)) + t * ((1 - s) * at(0, 1) + s * at(1, 1));
}
