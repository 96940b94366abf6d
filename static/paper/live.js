/**
 * What the paper's equations come to on the present rig, with the present poles: matrices and constants beside their
 * formulas.
 */
import { DEGREE } from '../text/index.js';
import { FULL_RANK, nameOf } from '../model/index.js';
import { h, Matrix, setText, symbol } from '../ui/index.js';
import { outerLoops, stateFeedback } from './diagrams.js';
import { clean, figure, polesText } from './math.js';
import { rich } from './rich.js';
import { Machine } from './machine.js';

const sym = (/** @type {string} */ base, /** @type {string} */ sub = '') => symbol(base, sub || undefined);
const states = () => ['θ', 'ψ', 'θ̇', 'ψ̇'].map((s) => sym(s));
const rates = () => ['θ̇', 'ψ̇', 'θ̈', 'ψ̈'].map((s) => sym(s));
const motors = () => [sym('V', 'p'), sym('V', 'y')];
const chain = (/** @type {string} */ z) => [1, 2, 3, 4].map((i) => sym(z, String(i)));
const pairs = (/** @type {string[]} */ names) => names.flatMap((n) => [sym(n, '1'), sym(n, '2')]);

/**
 * @typedef {import('./walk.js').Walk} Walk
 * @typedef {import('./walk.js').Walkthrough} Walkthrough
 * @typedef {{key: import('../types.js').KeysOf<Walkthrough, number[][]>, name: () => Node, rows: () => Node[], columns:
 *   () => Node[], unit: string, above?: string}} Spec
 */
const bar = (/** @type {string} */ name) => () => h('b', {}, name);
const outputs = () => [sym('θ'), sym('ψ')];
const commands = () => [sym('v', 'p'), sym('v', 'y')];
const ends = () => [sym('ż', '2'), sym('ż', '4')];
/** @type {Record<string, Spec[]>} step → its matrices */
const MATRICES = {
  'Eq. 13': [{ key: 'A', name: bar('A'), rows: rates, columns: states, unit: '' }],
  'Eq. 14': [{ key: 'B', name: bar('B'), rows: rates, columns: motors, unit: '' }],
  'Eq. 16': [{ key: 'closed_loop', name: () => h('span'), above: '$A − BK$', rows: rates, columns: states, unit: '' }],
  controllability: [
    {
      key: 'controllability_matrix',
      name: () => h('span'),
      rows: states,
      columns: () => pairs(['b', 'Ab', 'A²b', 'A³b']),
      unit: '',
    },
  ],
  transformation: [
    { key: 'T', name: bar('T'), rows: () => chain('z'), columns: states, unit: '' },
    { key: 'Q', name: bar('Q'), rows: ends, columns: motors, unit: '' },
  ],
  'canonical form': [
    { key: 'A_bar', name: bar('Ā'), rows: () => chain('ż'), columns: () => chain('z'), unit: '' },
    { key: 'B_bar', name: bar('B̄'), rows: () => chain('ż'), columns: motors, unit: '' },
  ],
  'gain in z': [{ key: 'K_bar', name: bar('K̄'), rows: ends, columns: () => chain('z'), unit: '' }],
  'Eqs. 21, 22': [{ key: 'K', name: bar('K'), rows: motors, columns: states, unit: 'θ, ψ: V/rad; rates: V·s/rad' }],
  'closed loop': [
    {
      key: 'closed_loop_bar',
      name: () => h('span'),
      above: '$T(A − BK)T$⁻¹',
      rows: () => chain('ż'),
      columns: () => chain('z'),
      unit: '',
    },
  ],
  'steady state': [{ key: 'G_0', name: bar('Ĝ(0)'), rows: outputs, columns: commands, unit: 'rad/V' }],
  'Eq. 23': [{ key: 'rga', name: bar('RGA'), rows: outputs, columns: commands, unit: '' }],
};
/**
 * Step → group, key, as written, unit.
 * @type {Record<string, ['constants'|'trim'|'coefficients', string, string, string][]>}
 */
