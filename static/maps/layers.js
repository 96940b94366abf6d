/**
 * What is drawn of a field: the places of its bands, lines and forbidden regions. Pure.
 * @typedef {import('./types.d.ts').Field} Field
 * @typedef {import('./contours.js').Line} Line
 * @typedef {import('./contours.js').Grid} Grid
 * @typedef {{levels: number[], bands: {rings: Line[], lines: Line[]}[], unstable: Line[], unsettled: Line[], missed:
 *   Line[], grid: Grid}} Layers  bands: by level; grid: the values, where there are none those of their neighbours
 */
import { linesOf, regions } from './contours.js';

/**
 * The same values in both halves of the plane, as poles come in pairs.
 * @param {Field} field  rows from the real axis upwards
 * @returns {Field} rows from the top to the bottom
 */
export function mirrored(field) {
  const { columns, rows, values, stable, abscissa, others } = field;
  const all = 2 * rows - 1;
  const both = (/** @type {ArrayLike<number>} */ of) => {
    const out = new Float64Array(columns * all);
    for (let y = 0; y < all; y++)
      for (let x = 0; x < columns; x++) out[y * columns + x] = of[Math.abs(rows - 1 - y) * columns + x];
    return out;
  };
  return {
    ...field,
    rows: all,
    values: both(values),
    stable: Uint8Array.from(both(stable)),
    abscissa: both(abscissa),
    others: others.map(both),
  };
}

/**
 * The same, its rows the other way round: the first one is at the top of a picture.
 * @param {Field} field @returns {Field}
 */
export function upright(field) {
  const { columns, rows } = field;
  const turned = (/** @type {ArrayLike<number>} */ of) =>
    Float64Array.from({ length: columns * rows }, (_, i) => {
      const [x, y] = [i % columns, Math.floor(i / columns)];
      return of[(rows - 1 - y) * columns + x];
    });
  const { values, stable, abscissa, others } = field;
  return {
    ...field,
    values: turned(values),
    stable: Uint8Array.from(turned(stable)),
    abscissa: turned(abscissa),
    others: others.map(turned),
  };
}

/**
 * @param {Field} field
 * @param {(v: number) => number} inUnit  of its values
 * @param {number[]} levels  in that unit
 * @param {{max?: number, min?: number}[]} limits  required of the values, then of the others, in their own units
 * @returns {Layers}
 */
export function layersOf(field, inUnit, levels, limits) {
  const { columns, rows, stable, abscissa } = field;
  const size = { columns, rows };
  const there = Array.from(field.values, (v, i) => stable[i] === 2 && !Number.isNaN(v));
  const top = (levels.at(-1) ?? 0) + Math.abs((levels.at(-1) ?? 1) - (levels.at(-2) ?? 0)) + 1e-9;
  const shown = Float64Array.from(field.values, (v, i) => (there[i] ? finite(inUnit(v), top) : NaN));
  const grid = { ...size, values: extended(shown, columns, rows) };
  const bands = levels.map((level) => {
    const rings = regions(grid, level);
    return { rings, lines: linesOf(rings, grid) };
  });
  const none = Array.from(there, (known, i) => !known && stable[i] === 2);
  const growth = Float64Array.from(abscissa, (v, i) => (v < 0 === (stable[i] === 2) ? v : stable[i] === 2 ? -1e-9 : 1));
  return {
    levels,
    bands,
    grid,
    unstable: regions({ ...size, values: growth }, 0),
    unsettled: none.includes(true) ? regions({ ...size, values: softened(none, columns, rows) }, 0.5) : [],
    missed: limits.flatMap((limit, k) => {
      const values = k ? field.others[k - 1] : field.values;
      if (!values) return []; // the server has not been asked for it
      return missedOf(values, field, limit).flatMap((excess) => regions({ ...size, values: excess }, 0));
    }),
  };
}

/** What is unlimited lies just beyond the last level. @param {number} v @param {number} top */
const finite = (v, top) => (Number.isFinite(v) ? v : Math.sign(v) * top);

/**
 * By how much limits are missed: positive where they are.
 * @param {Float64Array} values @param {Field} field @param {{max?: number, min?: number}} limit
 * @returns {Float64Array[]} of each limit
 */
function missedOf(values, { columns, rows, stable }, { max, min }) {
  const excess = (/** @type {(v: number) => number} */ of, /** @type {number} */ scale) => {
    const known = Float64Array.from(values, (v, i) => {
      if (stable[i] !== 2) return NaN; // forbidden by itself
      return Number.isNaN(v) ? scale : Math.max(-1e12, Math.min(1e12, of(v)));
    });
    return extended(known, columns, rows);
  };
  return [
    ...(max === undefined ? [] : [excess((v) => v - max * (1 + 1e-9), Math.abs(max) || 1)]),
    ...(min === undefined ? [] : [excess((v) => min * (1 - 1e-9) - v, Math.abs(min) || 1)]),
  ];
}

/**
 * Where there is no value the nearest one of its row, else that of the row before: what lies there is hatched, and
 * only has to go on smoothly.
 * @param {Float64Array} values @param {number} columns @param {number} rows
 */
function extended(values, columns, rows) {
  const out = values.slice();
  /** @type {number[]} */ const empty = [];
  for (let y = 0; y < rows; y++) {
    const row = out.subarray(y * columns, (y + 1) * columns);
    let last = NaN;
    for (let x = 0; x < columns; x++) Number.isNaN(row[x]) ? (row[x] = last) : (last = row[x]);
    if (Number.isNaN(last)) empty.push(y);
    for (let x = columns - 1; x >= 0; x--) Number.isNaN(row[x]) ? (row[x] = last) : (last = row[x]);
  }
  if (empty.length === rows) return out.fill(0);
  for (const y of [...empty, ...empty.toReversed()]) {
    if (!Number.isNaN(out[y * columns])) continue;
    const near = [y - 1, y + 1].find((v) => v >= 0 && v < rows && !Number.isNaN(out[v * columns]));
    if (near !== undefined) out.copyWithin(y * columns, near * columns, (near + 1) * columns);
  }
  return out;
}

/** A mask without its steps. @param {boolean[]} mask @param {number} columns @param {number} rows */
function softened(mask, columns, rows) {
  return Float64Array.from(mask, (own, i) => {
    const [x, y] = [i % columns, Math.floor(i / columns)];
    const at = (/** @type {number} */ dx, /** @type {number} */ dy) => {
      const [u, v] = [Math.max(0, Math.min(columns - 1, x + dx)), Math.max(0, Math.min(rows - 1, y + dy))];
      return Number(mask[v * columns + u]);
    };
    return Number(own) / 2 + (at(1, 0) + at(-1, 0) + at(0, 1) + at(0, -1)) / 8;
  });
}
