/**
 * One figure over the number that is swept, behind its slider: a line, gaps where there is no value, a mark at the
 * value in question.
 * @typedef {import('../contract.js').FigureTrack} FigureTrack
 * @typedef {{values: readonly number[], starts: readonly number[], stable: readonly boolean[]}} Values
 */
import { h, setAttr, setText, svg } from '../ui/index.js';
import { toldBy, valueText } from './figures.js';

/** The drawing's own units; it is as wide as the slider. */
const [WIDTH, HEIGHT, ROOM] = [1000, 100, 8];

export class Strip {
  /** @type {[number, number]|null} */ #range = null;

  constructor() {
    this.line = svg('path', { class: 'track-figure' });
    this.bad = svg('path', { class: 'track-unstable' });
    this.mark = svg('line', { class: 'track-now', y1: 0, y2: HEIGHT });
    this.svg = svg(
      'svg',
      { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, preserveAspectRatio: 'none', 'aria-hidden': 'true' },
      this.bad,
      this.line,
      this.mark,
    );
    this.top = h('span', { class: 'track-top', translate: 'no' });
    this.low = h('span', { class: 'track-low', translate: 'no' });
    this.node = h('div', { class: 'track-strip', 'data-testid': 'track-strip' }, this.svg, this.top, this.low);
  }

  /**
   * @param {Values} track @param {FigureTrack|null} figure @param {(value: number) => number} share
   */
  draw(track, figure, share) {
    const xs = track.values.map((value) => WIDTH * share(value));
    this.#drawUnstable(track, xs);
    const known = figure ? figure.values.filter((_, k) => figure.valid[k]) : [];
    const [low, high] = [Math.min(...known), Math.max(...known)];
    this.#range = known.length ? [low, high] : null;
    const height = (/** @type {number} */ v) => HEIGHT - ROOM - ((HEIGHT - 2 * ROOM) * (v - low)) / (high - low || 1);
    let d = '';
    let open = false;
    for (const [k, x] of xs.entries()) {
      if (track.starts.includes(k)) open = false;
      if (figure?.valid[k]) d += `${open ? 'L' : 'M'} ${x.toFixed(1)} ${height(figure.values[k]).toFixed(1)} `;
      open = figure?.valid[k] ?? false;
    }
    setAttr(this.line, 'd', d);
    const [least, most] = figure && this.#range ? this.#range.map((v) => textAt(figure, v)) : ['', ''];
    setText(this.top, most);
    setText(this.low, least === most ? '' : least);
  }

  /** @param {Values} track @param {number[]} xs */
  #drawUnstable({ stable }, xs) {
    const parts = xs.flatMap((x, k) =>
      stable[k] ? [] : [`M ${between(x, xs[k - 1])} 0 V ${HEIGHT} H ${between(x, xs[k + 1])} V 0 Z`],
    );
    setAttr(this.bad, 'd', parts.join(' '));
  }

  /** @param {number} share */
  point(share) {
    for (const end of ['x1', 'x2']) setAttr(this.mark, end, (WIDTH * share).toFixed(1));
  }
}

/** Half way to a neighbour, if there is one. @param {number} x @param {number} [other] */
const between = (x, other = x) => (0.5 * (x + other)).toFixed(1);

/** @param {FigureTrack} figure @param {number} value */
const textAt = (figure, value) =>
  toldBy(figure) ? valueText({ ...figure, values: [value], valid: [true], unlimited: undefined }, 0) : String(value);