const CONSTANTS = {
  'Eq. 12': [['constants', 'gravity_torque', 'held at rest', 'N·m']],
  trim: [
    ['trim', 'V_p', 'V_p', 'V'],
    ['trim', 'V_y', 'V_y', 'V'],
  ],
  'Eq. 15': [
    ['constants', 'alpha', 'α', 'kg·m²'],
    ['constants', 'beta_0', 'β_0', 'kg·m²'],
    ['constants', 'gamma_', 'γ', '(N·m/V)²'],
    ['constants', 'a', 'a', 's⁻²'],
  ],
  'desired polynomials': [
    ['coefficients', 'd_10', 'd_10 = p_1 p_2', 's⁻²'],
    ['coefficients', 'd_11', 'd_11 = −p_1 − p_2', 's⁻¹'],
    ['coefficients', 'd_20', 'd_20 = p_3 p_4', 's⁻²'],
    ['coefficients', 'd_21', 'd_21 = −p_3 − p_4', 's⁻¹'],
  ],
};
/** @type {Record<string, (answer: import('./walk.js').Answer) => string>} step → what is said in words */
const LINES = {
  controllability: ({ controllability_indices: [p, y] }) =>
    `Indices: ${p} for the pitch motor, ${y} for the yaw motor.`,
  'Eq. 18': ({ asked }) => `Requested: ${polesText(asked.poles, 4)} rad/s.`,
  'closed loop': ({ closed_loop_poles: poles, pole_error: error }) =>
    `Eigenvalues of A − BK: ${polesText(poles, 4)} ` +
    `rad/s${error === undefined ? '' : `; largest distance from those asked for ${figure(error, 2)}`}.`,
};
const OWN = new Set(['T', 'Q', 'A_bar', 'B_bar', 'K_bar', 'closed_loop_bar', 'coefficients']);
const DIAGRAMS = { 'Fig. 2': stateFeedback, 'Fig. 3': outerLoops };

/** Why a step has no numbers. @param {string} key @param {Walk} answer */
function whyNot(key, { asked }) {
  if (OWN.has(key))
    return (
      `The method chosen above, ${nameOf(asked)}, has no such step. Choose the full-rank method to see its ` +
      'numbers.'
    );
  return 'There is none: with a pole at 0 the closed loop has no steady state.';
}

export class LiveNumbers {
  /** @type {((answer: Walk) => void)[]} */ #fill = [];

  constructor() {
    this.machine = new Machine();
    this.rig = h('ul', { class: 'present', 'data-testid': 'paper-rig' });
    this.loop = h('p', { class: 'loop-now', 'data-testid': 'paper-loop' });
  }

