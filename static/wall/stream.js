/**
 * Server-sent events of a call that takes its secret in a header, which the browser's own EventSource cannot send; and
 * the connection over which they come, made again whenever it is lost.
 */
import { backoff } from '../net/index.js';

/** @typedef {{event: string, data: string}} ServerEvent */

/** Reads events out of the text as it arrives, wherever it is cut. Pure. */
export class EventReader {
  #rest = '';
  #event = '';
  /** @type {string[]} */ #data = [];

  /** @param {string} text @returns {ServerEvent[]} those that are complete now */
  read(text) {
    const lines = (this.#rest + text).split(/\r\n|\n|\r(?!$)/); // a last \r may be half of a line's end
    this.#rest = lines.pop() ?? '';
    return lines.flatMap((line) => this.#line(line));
  }

  /** @param {string} line @returns {ServerEvent[]} */
  #line(line) {
    if (line !== '') {
      const [, field, value] = /** @type {RegExpExecArray} */ (/^([^:]*)(?:: ?(.*))?$/s.exec(line));
      if (field === 'event') this.#event = value ?? '';
      if (field === 'data') this.#data.push(value ?? '');
      return [];
    }
    const found = this.#data.length ? [{ event: this.#event || 'message', data: this.#data.join('\n') }] : [];
    this.#event = '';
    this.#data = [];
    return found;
  }
}

/** A server says something, if only a comment, several times within this time; ms. */
const SILENCE = 45_000;
const FIRST = 1_000;
const LONGEST = 15_000;

/**
 * @typedef {object} FeedOptions
 * @property {(signal: AbortSignal) => Promise<Response>} open  a good answer, whose body brings the events
 * @property {(event: ServerEvent) => void} onEvent
 * @property {(connected: boolean) => void} onStatus
 * @property {(error: unknown) => boolean} onRefused  whether the error is final, so that asking again is of no use
 * @property {(f: () => void, ms: number) => ReturnType<typeof setTimeout>} [later]
 */

export class Feed {
  #attempt = 0;
  /** @type {AbortController|null} */ #now = null;
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #timer;
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #watch;
  #stopped = false;

  /** @param {FeedOptions} options */
  constructor(options) {
    this.options = { later: setTimeout.bind(globalThis), ...options };
  }

  /** Connects, now; where it waits to try again it waits no longer. */
  start() {
    clearTimeout(this.#timer);
    if (this.#stopped || this.#now) return;
    this.#run();
  }

  /** For good. */
  stop() {
    this.#stopped = true;
    clearTimeout(this.#timer);
    clearTimeout(this.#watch);
    this.#now?.abort();
  }

  async #run() {
    const control = new AbortController();
    this.#now = control;
    let final = false;
    try {
      this.#heard(control);
      const response = await this.options.open(control.signal);
      await this.#read(response, control);
    } catch (error) {
      final = !control.signal.aborted && this.options.onRefused(error);
    }
    clearTimeout(this.#watch);
    this.#now = null;
    if (this.#stopped) return;
    this.options.onStatus(false);
    if (final) return this.stop();
    this.#timer = this.options.later(() => this.start(), backoff(this.#attempt++, FIRST, LONGEST));
  }

  /** @param {Response} response @param {AbortController} control */
  async #read(response, control) {
    const reader = new EventReader();
    const decoder = new TextDecoder();
    const body = /** @type {ReadableStream<Uint8Array<ArrayBuffer>>} */ (response.body).getReader();
    this.options.onStatus(true);
    for (;;) {
      const { done, value } = await body.read();
      if (done) return;
      this.#attempt = 0;
      this.#heard(control);
      for (const event of reader.read(decoder.decode(value, { stream: true })))
        if (!control.signal.aborted) this.options.onEvent(event);
    }
  }

  /** A connection that says nothing any more is none. @param {AbortController} control */
  #heard(control) {
    clearTimeout(this.#watch);
    this.#watch = this.options.later(() => control.abort(), SILENCE);
  }
}
