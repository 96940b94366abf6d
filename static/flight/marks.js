/**
 * What has happened, over the strip chart: a line at its time with a flag. What follows at once and is of the same kind
 * makes a stretch of it: a pole that is dragged is one change, from before to after.
 * @typedef {object} Mark
 * @property {number} time  s
 * @property {number} until  s
 * @property {string} title
 * @property {string} kind  design, takeover, gust, fault, hands, …
 */
import { h, setAttr, setText } from '../ui/index.js';

/** Between two that are one, s. */
const TOGETHER = 0.6;
/** Marks that are kept: those of the last minute and of the window before it, as a rule. */
const MOST = 400;

/**
 * Adds one, or draws the last of its kind out.
 * @param {Mark[]} marks  in order of time
 * @param {number} time @param {string} title @param {string} kind
 * @returns {Mark} the one that tells of it
 */
export function joined(marks, time, title, kind) {
  const last = marks.findLast((own) => own.kind === kind);
  if (last && time - last.until < TOGETHER) {
    last.until = Math.max(time, last.until);
    last.title = title;
    return last;
  }
  const made = { time, until: time, title, kind };
  marks.push(made);
  return made;
}

/**
 * The mark that is meant by a place, null where none is near.
 * @param {readonly Mark[]} marks @param {number} time  s, of the place @param {number} reach  s
 */
export function nearest(marks, time, reach) {
  let [found, least] = [/** @type {Mark|null} */ (null), reach];
  for (const mark of marks) {
    const away = Math.max(mark.time - time, time - mark.until, 0);
    if (away <= least) [found, least] = [mark, away];
  }
  return found;
}

export class Marks {
  node = h('div', { class: 'strip-marks', 'aria-hidden': 'true' });
  /** In order of time. @type {Mark[]} */ all = [];
  /** @type {Map<Mark, {node: HTMLElement, flag: HTMLElement}>} */ #drawn = new Map();
  #scale = 0; // px in a second
  #cursor = h('div', { class: 'strip-cursor', hidden: true });
  #looked = 0; // where the cursor stands, s

  constructor() {
    this.node.append(this.#cursor);
  }

  /** @param {number} time @param {string} title @param {string} kind */
  put(time, title, kind) {
    const mark = joined(this.all, time, title, kind);
    if (!this.#drawn.has(mark)) {
      const flag = h('span', { class: 'strip-flag' });
      const node = h('div', { class: 'strip-mark', 'data-kind': kind }, flag);
      this.#drawn.set(mark, { node, flag });
      this.node.append(node);
    }
    if (this.all.length > MOST) this.#drop(this.all.splice(0, this.all.length - MOST));
    for (const own of this.all.slice(-2)) this.#place(own);
  }

  /** What was from this time on has not been. @param {number} time  s */
  cut(time) {
    this.#drop(this.all.filter((own) => own.time > time));
    this.all = this.all.filter((own) => own.time <= time);
    for (const mark of this.all) mark.until = Math.min(mark.until, time);
    this.scale = this.#scale;
  }

  /** Where one looks, s; null: nowhere. @param {number|null} time */
  look(time) {
    this.#cursor.hidden = time === null;
    this.#looked = time ?? this.#looked;
    this.#cursor.style.left = `${this.#looked * this.#scale}px`;
  }

  clear() {
    this.#drop(this.all.splice(0));
  }

  /** px in a second. @param {number} scale */
  set scale(scale) {
    this.#scale = scale;
    for (const mark of this.all) this.#place(mark);
    this.#cursor.style.left = `${this.#looked * scale}px`;
  }

  /** @param {Mark[]} marks */
  #drop(marks) {
    for (const mark of marks) {
      this.#drawn.get(mark)?.node.remove();
      this.#drawn.delete(mark);
    }
  }

  /** @param {Mark} mark */
  #place(mark) {
    const own = this.#drawn.get(mark);
    if (!own) return;
    const next = this.all[this.all.indexOf(mark) + 1];
    setText(own.flag, mark.title);
    setAttr(own.flag, 'title', mark.title);
    own.node.style.left = `${mark.time * this.#scale}px`;
    own.node.style.width = `${(mark.until - mark.time) * this.#scale}px`;
    // a flag ends where the next one begins
    own.flag.style.maxWidth = next ? `${Math.max((next.time - mark.time) * this.#scale - 2, 0)}px` : '';
  }
}
