/**
 * Keeps the address in step with the state, so that it can be mailed, reloaded, and walked through with the browser's
 * Back and Forward: an entry of the history for every step of undo, rewritten while the gesture goes on. Browsers allow
 * about a hundred such calls in half a minute.
 * @typedef {import('../types.js').State} State
 * @typedef {import('./permalink.js').Known} Known
 */
import { initialState, isView, STANDARD_VIEW, viewOfPlace } from '../model/index.js';
import { linkOf, placeIn, readLink } from './permalink.js';
import { troubleWords } from './trouble.js';

const WITHIN_MS = 1000; // between two writes of one gesture
const BURST = 20; // calls that may follow each other at once
const REFILL_MS = 400; // for each call after these: at most 20 + 75 in half a minute

/** Allows so many calls at once, and one more every so often. */
export class Budget {
  #tokens = BURST;
  #since;

  /** @param {number} now ms */
  constructor(now) {
    this.#since = now;
  }

  /** @param {number} now ms @returns {boolean} whether a call may be made; then it counts */
  take(now) {
    const refilled = Math.floor((now - this.#since) / REFILL_MS);
    this.#tokens = Math.min(BURST, this.#tokens + refilled);
    this.#since += refilled * REFILL_MS;
    if (this.#tokens < 1) return false;
    this.#tokens -= 1;
    return true;
  }
}

/** What of the state a link holds. @param {State} s */
const held = (s) => [
  s.design,
  s.view,
  s.motion,
  s.showLinear,
  s.showMarks,
  s.showLag,
  s.spread,
  s.map,
  s.track,
  s.requirements,
  s.locks,
  s.plant,
  s.find,
  pinKey(s.pins),
  s.plantPins.map((p) => p.id).join(),
];
/** Their replies are no part of it. @param {State['pins']} pins */
const pinKey = (pins) => pins.map((p) => `${p.id} ${p.index} ${p.name}`).join('\n');

/**
 * @typedef {ReturnType<typeof setTimeout>} Timer
 * @typedef {{hash: () => string, push: (hash: string) => void, replace: (hash: string) => void, now: () => number,
 *   later: (f: () => void, ms: number) => Timer, cancel: (id: Timer) => void}} Browser
 */
/** @type {() => Browser} */
const browser = () => ({
  hash: () => location.hash,
  push: (hash) => history.pushState(null, '', hash),
  replace: (hash) => history.replaceState(null, '', hash),
  now: () => performance.now(),
  later: (f, ms) => setTimeout(f, ms),
  cancel: (id) => clearTimeout(id),
});

export class Address {
  #shown = '';
  #step = -1;
  /** A lab's, in place of the design's. @type {{hash: string, end?: () => void}|null} */ #held = null;
  /** @type {string|null} */ #place = null;
  /** Whether the address names a whole view, which begins at its top. */ toTop = false;
  /** @type {unknown[]} */ #seen = [];
  /** @type {{state: State, step: number}|null} */ #pending = null;
  /** @type {Timer|null} */ #timer = null;
  #wrote = -Infinity;

  /** @param {import('../model/store.js').Store} store @param {Browser} [of] */
  constructor(store, of = browser()) {
    this.store = store;
    this.of = of;
    this.budget = new Budget(of.now());
  }

  /** @returns {Known} */
  get #known() {
    const { presets, methods } = this.store.state;
    return { presets, methods };
  }

  /** @param {string} hash empty: the design's @param {() => void} [end] a design's link is opened */
  hold(hash, end) {
    this.#held = hash ? { hash, end } : null;
    this.#shown = this.of.hash(); // Back and Forward within a lab are not told here
    this.#cancel();
    if (this.#step >= 0) this.#write(this.store.state, this.#step);
  }

  /** A lab's, or the design's. @param {State} state @param {string|null} [place] */
  #linkOf(state, place) {
    if (!this.#held) return linkOf(state, this.#known, place);
    return this.#held.hash + (state.view === STANDARD_VIEW ? '' : `&view=${state.view}`);
  }

  /** The present link, with its #. */
  get link() {
    return linkOf(this.store.state, this.#known);
  }

  /** The present design with other locks. @param {string[]} locks */
  linkWith(locks) {
    return linkOf({ ...this.store.state, locks }, this.#known);
  }

  /**
   * Fills the store from the address; called once, when the presets are known.
   * @param {import('../types.js').View} [first] the view where the address names none
   */
  open(first = this.store.state.view) {
    const link = readLink(this.of.hash(), this.#known);
    const { design } = readLink('#v1', this.#known);
    this.store.set(link.shown ?? { view: viewOfPlace(link.place) ?? first });
    const fresh = /** @type {import('../types.js').Design} */ (design);
    // the first minute begins with the inner loop alone: PI moves the poles that one has just placed
    const alone = this.store.state.view === 'explore' ? { ...fresh, outer: /** @type {const} */ ('none') } : fresh;
    this.store.load(link.design ?? alone);
    if (link.pins?.length) this.store.addPins(link.pins.map((pin) => ({ ...pin, reply: null })));
    this.store.addPlantPins(link.plantPins ?? []);
    this.store.set({ notice: troubleWords(link.trouble) });
    this.#at(link.place);
    this.#step = this.store.step;
    // a link that was not understood stays to be read
    if (!link.trouble.length) this.#write(this.store.state, this.#step);
  }

  /** The place on the page to which the address leads; null where it names a whole view. */
  get place() {
    return this.#place;
  }

  /** @param {string|null} [place] */
  #at(place) {
    this.toTop = isView(place);
    this.#place = place && !isView(place) ? place : null;
  }

  /** After Back, Forward, a jump within the page, or a link put into the address bar. */
  navigated() {
    const hash = this.of.hash();
    if (hash === this.#shown || !this.store.state.design) return;
    const link = readLink(hash, this.#known);
    if (!link.design && !link.trouble.length) {
      // a jump within the page: the design goes along
      this.flush();
      const place = placeIn(hash);
      this.#at(place);
      this.store.set({ view: viewOfPlace(place) ?? this.store.state.view });
      this.#seen = held(this.store.state);
      this.#replace(this.#linkOf(this.store.state, this.#place));
      return;
    }
    this.#cancel();
    this.#held?.end?.();
    this.#held = null;
    const { plant = null, ...shown } = link.shown ?? {};
    this.store.set({ ...shown, notice: troubleWords(link.trouble) });
    if (!link.design) return;
    this.#at(link.place);
    this.#shown = hash;
    const known = new Set(this.store.state.pins.map((p) => p.name));
    // going back takes no pin away
    this.store.addPins((link.pins ?? []).filter((p) => !known.has(p.name)).map((pin) => ({ ...pin, reply: null })));
    this.store.addPlantPins(link.plantPins ?? []);
    this.store.editPlant(plant);
    if (this.#words(link.design) !== this.#words(this.store.state.design)) this.store.restore(link.design);
    this.#step = this.store.step;
    this.#seen = held(this.store.state);
  }

  /** A design alone, as a link has it. @param {import('../types.js').Design|null} design */
  #words(design) {
    return linkOf({ ...initialState(), design }, this.#known);
  }

  /** @param {State} state */
  render(state) {
    if (!state.design || this.#step < 0) return;
    const now = held(state);
    if (now.every((v, i) => v === this.#seen[i])) return;
    this.#seen = now;
    if (this.#pending && this.#pending.step !== this.store.step) this.flush();
    this.#pending = { state, step: this.store.step };
    if (this.#timer !== null) return;
    this.#timer = this.of.later(
      () => this.flush(),
      this.store.busy ? Math.max(0, WITHIN_MS - (this.of.now() - this.#wrote)) : 0,
    );
  }

  /** Writes what waits. */
  flush() {
    const pending = this.#pending;
    this.#cancel();
    if (!pending) return;
    if (this.#write(pending.state, pending.step)) return;
    this.#pending = pending;
    this.#timer = this.of.later(() => this.flush(), REFILL_MS);
  }

  #cancel() {
    if (this.#timer !== null) this.of.cancel(this.#timer);
    this.#timer = null;
    this.#pending = null;
  }

  /** @param {State} state @param {number} step @returns {boolean} whether the address is right now */
  #write(state, step) {
    const fresh = step !== this.#step;
    const link = this.#linkOf(state, fresh ? null : this.#place);
    if (link === this.#shown) return true;
    if (!this.budget.take(this.of.now())) return false;
    this.#wrote = this.of.now();
    if (!fresh || this.#held) return this.#replace(link);
    this.#place = null;
    this.#step = step;
    return this.#attempt(() => this.of.push(link), link);
  }

  /** @param {string} link */
  #replace(link) {
    return this.#attempt(() => this.of.replace(link), link);
  }

  /** A browser may refuse all the same; then the next change writes. @param {() => void} call @param {string} link */
  #attempt(call, link) {
    try {
      call();
      this.#shown = this.of.hash();
    } catch {
      this.#shown = link;
    }
    return true;
  }
}
