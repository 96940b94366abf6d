/** How much pitch and yaw feel each other at each frequency: relative gains, and off-diagonal over diagonal entries of Ĝ(jω). */
import uPlot from '../vendor/uplot/uPlot.esm.js';
import { relativeGain } from '../api.js';
import { dominanceWords, largest, logSpaced } from '../compare_math.js';
import { h, setText, symbol } from '../dom.js';
import { forField, significant } from '../format.js';
import { Lazy } from '../lazy.js';
import { followsPage, pictureScale } from '../picture_scale.js';
import { pictureMenu, subtitle } from '../plot_menu.js';
import { drawLabel, drawRule } from '../plot_rules.js';
import { bodyOf } from '../store.js';
import { t } from '../words.js';

const Chart = /** @type {any} */ (uPlot); // its types stay in its package
const FREQUENCIES = logSpaced(0.01, 1000, 121);
const FONT = '11px system-ui, sans-serif';
/** Only full powers of ten get a line and a number. */
const decades = (/** @type {any} */ _u, /** @type {number[]} */ splits) => splits.map((v) => (v && Math.abs(Math.log10(v) - Math.round(Math.log10(v))) < 1e-6 ? v : null));
const power = (/** @type {any} */ u, /** @type {number[]} */ splits) => decades(u, splits).map((v) => (v === null ? '' : forField(v)));
const size = (/** @type {string} */ sub) => h('span', { class: 'sym' }, '|', h('i', {}, 'λ'), h('sub', {}, sub), '|');

const LIMIT = 'below 1: diagonally dominant';

/** @typedef {{id: string, title: string, limit: boolean, series: {name: () => (Node|string)[], plain: string, title: string, of: (r: any) => number[]}[]}} About  plain: the name where only letters can be */
/** @type {About[]} */
const CHARTS = [
  { id: 'gains', title: 'Relative gains', limit: false, series: [
    { name: () => [size('11')], plain: '|λ₁₁|', title: 'relative gain of the diagonal pairing at this frequency', of: (r) => r.rga_magnitude.map((/** @type {number[][]} */ m) => m[0][0]) },
    { name: () => [size('12')], plain: '|λ₁₂|', title: 'relative gain of the crosswise pairing at this frequency', of: (r) => r.rga_magnitude.map((/** @type {number[][]} */ m) => m[0][1]) }] },
  { id: 'dominance', title: 'Off-diagonal over diagonal', limit: true, series: [
    { name: () => ['rows'], plain: 'rows', title: 'larger of both rows of Ĝ(jω): an angle’s answer to the other input, over that to its own', of: (r) => largest(r.dominance?.rows ?? []) },
    { name: () => ['columns'], plain: 'columns', title: 'larger of both columns of Ĝ(jω): an input’s effect on the other angle, over that on its own', of: (r) => largest(r.dominance?.columns ?? []) }] },
];

class FrequencyPlot {
  /** @type {Record<string, string>} */ #colors = {};
  /** @type {[number, number]} */ #range = [0.001, 10];
  /** @type {number[][]} */ #data = [];

