/**
 * What is written in a plot: the numbers at its axes, and what the lines across it are called. As elements over the
 * canvas, they are laid out when they change, which in a drag is seldom, and not drawn anew with every line.
 */
import { h } from '../ui/index.js';
import { namePlaces } from './rules.js';

const GAP = { x: 4, y: 5, rule: 3 }; // px at the usual size of type
const FOOT = 4;
const HIGH = 12; // a line of type with its paper

/**
 * @typedef {import('./rules.js').Rule} Rule
 * @typedef {import('../ui/picture_scale.js').Chart} Chart
 * @typedef {{key: string, text: string, x: number, y: number}} Text CSS pixels in the chart
 */

export class PlotTexts {
  #drawn = '';

  /**
   * @param {Chart} chart
   * @param {{axis: (value: number) => string, time: (value: number, last: boolean) => string}} words of the numbers at
   *   the axes
   */
  constructor(chart, words) {
    this.chart = chart;
    this.words = words;
    this.node = h('div', { class: 'plot-texts', 'aria-hidden': 'true' });
    chart.root.querySelector('.u-wrap')?.append(this.node);
  }

  /** Where they have changed. @param {Rule[]} rules in sight @param {number} size of type, to the usual one */
  draw(rules, size) {
    const texts = [...this.#axes(size), ...this.#rules(rules, size)];
    const drawn = texts.map(({ key, text, x, y }) => `${key} ${text} ${x.toFixed(1)} ${y.toFixed(1)}`).join('\n');
    if (drawn === this.#drawn) return;
    this.#drawn = drawn;
    this.node.replaceChildren(...texts.map(({ key, text }) => h('span', { class: key, translate: 'no' }, text)));
    texts.forEach(({ x, y }, i) => {
      const { style } = /** @type {HTMLElement} */ (this.node.children[i]);
      [style.left, style.top] = [`${x.toFixed(1)}px`, `${y.toFixed(1)}px`];
    });
  }

  /** @param {number} size @returns {Text[]} */
  #axes(size) {
    const { chart } = this;
    const [across, up] = /** @type {{_splits?: number[]}[]} */ (chart.axes); // where its numbers stand
    const { left, right, bottom } = box(chart);
    const times = (across._splits ?? []).map((v, i, all) => ({
      key: 'x',
      text: this.words.time(v, i === all.length - 1),
      x: Math.min(right, chart.valToPos(v, 'x') + left),
      y: bottom + GAP.x * size,
    }));
    const values = (up._splits ?? []).map((v) => ({
      key: 'y',
      text: this.words.axis(v),
      x: left - GAP.y * size,
      y: heightOf(chart, v),
    }));
    return [...times.filter(({ text }) => text), ...values];
  }

  /**
   * At the right end of their lines.
   * @param {Rule[]} rules
   * @param {number} size
   * @returns {Text[]}
   */
  #rules(rules, size) {
    const { right, top, bottom } = box(this.chart);
    const lines = rules.map(({ value }) => ({ value, y: heightOf(this.chart, value) }));
    const high = HIGH * size;
    const middles = namePlaces(lines, { gap: high / 2 + GAP.rule * size, high, top, bottom });
    return rules.map(({ label, danger }, i) => ({
      key: `rule ${danger ? 'danger' : ''}`,
      text: label,
      x: right - FOOT * size,
      y: middles[i],
    }));
  }
}

/** The plotting area within the chart, CSS pixels. @param {Chart} chart */
function box({ bbox }) {
  const [left, top, width, height] = [bbox.left, bbox.top, bbox.width, bbox.height].map((v) => v / devicePixelRatio);
  return { left, top, right: left + width, bottom: top + height };
}

/** @param {Chart} chart @param {number} value */
const heightOf = (chart, value) => chart.valToPos(value, 'y') + box(chart).top;
