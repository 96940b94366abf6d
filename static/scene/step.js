/**
 * Keeps a player where the session's other windows are: a window that was hidden, or drew slowly, has lost time. Pure
 * but for the clock that it is given.
 * @typedef {import('./clock.js').Snapshot} Snapshot
 */
import { SceneClock } from './clock.js';

/** Seconds of the motion, at its speed, that a window may be behind: a few slow frames. */
const TOLERATED = 0.12;

export class InStep {
  /** How time ran, and when that was. @type {{snapshot: Snapshot, since: number}|null} */ #last = null;

  /**
   * @param {{time: number, duration: number, follow: (snapshot: Snapshot, elapsed: number) => void}} player
   * @param {() => number} [now] seconds
   */
  constructor(player, now = () => performance.now() / 1000) {
    this.player = player;
    this.now = now;
  }

  /** Notes how time runs here from now on. @param {Snapshot} snapshot */
  keep(snapshot) {
    this.#last = { snapshot, since: this.now() };
  }

  /** Runs as another window did so many seconds ago. @param {Snapshot} snapshot @param {number} elapsed */
  follow(snapshot, elapsed) {
    this.#last = { snapshot, since: this.now() - elapsed };
    this.player.follow(snapshot, elapsed);
  }

  /** Puts the player where it should be, if it is elsewhere. @returns {boolean} whether it was */
  correct() {
    if (!this.#last || this.expects(this.player.time)) return false;
    this.player.follow(this.#last.snapshot, this.now() - this.#last.since);
    return true;
  }

  /** Whether the others believe that time stands about there. @param {number} time */
  expects(time) {
    if (!this.#last) return false;
    const { snapshot, since } = this.#last;
    const clock = new SceneClock();
    clock.setDuration(this.player.duration);
    clock.apply(snapshot, this.now() - since);
    return Math.abs(clock.time - time) <= TOLERATED * clock.speed;
  }
}
