/**
 * Attempts on their way to the server. Each stands in the browser's storage, with a name of its own, until the server
 * has answered it, so that none is lost and none counts twice: not where the network goes, nor where the page is
 * closed, nor where two tabs send at once. Who holds the lock sends for all.
 * @typedef {import('./shapes.js').Marked} Marked
 * @typedef {{id: string, code: string, student: string, step: string, design: import('../bodies/bodies.js').Body,
 *   answers: import('./shapes.js').Answers, at: string, flight?: import('./shapes.js').Log}} Attempt
 * @typedef {(attempt: Attempt) => Promise<Marked>} Send
 * @typedef {<T>(act: () => Promise<T>) => Promise<T>} Alone  one tab at a time, where browsers can
 */
import { read, write } from './kept.js';

const NAME = 'outbox';
/** More than anybody hands in by hand; the oldest of a full box were long overtaken. */
const MOST = 200;
/** Of these the newest keep their flights: logs are long, a browser keeps five million signs, and the best flight of a
 * step is handed in with every attempt at it. */
const MOST_FLIGHTS = 20;

/** @param {Attempt[]} attempts oldest first @returns {Attempt[]} */
function lighter(attempts) {
  const flown = attempts.filter(({ flight }) => flight);
  const heavy = new Set(flown.slice(0, -MOST_FLIGHTS));
  return attempts.map((attempt) => {
    if (!heavy.has(attempt)) return attempt;
    const { flight: _flight, ...rest } = attempt;
    return rest;
  });
}

/** @type {Alone} */
const alone = (act) => (globalThis.navigator?.locks ? navigator.locks.request(`heli2dof.${NAME}`, act) : act());

export class Outbox {
  /** @param {Send} send  refuses with `final: true` what will never be taken @param {Alone} [lock] */
  constructor(send, lock = alone) {
    this.send = send;
    this.lock = lock;
  }

  /** @returns {Attempt[]} oldest first */
  get waiting() {
    return read(NAME, /** @type {Attempt[]} */ ([]));
  }

  /** @param {Attempt} attempt */
  put(attempt) {
    write(NAME, lighter([...this.waiting.filter(({ id }) => id !== attempt.id), attempt].slice(-MOST)));
  }

  /** @param {string} id */
  #drop(id) {
    write(
      NAME,
      this.waiting.filter((attempt) => attempt.id !== id),
    );
  }

  /**
   * Sends what waits, in order; stops where one cannot be sent now.
   * @param {(attempt: Attempt) => boolean} [mine]
   * @param {(attempt: Attempt, marked: Marked|null, error?: unknown) => void} [told] null: refused for good
   * @returns {Promise<unknown>} why not all was sent; undefined where it was
   */
  flush(mine = () => true, told = () => {}) {
    return this.lock(async () => {
      for (const attempt of this.waiting.filter(mine)) {
        try {
          const marked = await this.send(attempt);
          this.#drop(attempt.id);
          told(attempt, marked);
        } catch (error) {
          if (!(/** @type {{final?: boolean}} */ (error).final)) return error;
          this.#drop(attempt.id);
          told(attempt, null, error);
        }
      }
      return undefined;
    });
  }
}
