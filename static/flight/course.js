/**
 * The course of a flight's last minute, row by row, for charts that are drawn anew. Pure.
 * @typedef {object} Rows
 * @property {Float64Array} rows  ROW.FLIGHT_ROW numbers each
 * @property {number} count
 * @property {number} step  s from one to the next; where it has changed on the way, that of the newest
 * @property {number} firstTick
 * @property {number} time  of the first, s
 * @property {Float64Array} times  of each, s
 */
import { ROW } from '../kernel/index.js';

const { FLIGHT_ROW } = ROW;
/** What is kept, s; and of faster ticks one in so many seconds. */
export const KEPT = 61;
const SPACING = 1e-3;
const ROWS = 1024; // in a piece

/** @typedef {{rows: Float64Array, times: Float64Array, ticks: Float64Array, count: number, step: number}} Piece */

export class Course {
  /** @type {Piece[]} */ #pieces = [];

  /** @param {Float64Array} rows @param {number} step @param {number} tick of the first @param {number} time */
  put(rows, step, tick, time) {
    const every = Math.max(Math.round(SPACING / step), 1);
    const count = rows.length / FLIGHT_ROW;
    for (let i = (every - (tick % every)) % every; i < count; i += every) {
      const piece = this.#room(every * step);
      const row = rows.subarray(i * FLIGHT_ROW, (i + 1) * FLIGHT_ROW);
      piece.rows.set(row, piece.count * FLIGHT_ROW);
      piece.times[piece.count] = time + i * step;
      piece.ticks[piece.count] = tick + i;
      piece.count += 1;
    }
  }

  /** @param {number} step */
  #room(step) {
    const last = this.#pieces.at(-1);
    if (last && last.count < ROWS && last.step === step) return last;
    const end = last ? last.times[last.count - 1] : 0;
    while (this.#pieces.length && this.#pieces[0].times[this.#pieces[0].count - 1] < end - KEPT) this.#pieces.shift();
    const made = {
      ...{ rows: new Float64Array(ROWS * FLIGHT_ROW), times: new Float64Array(ROWS) },
      ...{ ticks: new Float64Array(ROWS), count: 0, step },
    };
    this.#pieces.push(made);
    return made;
  }

  /** What was from this tick on has not been. @param {number} tick */
  cut(tick) {
    for (const piece of this.#pieces) {
      const kept = piece.ticks.subarray(0, piece.count).findIndex((own) => own >= tick);
      if (kept >= 0) piece.count = kept;
    }
    this.#pieces = this.#pieces.filter(({ count }) => count > 0);
  }

  /** @param {number} seconds @returns {Rows} copies */
  last(seconds) {
    const newest = this.#pieces.at(-1);
    const from = newest ? newest.times[newest.count - 1] - seconds : 0;
    const parts = this.#pieces.flatMap(({ rows, times, ticks, count }) => {
      const first = times.subarray(0, count).findIndex((own) => own >= from);
      return first < 0 ? [] : [{ rows, times, ticks, first, count }];
    });
    const count = parts.reduce((sum, own) => sum + own.count - own.first, 0);
    const out = { rows: new Float64Array(count * FLIGHT_ROW), times: new Float64Array(count) };
    let at = 0;
    for (const { rows, times, first, count: end } of parts) {
      out.rows.set(rows.subarray(first * FLIGHT_ROW, end * FLIGHT_ROW), at * FLIGHT_ROW);
      out.times.set(times.subarray(first, end), at);
      at += end - first;
    }
    const [{ ticks, first }] = parts.length ? parts : [{ ticks: [0], first: 0 }];
    return { ...out, count, step: newest?.step ?? 0, firstTick: ticks[first], time: out.times[0] ?? 0 };
  }
}
