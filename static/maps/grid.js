/**
 * The places of a map, a grid of nodes that is filled from coarse to fine: what is coarse is part of what is finer, so
 * that nothing is computed twice. Pure.
 */

/** Nodes of the whole grid: 128 × 96 cells, so that lines are smooth. */
export const COLUMNS = 129;
export const ROWS = 97;
/** From one node to the next, in the grid's, at first and then. */
const STRIDES = [8, 4, 2, 1];

/**
 * In which order nodes come.
 * @param {number} columns @param {number} rows  multiples of the first stride, and one
 * @param {number[]} [strides]
 * @returns {{order: Uint16Array, stops: number[]}} nodes, row by row; and how many belong to each stride's grid
 */
export function refined(columns, rows, strides = STRIDES) {
  const seen = new Uint8Array(columns * rows);
  /** @type {number[]} */ const order = [];
  const stops = strides.map((stride) => {
    for (let y = 0; y < rows; y += stride)
      for (let x = 0; x < columns; x += stride) {
        const node = y * columns + x;
        if (!seen[node]) order.push(node);
        seen[node] = 1;
      }
    return order.length;
  });
  return { order: Uint16Array.from(order), stops };
}

/** @typedef {import('./types.d.ts').Field} Field */

/**
 * The finest grid that is known as a whole, in arrays of its own.
 * @param {{order: Uint16Array, stops: number[]}} how
 * @param {{columns: number, rows: number}} size
 * @param {import('../kernel/designs.js').Found} found  in that order; of its measures the first is the map's
 * @param {number} measures
 * @returns {Omit<Field, 'domain'>|null} null where not even the coarsest is
 */
export function fieldOf({ order, stops }, { columns, rows }, found, measures) {
  const level = stops.findLastIndex((stop) => stop <= found.done);
  if (level < 0) return null;
  const stride = strideOf(level, stops.length);
  const [across, down] = [(columns - 1) / stride + 1, (rows - 1) / stride + 1];
  const field = {
    columns: across,
    rows: down,
    values: new Float64Array(across * down),
    stable: new Uint8Array(across * down),
    abscissa: new Float64Array(across * down),
    others: Array.from({ length: measures - 1 }, () => new Float64Array(across * down)),
    whole: found.done === order.length,
  };
  for (let k = 0; k < stops[level]; k++) {
    const [x, y] = [order[k] % columns, Math.floor(order[k] / columns)];
    const to = (y / stride) * across + x / stride;
    field.values[to] = found.values[k * measures];
    field.stable[to] = found.stable[k];
    field.abscissa[to] = found.abscissa[k];
    for (const [m, other] of field.others.entries()) other[to] = found.values[k * measures + m + 1];
  }
  return field;
}

/** @param {number} level @param {number} levels */
const strideOf = (level, levels) => 2 ** (levels - 1 - level);
