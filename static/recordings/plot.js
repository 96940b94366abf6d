/** One axis of a recording over the simulation: measured, simulated, reference, over the recording's own time. */
import uPlot from '../vendor/uplot/uPlot.esm.js';
import { fixed } from '../text/index.js';
import { followsPage, h, pictureScale, setText } from '../ui/index.js';
import { rangeOfCurves } from './recordings.js';

const FONT = '11px system-ui, sans-serif';
const NAMES = ['measured', 'simulated', 'reference'];

export class RecordingPlot {
  /** @type {Record<string, string>} */ #colors = {};
  /** @type {[number, number]} */ #range = [-1, 1];
  /** @type {import('./recordings.js').Curves} */ #data = [[], [], [], []];

  /** @param {string} axis @param {'pitch'|'yaw'} name */
  constructor(axis, name) {
    this.fit = h('b', { 'data-testid': `recording-fit-${axis}` });
    this.values = NAMES.map(() => h('span', { class: 'value' }));
    this.body = h('div', {
      class: 'plot-body',
      tabindex: 0,
      role: 'group',
      'aria-label': `${name} recorded and simulated: left and right read the values`,
      onkeydown: (/** @type {KeyboardEvent} */ e) => this.#key(e),
    });
    this.node = h(
      'figure',
      { class: 'frequency-plot recording-plot' },
      h(
        'figcaption',
        {},
        h('span', { class: 'what' }, h('span', {}, name), ' ', this.fit),
        NAMES.map((text, i) =>
          h(
            'span',
            { class: 'key' },
            h('span', { class: `line recorded-${i}`, 'aria-hidden': 'true' }),
            h('span', {}, text),
            this.values[i],
          ),
        ),
      ),
      this.body,
    );
    for (const query of ['(prefers-color-scheme: dark)', '(prefers-contrast: more)'])
      matchMedia(query).addEventListener('change', () => {
        this.#readColors();
        this.chart?.redraw(false);
      });
    this.#readColors();
  }

  #readColors() {
    const style = getComputedStyle(document.documentElement);
    for (const name of ['ink', 'muted', 'grid', 'series-0', 'series-1'])
      this.#colors[name] = style.getPropertyValue(`--${name}`).trim();
  }

  #build() {
    const color = (/** @type {string} */ name) => () => this.#colors[name];
    const axis = {
      stroke: color('muted'),
      font: FONT,
      ticks: { show: false },
      grid: { stroke: color('grid'), width: 1 },
    };
    const line = (/** @type {string} */ name, /** @type {object} */ more) => ({
      stroke: color(name),
      points: { show: false },
      ...more,
    });
    const chart = followsPage(
      new uPlot(
        {
          width: 300,
          height: 160,
          legend: { show: false },
          pxAlign: 0,
          series: [
            {},
            line('series-0', { width: 1.5 }),
            line('series-1', { width: 2, dash: [7, 4] }),
            line('muted', { width: 1, dash: [2, 3] }),
          ],
          scales: { x: { time: false }, y: { range: () => this.#range } },
          axes: [
            { ...axis, gap: 6, size: () => 24 * pictureScale().type },
            { ...axis, gap: 5, size: () => 46 * pictureScale().type },
          ],
          cursor: { y: false, points: { show: false }, sync: { key: 'recording' } },
          hooks: {
            setCursor: [(u) => this.#values((u.cursor.left ?? -1) < 0 ? null : (u.cursor.idx ?? null))],
          },
        },
        this.#data,
        this.body,
      ),
    );
    new ResizeObserver(([entry]) => {
      const { width, height } = entry.contentRect;
      if (width > 60 && height > 40) chart.setSize({ width: Math.floor(width), height: Math.floor(height) });
    }).observe(this.body);
    return (this.chart = chart);
  }

  /** @param {import('./recordings.js').Curves} data t and degrees @param {string} fit */
  show(data, fit) {
    const chart = this.chart ?? this.#build();
    this.#data = data;
    this.#range = rangeOfCurves(data);
    chart.setData(data);
    setText(this.fit, fit);
    this.#values(null);
  }

  /** @param {number|null} i */
  #values(i) {
    this.values.forEach((node, k) =>
      setText(node, i === null ? '' : `${fixed(this.#data[k + 1][i] ?? undefined, 2)}°`),
    );
  }

  /** @param {KeyboardEvent} e */
  #key(e) {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[e.key];
    if (!step || !this.chart || e.ctrlKey || e.metaKey || e.altKey) return;
    const { idx, left } = this.chart.cursor;
    const last = this.#data[0].length - 1;
    const i =
      left === undefined || left < 0 || idx === null || idx === undefined
        ? Math.round(last / 2)
        : Math.max(0, Math.min(last, idx + step * (e.shiftKey ? 50 : 5)));
    this.chart.setCursor({ left: this.chart.valToPos(this.#data[0][i], 'x'), top: 1 });
    e.preventDefault();
  }
}
