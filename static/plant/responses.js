/**
 * Responses over time and Bode plots of a design, beside those of pinned ones.
 * @typedef {import('../contract.js').SystemDesign} SystemDesign
 * @typedef {import('./curves.js').Line} Line
 */
import { DEGREE, inField, say, t } from '../text/index.js';
import { h, setText } from '../ui/index.js';
import { Curves } from './curves.js';
import { Line as Field, reader } from './line.js';

const LETTERS = '₀₁₂₃₄₅₆₇₈₉';
/** @param {string} name @param {number} i from 0 */
export const indexed = (name, i) => `${name}${[...String(i + 1)].map((d) => LETTERS[Number(d)]).join('')}`;
const named = (/** @type {string} */ name, /** @type {number[][]} */ rows) =>
  rows.map((values, i) => ({ name: indexed(name, i), values }));

/**
 * The lines of one view over time. Pure.
 * @param {SystemDesign} design @param {string} view ``step-0`` and so on, or ``initial``
 * @returns {{y: Line[], u: Line[]}}
 */
export function overTime({ courses }, view) {
  if (view === 'initial')
    return {
      y: [...named('x', courses.initial_x), ...(courses.estimate ? named('x̂', courses.estimate) : [])],
      u: named('u', courses.initial_u),
    };
  const k = Math.min(Number(view.slice(5)) || 0, courses.step_y.length - 1);
  return { y: named('y', courses.step_y[k]), u: named('u', courses.step_u[k]) };
}

/**
 * The lines of one view over frequency. Pure.
 * @param {SystemDesign} design @param {string} view ``plant-0``, ``closed-0``: of an input; ``loops``; ``rga``
 * @returns {{gain: Line[], phase: Line[]}}
 */
export function overFrequency({ bode }, view) {
  const degrees = (/** @type {ArrayLike<number>} */ values) => Array.from(values, (v) => v * DEGREE);
  if (view === 'rga') {
    const own = (bode.rga ?? []).flatMap((row, i) =>
      row.map((values, j) => ({ name: `|λ${indexed('', i)}${indexed('', j)}|`, values })),
    );
    return { gain: own, phase: [] };
  }
  if (view === 'loops')
    return {
      gain: named('L', bode.loops.gain),
      phase: named('L', bode.loops.phase).map((line) => ({ ...line, values: degrees(line.values) })),
    };
  const [which, at] = view.split('-');
  const { gain, phase } = which === 'closed' ? bode.closed : bode.plant;
  const k = Math.min(Number(at) || 0, gain[0].length - 1);
  const from = which === 'closed' ? 'r' : 'u';
  const name = (/** @type {number} */ i) => `${indexed(from, k)} → ${indexed('y', i)}`;
  return {
    gain: gain.map((row, i) => ({ name: name(i), values: row[k] })),
    phase: phase.map((row, i) => ({ name: name(i), values: degrees(row[k]) })),
  };
}

export class Responses {
  /** @type {SystemDesign|null} */ #design = null;
  /** @type {readonly {index: number, design: SystemDesign}[]} */ #pins = [];
  #shape = '';
  #states = 0;

