/**
 * A plot of two lines over frequency, its values under the pointer or by the arrow keys, to be saved as picture and
 * numbers.
 */
import { forField, inField, say, significant, t } from '../text/index.js';
import { h, pictureScale, setText } from '../ui/index.js';
import { chartBody, ink, makeChart, readByKeys, readIndex, readingFigure, scaled } from '../charts/index.js';
import { drawNamedRules, pictureMenu } from '../plots/index.js';

/** Only full powers of ten get a line and a number. */
const decades = (/** @type {uPlot} */ _u, /** @type {number[]} */ splits) =>
  splits.map((v) => (v && Math.abs(Math.log10(v) - Math.round(Math.log10(v))) < 1e-6 ? v : null));
const power = (/** @type {uPlot} */ u, /** @type {number[]} */ splits) =>
  decades(u, splits).map((v) => (v === null ? '' : forField(v)));
const plain = (/** @type {uPlot} */ _u, /** @type {number[]} */ splits) => splits.map((v) => inField(v));

/**
 * @typedef {'series-0'|'series-1'|'pitch'|'yaw'} Kind
 * @typedef {{kind: Kind, at: number, from: number, to: number, label: string}} Span  a measured height at a frequency
 */
/**
 * @template R a reply
 * @typedef {{kind: Kind, name: () => (Node|string)[], plain: string, title: string, of: (reply: R) => number[]}}
 *   Series plain: the name where only letters can be
 */
/**
 * @template R a reply
 * @typedef {{id: string, title: string, full?: string, unit?: string, steps?: number[], rule?: {value: number, every?:
 *   number, label: string, above: boolean}, range: (data: number[][]) => [number, number], spans?: (reply: R) =>
 *   Span[], series: Series<R>[]}} About
 *   full: the title where it stands alone. steps: between the numbers of a linear axis; a logarithmic one without.
 *   rule: a border, where it comes again, and whether what lies above it is shaded
 */

/** @template R */
export class FrequencyPlot {
  /** @type {uPlot|null} */ #chart = null;
  /** @type {[number, number]} */ #range = [0.001, 10];
  /** @type {number[][]} */ #data = [];
  /** @type {Span[]} */ #spans = [];

