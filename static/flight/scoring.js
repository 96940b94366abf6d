/**
 * What a flight is worth, row by row: heli2dof_core/flight/scores.py and tasks/task.py once more, by which the server
 * marks it; a test holds the two to one another. Pure.
 * @typedef {import('../kernel/flight_tasks.js').Task} Task
 * @typedef {import('./plan.js').Planned} Planned
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {Record<string, number | {theta: number, psi: number}>} Values  by figure, in the registry's units
 * @typedef {{parameters: {K_pp: number, K_yy: number}, limits: {V_p: number, V_y: number, theta: number},
 *   theta0: number}} Rig  limits: V and rad, infinite where there is none
 */
import { NEAR, ROW, uniform } from '../kernel/index.js';

const { FLIGHT_ROW, ON_STOP, STATE, VOLTAGE, WISH } = ROW;
const { AT_REST, EARLY, HIGHEST, LANDED, REACHED, RESTED, ROOM, WITHIN } = NEAR;

/** A design's rig as a task knows it. @param {Design} design @param {Preset} [preset] @returns {Rig} */
export function rigOf(design, preset) {
  const limits = { ...preset?.limits, ...design.limits };
  return /** @type {Rig} */ ({
    parameters: { ...preset?.parameters, ...design.parameters },
    limits: { V_p: limits.V_p, V_y: limits.V_y, theta: limits.theta ?? Infinity },
    theta0: design.theta0,
  });
}

/** How far a task goes in pitch, rad: towards the farther stop. @param {Rig} rig */
export const reachOf = ({ theta0, limits }) =>
  (theta0 > 0 ? -1 : 1) * Math.min(HIGHEST, ROOM * (limits.theta + Math.abs(theta0)));

/**
 * What a task has in store: its gusts.
 * @param {Task} task @param {Rig} rig @param {number} seed
 * @returns {Planned[]}
 */
export function planOf({ gusts, duration, strength }, { parameters, limits }, seed) {
  const pitch = Math.abs(parameters.K_pp) * limits.V_p;
  const yaw = Math.abs(parameters.K_yy) * limits.V_y;
  return Array.from({ length: gusts }, (_, k) => {
    const every = (duration - 4) / gusts;
    const time = 1.5 + every * (k + 0.25 + 0.25 * uniform(4 * k, seed));
    const torques = [strength * pitch * uniform(4 * k + 1, seed), strength * yaw * uniform(4 * k + 2, seed)];
    const length = 0.8 + 0.4 * uniform(4 * k + 3, seed);
    return { time, event: (step) => ['gust', ...torques, Math.max(1, Math.floor(length / step + 0.5))] };
  });
}

/**
 * θ and ψ that a task asks at a time, rad; where marks are reached in turn, the one that is.
 * @param {Task} task @param {number} t @param {Rig} rig @param {number} [mark]
 * @returns {[number, number]}
 */
export function askedAt({ marks, ends }, t, rig, mark = 0) {
  const reach = reachOf(rig);
  if (ends) {
    const [, theta, psi] = marks[Math.min(mark, marks.length - 1)];
    return [rig.theta0 + reach * theta, psi];
  }
  let n = 0;
  while (n < marks.length - 1 && t >= marks[n + 1][0]) n += 1;
  const [from, theta, psi] = marks[n];
  if (n === marks.length - 1) return [rig.theta0 + reach * theta, psi];
  const [to, nextTheta, nextPsi] = marks[n + 1];
  let part = (t - from) / (to - from);
  part = part * part * (3 - 2 * part);
  return [rig.theta0 + reach * (theta + part * (nextTheta - theta)), psi + part * (nextPsi - psi)];
}

export class Scoring {
  /** Whether the task has come to its end; what is put from then on does not count. */ done = false;
  /** The mark that is asked for, where they are reached in turn. */ mark = 0;
  #squares = [0, 0];
  #largest = [0, 0];
  #error = [0, 0];
  #within = 0;
  #effort = 0;
  #hand = 0;
  #time = 0;
  #impacts = 0;
  #onStop = 0;
  #since = -1;
  /** @type {number|null} */ #reached = null;
  /** The last row, whose length nobody knows yet. */ #last = new Float64Array(FLIGHT_ROW);
  #lastTime = NaN; // without one
  #lastHands = false;