  /** @param {(x0: number[]|null) => void} onStart */
  constructor(onStart) {
    const read = reader(() => this.#states);
    /** @type {Field<number[]|null>} */ this.start = new Field('Initial state x₀', 'plant-x0', {
      title: 'One number per state, as 1 0 0 0 or [1; 0; 0; 0]; empty: 1 for the first',
      read: (text) => (text.trim() ? read(text) : null),
      take: (x0) => {
        this.time.value = 'initial';
        this.#draw();
        onStart(x0);
      },
    });
    this.start.node.classList.add('plant-start');
    const select = (/** @type {string} */ label, /** @type {string} */ testid) =>
      h('select', { 'aria-label': label, 'data-testid': testid, onchange: () => this.#draw() });
    this.time = select('Response', 'plant-time-view');
    this.frequency = select('Frequency response', 'plant-frequency-view');
    this.y = new Curves('plant-y', 'Outputs', { unit: '', sync: 'plant-time' });
    this.u = new Curves('plant-u', 'Inputs', { unit: '', sync: 'plant-time' });
    this.gain = new Curves('plant-gain', 'Gain', { unit: '', sync: 'plant-frequency', log: { x: true, y: true } });
    this.phase = new Curves('plant-phase', 'Phase', {
      unit: '°',
      sync: 'plant-frequency',
      log: { x: true },
      steps: [15, 30, 45, 90, 180, 360],
    });
    this.node = h(
      'section',
      { class: 'card plant-responses', 'aria-label': 'Responses of the plant' },
      h('div', { class: 'plant-row' }, h('h3', {}, 'Responses over time'), this.start.node, this.time),
      h('div', { class: 'plant-charts' }, this.y.node, this.u.node),
      h('div', { class: 'plant-row' }, h('h3', {}, 'Over frequency'), this.frequency),
      h('div', { class: 'plant-charts' }, this.gain.node, this.phase.node),
    );
  }

  /** Where the states begin. @param {number[]|null} x0 null: 1 for the first @param {number} n */
  from(x0, n) {
    this.#states = n;
    this.start.set((x0 ?? Array.from({ length: n }, (_, i) => Number(i === 0))).map((v) => inField(v)).join(' '));
  }

  /** @param {SystemDesign} design @param {readonly {index: number, design: SystemDesign}[]} pins */
  show(design, pins) {
    this.#design = design;
    this.#pins = pins;
    const m = design.courses.step_y.length;
    const p = design.K.length;
    const shape = [m, p, design.scaling, Boolean(design.bode.rga)].join();
    if (shape !== this.#shape) this.#offer(design);
    this.#shape = shape;
    this.#draw();
  }

  /** @param {SystemDesign} design */
  #offer({ courses, K, scaling, bode }) {
    const of = scaling === 'inputs' ? 'v' : 'r';
    const each = (/** @type {number} */ n, /** @type {(i: number) => HTMLOptionElement} */ make) =>
      Array.from({ length: n }, (_, i) => make(i));
    const option = (/** @type {string} */ value, /** @type {string} */ words) => h('option', { value }, words);
    const keep = (/** @type {HTMLSelectElement} */ menu, /** @type {HTMLOptionElement[]} */ options) => {
      const { value } = menu;
      menu.replaceChildren(...options);
      if (options.some((own) => own.value === value)) menu.value = value;
    };
    keep(this.time, [
      ...each(courses.step_y.length, (i) => option(`step-${i}`, say`Step of ${indexed(of, i)}`)),
      option('initial', 'From an initial state'),
    ]);
    keep(this.frequency, [
      ...each(K.length, (i) => option(`plant-${i}`, say`Plant, from ${indexed('u', i)}`)),
      option('loops', 'Loop at each input, the others closed'),
      ...each(courses.step_y.length, (i) => option(`closed-${i}`, say`Closed loop, from ${indexed(of, i)}`)),
      ...(bode.rga ? [option('rga', 'Relative gains')] : []),
    ]);
  }

  #draw() {
    const design = this.#design;
    if (!design) return;
    const own = overTime(design, this.time.value);
    const initial = this.time.value === 'initial';
    this.y.name(initial ? 'States' : 'Outputs');
    const ghosts = (/** @type {'y'|'u'} */ part) =>
      this.#pins.map(({ index, design: kept }) => ({
        pin: index,
        x: kept.courses.t,
        lines: overTime(kept, this.time.value)[part],
      }));
    this.y.show(design.courses.t, own.y, ghosts('y'));
    this.u.show(design.courses.t, own.u, ghosts('u'));
    const { value } = this.frequency;
    const over = overFrequency(design, value);
    const faint = (/** @type {'gain'|'phase'} */ part) =>
      this.#pins.map(({ index, design: kept }) => ({
        pin: index,
        x: kept.bode.frequencies,
        lines: overFrequency(kept, value)[part],
      }));
    setText(this.gain.what, value === 'rga' ? t('Relative gains, magnitude') : t('Gain'));
    this.phase.node.hidden = value === 'rga';
    this.gain.show(design.bode.frequencies, over.gain, faint('gain'));
    if (over.phase.length) this.phase.show(design.bode.frequencies, over.phase, faint('phase'));
  }
}
