/** One axis of a recording over the simulation: measured, simulated, reference, over the recording's own time. */
import { fixed } from '../text/index.js';
import { h, setText } from '../ui/index.js';
import { chartBody, makeChart, readByKeys, readIndex, readingFigure } from '../charts/index.js';
import { rangeOfCurves } from './recordings.js';

const NAMES = ['measured', 'simulated', 'reference'];

export class RecordingPlot {
  /** @type {uPlot|null} */ #chart = null;
  /** @type {[number, number]} */ #range = [-1, 1];
  /** @type {import('./recordings.js').Curves} */ #data = [[], [], [], []];

  /** @param {string} axis @param {'pitch'|'yaw'} name */
  constructor(axis, name) {
    this.fit = h('b', { 'data-testid': `recording-fit-${axis}` });
    this.values = NAMES.map(() => h('span', { class: 'value' }));
    this.body = chartBody(`${name} recorded and simulated: left and right read the values`, (e) =>
      readByKeys(e, this.#chart, 5),
    );
    this.node = readingFigure(
      { class: 'frequency-plot recording-plot' },
      [h('span', { class: 'what' }, h('span', {}, name), ' ', this.fit)],
      NAMES.map((text, i) => ({ kind: `recorded-${i}`, name: text, value: this.values[i] })),
      this.body,
    );
  }

  #build() {
    return makeChart(this.body, {
      lines: [
        { color: 'series-0', width: 1.5 },
        { color: 'series-1', width: 2, dash: [7, 4] },
        { color: 'muted', width: 1, dash: [2, 3] },
      ],
      data: this.#data,
      scales: { y: { range: () => this.#range } },
      axes: [{ gap: 6, size: 24 }, { size: 46 }],
      cursor: { sync: { key: 'recording' } },
      hooks: { setCursor: [(u) => this.#values(readIndex(u))] },
    });
  }

  /** @param {import('./recordings.js').Curves} data t and degrees @param {string} fit */
  show(data, fit) {
    this.#chart ??= this.#build();
    this.#data = data;
    this.#range = rangeOfCurves(data);
    this.#chart.setData(data);
    setText(this.fit, fit);
    this.#values(null);
  }

  /** @param {number|null} i */
  #values(i) {
    this.values.forEach((node, k) =>
      setText(node, i === null ? '' : `${fixed(this.#data[k + 1][i] ?? undefined, 2)}°`),
    );
  }
}
