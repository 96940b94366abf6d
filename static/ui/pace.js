/**
 * While a pole moves, what is read in figures is written less often than it changes, and never all at once: nobody
 * reads sixty numbers a second. Pure.
 */

export const CALM = 80; // ms between two writings of the same figures during a drag
const LATE = 200; // ms after which figures are written even in a frame that has the plots to draw
const SHARE = 1; // ms of a frame for figures

/** Views that take turns while something is dragged, so that no frame has to draw them all. */
export class Turns {
  #next = 0;
  #waits = false;
  /** @type {WeakMap<Function, number>} when each view was drawn last */ #drawn = new WeakMap();

  /** @param {{now?: () => number, later?: (act: () => void, delay: number) => unknown}} [clock] */
  constructor({ now = () => performance.now(), later = (act, delay) => setTimeout(act, delay) } = {}) {
    this.now = now;
    this.later = later;
  }

  /**
   * Draws all views, or while something is dragged the next of those that have something to show and were not drawn a
   * moment ago, as long as the frame's share of time lasts. `again` is called when it is the others' turn.
   * @template {{dragging: boolean}} S
   * @param {S} state
   * @param {((state: S) => unknown)[]} views each returns true where it has drawn
   * @param {{busy: boolean, again: () => void}} frame busy: it has the plots to draw
   */
  take(state, views, { busy, again }) {
    if (!state.dragging) {
      for (const view of views) view(state);
      return;
    }
    const begin = this.now();
    const pause = busy ? LATE : CALM;
    let soonest = Infinity;
    const first = this.#next;
    for (let k = 0; k < views.length; k++) {
      const i = (first + k) % views.length;
      const rest = (this.#drawn.get(views[i]) ?? -Infinity) + pause - begin;
      if (rest > 0) soonest = Math.min(soonest, rest);
      else if (views[i](state) === true) {
        this.#drawn.set(views[i], begin);
        this.#next = i + 1;
        if (this.now() - begin >= SHARE) return again();
      }
    }
    if (soonest < Infinity && !this.#waits) {
      this.#waits = true;
      this.later(
        () => {
          this.#waits = false;
          again();
        },
        Math.min(soonest, CALM),
      );
    }
  }
}
