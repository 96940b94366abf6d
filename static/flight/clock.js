/**
 * The wall's clock and a flight's: how far a flight has to be by now. Of a long gap between two looks only a part is
 * time of the flight: where a machine draws so slowly, time slows. Pure.
 */

/** So much of a gap between two frames passes at most, ms. */
export const GAP_MS = 250;
/** Of what is new in `slow`, in each frame. */
const FRESH = 0.1;

export class Clock {
  /** Seconds of flight in one of the wall's. */
  speed = 1;
  /** Share of what is asked for that is reached, as of late; 1: all. */ slow = 1;
  #passed = 1; // share of the last gap
  #wall = NaN; // ms, and what time of the flight it was then, s
  #time = 0;
  #last = NaN; // when somebody looked last, ms

  /** From the next look on, time goes on from where the flight is then. */
  hold() {
    [this.#wall, this.slow] = [NaN, 1];
  }

  /**
   * When the flight has to be.
   * @param {number} now  the wall's, ms @param {number} time  the flight's, s @returns {number} s
   */
  due(now, time) {
    const gap = now - this.#last;
    const held = !(now >= this.#wall);
    this.#last = now;
    this.#passed = !held && gap > GAP_MS ? GAP_MS / gap : 1;
    if (held) this.anchor(now, time);
    else if (gap > GAP_MS) this.anchor(now - GAP_MS, time);
    return this.#time + ((now - this.#wall) / 1000) * this.speed;
  }

  /**
   * So much of what was due was flown.
   * @param {number} share @returns {boolean} whether `slow` reads otherwise now
   */
  paced(share) {
    const [before, reached] = [this.slow, share * this.#passed];
    const now = before + FRESH * (reached - before);
    this.slow = reached === 1 && now > 0.995 ? 1 : now;
    return Math.round(now * 20) !== Math.round(before * 20);
  }

  /**
   * The flight's time is this, at this moment: what it has missed it does not catch up.
   * @param {number} now @param {number} time
   */
  anchor(now, time) {
    [this.#wall, this.#time] = [now, time];
  }
}