  /** The block of a step. @param {string} number @returns {Element|null} */
  at(number) {
    const matrices = (MATRICES[number] ?? []).map((spec, i) => this.#matrix(spec, i === 0));
    const parts = [
      ...this.#diagram(number),
      ...this.#constants(number),
      ...(matrices.length ? [h('div', { class: 'numerics' }, matrices)] : []),
      ...this.#line(number),
      ...(number === 'Fig. 3' ? [this.loop] : []),
    ];
    if (number === 'Table I') return this.#block([this.machine.table]);
    if (number === 'Eq. 1' || number === 'Eq. 8') return this.#block([this.machine.example(number)]);
    if (!parts.length) return null;
    const block = this.#block(parts);
    const why = h('p', { class: 'refused-words', hidden: true });
    block.append(why);
    this.#fill.push((answer) => {
      const missing =
        answer.refused ??
        (number in CONSTANTS && !answer[CONSTANTS[number][0][0]] ? whyNot(CONSTANTS[number][0][0], answer) : '');
      why.hidden = !missing;
      block.classList.toggle('refused-block', Boolean(missing));
      setText(why, missing);
    });
    return block;
  }

  /** @param {Node[]} parts */
  #block(parts) {
    return h('div', { class: 'live' }, h('p', { class: 'live-caption' }, 'on the present rig'), parts);
  }

  /** A block diagram, drawn anew with each answer. @param {string} number */
  #diagram(number) {
    const draw = DIAGRAMS[/** @type {keyof typeof DIAGRAMS} */ (number)];
    if (!draw) return [];
    const node = h('div', { class: 'diagram' });
    this.#fill.push((answer) => {
      if (!answer.refused) node.replaceChildren(draw(answer));
    });
    return [node];
  }

  /** @param {string} number */
  #line(number) {
    const say = LINES[number];
    if (!say) return [];
    const node = h('p', { class: 'live-line', 'data-testid': `paper-line-${number.replaceAll(/[ .]+/g, '-')}` });
    this.#fill.push((answer) => setText(node, answer.refused === undefined ? say(answer) : ''));
    return [node];
  }

  /** @param {string} number */
  #constants(number) {
    const list = CONSTANTS[number];
    if (!list) return [];
    return [
      h(
        'dl',
        { class: 'constants' },
        list.map(([group, key, name, unit]) => {
          const value = h('span', { 'data-testid': `paper-${key}` });
          this.#fill.push((answer) => setText(value, figure(answer[group]?.[key])));
          return h('div', {}, h('dt', {}, rich(name)), h('dd', {}, value, ` ${unit}`));
        }),
      ),
    ];
  }

  /** @param {Spec} spec @param {boolean} first of its step: it tells why there are none */
  #matrix({ key, name, rows, columns, unit, above }, first) {
    const matrix = new Matrix(
      `paper-${key}`,
      name(),
      rows(),
      columns(),
      (i, j) => `${key}, row ${i + 1}, column ${j + 1}`,
      { name: key === 'rga' ? 'RGA' : key, note: unit || undefined },
    );
    const none = h('p', { class: 'refused-words', hidden: true });
    this.#fill.push((answer) => {
      const missing = !answer.refused && !answer[key];
      none.hidden = !missing || !first;
      setText(none, missing && first ? whyNot(key, answer) : '');
      matrix.node.hidden = missing;
      matrix.render(clean(answer[key]), (v) => figure(v, key === 'K' ? 6 : 5));
    });
    const whose = key === 'K' ? h('p', { class: 'unit-line', hidden: true }) : null;
    if (whose)
      this.#fill.push(({ asked, refused, rotors }) => {
        const six = Boolean(rotors?.placed);
        whose.hidden = Boolean(refused) || (asked.method === FULL_RANK && !six);
        const other = asked.method === FULL_RANK ? '' : `As ${nameOf(asked)} computes it, not by this formula. `;
        setText(whose, other + (six ? 'Four states: the design places the rotors, too, see “The rotors”.' : ''));
      });
    return h(
      'div',
      { class: 'numeric' },
      above ? h('p', { class: 'above' }, rich(above)) : null,
      h('div', { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': key }, matrix.node),
      unit ? h('p', { class: 'unit-line' }, unit) : null,
      whose,
      none,
    );
  }

  /** The walkthrough's answer, or why there is none. @param {Walk} answer */
  show(answer) {
    for (const fill of this.#fill) fill(answer);
  }

  /** What needs no question to the server. @param {import('../types.js').State} state */
  render({ design, presets, reply }) {
    if (!design) return;
    const preset = presets.find((p) => p.name === design.preset);
    this.machine.render(presets, preset, design.parameters);
    const changed = Object.keys(design.parameters).length;
    const facts = [
      preset?.title ?? design.preset,
      ...(changed ? [`${changed} value${changed > 1 ? 's' : ''} changed`] : []),
      `θ₀ = ${figure(design.theta0 * DEGREE, 4)}°`,
      `poles ${polesText(design.poles, 2)}`,
      nameOf(design),
    ];
    if (this.rig.textContent !== facts.join('')) this.rig.replaceChildren(...facts.map((text) => h('li', {}, text)));
    const controllers = Object.entries(design.loops)
      .map(([axis, { kp, ti }]) => `${axis} ${figure(kp)} (1 + 1/(${figure(ti)} s))`)
      .join(', ');
    const own = reply?.gains && 'integral' in reply.gains;
    setText(
      this.loop,
      own
        ? 'The method’s own integral action takes the place of the PI loops. Poles of the whole loop: ' +
            `${polesText(reply.loop_poles, 2)} rad/s.`
        : design.outer === 'pi'
          ? `PI: ${controllers}. Poles of the whole loop: ${reply ? polesText(reply.loop_poles, 2) : '–'} rad/s.`
          : `No PI loops now. Poles of the loop: ${reply ? polesText(reply.loop_poles, 2) : '–'} rad/s.`,
    );
  }
}
