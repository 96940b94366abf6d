/**
 * One axis of an identification: measured, before and after in one chart, what is held out shaded; below it what is
 * left, and how that is correlated, with the band of white residuals.
 */
import { fixed, significant } from '../text/index.js';
import { h, setText } from '../ui/index.js';
import { chartBody, ink, makeChart, readByKeys, readIndex, readingFigure } from '../charts/index.js';
import {
  correlationCurve,
  fittedCurves,
  heldOut,
  rangeOfCorrelation,
  rangeOfFit,
  rangeOfRest,
  residualCurve,
  whitenessWords,
} from './found.js';

/** @typedef {import('./found.js').Curves} Curves */
/** @typedef {{u: uPlot|null, data: Curves, range: [number, number]}} Shown */

const NAMES = ['measured', 'before', 'found'];
/** How each is drawn. @type {import('../charts/chart.js').Line[]} */
const LINES = [
  { color: 'series-0', width: 3 },
  { color: 'muted', width: 1.5, dash: [2, 3] },
  { color: 'series-1', width: 1.5, dash: [7, 4] },
];
const ROOM = 46;

export class FitPlot {
  /** @type {[number, number]|null} */ #held = null;
  #band = 0;
  /** @type {Shown} */ #fit = { u: null, data: [[]], range: [-1, 1] };
  /** @type {Shown} */ #rest = { u: null, data: [[]], range: [-1, 1] };
  #heldWords = '';
  /** @type {Shown} */ #correlation = { u: null, data: [[]], range: [-1, 1] };

