/** Bode plots of the loop opened at each motor, the other closed, with the margins drawn where they are measured. */
import { openLoops } from '../api.js';
import { logSpaced } from '../compare_math.js';
import { h, setText, symbol } from '../dom.js';
import { decibel, DEGREE, degrees, fixed, significant } from '../format.js';
import { Lazy } from '../lazy.js';
import { decibels, marginPlaces } from '../margins_math.js';
import { subtitle } from '../plot_menu.js';
import { bodyOf } from '../store.js';
import { say } from '../words.js';
import { FrequencyPlot } from './frequency_plot.js';

const FREQUENCIES = logSpaced(0.1, 1000, 241);
const AXES = /** @type {const} */ (['pitch', 'yaw']);
const NAMES = { pitch: 'pitch motor', yaw: 'yaw motor' };
const TITLE = 'loop opened at this motor’s input, all else closed';

/** Rounded to steps around what is seen. @param {number} step @param {number} low @param {number} high */
const around = (step, low, high) => (/** @type {number[][]} */ data) => {
  const seen = data.flat().filter(Number.isFinite);
  return /** @type {[number, number]} */ ([Math.max(low, step * Math.floor(Math.min(-step, ...seen) / step)), Math.min(high, step * Math.ceil(Math.max(0, ...seen) / step))]);
};

/** @param {'phase'|'gain'} kind @param {(m: any) => string} label */
const spans = (kind, label) => (/** @type {any} */ reply) => AXES.flatMap((axis) => {
  const place = marginPlaces(reply.frequencies, reply[axis], reply.margins[axis])[kind];
  return place ? [{ kind: axis, ...place, label: label(reply.margins[axis]) }] : [];
});

/** @param {(own: any) => number[]} of */
const series = (of) => AXES.map((axis) => ({ kind: axis, name: () => [NAMES[axis]], plain: NAMES[axis], title: TITLE, of: (/** @type {any} */ r) => of(r[axis]) }));

/** @type {import('./frequency_plot.js').About[]} */
const CHARTS = [
  { id: 'loop-gain', title: 'Gain', full: 'Gain of the loop opened at each motor', unit: ' dB', steps: [10, 20, 40, 60, 100], range: around(20, -100, 120), rule: { value: 0, label: 'crossover', above: false }, spans: spans('gain', (m) => decibel(m.gain_margin)), series: series((own) => decibels(own.gain)) },
  { id: 'loop-phase', title: 'Phase', full: 'Phase of the loop opened at each motor', unit: '°', steps: [15, 30, 45, 90, 180, 360], range: around(45, -1080, 360), rule: { value: -180, every: 360, label: 'critical', above: false }, spans: spans('phase', (m) => degrees(m.phase_margin, 0)),
    series: series((own) => own.phase.map((/** @type {number} */ v) => v * DEGREE)) },
];

/** One motor's margins in words. @param {any} reply @param {'pitch'|'yaw'} axis */
function words(reply, axis) {
  const margins = reply.margins[axis];
  const place = marginPlaces(reply.frequencies, reply[axis], margins);
  const phase = place.phase ? say`${degrees(margins.phase_margin, 0)} at ${significant(place.phase.at, 3)} rad/s` : degrees(margins?.phase_margin, 0);
  const gain = margins?.gain_margin === undefined ? '∞' : place.gain ? say`${decibel(margins.gain_margin)} at ${significant(place.gain.at, 3)} rad/s` : decibel(margins.gain_margin);
  const lower = margins?.gain_reduction_margin === undefined ? '' : say`, down to × ${fixed(margins.gain_reduction_margin)}`;
  return axis === 'pitch' ? say`Pitch motor: phase margin ${phase}, gain margin ${gain}${lower}.` : say`Yaw motor: phase margin ${phase}, gain margin ${gain}${lower}.`;
}

export class OpenLoopsCard {
  /** @param {HTMLElement} root @param {import('../store.js').Store} store */
  constructor(root, store) {
    this.at = h('span', { class: 'at-frequency' });
    this.words = h('p', { class: 'claim', 'data-testid': 'margin-words' });
    this.plots = CHARTS.map((about) => new FrequencyPlot(about, FREQUENCIES, { onHover: (i) => this.#hover(i), subtitle: () => subtitle(store) }));
    const content = h('div', {}, h('p', { class: 'caption' }, 'The loop opened at one motor, all else closed, PI loops included; ', symbol('ω'), ' in rad/s. Values at ', this.at), h('div', { class: 'frequency-plots' }, this.plots.map((p) => p.node)), this.words);
    root.append(content);
    this.lazy = new Lazy(root, content, store, { wait: 'Computing the open loops…', ask: openLoops, show: (answer) => this.#show(answer), body: (d) => ({ ...bodyOf(d), frequencies: FREQUENCIES }) });
  }

  /** @param {any} reply */
  #show(reply) {
    for (const plot of this.plots) plot.show(reply);
    setText(this.words, reply.stable ? AXES.map((axis) => words(reply, axis)).join(' ') : 'The whole loop is unstable: it has no margins.');
    this.words.classList.toggle('warning', !reply.stable);
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
