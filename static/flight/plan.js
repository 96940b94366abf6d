/**
 * What a task has in store for a flight: events at times that stand before, each at the first tick from its time on.
 * They stand in the log like any other. Pure.
 * @typedef {object} Planned
 * @property {number} time  s
 * @property {(step: number) => [word: string, ...values: number[]]} event  by the length of the tick, s
 * @typedef {import('./craft.js').Craft} Craft
 */

/**
 * Set points where the rig stands when it takes off: it hovers there until a hand moves them.
 * @param {import('../types.js').Design} design
 * @returns {Planned}
 */
export function hover({ theta0, scenario: { initial } }) {
  return { time: 0, event: () => ['reference', initial?.theta ?? theta0, initial?.psi ?? 0] };
}

/** A tick that begins so little before a time counts as from it on, s. */
const EARLY = 1e-6;

export class Plan {
  /** When those were done that are. @type {number[]} */ #done = [];

  /** @param {Planned[]} [planned]  in the order of their times */
  constructor(planned = []) {
    this.planned = planned;
  }

  /** @returns {Planned|undefined} */
  get #next() {
    return this.planned[this.#done.length];
  }

  /** What is due now. @param {Craft} craft @returns {[word: string, ...values: number[]]|null} done from now on */
  take(craft) {
    const next = this.#next;
    if (!next || !(craft.time > next.time - EARLY)) return null;
    this.#done.push(craft.tick);
    return next.event(craft.nextStep);
  }

  /** The tick of what comes next. @param {Craft} craft */
  until({ tick, time, step }) {
    const next = this.#next;
    return next ? tick + Math.max(Math.floor((next.time - EARLY - time) / step) + 1, 1) : Infinity;
  }

  /** What was done from this tick on comes again. @param {number} tick */
  cut(tick) {
    while ((this.#done.at(-1) ?? -1) >= tick) this.#done.pop();
  }
}
