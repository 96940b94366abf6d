/**
 * A chart of as many lines as a system has outputs: the present ones, and those of pinned designs, faint. Values are
 * read under the pointer or by the arrow keys.
 * @typedef {{name: string, values: ArrayLike<number>}} Line
 * @typedef {{pin: number, x: ArrayLike<number>, lines: Line[]}} Ghost of a pinned design, on a grid of its own
 */
import { forField, inField, say, significant } from '../text/index.js';
import { h, setText } from '../ui/index.js';
import { chartBody, makeChart, readByKeys, readIndex, scaled } from '../charts/index.js';

export const MOST_LINES = 12;
const GHOSTS = 16;
const COLORS = ['pitch', 'yaw', 'series-0', 'series-1', 'pin-2', 'pin-3'];
const DASHES = [[], [7, 4]];
const GAP = 0.07; // of the range, above and below the lines

/** Only full powers of ten get a line and a number. */
const decades = (/** @type {uPlot} */ _u, /** @type {number[]} */ splits) =>
  splits.map((v) => (v && Math.abs(Math.log10(v) - Math.round(Math.log10(v))) < 1e-6 ? v : null));
const powers = (/** @type {uPlot} */ u, /** @type {number[]} */ splits) =>
  decades(u, splits).map((v) => (v === null ? '' : powerOfTen(Math.round(Math.log10(v)))));
const RAISED = '⁰¹²³⁴⁵⁶⁷⁸⁹';
/** As 0.01, 1, 100, and from there on with an exponent. Pure. @param {number} n */
export const powerOfTen = (n) =>
  Math.abs(n) < 3
    ? forField(10 ** n)
    : `10${n < 0 ? '⁻' : ''}${[...String(Math.abs(n))].map((d) => RAISED[Number(d)]).join('')}`;
const plain = (/** @type {uPlot} */ _u, /** @type {number[]} */ splits) => splits.map((v) => inField(v));

/**
 * Values of a line at other places, straight between its samples; nothing beyond its ends. Pure.
 * @param {ArrayLike<number>} x rising @param {ArrayLike<number>} y @param {ArrayLike<number>} at rising
 * @returns {(number|null)[]}
 */
export function resampled(x, y, at) {
  /** @type {(number|null)[]} */ const found = [];
  let k = 0;
  for (let i = 0; i < at.length; i++) {
    while (k < x.length - 2 && x[k + 1] < at[i]) k++;
    const inside = at[i] >= x[0] && at[i] <= x[x.length - 1] * (1 + 1e-9);
    found.push(inside ? y[k] + ((y[k + 1] - y[k]) * (at[i] - x[k])) / (x[k + 1] - x[k]) : null);
  }
  return found;
}

/**
 * From the lowest to the highest value with a little room; at least so much apart that a constant is a line. Pure.
 * @param {readonly (readonly (number|null)[])[]} lines @param {boolean} log
 * @returns {[number, number]}
 */
export function rangeOf(lines, log) {
  let [low, high] = [Infinity, -Infinity];
  for (const line of lines)
    for (const v of line)
      if (v !== null && Number.isFinite(v) && (!log || v > 0)) [low, high] = [Math.min(low, v), Math.max(high, v)];
  if (low > high) return log ? [0.1, 10] : [-1, 1];
  if (log) {
    low = Math.max(low, high * 1e-8);
    return [10 ** Math.floor(Math.log10(low) - 0.05), 10 ** Math.ceil(Math.log10(high) + 0.05)];
  }
  const room = Math.max(GAP * (high - low), 1e-3 * Math.max(Math.abs(low), Math.abs(high)), 1e-9);
  return [low - room, high + room];
}

export class Curves {
  /** @type {uPlot|null} */ #chart = null;
  /** @type {[number, number]} */ #range = [-1, 1];
  /** @type {ArrayLike<number>} */ #x = [0, 1];
  /** @type {HTMLElement[]} */ values = [];
  /** @type {Line[]} */ lines = [];

