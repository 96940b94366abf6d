/**
 * The rig in hand: it stands or flies, one steps it, pushes it, and changes its controller in the air. The twin of
 * heli2dof_core/flight/rig.py, line by line: a log that one of them writes the other flies to the same digits. Pure.
 * @typedef {import('../kernel/index.js').Flights} Flights
 * @typedef {import('../kernel/flights.js').Controller} Controller
 * @typedef {import('../kernel/flights.js').Flying} Flying
 * @typedef {import('./designs.js').Aboard} Aboard
 * @typedef {import('./designs.js').Body} Body
 * @typedef {[tick: number, word: string, ...values: (number|Body)[]]} LogEvent  as it stands in a log
 *
 * @typedef {object} Takeover  how a controller took over in the air
 * @property {number} tick
 * @property {number} time  s
 * @property {[number, number]} jump  of V_p and V_y that remains, V
 * @property {[number, number]} jumpWithout  what it would have been with the integrals as they were, V
 * @property {boolean} bumpless  whether the integrals drive both motors, so that neither voltage need jump
 *
 * @typedef {object} Snapshot  all from which a flight goes on as it did
 * @property {Aboard} aboard
 * @property {Flying} flying
 * @property {Float64Array} u
 * @property {number} before
 * @property {number} since
 * @property {Waiting|null} waiting
 * @property {number} events  how many there were
 * @property {number} takeovers
 * @property {number} checks
 *
 * @typedef {{aboard: Aboard, u: Float64Array}} Waiting  for the next sample, and what acted before it
 */
import {
  CONSTANT,
  CONTROLLER,
  ENDS,
  INPUT,
  LOG,
  MEMORY,
  MODE,
  MOST_AT_ONCE,
  ROW,
  TAKEN_OVER,
} from '../kernel/index.js';
import { t } from '../text/index.js';
import { act, DESIGN, keepGust, nothingActs, requireEvent } from './events.js';

const { FLIGHT_ROW } = ROW;

export class Craft {
  /** All that has been done to it, in order: what a log keeps. @type {LogEvent[]} */ events = [];
  /** One for each change of the controller. @type {Takeover[]} */ takeovers = [];
  /** (tick, θ, ψ, θ̇, ψ̇) on the way. @type {number[][]} */ checks = [];
  /** @type {Waiting|null} */ #waiting = null;
  /** @type {Aboard} */ #aboard;
  /** @type {Flying} */ #flying;
  #flights;
  #before = 0; // time of the tick from which `since` counts, s
  #since = 0;

  /**
   * At rest where the design's experiment begins.
   * @param {Flights} flights @param {Aboard} aboard  the design that flies @param {number} [seed]  of the noise
   */
  constructor(flights, aboard, seed = 0) {
    this.#flights = flights;
    this.#aboard = aboard;
    this.seed = seed;
    this.u = nothingActs();
    this.u[INPUT.SEED] = seed;
    this.#flying = flights.begun(aboard.controller);
    this.#noise();
    act(this.u, 'reference', aboard.reference, 0, this.step);
  }

  #noise() {
    this.u.set(this.#aboard.noises, INPUT.NOISE);
  }

  /** The design that flies; one that waits for the controller's next sample does not yet. */
  get aboard() {
    return this.#aboard;
  }

  /** The design that flies, or will from the next sample on. */
  get next() {
    return this.#waiting?.aboard ?? this.#aboard;
  }

  /** Whether another controller waits for the next sample. */
  get waiting() {
    return this.#waiting !== null;
  }

  /** Ticks flown. */
  get tick() {
    return this.#flying.s[MEMORY.TICK];
  }

  /** Seconds flown. */
  get time() {
    return this.#before + (this.tick - this.#since) * this.step;
  }

  /** Length of a tick, s. */
  get step() {
    const { k } = this.#aboard.controller;
    return k[CONTROLLER.TIME] / k[CONTROLLER.TICKS];
  }

