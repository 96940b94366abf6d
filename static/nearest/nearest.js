/**
 * Why not: where the design misses what is required below the s-plane, or by a lab's step, the smallest moves that
 * would meet it, as arrows and in words. The server looks for them while the hand rests; a click takes one.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../labs/shapes.js').Goal} Goal
 * @typedef {import('../contract.js').NearestReply} Reply
 * @typedef {import('../contract.js').MoveReply} Move
 * @typedef {{show: (design: Design) => void, end: () => void, take: (design: Design) => void}} Preview
 */
import { call, Latest } from '../net/index.js';
import { h, svg } from '../ui/index.js';
import { arrowOf } from './arrows.js';
import { freeOf, isKeptBack, requestOf, requiredOf } from './asked.js';
import { inWords, Line } from './line.js';
import { moved, numbersOf, waysOf } from './moves.js';

const REST_MS = 250;
/** Answers that are kept: undo and redo find them again. */
const KEPT = 24;

/** @typedef {{key: string, body: ReturnType<typeof requestOf>, design: Design}} Asked */

export class Nearest {
  /** @type {Asked|null} what the page would ask now */ #asked = null;
  /** What is shown, and of which design. @type {{design: Design, reply: Reply}|null} */ #shown = null;
  /** @type {Map<string, Reply>} */ #known = new Map();
  /** @type {Latest<Asked>} */ #asks = new Latest((asked) => void this.#ask(asked));
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #timer;
  /** The designs that moves lead to, one object each. @type {WeakMap<Move, Design>} */ #led = new WeakMap();
  /** @type {Move|null} what is pointed at */ #on = null;
  /** @type {Goal[]|null} for which it was asked by a click */ #wanted = null;
  /** The design that was taken, and what it had moved. @type {{design: Design, words: string}|null} */ #taken = null;
  /** Rules of labs, once there is one. @type {typeof import('../labs/index.js')|null} */ #labs = null;
  #drawn = '';

  /**
   * @param {import('../splane/splane.js').SPlane} plane
   * @param {HTMLElement} loops  the panel of the PI loops
   * @param {import('../model/store.js').Store} store
   * @param {Preview} preview
   */
  constructor(plane, loops, store, preview) {
    this.plane = plane;
    this.loops = loops;
    this.store = store;
    this.preview = preview;
    this.line = new Line({
      on: (move) => this.#point(move),
      take: (move) => this.#take(move),
      ask: () => this.#want(),
    });
    this.layer = svg('g', { class: 'nearest-ways', 'data-testid': 'nearest-ways', 'aria-hidden': 'true' });
    plane.marks.handles[0].before(this.layer);
    plane.bar.node.after(this.line.node);
    const before = plane.over;
    plane.over = (fresh) => {
      before?.(fresh);
      if (fresh) this.#draw();
    };
  }

