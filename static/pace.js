/** While a pole moves, what is read in figures is written less often than it changes, and never all at once: nobody reads sixty numbers a second. Pure. */

export const CALM = 80; // ms between two writings of the same figures during a drag

/** Views that take turns while something is dragged, so that no frame has to draw them all. */
export class Turns {
  #next = 0;
  #waits = false;
  /** @type {WeakMap<Function, number>} when each view was drawn last */ #drawn = new WeakMap();

  /** @param {{every?: number, now?: () => number, later?: (act: () => void, delay: number) => unknown}} [clock] */
  constructor({ every = CALM, now = () => performance.now(), later = (act, delay) => setTimeout(act, delay) } = {}) {
    this.every = every;
    this.now = now;
    this.later = later;
  }

  /**
   * Draws all views, or while something is dragged the next one that has something to show and was not drawn a moment ago. `again` is called when it is the others' turn.
   * @template {{dragging: boolean}} S @param {S} state @param {((state: S) => unknown)[]} views each returns true where it has drawn @param {() => void} again
   */
  take(state, views, again) {
    if (!state.dragging) {
      for (const view of views) view(state);
      return;
    }
    const now = this.now();
    let soonest = Infinity;
    for (let k = 0; k < views.length; k++) {
      const i = (this.#next + k) % views.length;
      const wait = (this.#drawn.get(views[i]) ?? -Infinity) + this.every - now;
      if (wait > 0) soonest = Math.min(soonest, wait);
      else if (views[i](state) === true) {
        this.#drawn.set(views[i], now);
        this.#next = i + 1;
        again();
        return;
      }
    }
    if (soonest < Infinity && !this.#waits) {
      this.#waits = true;
      this.later(() => { this.#waits = false; again(); }, soonest);
    }
  }
}