  /** That of the next tick, where another controller may have taken over. */
  get nextStep() {
    const { k } = (this.untilSample ? this.#aboard : this.next).controller;
    return k[CONTROLLER.TIME] / k[CONTROLLER.TICKS];
  }

  /** Ticks in a sample of the controller. */
  get ticksPerSample() {
    return this.#aboard.controller.k[CONTROLLER.TICKS];
  }

  /** Ticks until the controller's next sample; 0: now. */
  get untilSample() {
    const phase = this.#flying.s[MEMORY.PHASE];
    return phase === 0 ? 0 : this.ticksPerSample - phase;
  }

  /** Pitch, rad. */
  get theta() {
    return this.#flying.y[0];
  }

  /** Yaw, rad. */
  get psi() {
    return this.#flying.y[1];
  }

  /** θ̇ and ψ̇, rad/s. @returns {[number, number]} */
  get rates() {
    return [this.#flying.y[2], this.#flying.y[3]];
  }

  /** V_p and V_y that the motors have, V. @returns {[number, number]} */
  get volts() {
    const { s } = this.#flying;
    return [s[MEMORY.HAS], s[MEMORY.HAS + 1]];
  }

  /** Rotors' speeds, as the voltages that keep them, V. @returns {[number, number]} */
  get speeds() {
    return [this.#flying.y[6], this.#flying.y[7]];
  }

  /** V_p and V_y at most, V. @returns {[number, number]} */
  get limits() {
    const { c } = this.#aboard.controller;
    return [c[CONSTANT.LIMIT], c[CONSTANT.LIMIT + 1]];
  }

  /** Pitch at most to either side of level, rad. */
  get travel() {
    return this.#aboard.controller.c[CONSTANT.TRAVEL];
  }

  /** Impacts on the stops so far. */
  get impacts() {
    return this.#flying.s[MEMORY.HITS];
  }

  /** Whether the sticks are the motors' voltages. */
  get hands() {
    return this.u[INPUT.MANUAL] !== 0;
  }

  /** Set points of θ and ψ now, rad. @returns {[number, number]} */
  get reference() {
    const { u } = this;
    const since = (this.tick - u[INPUT.TURN_FROM]) * this.step;
    const now = (/** @type {number} */ i) => u[INPUT.REFERENCE + i] + since * u[INPUT.TURN + i];
    return [now(0), now(1)];
  }

  /** Why it flies no more; empty while it does. */
  get ended() {
    const how = this.#flying.s[MEMORY.ENDED_AS];
    if (how === ENDS.ENDED) return '';
    return how === ENDS.OUT_OF_BOUNDS
      ? t('It has turned more than 150 times.')
      : t('Its course cannot be followed any more.');
  }

  /**
   * Something happens now: one of a log's words, until something else of its kind does.
   * @param {string} word @param {...number} values
   */
  do(word, ...values) {
    const own = values.map((value) => value + 0); // JSON has no −0
    requireEvent(word, own);
    this.events.push([this.tick, word, ...own]);
    const [before, hands] = [this.u.slice(), this.hands];
    act(this.u, word, own, this.tick, this.step);
    if (hands && !this.hands) this.#later(this.#waiting?.aboard ?? this.#aboard, before);
  }

  /** Another design flies on, from the controller's next sample on, without a jump if possible. @param {Aboard} next */
  change(next) {
    this.events.push([this.tick, DESIGN, next.body]);
    this.#later(next, this.u.slice());
  }

  /** It takes over at the next sample from what acted before. @param {Aboard} aboard @param {Float64Array} u */
  #later(aboard, u) {
    this.#waiting = { aboard, u: this.#waiting?.u ?? u };
  }

  /** What waits takes over where a sample begins; `fly` does so by itself. */
  settle() {
    if (this.#waiting && this.#flying.s[MEMORY.PHASE] === 0 && !this.ended) this.#takeOver(this.#waiting);
  }

  /** @param {Waiting} waiting */
  #takeOver({ aboard, u: before }) {
    this.#waiting = null;
    const { controller: old } = this.#aboard;
    const { controller: now } = aboard;
    const { tick, time, step, u } = this;
    const next = now.k[CONTROLLER.TIME] / now.k[CONTROLLER.TICKS];
    if (next !== step) {
      act(u, 'turn', [...u.slice(INPUT.TURN, INPUT.TURN + 2)], tick, step); // references move on from where they are
      keepGust(u, tick, step / next);
    }
    const told = this.#flights.takeOver(this.#flying, old, before, now, u);
    const { y, s, free } = this.#flying;
    if (!told.every(Number.isFinite)) {
      s[MEMORY.ENDED_AS] = ENDS.OUT_OF_STEPS;
      return;
    }
    if (Math.abs(y[0]) < now.c[CONSTANT.TRAVEL]) free[MODE.REST] = 0n; // another rig's stop may be farther away
    [this.#before, this.#since] = [time, tick];
    this.#aboard = aboard;
    this.#noise();
    const both = (/** @type {number} */ at) => /** @type {[number, number]} */ ([told[at], told[at + 1]]);
    this.takeovers.push({
      ...{ tick, time, jump: both(TAKEN_OVER.JUMP), jumpWithout: both(TAKEN_OVER.JUMP_WITHOUT) },
      bumpless: told[TAKEN_OVER.BUMPLESS] !== 0,
    });
  }

  /**
   * Flies on.
   * @param {number} ticks
   * @returns {Float64Array} a row (ROW) per tick as it begins, until the next call; fewer where the flight has ended
   */
  fly(ticks) {
    /** @type {Float64Array[]} */ const parts = [];
    let done = 0;
    while (done < ticks && !this.ended) {
      this.settle();
      let count = Math.min(ticks - done, MOST_AT_ONCE);
      if (this.#waiting) count = Math.min(count, this.untilSample);
      const from = this.tick;
      const rows = this.#numbers(this.#flights.fly(this.#flying, this.#aboard.controller, this.u, count));
      this.#check(rows, from);
      done += rows.length / FLIGHT_ROW;
      if (count === ticks) return rows;
      parts.push(rows.slice());
    }
    return joined(parts, done * FLIGHT_ROW);
  }

  /**
   * The rows that were just flown, as far as they are numbers: at the first that is none the flight has ended. An
   * observer that runs away, under hands or not, is infinite before the rig is.
   * @param {Float64Array} rows
   */
  #numbers(rows) {
    const at = rows.findIndex((value) => !Number.isFinite(value));
    if (at < 0) return rows;
    const first = Math.floor(at / FLIGHT_ROW);
    const { y, s } = this.#flying;
    y.set(rows.subarray(first * FLIGHT_ROW, first * FLIGHT_ROW + 4));
    s[MEMORY.TICK] -= rows.length / FLIGHT_ROW - first;
    s[MEMORY.ENDED_AS] = ENDS.OUT_OF_STEPS;
    return rows.subarray(0, first * FLIGHT_ROW);
  }

  /** Some states on the way. @param {Float64Array} rows @param {number} from  tick of the first */
  #check(rows, from) {
    const end = from + rows.length / FLIGHT_ROW;
    let mark = Math.max(Math.ceil(from / LOG.CHECK_EVERY), 1) * LOG.CHECK_EVERY;
    for (; mark < end; mark += LOG.CHECK_EVERY) {
      if (mark === this.checks.at(-1)?.[0]) continue;
      const at = (mark - from) * FLIGHT_ROW;
      this.checks.push([mark, ...rows.subarray(at, at + 4)]);
    }
  }

  /** All from which it goes on as it does now. @returns {Snapshot} */
  snapshot() {
    const { y, s, free } = this.#flying;
    return {
      ...{ aboard: this.#aboard, flying: { y: y.slice(), s: s.slice(), free: free.slice() }, u: this.u.slice() },
      ...{ before: this.#before, since: this.#since, waiting: this.#waiting, events: this.events.length },
      ...{ takeovers: this.takeovers.length, checks: this.checks.length },
    };
  }

  /** What has happened since then has not. @param {Snapshot} then  of this flight */
  restore(then) {
    const { y, s, free } = then.flying;
    this.#aboard = then.aboard;
    this.#flying = { y: y.slice(), s: s.slice(), free: free.slice() };
    this.u.set(then.u);
    [this.#before, this.#since, this.#waiting] = [then.before, then.since, then.waiting];
    this.events.length = then.events;
    this.takeovers.length = then.takeovers;
    this.checks.length = then.checks;
  }

  /** Its state now as a log tells it. @returns {number[]} */
  get check() {
    return [this.tick, ...this.#flying.y.subarray(0, 4)];
  }
}

/** @param {Float64Array[]} parts @param {number} length */
function joined(parts, length) {
  if (parts.length === 1) return parts[0];
  const all = new Float64Array(length);
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}
