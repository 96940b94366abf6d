/**
 * Moves along a track by itself: from open to closed loop in some seconds. Where a person wants little motion, a press
 * takes it one step on instead.
 */

const SECONDS = 4;
/** Of the way, for who wants little motion. */
const STEP = 1 / 12;

export class Player {
  #from = 0;
  #to = 1;
  #begun = 0;
  /** @type {number|null} */ #frame = null;

  /** @param {(share: number) => void} show @param {(on: boolean) => void} tell */
  constructor(show, tell) {
    this.show = show;
    this.tell = tell;
    this.little = matchMedia('(prefers-reduced-motion: reduce)');
  }

  get isPlaying() {
    return this.#frame !== null;
  }

  /**
   * Goes on from where it is, or from the beginning if that is the end; or stops.
   * @param {number} now @param {number} to
   */
  toggle(now, to) {
    if (this.isPlaying) return this.stop();
    const from = now < to - 1e-9 ? now : 0;
    if (this.little.matches) return this.show(Math.min(to, from + STEP * to));
    [this.#from, this.#to, this.#begun] = [from, to, performance.now()];
    this.tell(true);
    this.#step(this.#begun);
    return undefined;
  }

  stop() {
    if (this.#frame === null) return;
    cancelAnimationFrame(this.#frame);
    this.#frame = null;
    this.tell(false);
  }

  /** @param {number} now */
  #step(now) {
    const gone = Math.max(0, now - this.#begun) / (1000 * SECONDS);
    const share = Math.min(this.#to, this.#from + gone * this.#to);
    this.#frame = share < this.#to ? requestAnimationFrame((at) => this.#step(at)) : null;
    this.show(share);
    if (this.#frame === null) this.tell(false);
  }
}