  /** @param {State} state */
  render(state) {
    const { design, heard, answered, problem, dragging, connection, preview, view, task } = state;
    const goals = task?.goals ?? [];
    if (preview) {
      // what is shown is of the present design, and stays as long as that is asked for
      const { design: own, reply } = this.store.state;
      const still = this.#askedOf({ ...state, design: own, reply }, goals)?.key === this.#asked?.key;
      if (this.#on && !still) this.#point(null);
      return;
    }
    if (goals.length && !this.#labs) {
      import('../labs/index.js').then((labs) => {
        this.#labs = labs;
        this.render(this.store.state);
      }, console.warn);
      return;
    }
    if (this.#wanted !== goals && goals.length) this.#wanted = null;
    const asked = view === 'design' && answered === design && !dragging ? this.#askedOf(state, goals) : null;
    if (asked?.key === this.#asked?.key && (asked || !this.#asked)) {
      if (asked && heard === design && !problem && connection !== 'lost') this.#start(asked);
      else if (!asked) this.#rest(state);
      return;
    }
    this.#asked = asked;
    clearTimeout(this.#timer);
    this.#timer = undefined;
    this.#put(null);
    const known = asked && this.#known.get(asked.key);
    if (!asked) this.#rest(state);
    else if (known) this.#put({ design: asked.design, reply: known });
    else if (goals.length && this.#wanted !== goals)
      this.line.offer(); // a lab's student asks for it
    else {
      this.line.clear();
      if (heard === design && !problem && connection !== 'lost') this.#start(asked);
    }
  }

  /** Nothing is asked: there is what was taken, as long as it is the present design. @param {State} state */
  #rest(state) {
    if (state.view === 'design' && state.design === this.#taken?.design && !isKeptBack(state))
      this.line.taken(this.#taken.words);
    else this.line.clear();
  }

  /** @param {State} state @param {Goal[]} goals @returns {Asked|null} null where nothing is missed or may be said */
  #askedOf(state, goals) {
    const { design } = state;
    if (!design || isKeptBack(state)) return null;
    const labs = this.#labs;
    const require = requiredOf(state, goals, (goal) => labs?.judged(goal, state).met === false);
    const free = freeOf(state);
    if (!require || !free.length) return null;
    const body = requestOf(design, require, free);
    return { key: JSON.stringify(body), body, design };
  }

  /** @param {Asked} asked */
  #start(asked) {
    const goals = this.store.state.task?.goals ?? [];
    if (this.#timer !== undefined || this.#shown || (goals.length && this.#wanted !== goals)) return;
    if (this.#asks.underWay?.key === asked.key || this.#known.has(asked.key)) return;
    this.#timer = setTimeout(() => {
      this.line.wait();
      this.#asks.put(asked);
    }, REST_MS);
  }

  /** By a click, in a lab. */
  #want() {
    this.#wanted = this.store.state.task?.goals ?? null;
    if (this.#asked) this.#start(this.#asked);
  }

  /** @param {Asked} asked */
  async #ask(asked) {
    /** @type {Reply|null} */
    const reply = await call('api/v1/nearest', asked.body).catch(() => null); // what is wrong is told elsewhere
    if (reply) {
      this.#known.set(asked.key, reply);
      const [oldest] = this.#known.keys();
      if (this.#known.size > KEPT) this.#known.delete(oldest);
    }
    if (this.#asked?.key === asked.key) {
      if (reply) this.#put({ design: asked.design, reply });
      else this.line.clear();
    }
    this.#asks.done();
  }

  /** @param {{design: Design, reply: Reply}|null} shown */
  #put(shown) {
    this.#shown = shown;
    this.#on = null;
    if (shown) this.line.show(shown.design, shown.reply);
    this.#draw();
  }

  /** The design that a move leads to. @param {Move} move @returns {Design} */
  #end(move) {
    const { design } = /** @type {{design: Design}} */ (this.#shown);
    const known = this.#led.get(move) ?? moved(design, move);
    this.#led.set(move, known);
    return known;
  }

  /** @param {Move|null} move */
  #point(move) {
    if (!this.#shown || move === this.#on) return;
    this.#on = move;
    if (move) this.preview.show(this.#end(move));
    else this.preview.end();
    this.#draw();
  }

  /** @param {Move} move */
  #take(move) {
    if (!this.#shown) return;
    const end = this.#end(move);
    this.#taken = { design: end, words: inWords(this.#shown.design, move) };
    this.#on = null;
    this.preview.take(end);
  }

  /** The arrows of the move that is pointed at, or else of the nearest, and the loops' numbers. */
  #draw() {
    const move = this.#on ?? this.#shown?.reply.moves[0] ?? null;
    const from = this.#shown?.design;
    const { view } = this.plane;
    const key = move && from ? JSON.stringify([move.design, from.poles, from.loops, view]) : '';
    if (key === this.#drawn) return;
    this.#drawn = key;
    for (const old of this.loops.querySelectorAll('.nearest-number')) old.remove();
    if (!move || !from) {
      this.layer.replaceChildren();
      return;
    }
    const to = this.#end(move);
    this.layer.replaceChildren(...waysOf(from, to).map((way) => arrowOf(view, way, () => this.#take(move))));
    for (const { axis, text } of numbersOf(from, to)) {
      const number = h('span', { class: 'nearest-number', 'data-testid': `nearest-${axis}-pi`, translate: 'no' }, text);
      number.ariaHidden = 'true'; // the move's button says it
      this.loops.querySelector(`.pi.${axis} legend`)?.append(number);
    }
  }
}
