/**
 * The course of a flight as a strip chart keeps it: bins of 10 ms, each with the least and the largest value of every
 * channel, so that nothing is lost that is shorter than what can be drawn, and drawing costs the same however short a
 * tick is. It reaches far enough back for a rewind of 60 s to find the 20 s before it. Pure; nothing is made per row.
 */
import { ROW } from '../kernel/index.js';

const { FLIGHT_ROW, STATE, SENSED, VOLTAGE, WISH, OUTSIDE, ON_STOP } = ROW;

/** Width of a bin, s: as a fraction of a second, so that whole seconds begin with one. */
export const BINS_PER_SECOND = 100;
/** Bins that are kept; a power of two. */
export const KEPT = 8192;
/** Of a bin's width: by so much a tick may begin early and still be counted to it. */
const ROUNDING = 1e-6;

/** Channels: true angles and rates, the same as measured, voltages, set points, torques from outside; two each. */
export const CHANNEL = { ANGLE: 0, RATE: 2, SEEN: 4, SEEN_RATE: 6, VOLTS: 8, WISH: 10, TORQUE: 12 };
const COLUMNS = [STATE, SENSED, VOLTAGE, WISH, OUTSIDE].flatMap((at) =>
  Array.from({ length: at === STATE || at === SENSED ? 4 : 2 }, (_, i) => at + i),
);
export const CHANNELS = COLUMNS.length;
/** What was so in a bin: V_p at its limit, V_y at its limit, pitch on a stop. */
export const FLAG = { FULL: 1, FULL_YAW: 2, STOP: 4 };

export class Trace {
  /** Bin k's values stand at (k mod KEPT)·CHANNELS. */
  low = new Float32Array(KEPT * CHANNELS);
  high = new Float32Array(KEPT * CHANNELS);
  /** V_p and V_y at most, V. */
  limits = new Float32Array(KEPT * 2);
  flags = new Uint8Array(KEPT);
  /** The first bin that is kept. */ first = 0;
  /** The bin that is being filled: those before it are whole. */ head = 0;
  #begun = false;

  /** Nothing has been flown. */
  clear() {
    [this.first, this.head, this.#begun] = [0, 0, false];
  }

  /**
   * Ticks that were flown.
   * @param {Float64Array} rows  ROW.FLIGHT_ROW numbers each
   * @param {number} count
   * @param {number} step  s from one to the next
   * @param {number} time  of the first, s; where it lies before what is known, that has not happened
   * @param {ArrayLike<number>} limits  V_p and V_y at most, V
   */
  put(rows, count, step, time, limits) {
    if (count > 0 && this.#begun && binOf(time) < this.head) this.cut(time);
    for (let i = 0; i < count; i++) {
      const bin = binOf(time + i * step);
      if (!this.#begun || bin > this.head) this.#open(bin, limits);
      this.#add(rows, i * FLIGHT_ROW, limits);
    }
  }

  /** @param {number} bin @param {ArrayLike<number>} limits */
  #open(bin, limits) {
    if (!this.#begun || bin - this.head >= KEPT) this.first = bin;
    const from = this.#begun ? Math.max(this.head + 1, this.first) : bin;
    for (let k = from; k <= bin; k++) {
      const slot = k & (KEPT - 1);
      this.low.fill(Infinity, slot * CHANNELS, (slot + 1) * CHANNELS);
      this.high.fill(-Infinity, slot * CHANNELS, (slot + 1) * CHANNELS);
      this.flags[slot] = 0;
      this.limits[2 * slot] = limits[0];
      this.limits[2 * slot + 1] = limits[1];
    }
    this.head = bin;
    this.first = Math.max(this.first, bin - KEPT + 1);
    this.#begun = true;
  }

  /** @param {Float64Array} rows @param {number} at @param {ArrayLike<number>} limits */
  #add(rows, at, limits) {
    const { low, high } = this;
    const slot = this.head & (KEPT - 1);
    for (let c = 0, to = slot * CHANNELS; c < CHANNELS; c++, to++) {
      const value = rows[at + COLUMNS[c]];
      if (value < low[to]) low[to] = value;
      if (value > high[to]) high[to] = value;
    }
    this.flags[slot] |= flagsOf(rows, at, limits);
  }

  /** What was from this time on has not been; the bin in which it lies is begun anew. @param {number} time  s */
  cut(time) {
    const bin = binOf(time);
    if (!this.#begun || bin > this.head) return;
    if (bin <= this.first) this.clear();
    else this.head = bin - 1; // the next row opens the bin
  }

  /**
   * The least and the largest value of some channels over whole bins; Infinity and −Infinity where there is none.
   * @param {readonly number[]} channels @param {number} from  bin @param {number} to  bin behind the last
   * @param {[number, number]} out
   */
  extremes(channels, from, to, out) {
    let [least, most] = [Infinity, -Infinity];
    for (let k = Math.max(from, this.first); k < to; k++) {
      const slot = (k & (KEPT - 1)) * CHANNELS;
      for (const channel of channels) {
        if (this.low[slot + channel] < least) least = this.low[slot + channel];
        if (this.high[slot + channel] > most) most = this.high[slot + channel];
      }
    }
    [out[0], out[1]] = [least, most];
  }
}

/** @param {number} time  s */
export const binOf = (time) => Math.floor(time * BINS_PER_SECOND + ROUNDING);

/**
 * What is remarkable in a row.
 * @param {Float64Array} rows @param {number} at  where the row begins @param {ArrayLike<number>} limits  V
 */
export function flagsOf(rows, at, limits) {
  return (
    (Math.abs(rows[at + VOLTAGE]) >= limits[0] ? FLAG.FULL : 0) |
    (Math.abs(rows[at + VOLTAGE + 1]) >= limits[1] ? FLAG.FULL_YAW : 0) |
    (rows[at + ON_STOP] !== 0 ? FLAG.STOP : 0)
  );
}