  /** @param {Task|null} task  null: what is asked are the flight's own set points @param {Rig} rig */
  constructor(task, rig) {
    this.task = task;
    this.rig = rig;
  }

  /** What is asked now, rad. @param {number} time @returns {[number, number]|null} */
  asked(time) {
    return this.task && askedAt(this.task, time, this.rig, this.mark);
  }

  /**
   * Rows that were flown.
   * @param {{rows: Float64Array, count: number, step: number, time: number}} flown @param {boolean} hands  whether the
   *   controller was off
   */
  put({ rows, count, step, time }, hands) {
    for (let n = 0; n < count && !this.done; n++) {
      const now = time + n * step;
      this.#take(now - this.#lastTime);
      for (let i = 0; i < FLIGHT_ROW; i++) this.#last[i] = rows[n * FLIGHT_ROW + i];
      this.#lastTime = now;
      this.#lastHands = hands;
    }
  }

  /** The last row, if there is one, has lasted so long, s. @param {number} dt */
  #take(dt) {
    const [row, time, hands] = [this.#last, this.#lastTime, this.#lastHands];
    if (Number.isNaN(time)) return;
    const wanted = this.asked(time) ?? [row[WISH], row[WISH + 1]];
    this.#error = [row[STATE] - wanted[0], row[STATE + 1] - wanted[1]];
    for (const [i, error] of this.#error.entries()) {
      this.#squares[i] += error * error * dt;
      this.#largest[i] = Math.max(this.#largest[i], Math.abs(error));
    }
    if (this.#far <= WITHIN) this.#within += dt;
    this.#effort += (row[VOLTAGE] * row[VOLTAGE] + row[VOLTAGE + 1] * row[VOLTAGE + 1]) * dt;
    if (hands) this.#hand += dt;
    if (row[ON_STOP] !== 0 && this.#onStop === 0) this.#impacts += 1;
    this.#onStop = row[ON_STOP];
    this.#time = time + dt;
    if (this.task) this.#follow(this.task, row, time + dt);
  }

  /** Larger of both errors, rad. */
  get #far() {
    return Math.max(Math.abs(this.#error[0]), Math.abs(this.#error[1]));
  }

  /** @param {Task} task @param {Float64Array} row @param {number} time */
  #follow({ ends, marks, duration }, row, time) {
    if (ends === 'reached' && this.#far <= REACHED) {
      this.mark += 1;
      if (this.mark === marks.length) [this.#reached, this.done] = [time, true];
    }
    if (ends === 'landed') {
      const still = Math.max(Math.abs(row[STATE + 2]), Math.abs(row[STATE + 3])) <= AT_REST && this.#far <= LANDED;
      if (!still) this.#since = -1;
      else if (this.#since < 0) this.#since = time;
      else if (time - this.#since > RESTED - EARLY) [this.#reached, this.done] = [time, true];
    }
    if (time > duration - EARLY) this.done = true;
  }

  /** What it is worth so far. @returns {Values} */
  get values() {
    if (this.#time === 0) return {};
    const [theta, psi] = this.#squares.map((square) => Math.sqrt(square / this.#time));
    return {
      flight_error_rms: { theta, psi },
      flight_error_max: { theta: this.#largest[0], psi: this.#largest[1] },
      path_error: Math.hypot(theta, psi),
      time_within: this.#within / this.#time,
      flight_effort: this.#effort,
      landing_error: this.#far,
      flight_impacts: this.#impacts,
      by_hand: this.#hand / this.#time,
      ...(this.#reached !== null && { flight_time: this.#reached }),
    };
  }

  /** 0 to 3. */
  get stars() {
    const { task } = this;
    if (!task || (task.ends && this.#reached === null)) return 0;
    const value = this.values[task.figure];
    const { V_p, V_y } = this.rig.limits;
    const unit = task.per_square_volt ? V_p ** 2 + V_y ** 2 : 1;
    return typeof value === 'number' ? task.stars.filter((limit) => value <= limit * unit).length : 0;
  }
}