  /**
   * @param {string} testid @param {string} title
   * @param {{log?: {x?: boolean, y?: boolean}, unit: string, sync: string, steps?: number[]}} how
   */
  constructor(testid, title, { log = {}, unit, sync, steps }) {
    this.how = { log, unit, sync, steps };
    this.what = h('span', { class: 'what' }, title);
    this.keys = h('span', { class: 'plant-keys' });
    this.at = h('span', { class: 'plant-at' });
    this.body = chartBody(say`${title}: left and right read the values`, (e) => readByKeys(e, this.#chart, 1));
    this.node = h(
      'figure',
      { class: 'plant-curves', 'data-testid': testid },
      h('figcaption', {}, this.what, this.keys, this.at),
      this.body,
    );
  }

  /** @param {string} words */
  name(words) {
    setText(this.what, words);
    this.body.setAttribute('aria-label', say`${words}: left and right read the values`);
  }

  #build() {
    const { log, sync, steps } = this.how;
    const axis = (/** @type {boolean|undefined} */ own) =>
      own ? { grid: { filter: decades }, values: powers } : { values: plain };
    return makeChart(this.body, {
      lines: [
        ...Array.from({ length: GHOSTS }, (_, i) => ({ color: `pin-${i % 4}`, width: 1, dash: [3, 3] })),
        ...Array.from({ length: MOST_LINES }, (_, i) => ({
          color: COLORS[i % COLORS.length],
          width: 2,
          dash: DASHES[Math.floor(i / COLORS.length)],
        })),
      ],
      data: [[0, 1], ...Array.from({ length: GHOSTS + MOST_LINES }, () => [null, null])],
      padding: [scaled(6), scaled(18), 0, 0],
      scales: {
        x: { distr: log.x ? 3 : 1, range: () => [this.#x[0], this.#x[this.#x.length - 1]] },
        y: { distr: log.y ? 3 : 1, range: () => this.#range },
      },
      axes: [
        { ...axis(log.x), gap: 6, size: 24 },
        { ...axis(log.y), incrs: steps, size: 56, space: 28 },
      ],
      font: '14px',
      cursor: { drag: { x: false, y: false }, sync: { key: sync } },
      hooks: { setCursor: [(u) => this.#read(readIndex(u))] },
    });
  }

  /** @param {ArrayLike<number>} x @param {Line[]} lines @param {readonly Ghost[]} [ghosts] */
  show(x, lines, ghosts = []) {
    const chart = (this.#chart ??= this.#build());
    this.#x = x;
    this.lines = lines.slice(0, MOST_LINES);
    const known = (/** @type {ArrayLike<number>} */ v) =>
      Array.from(v, (y) => (Number.isFinite(y) && (!this.how.log.y || y > 0) ? y : null));
    const own = this.lines.map((line) => known(line.values));
    const nothing = Array.from(x, () => null);
    /** @type {(number|null)[][]} */ const faint = Array.from({ length: GHOSTS }, () => nothing);
    ghosts.forEach((ghost) =>
      ghost.lines.slice(0, GHOSTS / 4).forEach((line, k) => {
        faint[4 * k + ghost.pin] = resampled(
          ghost.x,
          known(line.values).map((v) => v ?? NaN),
          x,
        ).map((v) => (Number.isFinite(v) ? v : null));
      }),
    );
    this.#range = rangeOf([...own, ...faint], Boolean(this.how.log.y));
    const empty = Array.from({ length: MOST_LINES - own.length }, () => nothing);
    chart.setData(/** @type {uPlot.AlignedData} */ ([Array.from(x), ...faint, ...own, ...empty]));
    const names = this.lines.map((line) => line.name).join('\n');
    if (names !== this.#names) this.#key(names);
    this.#read(readIndex(chart));
  }
  #names = '';

  /** @param {string} names */
  #key(names) {
    this.#names = names;
    this.values = this.lines.map(() => h('span', { class: 'value' }));
    this.keys.replaceChildren(
      ...this.lines.map((line, i) =>
        h(
          'span',
          { class: 'key' },
          h('span', { class: `plant-line color-${i % COLORS.length} dash-${Math.floor(i / COLORS.length)}` }),
          h('span', { translate: 'no' }, line.name),
          this.values[i],
        ),
      ),
    );
  }

  /** @param {number|null} i */
  #read(i) {
    const at = i === null || i >= this.#x.length ? null : i;
    const [name, unit] = this.how.log.x ? ['ω', 'rad/s'] : ['t', 's'];
    setText(this.at, at === null ? say`${name} in ${unit}` : `${name} = ${significant(this.#x[at], 3)} ${unit}`);
    this.lines.forEach((line, k) =>
      setText(this.values[k], at === null ? '' : `${significant(line.values[at], 4)}${this.how.unit}`),
    );
  }
}
