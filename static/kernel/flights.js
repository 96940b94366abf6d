/**
 * The kernels of a flight (heli2dof_core/kernels/flight.py, flight_controller.py) of kernels.wasm. What flies is in
 * plain arrays of its own, which are copied into the module's memory and back: several may fly by turns. Pure.
 *
 *     const flights = new Flights(await instantiated(module));
 *     const controller = flights.controller(design, preset); // null: ask the server for its numbers
 *     const body = flights.begun(controller);
 *     const rows = flights.fly(body, controller, u, 100);
 *
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {import('./module.js').Block} Block
 * @typedef {import('./module.js').Kernels} Kernels
 *
 * @typedef {object} Controller  a design's rig and digital controller, laid out as flight_layout.py says
 * @property {Float64Array} numbers  what makes the same controller anywhere
 * @property {Float64Array} c
 * @property {BigInt64Array} m
 * @property {Float64Array} k
 * @property {Float64Array} estimated
 * @property {Float64Array} start  where its experiment begins
 * @property {boolean} stable  whether the linear loop is
 *
 * @typedef {object} Flying  what a flight remembers: its state, and what else; both change as it flies
 * @property {Float64Array} y
 * @property {Float64Array} s
 * @property {BigInt64Array} free
 */
import { CONTROLLER, FLOWN, INPUT, MEMORY, ROW, TAKEN_OVER, WITHIN } from './flight_layout.js';
import { AT, FIGURES, FULL, OUTCOMES } from './layout.js';
import { fill, serves } from './numbers.js';
import { block, scratch } from './shapes.js';
import { arrays } from './updates.js';

/** Of responses, which nobody asks for. */
const SAMPLES = 2;
/** What of an update nobody asks for. */
const WITHOUT = [AT.WITHOUT_MARGINS, AT.WITHOUT_LAG_MARGIN, AT.WITHOUT_LINEAR, AT.WITHOUT_RIG, AT.WITHOUT_SCENARIO];
/** Ticks that are flown by one call at most. */
export const MOST_AT_ONCE = 2048;
/** Calls that are kept, each for another number of ticks. */
const KEPT = 64;

/**
 * The same design with a digital controller: a continuous one is flown as one that samples every 2 ms, exactly. Noise
 * and disturbances are the flight's own.
 * @param {Design} design @returns {Design}
 */
export function flyable(design) {
  const { noise: _noise, disturbance: _volts, digital, ...scenario } = design.scenario;
  const {
    noise: _own,
    seed: _seed,
    ...sampled
  } = digital ?? {
    sample_time: WITHIN.SAMPLED,
    encoders: { theta: 0, psi: 0 },
    rates:
      (scenario.measured ?? 'states') === 'states' ? /** @type {const} */ ('true') : /** @type {const} */ ('filtered'),
  };
  return { ...design, scenario: { ...scenario, duration: 1, digital: sampled } };
}

/**
 * Whether the kernel serves what is flown of a design, and the server would take what is left out, too.
 * @param {Design} design @param {Preset} preset
 */
function isSound(design, preset) {
  const { noise, digital, ...scenario } = design.scenario;
  const flown = flyable(design);
  const short = { ...flown, scenario: { ...flown.scenario, duration: 0.1 } }; // an update has few samples
  const quiet = [noise?.theta, noise?.psi, digital?.noise].every((own) => own === undefined || (own >= 0 && own <= 1));
  const samples = digital ? scenario.duration / (digital.sample_time ?? WITHIN.SAMPLED) : 0;
  return quiet && samples <= WITHIN.MOST_SAMPLES && serves({ ...design, scenario }, preset) && serves(short, preset);
}

export class Flights {
  #kernels;
  /** Arrays that the kernels share, by their names. @type {Record<string, Block>} */ #own;
  /** @type {Block} */ #numbers;
  /** @type {Record<string, Block>|null} */ #made = null;
  /** @type {(() => unknown)|null} */ #make = null;
  /** @type {() => unknown} */ #begin;
  /** @type {() => unknown} */ #takeOver;
  /** By the number of ticks. @type {Map<number, () => unknown>} */ #calls = new Map();

  /** @param {Kernels} kernels */
  constructor(kernels) {
    this.#kernels = kernels;
    const { STATES, CONSTANTS, MODES, OBSERVER_ROWS, OBSERVER_COLUMNS, WORK_ROWS, WORK_COLUMNS } = FLOWN;
    const f64 = (/** @type {number[]} */ ...shape) => kernels.array('f64', ...shape);
    const own = {
      ...{ size: f64(STATES), start: f64(STATES), y: f64(STATES), s: f64(MEMORY.FLIGHT_MEMORY) },
      ...{ free: kernels.array('i64', MODES), c: f64(CONSTANTS), m: kernels.array('i64', MODES) },
      ...{ k: f64(CONTROLLER.FLIGHT_CONTROLLER), estimator: f64(OBSERVER_ROWS, OBSERVER_COLUMNS) },
      ...{ u: f64(INPUT.FLIGHT_INPUTS), new_c: f64(CONSTANTS), new_m: kernels.array('i64', MODES) },
      ...{ new_k: f64(CONTROLLER.FLIGHT_CONTROLLER), new_u: f64(INPUT.FLIGHT_INPUTS), own: f64(CONSTANTS) },
      ...{ plant: f64(CONSTANTS), grid: f64(2), course: f64(2, STATES), w: f64(WORK_ROWS, WORK_COLUMNS) },
      ...{ seen: f64(STATES), told: f64(TAKEN_OVER.TOLD), rows: f64(MOST_AT_ONCE, ROW.FLIGHT_ROW) },
    };
    this.#own = own;
    this.#numbers = f64(AT.NUMBERS);
    this.#begin = kernels.bound('begin_flight', own);
    this.#takeOver = kernels.bound('take_over', own);
  }