  /** @param {'theta'|'psi'} axis @param {'pitch'|'yaw'} name */
  constructor(axis, name) {
    this.axis = axis;
    this.values = NAMES.map(() => h('span', { class: 'value' }));
    this.left = h('span', { class: 'value' });
    this.share = h('span', { class: 'value' });
    this.words = h('p', { class: 'caption whiteness', 'data-testid': `recording-whiteness-${axis}` });
    const read = (/** @type {Shown} */ shown, /** @type {number} */ step) => (/** @type {KeyboardEvent} */ e) =>
      readByKeys(e, shown.u, step);
    this.bodies = [
      chartBody(`${name} measured, before and found: left and right read the values`, read(this.#fit, 5)),
      chartBody(`residuals in ${name}: left and right read the values`, read(this.#rest, 5)),
      chartBody(`correlation of the residuals in ${name}: left and right read the values`, read(this.#correlation, 1)),
    ];
    const key = (/** @type {string} */ kind, /** @type {string} */ text, /** @type {HTMLElement} */ value) => ({
      kind,
      name: text,
      value,
    });
    this.node = h(
      'div',
      { class: 'fit-axis', 'data-testid': `recording-fitted-${axis}` },
      readingFigure(
        { class: 'frequency-plot fit-plot' },
        [h('span', { class: 'what' }, `${name}, deg`)],
        NAMES.map((text, i) => key(`fitted-${i}`, text, this.values[i])),
        this.bodies[0],
      ),
      readingFigure(
        { class: 'frequency-plot rest-plot' },
        [],
        [key('fitted-rest', 'residuals, measured − found, deg', this.left)],
        this.bodies[1],
      ),
      readingFigure(
        { class: 'frequency-plot rest-plot' },
        [],
        [
          key('fitted-rest', 'their correlation over time lags, ms', this.share),
          key('fitted-band', '99 % of white ones', h('span')),
        ],
        this.bodies[2],
      ),
      this.words,
    );
  }

  /** What is held out, behind the curves. @param {uPlot} u */
  #shade(u) {
    if (!this.#held) return;
    const { left, top, width, height } = u.bbox;
    const [from, to] = this.#held.map((t) => Math.max(left, Math.min(left + width, u.valToPos(t, 'x', true))));
    u.ctx.save();
    u.ctx.fillStyle = ink('sunk');
    u.ctx.fillRect(from, top, to - from, height);
    u.ctx.fillStyle = ink('muted');
    u.ctx.font = `${12 * devicePixelRatio}px system-ui, sans-serif`;
    u.ctx.textBaseline = 'top';
    u.ctx.textAlign = 'right';
    u.ctx.fillText(this.#heldWords, to - 4 * devicePixelRatio, top + 3 * devicePixelRatio);
    u.ctx.restore();
  }

  /** Where 99 % of the correlations of white residuals lie. @param {uPlot} u */
  #drawBand(u) {
    const { left, width } = u.bbox;
    const [high, low] = [this.#band, -this.#band].map((v) => u.valToPos(v, 'y', true));
    u.ctx.save();
    u.ctx.fillStyle = ink('sunk');
    u.ctx.fillRect(left, high, width, low - high);
    u.ctx.strokeStyle = ink('muted');
    u.ctx.lineWidth = devicePixelRatio;
    u.ctx.setLineDash([4, 3].map((v) => v * devicePixelRatio));
    for (const y of [high, low]) {
      u.ctx.beginPath();
      u.ctx.moveTo(left, y);
      u.ctx.lineTo(left + width, y);
      u.ctx.stroke();
    }
    u.ctx.restore();
  }

  /** Correlations as stems. @param {uPlot} u */
  #drawStems(u) {
    const [lags, values] = this.#correlation.data;
    const zero = u.valToPos(0, 'y', true);
    u.ctx.save();
    u.ctx.strokeStyle = u.ctx.fillStyle = ink('series-1');
    u.ctx.lineWidth = 1.5 * devicePixelRatio;
    lags.forEach((lag, i) => {
      const [x, y] = [u.valToPos(lag, 'x', true), u.valToPos(values[i] ?? 0, 'y', true)];
      u.ctx.beginPath();
      u.ctx.moveTo(x, zero);
      u.ctx.lineTo(x, y);
      u.ctx.stroke();
      u.ctx.beginPath();
      u.ctx.arc(x, y, 2.2 * devicePixelRatio, 0, 2 * Math.PI);
      u.ctx.fill();
    });
    u.ctx.restore();
  }

  #build() {
    const [fit, rest, correlation] = this.bodies;
    const y = (/** @type {Shown} */ shown) => ({ y: { range: () => shown.range } });
    const cursor = { sync: { key: 'identification' } };
    const font = '12px';
    /** In a low plot a number above zero, and one below. */
    const low = { size: ROOM, space: 16 };
    this.#fit.u = makeChart(fit, {
      lines: LINES,
      data: this.#fit.data,
      scales: y(this.#fit),
      axes: [{ gap: 6, size: 24 }, { size: ROOM }],
      font,
      cursor,
      hooks: { drawAxes: [(u) => this.#shade(u)], setCursor: [(u) => this.#read(u, this.#fit, this.values, '°')] },
    });
    this.#rest.u = makeChart(rest, {
      lines: [{ color: 'series-1', width: 1 }],
      data: this.#rest.data,
      scales: y(this.#rest),
      axes: [{ gap: 6, size: 24 }, low],
      font,
      cursor,
      hooks: { drawAxes: [(u) => this.#shade(u)], setCursor: [(u) => this.#read(u, this.#rest, [this.left], '°')] },
    });
    this.#correlation.u = makeChart(correlation, {
      lines: [{ color: 'series-1', width: 0 }],
      data: this.#correlation.data,
      scales: y(this.#correlation),
      axes: [{ gap: 6, size: 24 }, low],
      font,
      hooks: {
        drawAxes: [(u) => this.#drawBand(u)],
        draw: [(u) => this.#drawStems(u)],
        setCursor: [(u) => this.#read(u, this.#correlation, [this.share], '')],
      },
    });
  }

  /** @param {uPlot} u @param {Shown} shown @param {HTMLElement[]} nodes @param {string} unit */
  #read(u, shown, nodes, unit) {
    const i = readIndex(u);
    nodes.forEach((node, k) => {
      const v = i === null ? null : shown.data[k + 1][i];
      setText(node, typeof v === 'number' ? (unit ? `${fixed(v, 2)}${unit}` : significant(v, 2)) : '');
    });
  }

  /** @param {import('../contract.js').IdentificationReply} found @param {string} heldWords */
  show(found, heldWords) {
    const { axis } = this;
    this.#held = heldOut(found);
    this.#heldWords = heldWords;
    this.#band = found.whiteness[axis].band;
    this.#fit.data = fittedCurves(found, axis);
    this.#fit.range = rangeOfFit(this.#fit.data);
    this.#rest.data = residualCurve(found, axis);
    this.#rest.range = rangeOfRest(this.#rest.data);
    this.#correlation.data = correlationCurve(found, axis);
    this.#correlation.range = rangeOfCorrelation(found, axis);
    if (!this.#fit.u) this.#build();
    for (const { u, data } of [this.#fit, this.#rest, this.#correlation]) u?.setData(data);
    setText(this.words, whitenessWords(found, axis));
  }
}
