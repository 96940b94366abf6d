/**
 * The page's own numbers: while a hand moves something nobody is asked, and every frame computes the newest design. The
 * server is asked when the hand rests; its numbers are compared with the page's, and hold. What the kernel does not
 * serve goes to the server at once, as all does before it is loaded.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Reply} Reply
 * @typedef {import('../types.js').LiveReply} LiveReply
 * @typedef {import('../types.js').Design} Design
 * @typedef {{numbers: Float64Array, update: (size: import('./numbers.js').Size, samples: number) =>
 *   import('./reply.js').Block}} Kernel
 */
import { say } from '../text/index.js';
import { presetOf, scenarioOf } from '../model/index.js';
import { differenceOf } from './compare.js';
import { fill, serves, sizeOf } from './numbers.js';
import { replyOf, withWords } from './reply.js';

/**
 * @typedef {ReturnType<typeof setTimeout>} Timer
 * @typedef {{now: () => number, later: (act: () => void, ms: number) => Timer, cancel: (timer?: Timer) => void}} Clock
 */
/** @type {Clock} */
const CLOCK = {
  now: () => performance.now(),
  later: (act, ms) => setTimeout(act, ms),
  cancel: (timer) => clearTimeout(timer),
};
const REST_MS = 200;
const SLOW_MS = 60; // where an update takes longer, a drag goes by the server

export class Own {
  /** The server's last reply, whose words are shown. @type {import('./reply.js').Said|null} */ #said;
  /** Computed here, and not compared yet. @type {Map<Design, Reply>} */ #made = new Map();
  /** Asked of the server. @type {Set<Design>} */ #asked = new Set();
  /** What has been computed, or could not be. @type {Design|null} */ #seen = null;
  /** Which design came after which. @type {WeakMap<Design, number>} */ #ages = new WeakMap();
  #newest = 0;
  /** The step of undo during which this took too long. */ #slow = -1;
  /** The page's pointer is down. */ #down = false;
  #broken = false;
  #held = false;
  /** When the design was changed last, and in which step of undo. */ #edited = -Infinity;
  #step = -1;
  /** @type {Timer|undefined} */ #timer;

  /**
   * @param {import('../model/store.js').Store} store
   * @param {Kernel} kernel
   * @param {() => void} ask  sends the present design to the server
   * @param {Clock} [clock]
   */
  constructor(store, kernel, ask, { now, later, cancel } = CLOCK) {
    this.store = store;
    this.kernel = kernel;
    this.ask = ask;
    this.now = now;
    this.later = later;
    this.cancel = cancel;
    const { reply, heard, design } = store.state;
    this.#said = reply && { reply, design: heard };
    this.#seen = design;
    if (design && this.#serves(design)) this.#attempt(design); // a slow one: browsers compile what they run
    this.#slow = store.busy ? store.step : -1; // what has begun goes on by the server
  }

  /** A pointer that is held moves something: a slider, a pole. @param {EventTarget} page */
  watch(page) {
    for (const [type, down] of /** @type {const} */ ([
      ['pointerdown', true],
      ['pointerup', false],
      ['pointercancel', false],
    ]))
      page.addEventListener(type, () => (this.#down = down), { capture: true, passive: true });
    return this;
  }

  /** The design has changed. @returns {boolean} whether the server is to be asked later */
  edited() {
    const { design } = this.store.state;
    if (design) this.#ages.set(design, ++this.#newest);
    const now = this.now();
    const quick = this.store.step === this.#step && now - this.#edited < REST_MS;
    // a hidden page has no frames; others may watch it
    const moving = (this.#down || this.store.state.dragging || quick) && !globalThis.document?.hidden;
    [this.#edited, this.#step] = [now, this.store.step];
    this.cancel(this.#timer);
    this.#held = design !== null && this.store.busy && moving && this.#serves(design);
    if (this.#held) this.#timer = this.later(() => this.#askNow(), REST_MS);
    else if (design) this.#asked.add(design);
    return this.#held;
  }

  /** @param {Design|null} design @returns {number} 0 where it was there at the beginning */
  #age(design) {
    return (design && this.#ages.get(design)) ?? 0;
  }

  /** @param {Design} design */
  #serves(design) {
    const preset = presetOf(this.store.state);
    const ready = !this.#broken && this.store.step !== this.#slow && this.#said !== null;
    return ready && preset !== undefined && serves(design, preset);
  }

  #askNow() {
    this.cancel(this.#timer);
    this.#held = false;
    const { design } = this.store.state;
    if (design) this.#asked.add(design);
    this.ask();
  }

  /** In the animation frame of an event, before anything is drawn. */
  frame() {
    const { design, answered } = this.store.state;
    if (design && design !== this.#seen) {
      this.#seen = design;
      // an answer may have been quicker than the frame
      const reply = answered !== design && this.#serves(design) ? this.#attempt(design) : null;
      if (reply) this.#show(design, reply);
      else if (this.#held) this.#askNow();
    }
    if (this.#held && !this.store.busy) this.#askNow();
  }

  /** What a design would come to that nobody has chosen. @param {Design} design @returns {Reply|null} */
  replyTo(design) {
    return this.#serves(design) ? this.#attempt(design) : null;
  }

  /** @param {Design} design */
  #attempt(design) {
    try {
      return this.#replyTo(design);
    } catch (error) {
      console.error(error);
      this.#broken = true; // the server does it all
      return null;
    }
  }

  /** @param {Design} design @param {Reply} reply */
  #show(design, reply) {
    for (const old of this.#made.keys()) if (!this.#asked.has(old)) this.#made.delete(old);
    this.#made.set(design, reply);
    this.store.set({ reply, answered: design, problem: null });
  }

  /** @param {Design} design @returns {Reply|null} null where the kernel does not find it */
  #replyTo(design) {
    const preset = presetOf(this.store.state);
    if (!preset || !this.#said) return null;
    const begin = this.now();
    const how = { size: sizeOf(design, preset), samples: scenarioOf(design).samples };
    fill(this.kernel.numbers, design, preset);
    const block = this.kernel.update(how.size, how.samples); // its memory may have moved
    const reply = replyOf(block, this.kernel.numbers, design, how, this.#said);
    if (this.now() - begin > SLOW_MS) this.#slow = this.store.step;
    return reply;
  }

  /**
   * The server has answered.
   * @param {LiveReply} reply @param {Design|null} design to which
   * @returns {Partial<State>} what of it is to be shown
   */
  heard(reply, design) {
    this.#said = { reply, design };
    const { state } = this.store;
    const made = design && this.#made.get(design);
    const found = made ? differenceOf(made, reply) : null;
    const told = found && {
      differences: state.differences + 1,
      notice: say`The server’s ${found.name} is ${found.server}; here it was ${found.own}. The server’s is shown.`,
    };
    if (design) {
      this.#asked.delete(design);
      this.#made.delete(design);
    }
    // shown are numbers of a later design, the page's own, though the hand may have gone on since the last frame
    const later = this.#age(state.answered) > this.#age(design);
    if (later && state.reply) return { reply: withWords(state.reply, reply), heard: design, ...told };
    this.#asked.clear(); // what was overtaken on its way is answered by nobody
    return { reply, answered: design, heard: design, problem: null, ...told };
  }
}