  /**
   * That of a design.
   * @param {Design} design @param {Preset} preset
   * @returns {Controller|null} null where it is the server's to say: its numbers make `controllerOf`
   */
  controller(design, preset) {
    const flown = flyable(design);
    if (!isSound(design, preset)) return null;
    const numbers = this.#numbers.floats;
    fill(numbers, flown, preset);
    for (const flag of WITHOUT) numbers[flag] = 1;
    [numbers[AT.EACH_AXIS], numbers[AT.MOST_STEPS]] = [0, 1];
    return this.#controller();
  }

  /**
   * That of the server's numbers (`POST flights/controller`).
   * @param {Float64Array} numbers
   * @returns {Controller|null} null where there is none
   */
  controllerOf(numbers) {
    this.#numbers.floats.set(numbers);
    return this.#controller();
  }

  /** @returns {Controller|null} */
  #controller() {
    const made = (this.#made ??= this.#makes());
    this.#make?.();
    if (made.outcome.floats[0] !== OUTCOMES.DONE) return null;
    return {
      numbers: this.#numbers.floats.slice(),
      c: made.c.floats.slice(),
      m: made.m.integers.slice(),
      k: made.k.floats.slice(),
      estimated: made.estimated.floats.slice(),
      start: made.start.floats.slice(),
      stable: made.figures.floats[FIGURES.STABLE] !== 0,
    };
  }

  /** Its arrays, made when the first is asked for. */
  #makes() {
    const kernels = this.#kernels;
    const { open, ...filled } = block(FULL, SAMPLES);
    const values = {
      ...Object.fromEntries(arrays(kernels, { ...filled, own_poles: open, ...scratch(FULL, SAMPLES) })),
      ...{ size: this.#own.size, numbers: this.#numbers, noise: kernels.array('f64', 1, 2) },
      k: kernels.array('f64', CONTROLLER.FLIGHT_CONTROLLER),
    };
    this.#make = kernels.bound('flight_controller', values);
    return /** @type {Record<string, Block>} */ (values);
  }

  /** At rest where the experiment begins. @param {Controller} controller @returns {Flying} */
  begun(controller) {
    const own = this.#own;
    own.start.floats.set(controller.start);
    this.#put(controller);
    this.#begin();
    return { y: own.y.floats.slice(), s: own.s.floats.slice(), free: own.free.integers.slice() };
  }

  /**
   * Flies on.
   * @param {Flying} flying  changes
   * @param {Controller} controller @param {Float64Array} u  what acts
   * @param {number} ticks
   * @returns {Float64Array} a row per tick that was flown: a view, valid until the next call
   */
  fly(flying, controller, u, ticks) {
    if (!(ticks > 0 && ticks <= MOST_AT_ONCE)) throw new RangeError(`1 to ${MOST_AT_ONCE} ticks are flown at once`);
    const { u: acts, estimator, rows } = this.#own;
    this.#put(controller, flying);
    estimator.floats.set(controller.estimated);
    acts.floats.set(u);
    const flown = Number(this.#call(ticks)());
    this.#take(flying);
    return rows.floats.subarray(0, flown * ROW.FLIGHT_ROW);
  }

  /** @param {number} ticks */
  #call(ticks) {
    const made = this.#calls.get(ticks);
    if (made) return made;
    if (this.#calls.size >= KEPT) this.#calls.clear();
    const { RTOL: rtol, ATOL: atol, MOST_STEPS: most_steps } = WITHIN;
    const call = this.#kernels.bound('fly', { ...this.#own, ticks, rtol, atol, most_steps });
    this.#calls.set(ticks, call);
    return call;
  }

  /**
   * Another controller takes over, or the same one from the sticks.
   * @param {Flying} flying  changes
   * @param {Controller} before @param {Float64Array} u  what acted on it
   * @param {Controller} after @param {Float64Array} now  what acts from now on
   * @returns {Float64Array} TAKEN_OVER
   */
  takeOver(flying, before, u, after, now) {
    const own = this.#own;
    this.#put(before, flying);
    own.u.floats.set(u);
    own.new_c.floats.set(after.c);
    own.new_m.integers.set(after.m);
    own.new_k.floats.set(after.k);
    own.new_u.floats.set(now);
    own.told.floats.fill(0);
    this.#takeOver();
    this.#take(flying);
    return own.told.floats.slice();
  }

  /** @param {Controller} controller @param {Flying} [flying] */
  #put({ c, m, k }, flying) {
    const own = this.#own;
    own.c.floats.set(c);
    own.m.integers.set(m);
    own.k.floats.set(k);
    if (!flying) return;
    own.y.floats.set(flying.y);
    own.s.floats.set(flying.s);
    own.free.integers.set(flying.free);
  }

  /** @param {Flying} flying */
  #take(flying) {
    const { y, s, free } = this.#own;
    flying.y.set(y.floats);
    flying.s.set(s.floats);
    flying.free.set(free.integers);
  }
}
