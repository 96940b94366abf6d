/** How much pitch and yaw feel each other at each frequency: relative gains, and off-diagonal over diagonal entries of Ĝ(jω). */
import { relativeGain } from '../api.js';
import { dominanceWords, largest, logSpaced } from '../compare_math.js';
import { h, setText, symbol } from '../dom.js';
import { significant } from '../format.js';
import { Lazy } from '../lazy.js';
import { subtitle } from '../plot_menu.js';
import { bodyOf } from '../store.js';
import { FrequencyPlot } from './frequency_plot.js';

const FREQUENCIES = logSpaced(0.01, 1000, 121);
const size = (/** @type {string} */ sub) => h('span', { class: 'sym' }, '|', h('i', {}, 'λ'), h('sub', {}, sub), '|');

/** Full decades around what is seen, and around 1. @param {number[][]} data @returns {[number, number]} */
function range(data) {
  const seen = data.flat().filter((v) => Number.isFinite(v) && v > 0).map((v) => Math.log10(v));
  return [10 ** Math.max(-6, Math.floor(Math.min(-1, ...seen))), 10 ** Math.min(6, Math.ceil(Math.max(1, ...seen)))];
}

/** @type {import('./frequency_plot.js').About[]} */
const CHARTS = [
  { id: 'gains', title: 'Relative gains', range, series: [
    { kind: 'series-0', name: () => [size('11')], plain: '|λ₁₁|', title: 'relative gain of the diagonal pairing at this frequency', of: (r) => r.rga_magnitude.map((/** @type {number[][]} */ m) => m[0][0]) },
    { kind: 'series-1', name: () => [size('12')], plain: '|λ₁₂|', title: 'relative gain of the crosswise pairing at this frequency', of: (r) => r.rga_magnitude.map((/** @type {number[][]} */ m) => m[0][1]) }] },
  { id: 'dominance', title: 'Off-diagonal over diagonal', range, rule: { value: 1, label: 'below 1: diagonally dominant', above: true }, series: [
    { kind: 'series-0', name: () => ['rows'], plain: 'rows', title: 'larger of both rows of Ĝ(jω): an angle’s answer to the other input, over that to its own', of: (r) => largest(r.dominance?.rows ?? []) },
    { kind: 'series-1', name: () => ['columns'], plain: 'columns', title: 'larger of both columns of Ĝ(jω): an input’s effect on the other angle, over that on its own', of: (r) => largest(r.dominance?.columns ?? []) }] },
];

export class InteractionCard {
  /** @param {HTMLElement} root @param {import('../store.js').Store} store */
  constructor(root, store) {
    this.at = h('span', { class: 'at-frequency' });
    this.words = h('p', { class: 'claim', 'data-testid': 'dominance-words' });
    this.plots = CHARTS.map((about) => new FrequencyPlot(about, FREQUENCIES, { onHover: (i) => this.#hover(i), subtitle: () => subtitle(store) }));
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
