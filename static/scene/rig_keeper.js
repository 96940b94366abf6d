/**
 * Sees to it that the server shows the wanted rig. What a server forgets (it was started again, another one took over)
 * and what it could not hear is told again; of several wishes only the newest is. Pure but for the clock that it is
 * given.
 */
import { backoff, Latest } from '../net/index.js';

const FIRST_RETRY_MS = 500;
const LAST_RETRY_MS = 30_000;

export class RigKeeper {
  /** @type {string|null} */ #wanted = null;
  /** @type {Promise<void>|undefined} */ #telling;
  #attempt = 0;
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #timer;

  /**
   * @param {(rig: string) => Promise<unknown>} put tells the server
   * @param {(act: () => void, delay: number) => ReturnType<typeof setTimeout>} [later]
   */
  constructor(put, later = (act, delay) => setTimeout(act, delay)) {
    this.put = put;
    this.later = later;
    this.wishes = new Latest((/** @type {string} */ rig) => void (this.#telling = this.#tell(rig)));
  }

  /** Resolves when the server has heard it, or could not. @param {string} rig */
  want(rig) {
    this.#wanted = rig;
    return this.again();
  }

  /** Tells the server what is wanted: where that is shown already, nothing happens. */
  async again() {
    clearTimeout(this.#timer);
    if (this.#wanted !== null) this.wishes.put(this.#wanted);
    await this.#telling;
  }

  /** @param {string} rig */
  async #tell(rig) {
    try {
      await this.put(rig);
      this.#attempt = 0;
    } catch {
      if (!this.wishes.overtaken)
        this.#timer = this.later(() => this.again(), backoff(this.#attempt++, FIRST_RETRY_MS, LAST_RETRY_MS));
    }
    this.wishes.done();
  }
}
