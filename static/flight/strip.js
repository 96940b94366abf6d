/**
 * A strip chart of the last 20 s of a flight: angles with their set points, voltages with their limits, rates true and
 * measured, torques from outside; above them what has happened, beside them what is so now.
 * @typedef {import('./strip_ink.js').Inks} Inks
 * @typedef {import('./marks.js').Mark} Mark
 */
import { say } from '../text/index.js';
import { h, pictureScale, setAttr } from '../ui/index.js';
import { LANE, LaneScales, placed } from './lanes.js';
import { Marks, nearest } from './marks.js';
import { DIVISIONS } from './scales.js';
import { Sheets, WINDOW } from './strip_sheets.js';
import { StripValues } from './strip_values.js';
import { binOf, Trace } from './trace.js';

/** px at the usual size of type: of the scales; their room at either side; of times below and of flags above. */
const [TYPE, SIDE, FOOT, HEAD] = [11, 42, 20, 22];
/** From this width on values stand beside their lanes, else above them, in so much room. */
const [WIDE, BESIDE, ABOVE] = [540, 168, 22];
/** Between two times, s: where a second has so much room, and where it has not. */
const [ROOMY, OFTEN, SELDOM] = [26, 2, 5];
/** How often values are written, and told to those who hear them, ms. */
const [READ, TOLD] = [100, 1000];
/** A press so near to a mark means it, px. */
const REACH = 22;
/** Of a moment that is looked at, what came before it is seen as well, s. */
const BEFORE = 2;
/** @type {(keyof Inks)[]} */
const NAMES = ['pitch', 'yaw', 'danger', 'muted', 'grid', 'line', 'limit-fill'];
const THEMES = ['(prefers-color-scheme: dark)', '(prefers-contrast: more)'];
const PRINTS = ['beforeprint', 'afterprint'];

export class Strip {
  /** V_p and V_y at most, V. @type {[number, number]} */ limits = [Infinity, Infinity];
  #trace = new Trace();
  #sheets = new Sheets();
  #marks = new Marks();
  #values = new StripValues();
  #scales = Object.values(LANE).map((lane) => new LaneScales(lane));
  #plot = h('div', { class: 'strip-plot', role: 'img' }, this.#sheets.node);
  #over = h('div', { class: 'strip-over' }, this.#marks.node);
  #axes = h('canvas', { class: 'strip-axes', 'aria-hidden': 'true' });
  node = h(
    'figure',
    { class: 'strip', 'aria-label': 'Strip chart' },
    this.#axes,
    this.#plot,
    this.#over,
    this.#values.node,
  );
  /** @type {import('./lanes.js').Place[]} */ #places = [];
  /** @type {Inks|null} */ #inks = null;
  #size = { width: 0, height: 0 };
  #left = 0; // of the plot, px
  #ratio = 0; // device pixels to one of the page's
  #laidOut = false;
  /** @type {number|null} */ #looked = null;
  #lastRead = -Infinity;
  #lastTold = -Infinity;

