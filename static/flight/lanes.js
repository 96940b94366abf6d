/**
 * The lanes of the strip chart: what each shows, in which unit and on which scale, and where it stands. Each has two
 * scales, pitch's at the left and yaw's at the right, whose divisions lie on the same lines. Pure.
 * @typedef {import('./scales.js').Span} Span
 * @typedef {import('./trace.js').Trace} Trace
 *
 * @typedef {object} Lane
 * @property {string} name
 * @property {string} unit
 * @property {number} factor  from the trace's unit
 * @property {number} decimals  of the values that are read
 * @property {readonly [base: string, sub: string][]} symbols  of pitch's and yaw's
 * @property {number} weight  share of the height
 * @property {number} channel  what is drawn boldly, pitch's; yaw's is the next
 * @property {number} [seen]  the same as measured
 * @property {number} [wish]  its set point
 * @property {import('./scales.js').Ruler} ruler
 *
 * @typedef {{lane: Lane, top: number, height: number}} Place  of the curves, in px
 */
import { DEGREE, fixed, inField } from '../text/index.js';
import { ANGULAR, decimalsOf, DIVISIONS, limited, PLAIN, Scale } from './scales.js';
import { BINS_PER_SECOND, CHANNEL } from './trace.js';

/** @type {Readonly<Record<'angles'|'volts'|'rates'|'torques', Lane>>} */
export const LANE = {
  angles: {
    ...{
      name: 'angles',
      unit: '°',
      factor: DEGREE,
      decimals: 1,
      weight: 2.4,
      ruler: { least: 5, ladder: ANGULAR, floating: true },
    },
    ...{ channel: CHANNEL.ANGLE, seen: CHANNEL.SEEN, wish: CHANNEL.WISH },
    symbols: [
      ['θ', ''],
      ['ψ', ''],
    ],
  },
  volts: {
    ...{
      name: 'volts',
      unit: 'V',
      factor: 1,
      decimals: 1,
      weight: 2,
      ruler: { least: 1, ladder: PLAIN },
      channel: CHANNEL.VOLTS,
    },
    symbols: [
      ['V', 'p'],
      ['V', 'y'],
    ],
  },
  rates: {
    ...{ name: 'rates', unit: '°/s', factor: DEGREE, decimals: 1, weight: 2, ruler: { least: 5, ladder: PLAIN } },
    ...{ channel: CHANNEL.RATE, seen: CHANNEL.SEEN_RATE },
    symbols: [
      ['θ̇', ''],
      ['ψ̇', ''],
    ],
  },
  torques: {
    ...{ name: 'torques', unit: 'N·m', factor: 1, decimals: 3, weight: 1.6, ruler: { least: 0.005, ladder: PLAIN } },
    channel: CHANNEL.TORQUE,
    symbols: [
      ['τ', 'θ'],
      ['τ', 'ψ'],
    ],
  },
};
/** Least height of a lane's curves, px at the usual size of type; of the gap between two. */
const LEAST = 36;
const GAP = 9;
/** Shares of the height at which divisions end. */
const EVEN = Array.from({ length: DIVISIONS + 1 }, (_, i) => i / DIVISIONS);
/** Bins between two looks at all that is seen. */
const LOOKS = 10;
const { angles, volts, rates, torques } = LANE;
/** From top to bottom; where there is no room for all, the last ones go. */
const IN_ORDER = [angles, volts, rates, torques];

/**
 * Where the lanes stand: as many as have room, one above the other.
 * @param {number} height  px, for all
 * @param {number} unit  px to one at the usual size of type
 * @param {number} head  px above each lane's curves, for its values
 * @returns {Place[]}
 */
export function placed(height, unit, head) {
  const gap = GAP * unit;
  let shown = IN_ORDER.length;
  while (shown > 1 && (height - (shown - 1) * gap) / shown - head < LEAST * unit) shown -= 1;
  const lanes = IN_ORDER.slice(0, shown);
  const room = height - (shown - 1) * gap - shown * head;
  const whole = lanes.reduce((sum, { weight }) => sum + weight, 0);
  let top = 0;
  return lanes.map((lane) => {
    const own = { lane, top: Math.round(top + head), height: Math.floor((room * lane.weight) / whole) };
    top = own.top + own.height + gap;
    return own;
  });
}

/** Both scales of a lane, which follow what is seen. */
export class LaneScales {
  #scales;
  #channels;
  /** @type {[number, number]} */ #found = [0, 0];
  #limits = [Infinity, Infinity];
  #looked = -LOOKS;

  /** @param {Lane} lane */
  constructor(lane) {
    this.lane = lane;
    this.#scales = [0, 1].map(() => new Scale(lane.ruler));
    this.#channels = [0, 1].map((axis) =>
      [lane.channel, lane.seen, lane.wish].flatMap((own) => (own === undefined ? [] : [own + axis])),
    );
  }

  /** Of pitch's and of yaw's, in the lane's unit. @returns {[Span, Span]} */
  get spans() {
    return [this.#span(0), this.#span(1)];
  }

  /** @param {number} axis */
  #span(axis) {
    const limit = this.#limits[axis];
    return limit < Infinity ? limited(limit) : this.#scales[axis].span;
  }

  /** Where lines lie behind the curves, as shares of the height from below: those that both scales share. */
  get lines() {
    return this.#limits.some((limit) => limit < Infinity) ? [0.5] : EVEN;
  }

  /**
   * The numbers of a scale: of its divisions, or, of a motor, of its limits.
   * @param {number} axis @param {boolean} few  whether there is room for three at most
   * @returns {{share: number, text: string}[]} share: of the height from below
   */
  numbers(axis, few) {
    const span = this.#span(axis);
    const limit = this.#limits[axis];
    const at = (/** @type {number} */ value) => (value - span.low) / (span.high - span.low);
    if (limit < Infinity) return [-limit, 0, limit].map((value) => ({ share: at(value), text: inField(value) }));
    const shown = EVEN.filter((_, i) => !few || i % 2 === 0);
    const decimals = decimalsOf(span, shown.length - 1);
    return shown.map((share) => ({
      ...{ share, text: fixed(span.low + share * (span.high - span.low), decimals) },
    }));
  }

  /** As at first. */
  reset() {
    for (const scale of this.#scales) scale.reset();
  }

  /**
   * Has all that is seen lie within the scales. What is new may be too large at once; whether less would do is asked
   * ten times a second.
   * @param {Trace} trace
   * @param {number} from  bin @param {number} fresh  the first that is new @param {number} to  behind the last one seen
   * @param {readonly [number, number]} limits  of the motors, V
   * @returns {boolean} whether one is another now
   */
  fit(trace, from, fresh, to, limits) {
    let changed = false;
    const due = to < this.#looked || to >= this.#looked + LOOKS;
    if (due) this.#looked = to;
    for (let axis = 0; axis < 2; axis++) {
      const limit = this.lane === LANE.volts ? limits[axis] : Infinity;
      changed ||= limit !== this.#limits[axis];
      this.#limits[axis] = limit;
      if (limit < Infinity) continue;
      const { factor } = this.lane;
      const scale = this.#scales[axis];
      const found = this.#found;
      trace.extremes(this.#channels[axis], due ? from : fresh, to, found);
      if (!due && !scale.exceeded(found[0] * factor, found[1] * factor)) continue;
      if (!due) trace.extremes(this.#channels[axis], from, to, found);
      if (scale.fit(found[0] * factor, found[1] * factor, to / BINS_PER_SECOND)) changed = true;
    }
    return changed;
  }
}
