/**
 * What one thing was before each of its changes, and what was undone. Pure.
 * @template T
 */
const DEPTH = 200;

/** @template T */
export class History {
  /** @type {T[]} */ #past = [];
  /** @type {T[]} */ #future = [];
  /** @type {string|null} what goes on */ gesture = null;

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  /**
   * Before a change. Changes by the same gesture in a row are one step.
   * @param {T} before @param {string|null} [gesture]
   * @returns {boolean} whether a new step begins
   */
  keep(before, gesture = null) {
    const begins = gesture === null || gesture !== this.gesture;
    if (begins) this.#past.push(before);
    if (this.#past.length > DEPTH) this.#past.shift();
    this.gesture = gesture;
    this.#future = [];
    return begins;
  }

  clear() {
    this.#past = [];
    this.#future = [];
    this.gesture = null;
  }

  /** One step back. @param {T} now @returns {T} */
  undo(now) {
    return this.#travel(this.#past, this.#future, now);
  }

  /** One step forth. @param {T} now @returns {T} */
  redo(now) {
    return this.#travel(this.#future, this.#past, now);
  }

  /** @param {T[]} from @param {T[]} to @param {T} now */
  #travel(from, to, now) {
    if (!from.length) return now;
    to.push(now);
    this.gesture = null;
    return /** @type {T} */ (from.pop());
  }
}
