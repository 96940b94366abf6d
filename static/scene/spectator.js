/**
 * A flight that another window flies, as one sees it here: what it tells comes in pieces, and is shown a moment later,
 * so that between two of them the rig moves on. Pure.
 * @typedef {import('./pose.js').Trajectory} Trajectory
 * @typedef {{from: number, speed: number}} Told  time of the piece's first pose, s; seconds of flight per second
 * @typedef {ReturnType<typeof sampleTrajectory> & Pick<Trajectory, 'reference'>} Seen
 */
import { sampleTrajectory } from './pose.js';

/** How long after the flight, s: two pieces and a little. */
const BEHIND = 0.12;
/** Farther away than this, time jumps, s. */
const FAR = 0.5;
/** Else it comes nearer by this share in a second. */
const NEARER = 2;
/** Of poses that are kept, s. */
const KEPT = 2;
/** Who has heard nothing for so long watches a flight no more, ms. */
const SILENT_MS = 2000;

export class Spectator {
  /** Absolute times, s. @type {{t: number[], theta: number[], psi: number[], V_p: number[], V_y: number[]}} */
  #course = { t: [], theta: [], psi: [], V_p: [], V_y: [] };
  /** @type {Trajectory['reference']} */ #reference;
  #speed = 0;
  #time = NaN;
  #looked = NaN;
  #heard = -Infinity;

  /** A piece of the flight. @param {Told} told @param {Trajectory} piece @param {number} now ms */
  take({ from, speed }, piece, now) {
    const { t } = this.#course;
    const kept = t.findIndex((time) => time >= from); // it was rewound, or goes on from there
    const first = t.findIndex((time) => time >= from - KEPT);
    for (const name of /** @type {const} */ (['t', 'theta', 'psi', 'V_p', 'V_y'])) {
      const before = this.#course[name].slice(Math.max(first, 0), kept < 0 ? undefined : kept);
      this.#course[name] = [...before, ...Array.from(piece[name], (value) => value + (name === 't' ? from : 0))];
    }
    this.#reference = piece.reference;
    this.#speed = speed;
    this.#heard = now;
  }

  /** Whether there is a flight. @param {number} now ms */
  watches(now) {
    return now - this.#heard < SILENT_MS;
  }

  /** What is seen now. @param {number} now ms @returns {Seen|null} */
  at(now) {
    const newest = this.#course.t.at(-1);
    if (newest === undefined) return null;
    const wall = Math.max((now - this.#looked) / 1000, 0) || 0;
    this.#looked = now;
    const target = newest - BEHIND * this.#speed;
    const next = this.#time + wall * this.#speed;
    const off = target - next;
    this.#time = Math.abs(off) < FAR ? Math.min(next + off * Math.min(NEARER * wall, 1), newest) : target;
    return { ...sampleTrajectory(this.#course, this.#time), reference: this.#reference };
  }
}
