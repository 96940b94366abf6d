/** While a pole moves, what is read in figures is written less often than it changes: nobody reads sixty numbers a second. Pure. */

export const CALM = 80; // ms between two writings of the figures during a drag

export class Pace {
  #last = -Infinity;
  #waiting = false;

  /** @param {{every?: number, now?: () => number, later?: (act: () => void, delay: number) => unknown}} [clock] */
  constructor({ every = CALM, now = () => performance.now(), later = (act, delay) => setTimeout(act, delay) } = {}) {
    this.every = every;
    this.now = now;
    this.later = later;
  }

  /**
   * Whether the figures' turn has come: always while nothing is dragged. Where it has not, `again` is called when it has.
   * @param {boolean} dragging @param {() => void} again
   */
  due(dragging, again) {
    const wait = dragging ? this.#last + this.every - this.now() : 0;
    if (wait > 0) {
      if (!this.#waiting) this.later(() => { this.#waiting = false; again(); }, wait);
      this.#waiting = true;
      return false;
    }
    this.#last = this.now();
    return true;
  }
}
