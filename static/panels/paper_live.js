/** What the paper's equations come to on the present rig, with the present poles: matrices and constants beside their formulas. */
import { h, setText, symbol } from '../dom.js';
import { DEGREE } from '../format.js';
import { Matrix } from '../matrix.js';
import { nameOf } from '../methods.js';
import { clean, figure, polesText } from '../paper_math.js';
import { rich } from '../rich.js';
import { Machine } from './paper_machine.js';

const sym = (/** @type {string} */ base, /** @type {string} */ sub = '') => symbol(base, sub || undefined);
const states = () => ['θ', 'ψ', 'θ̇', 'ψ̇'].map((s) => sym(s));
const rates = () => ['θ̇', 'ψ̇', 'θ̈', 'ψ̈'].map((s) => sym(s));
const motors = () => [sym('V', 'p'), sym('V', 'y')];
const chain = (/** @type {string} */ z) => [1, 2, 3, 4].map((i) => sym(z, String(i)));
const pairs = (/** @type {string[]} */ names) => names.flatMap((n) => [sym(n, '1'), sym(n, '2')]);

/** @typedef {{key: string, name: () => Node, rows: () => Node[], columns: () => Node[], unit: string, above?: string}} Spec */
/** @type {Record<string, Spec[]>} equation → its matrices */
const MATRICES = {
  'Eq. 13': [{ key: 'A', name: () => h('b', {}, 'A'), rows: rates, columns: states, unit: '' }],
  'Eq. 14': [{ key: 'B', name: () => h('b', {}, 'B'), rows: rates, columns: motors, unit: '' }],
  controllability: [{ key: 'controllability_matrix', name: () => h('span'), rows: states, columns: () => pairs(['b', 'Ab', 'A²b', 'A³b']), unit: '' }],
  'Eq. 19': [
    { key: 'T', name: () => h('b', {}, 'T'), rows: () => chain('z'), columns: states, unit: '' },
    { key: 'Q', name: () => h('b', {}, 'Q'), rows: () => [sym('1'), sym('2')], columns: () => [sym('1'), sym('2')], unit: '' },
    { key: 'A_bar', name: () => h('b', {}, 'Ā'), rows: () => chain('ż'), columns: () => chain('z'), unit: '' },
  ],
  'Eqs. 21, 22': [{ key: 'K', name: () => h('b', {}, 'K'), rows: motors, columns: states, unit: 'θ, ψ: V/rad; rates: V·s/rad' }],
  'Eq. 18': [{ key: 'closed_loop_bar', name: () => h('span'), above: '$T(A − BK)T$⁻¹', rows: () => chain('ż'), columns: () => chain('z'), unit: '' }],
  'Eq. 17': [{ key: 'G_0', name: () => h('b', {}, 'Ĝ(0)'), rows: () => [sym('θ'), sym('ψ')], columns: () => [sym('v', 'p'), sym('v', 'y')], unit: 'rad/V' }],
  'Eq. 23': [{ key: 'rga', name: () => h('b', {}, 'RGA'), rows: () => [sym('θ'), sym('ψ')], columns: () => [sym('v', 'p'), sym('v', 'y')], unit: '' }],
};
/** @type {Record<string, [string, string, string, string][]>} equation → group, key, as written, unit */
const CONSTANTS = {
  trim: [['trim', 'V_p', 'V_p', 'V'], ['trim', 'V_y', 'V_y', 'V']],
  'Eq. 15': [['constants', 'alpha', 'α', 'kg·m²'], ['constants', 'beta_0', 'β_0', 'kg·m²'], ['constants', 'gamma_', 'γ', '(N·m/V)²'], ['constants', 'a', 'a', 's⁻²']],
  'Eq. 18': [['coefficients', 'd_10', 'p_1 p_2', 's⁻²'], ['coefficients', 'd_11', '−p_1 − p_2', 's⁻¹'], ['coefficients', 'd_20', 'p_3 p_4', 's⁻²'], ['coefficients', 'd_21', '−p_3 − p_4', 's⁻¹']],
};
const NO_STEADY = 'There is none: with a pole at 0 the closed loop has no steady state.';