  /** @param {About} about @param {(i: number|null) => void} onHover @param {() => string} subtitle of its picture */
  constructor(about, onHover, subtitle) {
    this.about = about;
    this.onHover = onHover;
    this.values = about.series.map((s, i) => h('span', { class: 'value', 'data-testid': `interaction-${about.id}-${i}` }));
    this.body = h('div', { class: 'plot-body' });
    this.node = h('figure', { class: 'frequency-plot', 'data-testid': `interaction-${about.id}` },
      h('figcaption', {}, h('span', { class: 'what' }, about.title), about.series.map((s, i) => h('span', { class: 'key', title: s.title }, h('span', { class: `line series-${i}`, 'aria-hidden': 'true' }), h('span', {}, s.name()), this.values[i])),
        pictureMenu(`frequency-${about.id}`, about.title, () => this.#picture(subtitle()), 'omega [rad/s]')), this.body);
    this.#readColors();
    for (const query of ['(prefers-color-scheme: dark)', '(prefers-contrast: more)']) {
      matchMedia(query).addEventListener('change', () => {
        this.#readColors();
        this.chart?.redraw(false);
      });
    }
  }

  #readColors() {
    const style = getComputedStyle(document.documentElement);
    for (const name of ['series-0', 'series-1', 'panel', 'muted', 'grid', 'danger', 'limit-fill']) this.#colors[name] = style.getPropertyValue(`--${name}`).trim();
  }

  #build() {
    const color = (/** @type {string} */ name) => () => this.#colors[name];
    const axis = { stroke: color('muted'), font: FONT, grid: { stroke: color('grid'), width: 1, filter: decades }, ticks: { show: false } };
    this.chart = followsPage(new Chart({
      width: 300, height: 160, legend: { show: false }, pxAlign: 0, padding: [() => 6 * pictureScale().type, () => 18 * pictureScale().type, 0, 0],
      series: [{}, { stroke: color('series-0'), width: 2, points: { show: false } }, { stroke: color('series-1'), width: 2, dash: [7, 4], points: { show: false } }],
      scales: { x: { time: false, distr: 3, range: () => [FREQUENCIES[0], FREQUENCIES[FREQUENCIES.length - 1]] }, y: { distr: 3, range: () => this.#range } },
      axes: [{ ...axis, gap: 6, size: () => 24 * pictureScale().type, values: power }, { ...axis, gap: 5, size: () => 46 * pictureScale().type, values: power }],
      cursor: { y: false, points: { show: false }, drag: { x: false, y: false }, sync: { key: 'heli2dof-frequency' } },
      hooks: { drawClear: [() => this.#shade()], draw: [() => this.#drawLimit()], setCursor: [(/** @type {any} */ u) => this.onHover(u.cursor.left < 0 ? null : u.cursor.idx ?? null)] },
    }, [FREQUENCIES, ...this.about.series.map(() => FREQUENCIES.map(() => null))], this.body));
    new ResizeObserver(([entry]) => {
      const { width, height } = entry.contentRect;
      if (width > 60 && height > 40) this.chart.setSize({ width: Math.floor(width), height: Math.floor(height) });
    }).observe(this.body);
  }

  /** @param {string} subtitle @returns {import('../picture.js').Picture} */
  #picture(subtitle) {
    const { about } = this;
    return {
      title: t(about.title), subtitle, x: { range: [FREQUENCIES[0], FREQUENCIES[FREQUENCIES.length - 1]], title: t('ω in rad/s'), log: true }, y: { range: this.#range, title: t(about.title), log: true },
      lines: about.series.map((s, i) => ({ name: t(s.plain), kind: /** @type {'series-0'|'series-1'} */ (`series-${i}`), t: FREQUENCIES, values: this.#data[i] ?? [] })),
      rules: about.limit ? [{ value: 1, label: t(LIMIT), danger: true }] : [],
    };
  }

  /** Above 1 what is off the diagonal outweighs it. */
  #shade() {
    if (!this.about.limit) return;
    const { ctx, bbox, valToPos } = this.chart;
    ctx.fillStyle = this.#colors['limit-fill'];
    ctx.fillRect(bbox.left, bbox.top, bbox.width, Math.max(0, Math.round(valToPos(1, 'y', true)) - bbox.top));
  }

  #drawLimit() {
    if (!this.about.limit) return;
    const y = Math.round(this.chart.valToPos(1, 'y', true));
    this.chart.ctx.save();
    drawRule(this.chart, y, this.#colors.danger, []);
    drawLabel(this.chart, y, t(LIMIT), -1, this.#colors.danger, this.#colors.panel);
    this.chart.ctx.restore();
  }

  /** @param {any} reply */
  show(reply) {
    if (!this.chart) this.#build();
    this.#data = this.about.series.map((s) => s.of(reply));
    const seen = this.#data.flat().filter((v) => Number.isFinite(v) && v > 0).map((v) => Math.log10(v));
    this.#range = [10 ** Math.max(-6, Math.floor(Math.min(-1, ...seen))), 10 ** Math.min(6, Math.ceil(Math.max(1, ...seen)))];
    this.chart.setData([FREQUENCIES, ...this.#data.map((values) => FREQUENCIES.map((_w, i) => (values[i] > 0 && Number.isFinite(values[i]) ? values[i] : null)))]);
    this.valuesAt(0);
  }

  /** @param {number} i which frequency */
  valuesAt(i) {
    this.#data.forEach((values, k) => setText(this.values[k], significant(values[i], 4)));
  }
}

export class InteractionCard {
  /** @param {HTMLElement} root @param {import('../store.js').Store} store */
  constructor(root, store) {
    this.at = h('span', { class: 'at-frequency' });
    this.words = h('p', { class: 'claim', 'data-testid': 'dominance-words' });
    this.plots = CHARTS.map((about) => new FrequencyPlot(about, (i) => this.#hover(i), () => subtitle(store)));
    this.figures = h('div', {}, h('p', { class: 'caption' }, 'Of the inner loop ', symbol('Ĝ'), '(', symbol('jω'), '), ', symbol('ω'), ' in rad/s. Values at ', this.at), h('div', { class: 'frequency-plots' }, this.plots.map((p) => p.node)));
    const content = h('div', {}, this.figures, this.words);
    root.append(content);
    this.lazy = new Lazy(root, content, store, { wait: 'Computing the frequency response…', ask: relativeGain, show: (answer) => this.#show(answer), body: (d) => ({ ...bodyOf(d), frequencies: FREQUENCIES }) });
  }

  /** @param {any} reply */
  #show(reply) {
    this.figures.hidden = !reply.rga_magnitude;
    if (!reply.rga_magnitude) {
      setText(this.words, reply.findings?.[0]?.message ?? 'There is no steady state, so no relative gains.');
      return;
    }
    for (const plot of this.plots) plot.show(reply);
    const { dominant, text } = reply.dominance ? dominanceWords(reply.frequencies, reply.dominance)
      : { dominant: false, text: 'A diagonal entry of Ĝ(jω) is 0: there is nothing that could dominate.' };
    setText(this.words, text);
    this.words.classList.toggle('warning', !dominant);
    this.#hover(null);
  }

  /** @param {number|null} i */
  #hover(i) {
    setText(this.at, `${significant(FREQUENCIES[i ?? 0], 3)} rad/s${i === null ? ', the lowest' : ''}`);
    for (const plot of this.plots) plot.valuesAt(i ?? 0);
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    this.lazy.render(state);
  }
}
