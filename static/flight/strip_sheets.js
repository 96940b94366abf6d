/**
 * The sheets of the strip chart: pictures of 4 s each, that stand where their time is and come round again. What is
 * painted moves on by a transform; new bins alone are painted.
 * @typedef {import('./lanes.js').LaneScales} LaneScales
 * @typedef {import('./strip_ink.js').Inks} Inks
 * @typedef {import('./trace.js').Trace} Trace
 *
 * @typedef {object} Plan  how they are laid out, in device pixels where nothing else is said
 * @property {number} room  width of the window
 * @property {number} height  with the times below the lanes
 * @property {number} lanes  height without them
 * @property {{scales: LaneScales, top: number, height: number}[]} places
 * @property {number} ratio  device pixels to one of the page's
 * @property {number} line  the same at the page's width of lines
 * @property {string} font
 * @property {number} every  s, between two times
 */
import { h } from '../ui/index.js';
import { paintLane, paintTimes, xOf } from './strip_ink.js';
import { BINS_PER_SECOND } from './trace.js';

/** What is seen, s, and how much of it a sheet has. */
export const WINDOW = 20;
const SHEET = 4;
const SHEETS = WINDOW / SHEET;
const BINS = SHEET * BINS_PER_SECOND;
/** Columns that are painted again with the next ones, px of the page's width of lines. */
const AGAIN = 3;

/**
 * number: of its stretch of time; NaN: of none.
 * @typedef {{node: HTMLCanvasElement, ctx: CanvasRenderingContext2D, number: number}} Sheet
 */

export class Sheets {
  node = h('div', { class: 'strip-scroll' });
  /** @type {Sheet[]} */ #all = [];
  /** @type {Plan|null} */ #plan = null;
  #width = 0; // of a sheet, device px
  /** The bin behind the last that is painted. */ painted = 0;

  constructor() {
    for (let i = 0; i < SHEETS + 2; i++) {
      const node = h('canvas');
      this.#all.push({ node, ctx: /** @type {CanvasRenderingContext2D} */ (node.getContext('2d')), number: NaN });
      this.node.append(node);
    }
  }

  /** Page's pixels in a second. */
  get scale() {
    return this.#width / SHEET / (this.#plan?.ratio ?? 1);
  }

  /** They are empty then. @param {Plan} plan */
  layOut(plan) {
    this.#plan = plan;
    this.#width = Math.max(Math.round(plan.room / SHEETS), 8);
    for (const { node } of this.#all) {
      [node.width, node.height] = [this.#width, plan.height];
      [node.style.width, node.style.height] = [`${this.#width / plan.ratio}px`, `${plan.height / plan.ratio}px`];
    }
    this.forget();
  }

  /** What is painted is of no use. */
  forget() {
    this.painted = 0;
    for (const sheet of this.#all) sheet.number = NaN;
  }

  /** How far they have moved when this bin is the next, in the page's pixels. @param {number} head */
  shift(head) {
    return Math.round((head * this.#width) / BINS) / (this.#plan?.ratio ?? 1);
  }

  /** The first bin that is seen when this one is the next. @param {number} head */
  first(head) {
    const window = Math.ceil((this.#plan?.room ?? 0) / (this.#width / BINS)) + 1;
    return head - window;
  }

  /**
   * Paints what is new.
   * @param {Trace} trace @param {number} head  the bin behind the last that is seen
   * @param {Inks} inks @param {readonly boolean[]} anew  lanes whose scales are others now
   */
  paint(trace, head, inks, anew) {
    const plan = this.#plan;
    if (!plan) return;
    const { painted } = this;
    const first = this.first(head);
    // the last columns come again: what follows changes how lines join there
    const again = Math.ceil(AGAIN * plan.line);
    const before = Math.ceil((2 * again * BINS) / this.#width) + 1;
    for (let number = Math.floor(first / BINS); number * BINS <= head; number++) {
      const sheet = this.#all[modulo(number, this.#all.length)];
      const begun = sheet.number === number;
      if (!begun) this.#begin(sheet, number, plan, inks);
      const on = this.#on(sheet, plan, inks);
      const last = Math.min(head, (number + 1) * BINS + before);
      const left = Math.max(Math.floor(xOf(on, painted - 1)) - again, 0);
      plan.places.forEach((place, i) => {
        const whole = !begun || anew[i];
        if (!whole && left >= this.#width) return;
        const from = whole || left === 0 ? number * BINS - before : painted - before;
        paintLane(on, trace, place, whole ? 0 : left, plan.every, Math.max(from, first), last);
      });
    }
    this.painted = head;
  }

  /** @param {Sheet} sheet @param {number} number @param {Plan} plan @param {Inks} inks */
  #begin(sheet, number, plan, inks) {
    sheet.number = number;
    sheet.node.style.left = `${(number * this.#width) / plan.ratio}px`;
    const on = this.#on(sheet, plan, inks);
    paintTimes(on, plan.lanes, plan.height - plan.lanes, plan.every, plan.font);
  }

  /** @param {Sheet} sheet @param {Plan} plan @param {Inks} inks @returns {import('./strip_ink.js').Sheet} */
  #on({ ctx, number }, plan, inks) {
    return { ctx, origin: number * BINS, perBin: this.#width / BINS, width: this.#width, ratio: plan.line, inks };
  }
}

/** @param {number} a @param {number} n  also of what lies before the start */
const modulo = (a, n) => ((a % n) + n) % n;
