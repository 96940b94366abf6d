// The playback clock: where time stands in a response, and how it runs. Pure: who calls `advance` says how much time
// has passed.

/**
 * What another window needs to play in step. `time` lies beyond the response's end while a loop rests there.
 * @typedef {{playing: boolean, time: number, speed: number, loop: boolean}} Snapshot
 */

/** Seconds of the response per second. */
export const SPEEDS = /** @type {const} */ ([0.25, 0.5, 1, 2, 4]);
/** Seconds by the wall between two rounds of a loop: long enough to see where the rig has come to rest. */
export const REST = 0.9;

/** @param {number} v @param {number} low @param {number} high */
const clamp = (v, low, high) => Math.min(Math.max(v, low), high);

/** @param {number} speed @returns {number} the nearest that is offered, as ratios go; 1 for what is no speed */
export function nearestSpeed(speed) {
  if (!(speed > 0 && Number.isFinite(speed))) return 1;
  const apart = (/** @type {number} */ s) => Math.abs(Math.log(s / speed));
  return SPEEDS.reduce((best, s) => (apart(s) < apart(best) ? s : best));
}

export class SceneClock {
  #playing = false;
  /** Seconds; beyond the duration while a loop rests. */
  #position = 0;
  #speed = 1;
  #loop = false;
  #duration = 0;

  get playing() {
    return this.#playing;
  }

  /** Seconds since the step, from 0 to the duration. */
  get time() {
    return Math.min(this.#position, this.#duration);
  }

  get speed() {
    return this.#speed;
  }

  get loop() {
    return this.#loop;
  }

  /** Seconds. */
  get duration() {
    return this.#duration;
  }

  /**
   * Of another response; time stays where it is, within it, and a loop's rest goes on.
   * @param {number} duration seconds
   */
  setDuration(duration) {
    const rested = Math.max(this.#position - this.#duration, 0);
    const time = this.time;
    this.#duration = Number.isFinite(duration) ? Math.max(duration, 0) : 0;
    this.#position = rested > 0 ? this.#duration + rested : Math.min(time, this.#duration);
  }

  /** Lets time run, from the start again where it has come to the end. Does nothing without a duration. */
  play() {
    if (this.#playing || this.#duration === 0) return;
    if (this.#position >= this.#duration) this.#position = 0;
    this.#playing = true;
  }

  pause() {
    this.#playing = false;
    this.#position = this.time;
  }

  /** Plays from the start. */
  restart() {
    this.#position = 0;
    this.#playing = this.#duration > 0;
  }

  /** @param {number} time seconds; beyond the ends counts as the end */
  seek(time) {
    if (!Number.isNaN(time)) this.#position = clamp(time, 0, this.#duration);
  }

  /** @param {number} speed the nearest of SPEEDS is taken */
  setSpeed(speed) {
    this.#speed = nearestSpeed(speed);
  }

  /** @param {boolean} loop */
  setLoop(loop) {
    this.#loop = loop;
    if (!loop) this.#position = this.time;
  }

  /**
   * Lets time pass, if it runs.
   * @param {number} seconds by the wall
   * @returns {boolean} whether it came to the end and stopped there
   */
  advance(seconds) {
    if (!this.#playing || !(seconds > 0)) return false;
    const position = this.#position + seconds * this.#speed;
    if (position < this.#duration) this.#position = position;
    else if (this.#loop) this.#position = position % (this.#duration + REST * this.#speed);
    else {
      this.#position = this.#duration;
      this.#playing = false;
      return true;
    }
    return false;
  }

  /** @returns {Snapshot} */
  snapshot() {
    return { playing: this.#playing, time: this.#position, speed: this.#speed, loop: this.#loop };
  }

  /**
   * Stands as another clock of the same response did, so many seconds by the wall ago.
   * @param {Snapshot} snapshot @param {number} [elapsedSeconds]
   */
  apply({ playing, time, speed, loop }, elapsedSeconds = 0) {
    this.setSpeed(speed);
    this.#loop = loop;
    const end = this.#duration + (loop && this.#duration > 0 ? REST * this.#speed : 0);
    this.#position = Number.isNaN(time) ? 0 : clamp(time, 0, end);
    this.#playing = playing && this.#duration > 0;
    this.advance(elapsedSeconds);
  }
}