  /**
   * @param {About<R>} about
   * @param {number[]} frequencies rad/s
   * @param {{onHover: (i: number|null) => void, subtitle: () => string}} how subtitle: of its picture
   */
  constructor(about, frequencies, { onHover, subtitle }) {
    this.about = about;
    this.frequencies = frequencies;
    this.onHover = onHover;
    this.values = about.series.map((s, i) =>
      h('span', { class: 'value', 'data-testid': `interaction-${about.id}-${i}` }),
    );
    this.body = chartBody(`${about.title}: left and right read the values`, (e) => readByKeys(e, this.#chart, 1));
    const menu = pictureMenu(`frequency-${about.id}`, about.title, () => this.#picture(subtitle()), 'omega [rad/s]');
    this.node = readingFigure(
      { class: 'frequency-plot', 'data-testid': `interaction-${about.id}` },
      [h('span', { class: 'what' }, about.title), menu],
      about.series.map(({ kind, title, name }, i) => ({ kind, title, name: name(), value: this.values[i] })),
      this.body,
    );
  }

  #build() {
    const { frequencies, about } = this;
    const log = { grid: { filter: decades }, values: power };
    const even = { values: plain, incrs: about.steps };
    return makeChart(this.body, {
      lines: about.series.map(({ kind }) => ({
        color: kind,
        width: kind === 'yaw' ? 1.5 : 2,
        dash: kind === 'series-1' ? [7, 4] : [],
      })),
      data: [frequencies, ...about.series.map(() => frequencies.map(() => null))],
      padding: [scaled(6), scaled(18), 0, 0],
      scales: {
        x: { distr: 3, range: () => [frequencies[0], frequencies[frequencies.length - 1]] },
        y: { distr: about.steps ? 1 : 3, range: () => this.#range },
      },
      axes: [
        { ...log, gap: 6, size: 24 },
        { ...(about.steps ? even : log), size: 46, space: 26 },
      ],
      cursor: { drag: { x: false, y: false }, sync: { key: `frequency-${frequencies.length}` } },
      hooks: {
        drawAxes: [(u) => this.#shade(u)],
        draw: [(u) => drawNamedRules(u, this.#borders(), ink, -1), (u) => this.#drawSpans(u)],
        setCursor: [(u) => this.onHover(readIndex(u))],
      },
    });
  }

  /** @param {string} subtitle @returns {import('../plots/picture.js').Picture} */
  #picture(subtitle) {
    const { about, frequencies } = this;
    const title = about.unit ? say`${t(about.title)} in ${about.unit.trim()}` : t(about.title);
    return {
      title: t(about.full ?? about.title),
      subtitle,
      x: { range: [frequencies[0], frequencies[frequencies.length - 1]], title: t('ω in rad/s'), log: true },
      y: { range: this.#range, title, log: !about.steps, steps: about.steps },
      lines: about.series.map((s, i) => ({
        name: t(s.plain),
        kind: s.kind,
        t: frequencies,
        values: this.#data[i] ?? [],
      })),
      rules: this.#borders(),
      marks: this.#spans.map((s) => ({
        kind: 'rise',
        axis: s.kind === 'yaw' ? 'psi' : 'theta',
        t: s.at,
        value: s.from,
        to: s.to,
        brief: s.label,
        text: s.label,
      })),
    };
  }

  /** @param {uPlot} chart */
  #shade(chart) {
    if (!this.about.rule?.above) return;
    const { ctx, bbox, valToPos } = chart;
    ctx.fillStyle = ink('limit-fill');
    ctx.fillRect(
      bbox.left,
      bbox.top,
      bbox.width,
      Math.max(0, Math.round(valToPos(this.about.rule.value, 'y', true)) - bbox.top),
    );
  }

  /** The border's places in sight. @returns {import('../plots/rules.js').Rule[]} */
  #borders() {
    const { rule } = this.about;
    const [low, high] = this.#range;
    if (!rule) return [];
    const first = rule.every ? rule.value + rule.every * Math.ceil((low - rule.value) / rule.every) : rule.value;
    return Array.from(
      { length: rule.every ? Math.max(0, Math.floor((high - first) / rule.every) + 1) : 1 },
      (_, k) => ({ value: first + k * (rule.every ?? 0), label: t(rule.label), danger: true }),
    ).filter(({ value }) => value >= low && value <= high);
  }

  /**
   * Each from the curve to the border it is measured to, with its figure: pitch's to the left, yaw's to the right.
   * @param {uPlot} chart
   */
  #drawSpans({ ctx, valToPos, bbox }) {
    const size = devicePixelRatio * pictureScale().type;
    ctx.save();
    for (const { kind, at, from, to, label } of this.#spans) {
      const [x, y, end] = [valToPos(at, 'x', true), valToPos(from, 'y', true), valToPos(to, 'y', true)];
      Object.assign(ctx, {
        strokeStyle: ink(kind),
        fillStyle: ink(kind),
        lineWidth: 1.5 * devicePixelRatio * pictureScale().line,
      });
      ctx.setLineDash([]);
      ctx.beginPath();
      ctx.moveTo(x, y);
      ctx.lineTo(x, end);
      ctx.stroke();
      ctx.beginPath();
      if (kind === 'yaw') ctx.rect(x - 3.5 * size, y - 3.5 * size, 7 * size, 7 * size);
      else ctx.arc(x, y, 3.5 * size, 0, 2 * Math.PI);
      ctx.fill();
      const width = 8 * size + ((ctx.font = `600 ${11 * size}px system-ui, sans-serif`), ctx.measureText(label).width);
      const left =
        kind === 'yaw'
          ? Math.min(x + 3 * size, bbox.left + bbox.width - width)
          : Math.max(bbox.left, x - 3 * size - width);
      const middle = Math.max(bbox.top + 8 * size, Math.min(bbox.top + bbox.height - 8 * size, (y + end) / 2));
      ctx.fillStyle = ink('panel');
      ctx.globalAlpha = 0.85;
      ctx.fillRect(left + 2 * size, middle - 7 * size, width - 4 * size, 14 * size);
      Object.assign(ctx, { globalAlpha: 1, fillStyle: ink(kind), textAlign: 'left', textBaseline: 'middle' });
      ctx.fillText(label, left + 4 * size, middle);
    }
    ctx.restore();
  }

  /** @param {R} reply */
  show(reply) {
    const chart = (this.#chart ??= this.#build());
    this.#data = this.about.series.map((s) => s.of(reply));
    this.#spans = this.about.spans?.(reply) ?? [];
    this.#range = this.about.range(this.#data);
    const known = (/** @type {number} */ v) => (Number.isFinite(v) && (this.about.steps || v > 0) ? v : null);
    chart.setData([this.frequencies, ...this.#data.map((values) => this.frequencies.map((_w, i) => known(values[i])))]);
    this.valuesAt(0);
  }

  /** @param {number} i which frequency */
  valuesAt(i) {
    this.#data.forEach((values, k) => setText(this.values[k], `${significant(values[i], 4)}${this.about.unit ?? ''}`));
  }
}
