/**
 * Who flies beside the rig in a task: the design alone, simulated along with the flight, and one's best flight so far.
 * Knows no DOM.
 * @typedef {import('../kernel/flight_tasks.js').Task} Task
 * @typedef {import('./scoring.js').Rig} Rig
 * @typedef {{every: number, theta: number[], psi: number[]}} Trace  rad, every so many s from 0 on
 */
import { ROW } from '../kernel/index.js';
import { Craft } from './craft.js';
import { Plan } from './plan.js';
import { planOf, Scoring } from './scoring.js';

/** How often set points follow what a task asks, where the design flies it alone, s (flight/task_flights.py). */
const SET_POINTS = 0.02;
const EARLY = 1e-6;
/** Of a trace: so many points a second are kept. */
export const EVERY = 0.05;

/** The task as the design flies it alone. */
export class Alone {
  #due = 0;

  /**
   * @param {import('../kernel/index.js').Flights} flights @param {import('./designs.js').Aboard} aboard
   * @param {Task} task @param {Rig} rig @param {number} seed
   */
  constructor(flights, aboard, task, rig, seed) {
    this.craft = new Craft(flights, aboard, seed);
    this.plan = new Plan(planOf(task, rig, seed));
    this.scoring = new Scoring(task, rig);
    this.craft.do('reference', rig.theta0, 0);
  }

  /**
   * Flies on to a time, at most so many ticks.
   * @param {number} time  s @param {number} [most] @returns {[number, number]} θ and ψ then
   */
  to(time, most = 1000) {
    const { craft, plan, scoring } = this;
    for (let left = most; left > 0 && craft.time < time - EARLY && !craft.ended && !scoring.done;) {
      for (let event = plan.take(craft); event; event = plan.take(craft))
        craft.do(event[0], ...event.slice(1).map(Number));
      if (craft.time > this.#due - EARLY) {
        const asked = scoring.asked(craft.time);
        const moves = craft.tick === 0 || (scoring.task?.marks.length ?? 1) > 1;
        if (asked && moves) craft.do('reference', ...asked);
        this.#due += SET_POINTS;
      }
      const ahead = Math.ceil((Math.min(this.#due, time) - EARLY - craft.time) / craft.step);
      const ticks = Math.max(1, Math.min(ahead, plan.until(craft) - craft.tick, left));
      const begun = craft.time;
      const rows = craft.fly(ticks);
      scoring.put({ rows, count: rows.length / ROW.FLIGHT_ROW, step: craft.step, time: begun }, false);
      left -= ticks;
    }
    return [craft.theta, craft.psi];
  }
}

/**
 * Where a trace is at a time; it rests at its end.
 * @param {Trace} trace @param {number} time @returns {[number, number]}
 */
export function traceAt({ every, theta, psi }, time) {
  const last = theta.length - 1;
  const at = Math.min(Math.max(time / every, 0), last);
  const k = Math.min(Math.floor(at), Math.max(last - 1, 0));
  const part = Math.min(at - k, 1);
  const between = (/** @type {number[]} */ y) => y[k] + part * ((y[k + 1] ?? y[k]) - y[k]);
  return [between(theta), between(psi)];
}