  /**
   * @param {HTMLElement} root  whose room it takes
   * @param {{onMark?: (mark: Mark) => void}} [how]  onMark: a mark was pressed
   */
  constructor(root, { onMark } = {}) {
    root.append(this.node);
    new ResizeObserver(([{ contentRect }]) => this.#resized(contentRect)).observe(this.node);
    const anew = () => this.#repaint();
    for (const query of THEMES) matchMedia(query).addEventListener('change', anew);
    for (const type of PRINTS) addEventListener(type, () => this.#onPaper(type === PRINTS[0]));
    if (onMark) this.#over.addEventListener('click', (e) => this.#pressed(e, onMark));
  }

  /** Nothing has been flown. */
  clear() {
    this.#trace.clear();
    this.#marks.clear();
    this.#values.clear();
    for (const scales of this.#scales) scales.reset();
    this.#repaint();
  }

  /**
   * Ticks that were flown, as Flight's event `frame` tells them.
   * @param {Float64Array} rows @param {number} count @param {number} step @param {number} time  of the first, s
   */
  put(rows, count, step, time) {
    if (!count) return;
    const { head } = this.#trace;
    this.#trace.put(rows, count, step, time, this.limits);
    if (this.#trace.head < head) this.#repaint();
    this.#values.take(rows, count, this.limits);
  }

  /**
   * What the values beside the lanes tell, where nothing new was flown.
   * @param {Float64Array} rows @param {number} count
   */
  read(rows, count) {
    if (count) this.#values.take(rows, count, this.limits);
  }

  /** Something has happened. @param {number} time  s @param {string} title @param {string} [kind] */
  mark(time, title, kind = 'design') {
    this.#marks.put(time, title, kind);
  }

  /** What was from this time on has not been. @param {number} time  s */
  cut(time) {
    this.#trace.cut(time);
    this.#marks.cut(time);
    this.#repaint();
  }

  /** A moment of the past is looked at, s; null: none. @param {number|null} time */
  look(time) {
    if (time === this.#looked) return;
    this.#looked = time;
    this.#marks.look(time);
  }

  /** The bin behind the last that is seen. */
  get #end() {
    const { head } = this.#trace;
    return this.#looked === null ? head : Math.min(head, binOf(this.#looked + WINDOW - BEFORE));
  }

  #repaint() {
    this.#inks = null;
    this.#sheets.forget();
  }

  /** Ink for white paper, whatever the page's theme. @param {boolean} on */
  #onPaper(on) {
    this.node.classList.toggle('on-paper', on);
    this.#repaint();
    this.render(performance.now());
  }

  /** @param {{width: number, height: number}} size */
  #resized({ width, height }) {
    if (this.#size.width === width && this.#size.height === height) return;
    this.#size = { width, height };
    this.#laidOut = false;
  }

  /** Once per animation frame. @param {number} now  ms */
  render(now) {
    const { width, height } = this.#size;
    if (!(width > 100 && height > 40)) return;
    if (this.#ratio !== devicePixelRatio) this.#laidOut = false;
    if (!this.#laidOut) this.#layOut();
    if (!this.#inks || this.#sheets.painted !== this.#end) this.#paint();
    if (now - this.#lastRead >= READ) {
      this.#lastRead = now;
      this.#values.render();
    }
    if (now - this.#lastTold >= TOLD) {
      this.#lastTold = now;
      setAttr(this.#plot, 'aria-label', say`Strip chart of the last ${WINDOW} s. ${this.#values.words()}`);
    }
  }

  /** Where all stands; all is painted anew then. */
  #layOut() {
    const { type, line } = pictureScale();
    const { width, height } = this.#size;
    const ratio = (this.#ratio = devicePixelRatio);
    const px = (/** @type {number} */ usual) => Math.round(usual * type);
    const wide = width >= WIDE * type;
    const [left, top] = [px(SIDE + (wide ? BESIDE : 0)), px(HEAD)];
    const room = Math.max(Math.floor(width) - left - px(SIDE), 20);
    const lanes = Math.max(Math.floor(height) - top - px(FOOT), 20);
    const above = wide ? 0 : px(ABOVE);
    this.#left = left;
    this.#places = placed(lanes, type, above);
    const device = (/** @type {number} */ css) => Math.round(css * ratio);
    this.#sheets.layOut({
      ...{ room: device(room), height: device(lanes + px(FOOT)), lanes: device(lanes) + Math.ceil(2 * ratio) },
      places: this.#places.map((own, i) => ({
        ...{ scales: this.#scales[i], top: device(own.top), height: device(own.height) },
      })),
      ...{ ratio, line: ratio * line, font: `${TYPE * type * ratio}px system-ui, sans-serif` },
      every: room / WINDOW > ROOMY * type ? OFTEN : SELDOM,
    });
    box(this.#plot, left, top, room, lanes + px(FOOT));
    box(this.#over, left, 0, room + px(SIDE), top + lanes); // flags end beyond the curves
    this.#marks.node.style.left = `${room}px`;
    box(this.#axes, 0, 0, width, height);
    [this.#axes.width, this.#axes.height] = [device(width), device(height)];
    this.#marks.scale = this.#sheets.scale;
    this.node.classList.toggle('wide', wide);
    this.#values.place(this.#places, top - above);
    this.#inks = null;
    this.#laidOut = true;
  }

  #paint() {
    const trace = this.#trace;
    const head = this.#end;
    const fresh = !this.#inks;
    const inks = (this.#inks ??= this.#ink());
    if (fresh) this.#sheets.forget();
    const first = this.#sheets.first(head);
    const anew = this.#places.map((_, i) => {
      const painted = Math.min(this.#sheets.painted, head);
      return this.#scales[i].fit(trace, first, fresh ? first : painted, head, this.limits);
    });
    this.#sheets.paint(trace, head, inks, anew);
    if (fresh || anew.includes(true)) this.#paintAxes(inks);
    const shift = `translateX(${-this.#sheets.shift(head)}px)`;
    this.#sheets.node.style.transform = this.#marks.node.style.transform = shift;
  }

  /** @returns {Inks} */
  #ink() {
    const style = getComputedStyle(this.node);
    const inks = NAMES.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]);
    return /** @type {Inks} */ (Object.fromEntries(inks));
  }

  /** The scales' numbers: pitch's at the left, yaw's at the right. @param {Inks} inks */
  #paintAxes(inks) {
    const ctx = this.#axes.getContext('2d');
    if (!ctx) return;
    const { type } = pictureScale();
    const ratio = this.#ratio;
    const size = TYPE * type;
    const [gap, right] = [5 * type, this.#left + this.#plot.clientWidth];
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.clearRect(0, 0, this.#size.width, this.#size.height);
    ctx.textBaseline = 'middle';
    ctx.font = `${size}px system-ui, sans-serif`;
    this.#places.forEach(({ top, height }, i) => {
      const few = height / DIVISIONS < 1.4 * size;
      for (let axis = 0; axis < 2; axis++) {
        [ctx.fillStyle, ctx.textAlign] = axis ? [inks.yaw, 'left'] : [inks.pitch, 'right'];
        for (const { share, text } of this.#scales[i].numbers(axis, few))
          ctx.fillText(
            text,
            axis ? right + gap : this.#left - gap,
            this.#plot.offsetTop + top + height * (1 - share) + inward(share) * size,
          );
      }
    });
  }

  /** @param {MouseEvent} e @param {(mark: Mark) => void} onMark */
  #pressed(e, onMark) {
    const scale = this.#sheets.scale;
    const { left } = this.#marks.node.getBoundingClientRect(); // where time 0 is
    const mark = nearest(this.#marks.all, (e.clientX - left) / scale, REACH / scale);
    if (mark) onMark(mark);
  }
}

/** Numbers at a lane's edge keep clear of the next lane's. @param {number} share @returns {number} of their size */
const inward = (share) => (share === 1 ? 0.3 : share === 0 ? -0.3 : 0);

/**
 * Where it stands, px.
 * @param {HTMLElement} node
 * @param {number} left @param {number} top @param {number} width @param {number} height
 */
function box({ style }, left, top, width, height) {
  [style.left, style.top, style.width, style.height] = [`${left}px`, `${top}px`, `${width}px`, `${height}px`];
}
