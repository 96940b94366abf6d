/**
 * The curves while something else moves: coarse, from the page's workers. What these do not serve waits for the server,
 * which is asked when the hand rests.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {import('../contract.js').TrackReply} TrackReply
 * @typedef {import('./numbers.js').Swept} Swept
 * @typedef {Pick<TrackReply, 'plane'|'values'|'starts'|'poles'|'crossings'|'zeros'>} Curves
 */
import { AT, fill, serves, sizeOf } from '../kernel/index.js';
import { along } from './courses.js';
import { designAt, isOfDesign } from './numbers.js';

const COUNT = 64;

export class Moving {
  /** @type {import('../kernel/designs.js').Lane|null} */ #lane = null;

  /** @param {() => import('../kernel/index.js').Designs|null} designs  the workers, once they are there */
  constructor(designs) {
    this.designs = designs;
  }

  /**
   * @param {Design} design @param {Preset|undefined} preset @param {Swept} swept
   * @param {readonly [number, number]} range  SI @param {(curves: Curves) => void} then
   * @returns {boolean} whether the page computes it
   */
  ask(design, preset, swept, range, then) {
    const { path, kept, log } = swept;
    if (kept || !isOfDesign(path) || path.startsWith('scenario.') || path.startsWith('weights.')) return false;
    this.#lane ??= this.designs()?.lane() ?? null;
    if (!preset || !this.#lane?.designs.works) return false;
    const { value } = along(range, log);
    const values = Array.from({ length: COUNT }, (_, k) => value(k / (COUNT - 1)));
    const designs = values.flatMap((v) => designAt(design, path, v) ?? []);
    const size = sizeOf(designs[COUNT >> 1], preset);
    if (!designs.every((own) => serves(own, preset) && sizeOf(own, preset) === size)) return false;
    const rows = designs.map((own) => filled(own, preset));
    const at = [...rows[0].keys()].filter((k) => rows.some((row) => !Object.is(row[k], rows[0][k])));
    const changes = new Float64Array(COUNT * at.length);
    for (const [i, row] of rows.entries())
      for (const [k, place] of at.entries()) changes[i * at.length + k] = row[place];
    if (!at.length) return false;
    const task = { numbers: rows[0], size, at, values: changes, measures: [], poles: true, workers: 1 };
    this.#lane.ask(task, (found) => found && then(curvesOf(values, found.poles, found.stable, size)));
    return true;
  }

  forget() {
    this.#lane?.forget();
  }
}

/** @param {Design} design @param {Preset} preset */
function filled(design, preset) {
  const numbers = new Float64Array(AT.NUMBERS);
  fill(numbers, design, preset);
  return numbers;
}

/**
 * @param {number[]} values
 * @param {Float64Array} poles  (n, size, 2), 0 behind the last of each
 * @param {Uint8Array} stable  0: there is no such design
 * @param {number} size
 * @returns {Curves}
 */
export function curvesOf(values, poles, stable, size) {
  const there = values.map((_, k) => k).filter((k) => stable[k]);
  /** @type {Complex[][]} */ const rows = there.map((k) =>
    Array.from({ length: size }, (_, i) => {
      const at = 2 * (k * size + i);
      return { re: poles[at], im: poles[at + 1] };
    }),
  );
  const starts = there.flatMap((k, i) => (i && there[i - 1] === k - 1 ? [] : [i]));
  for (let i = 1; i < rows.length; i++) rows[i] = matched(rows[i - 1], rows[i]);
  const courses = Array.from({ length: size }, (_, j) => rows.map((row) => row[j]));
  const own = courses.filter((course) => course.some(({ re, im }) => re !== 0 || im !== 0));
  return { plane: 's', values: there.map((k) => values[k]), starts, poles: own, crossings: [], zeros: [] };
}

/**
 * The poles in the order of those before them: the nearest ones first.
 * @param {Complex[]} before @param {Complex[]} after
 */
export function matched(before, after) {
  const pairs = before.flatMap((p, i) => after.map((q, j) => ({ i, j, away: Math.hypot(p.re - q.re, p.im - q.im) })));
  pairs.sort((a, b) => a.away - b.away);
  /** @type {Complex[]} */ const out = [];
  const taken = new Set();
  for (const { i, j } of pairs) {
    if (out[i] || taken.has(j)) continue;
    out[i] = after[j];
    taken.add(j);
  }
  return out;
}
