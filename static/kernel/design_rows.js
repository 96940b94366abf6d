/**
 * Designs one after the other by the kernel `run_designs`: of each the figures that are asked for. Pure.
 * @typedef {import('./found.js').Measure} Measure
 * @typedef {object} Uncertain  rigs on which each design is tried
 * @property {number} count
 * @property {ArrayLike<number>} [spreads]  half widths, in the order of the kernel's factors, which are drawn by them
 * @property {Float64Array} [drawn]  by which they differ, row by row, in place of these
 *
 * @typedef {object} Part
 * @property {Float64Array} numbers  of one design, as numbers.js fills them: what all of them share
 * @property {number} size  states of its loop
 * @property {readonly number[]} at  where they differ in the numbers (layout.js)
 * @property {Float64Array} values  what stands there instead, row by row
 * @property {readonly Measure[]} measures
 * @property {Uncertain} [rigs]  needed for shares
 * @property {boolean} [unstable]  whether responses of unstable loops are wanted, too
 * @property {boolean} [poles]  whether the loops' poles are wanted
 *
 * @typedef {object} Values  of n designs
 * @property {Float64Array} values  (n, measures): NaN where there is none, ±∞ where it is unlimited
 * @property {Uint8Array} stable  (n): 2 stable, 1 not, 0 no such design
 * @property {Float64Array} abscissa  (n): the largest real part of the loop's poles, rad/s; NaN where there is none
 * @property {Float64Array} poles  (n, size, 2): of the loops, slowest first, 0 behind the last one; or empty
 */
import { exists, isStable, leaveOut, valueOf } from './found.js';
import { AT, FACTORS, FIGURES, FOUND, RIGS } from './layout.js';
import { Block } from './module.js';
import { fillFactors } from './random.js';
import { designs, many } from './shapes.js';
import { arrays, Updates } from './updates.js';

/** Designs in one call, at most. */
const BATCH = 64;
const SAMPLES = 2;
/**
 * @typedef {{numbers: Block, factors: Block, times: Block, poles: Block, found: Block, run: (n: number) => void}} Room
 */

export class DesignRows {
  #updates;
  /** By states, rigs and the times at which their responses are looked at. @type {Map<string, Room>} */
  #rooms = new Map();
  /** What the factors were drawn by. @type {WeakMap<Room, string>} */ #drawn = new WeakMap();

  /** @param {import('./module.js').Kernels} kernels */
  constructor(kernels) {
    this.kernels = kernels;
    this.#updates = new Updates(kernels);
  }

  /** @param {Part} part @returns {Values} in memory of its own */
  run({ numbers, size, at, values, measures, rigs, unstable = false, poles = false }) {
    const base = numbers.slice();
    const runs = leaveOut(base, measures, unstable);
    const within = measures.some(({ name }) => name === 'share_within_limits');
    const shares = within || measures.some(({ name }) => name === 'share_stable');
    const room = this.#roomFor(size, shares && rigs ? rigs.count : 0, within ? RIGS.TIMES : 1);
    if (shares && rigs) this.#tryOn(room, rigs, base[AT.DURATION]);
    const n = at.length ? values.length / at.length : 1;
    const out = {
      values: new Float64Array(n * measures.length),
      stable: new Uint8Array(n),
      abscissa: new Float64Array(n).fill(NaN),
      poles: new Float64Array(poles ? 2 * n * size : 0),
    };
    for (let from = 0; from < n; from += BATCH) {
      const count = Math.min(BATCH, n - from);
      const rows = room.numbers.floats;
      for (let i = 0; i < count; i++) {
        rows.set(base, i * AT.NUMBERS);
        for (const [k, place] of at.entries()) rows[i * AT.NUMBERS + place] = values[(from + i) * at.length + k];
      }
      room.run(count);
      for (let i = 0; i < count; i++) this.#read(room, i, from + i, measures, runs, out);
    }
    return out;
  }

  /**
   * @param {Room} room @param {number} i  in it @param {number} k  in what is told
   * @param {readonly Measure[]} measures @param {import('./found.js').Runs} runs @param {Values} out
   */
  #read(room, i, k, measures, runs, out) {
    const numbers = room.numbers.floats.subarray(i * AT.NUMBERS, (i + 1) * AT.NUMBERS);
    const found = room.found.floats.subarray(i * FOUND.FOUND, (i + 1) * FOUND.FOUND);
    for (const [m, measure] of measures.entries())
      out.values[k * measures.length + m] = valueOf(measure, numbers, found, runs);
    if (!exists(found)) return;
    out.stable[k] = isStable(found) ? 2 : 1;
    const size = room.poles.shape[1];
    const poles = room.poles.floats.subarray(2 * i * size, 2 * (i + 1) * size);
    out.abscissa[k] = -Infinity;
    for (let p = 0; p < found[FOUND.FOUND_FIGURES + FIGURES.CONNECTED]; p++)
      out.abscissa[k] = Math.max(out.abscissa[k], poles[2 * p]);
    if (out.poles.length) out.poles.set(poles, 2 * k * size);
  }

  /** @param {Room} room @param {Uncertain} rigs @param {number} duration  s */
  #tryOn(room, { spreads, drawn }, duration) {
    const times = room.times.floats;
    for (let k = 1; k < times.length; k++) times[k] = (duration * k) / (times.length - 1);
    const key = spreads ? Array.from(spreads).join() : '';
    if (drawn) room.factors.floats.set(drawn);
    else if (spreads && this.#drawn.get(room) !== key) fillFactors(room.factors.floats, spreads, RIGS.LEAST);
    this.#drawn.set(room, drawn ? '' : key);
  }

  /** @param {number} size @param {number} rigs @param {number} times */
  #roomFor(size, rigs, times) {
    const key = [size, rigs, times].join();
    const room = this.#rooms.get(key) ?? this.#made(size, rigs, times);
    this.#rooms.set(key, room);
    return room;
  }

  /** @param {number} size @param {number} rigs @param {number} times @returns {Room} */
  #made(size, rigs, times) {
    const { kernels } = this;
    const own = Object.fromEntries(arrays(kernels, many(size, rigs, times)));
    const { found, found_poles: poles } = Object.fromEntries(arrays(kernels, designs(size, BATCH)));
    const numbers = kernels.array('f64', BATCH, AT.NUMBERS);
    const factors = kernels.array('f64', rigs, FACTORS);
    const values = { ...this.#updates.values(size, SAMPLES), ...own, factors, rtol: RIGS.RTOL };
    /** By the number of designs. @type {(() => unknown)[]} */ const bound = [];
    const run = (/** @type {number} */ n) => {
      const [rows, to, loops] = [numbers, found, poles].map(
        ({ memory, at, type, shape }) => new Block(memory, at, type, [n, shape[1]]),
      );
      bound[n] ??= kernels.bound('run_designs', { ...values, designs: rows, found: to, found_poles: loops });
      bound[n]();
    };
    return { numbers, factors, times: own.times, poles, found, run };
  }
}