export class LiveNumbers {
  /** @type {((answer: any) => void)[]} */ #fill = [];

  constructor() {
    this.machine = new Machine();
    this.rig = h('ul', { class: 'present', 'data-testid': 'paper-rig' });
    this.loop = h('p', { class: 'loop-now', 'data-testid': 'paper-loop' });
  }

  /** The block of an equation. @param {string} number @returns {Element|null} */
  at(number) {
    const matrices = (MATRICES[number] ?? []).map((spec) => this.#matrix(spec));
    const parts = [...this.#constants(number), ...(matrices.length ? [h('div', { class: 'numerics' }, matrices)] : [])];
    if (number === 'Fig. 3') return this.#block([this.loop]);
    if (number === 'Table I') return this.#block([this.machine.table]);
    if (number === 'Eq. 1' || number === 'Eq. 8') return this.#block([this.machine.example(number)]);
    if (!parts.length) return null;
    const block = this.#block(parts);
    const why = h('p', { class: 'refused-words', hidden: true });
    block.append(why);
    this.#fill.push((answer) => {
      why.hidden = !answer.refused;
      block.classList.toggle('refused-block', Boolean(answer.refused));
      setText(why, answer.refused ?? '');
    });
    return block;
  }

  /** @param {Node[]} parts */
  #block(parts) {
    return h('div', { class: 'live' }, h('p', { class: 'live-caption' }, 'on the present rig'), parts);
  }

  /** @param {string} number */
  #constants(number) {
    const list = CONSTANTS[number];
    if (!list) return [];
    return [h('dl', { class: 'constants' }, list.map(([group, key, name, unit]) => {
      const value = h('span', { 'data-testid': `paper-${key}` });
      this.#fill.push((answer) => setText(value, figure(answer[group]?.[key])));
      return h('div', {}, h('dt', {}, rich(name)), h('dd', {}, value, ` ${unit}`));
    }))];
  }

  /** @param {Spec} spec */
  #matrix({ key, name, rows, columns, unit, above }) {
    const matrix = new Matrix(`paper-${key}`, name(), rows(), columns(), (i, j) => `${key}, row ${i + 1}, column ${j + 1}`, { name: key === 'rga' ? 'RGA' : key, note: unit || undefined });
    const none = h('p', { class: 'refused-words', hidden: true }, NO_STEADY);
    this.#fill.push((answer) => {
      const missing = !answer.refused && !answer[key];
      none.hidden = !missing;
      matrix.node.hidden = missing;
      matrix.render(clean(answer[key]), (v) => figure(v, key === 'K' ? 6 : 5));
    });
    return h('div', { class: 'numeric' }, above ? h('p', {}, rich(above)) : null, h('div', { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': key }, matrix.node), unit ? h('p', { class: 'unit-line' }, unit) : null, none);
  }

  /** The walkthrough's answer, or why there is none. @param {any} answer */
  show(answer) {
    for (const fill of this.#fill) fill(answer);
  }

  /** What needs no question to the server. @param {import('../types.js').State} state */
  render({ design, presets, reply }) {
    if (!design) return;
    const preset = presets.find((p) => p.name === design.preset);
    this.machine.render(presets, preset, design.parameters);
    const changed = Object.keys(design.parameters).length;
    const facts = [preset?.title ?? design.preset, ...(changed ? [`${changed} value${changed > 1 ? 's' : ''} changed`] : []),
      `θ₀ = ${figure(design.theta0 * DEGREE, 4)}°`, `poles ${polesText(design.poles, 2)}`, nameOf(design)];
    if (this.rig.textContent !== facts.join('')) this.rig.replaceChildren(...facts.map((text) => h('li', {}, text)));
    const controllers = Object.entries(design.loops).map(([axis, { kp, ti }]) => `${axis} ${figure(kp)} (1 + 1/(${figure(ti)} s))`).join(', ');
    setText(this.loop, design.outer === 'pi' ? `PI: ${controllers}. Poles of the whole loop: ${reply ? polesText(reply.loop_poles, 2) : '–'} rad/s.` : `No PI loops now. Poles of the loop: ${reply ? polesText(reply.loop_poles, 2) : '–'} rad/s.`);
  }
}

