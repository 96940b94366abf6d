/**
 * The page's design on its way into a flight: the newest one wins, and while a hand moves it, it changes so many times
 * in a second. Knows no DOM.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('./designs.js').Aboard} Aboard
 * @typedef {import('./designs.js').Body} Body
 * @typedef {import('./designs.js').Designs} Designs
 */
import { bodyOfFlight } from './designs.js';

/** Least time between two changes, s of flight. */
const CHANGES = 0.05;

export class Follower {
  /** @type {Design|null} */ #newest = null;
  /** What flies, or is asked for. */ #wanted;
  #changed = -Infinity; // s
  #asked = 0;

  /** @param {Designs} designs @param {Body} body  that flies */
  constructor(designs, body) {
    this.designs = designs;
    this.#wanted = meaning(body);
  }

  /** The page's design is another. @param {Design|null} design */
  edited(design) {
    this.#newest = design;
  }

  /**
   * What flies is this, by whatever way, and the page's design is to fly.
   * @param {Body} body @param {Design|null} design
   */
  flies(body, design) {
    this.#asked += 1;
    [this.#wanted, this.#newest, this.#changed] = [meaning(body), design, -Infinity];
  }

  /**
   * The newest design, if it is time for it and it is another than the one that flies.
   * @param {number} time  of the flight, s; Infinity: whatever it is
   * @param {(next: Aboard) => void} take  at once, or when the server has answered and nothing newer is wanted
   * @param {(problem: Error) => void} refuse
   */
  next(time, take, refuse) {
    if (!this.#newest || time < this.#changed + CHANGES) return;
    const body = bodyOfFlight(this.#newest, this.designs.presets());
    const wanted = meaning(body);
    this.#newest = null;
    if (wanted === this.#wanted) return;
    this.#wanted = wanted;
    if (time < Infinity) this.#changed = time;
    const asked = ++this.#asked;
    const own = this.designs.here(body);
    if (own) take(own);
    else
      this.designs.of(body).then(
        (answer) => asked === this.#asked && take(answer),
        (problem) => asked === this.#asked && refuse(problem),
      );
  }

  /** What is on its way from the server is wanted no more. */
  forget() {
    this.#asked += 1;
  }
}

/** What of a design makes a controller: two that mean the same need no change. @param {Body} body */
function meaning(body) {
  const { reference: _asked, duration: _long, initial: _start, disturbance: _volts, ...scenario } = body.scenario ?? {};
  return JSON.stringify({ ...body, scenario });
}
