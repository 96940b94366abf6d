/** The two pairs as numbers: real or complex, two values each, with sliders. */
import {
  AXES,
  isComplex,
  LIMIT,
  niceStep,
  placesPoles,
  setComplex,
  setMode,
  setReal,
  verdictOf,
} from '../model/index.js';
import { Choice, h, NumberField, setAttr, setText, shape } from '../ui/index.js';

const NAMES = ['pitch', 'yaw'];

/**
 * Which four poles of a design are edited, and how they are called.
 * @typedef {object} Four
 * @property {string} field  their path in the contract
 * @property {string} testid  what those of the fields begin with
 * @property {string} letter
 * @property {string} whose  for assistive technology
 * @property {(d: import('../types.js').Design) => import('../types.js').Poles} of
 * @property {(d: import('../types.js').Design, poles: import('../types.js').Poles) => import('../types.js').Design} put
 */

/** @type {Four} */
const PLACED = {
  field: 'poles',
  testid: '',
  letter: 'p',
  whose: '',
  of: (d) => d.poles,
  put: (d, poles) => ({ ...d, poles }),
};

/** Two poles as numbers: a real or a complex pair. */
export class PairEditor {
  /** @param {0|1} pair @param {import('../model/store.js').Store} store @param {Four} [four] */
  constructor(pair, store, four = PLACED) {
    this.pair = pair;
    this.four = four;
    const name = NAMES[pair];
    this.mode = new Choice({
      label: `${name} pair`,
      testid: `${four.testid}mode-${name}`,
      options: [
        ['real', 'real', 'two real poles'],
        ['complex', 'complex', 'a conjugate pair'],
      ],
      onChange: (v) => store.edit((d) => four.put(d, setMode(four.of(d), pair, v === 'complex'))),
    });
    this.fields = [0, 1].map((k) => this.#field(k, store));
    this.node = h(
      'fieldset',
      { class: `pair ${name}`, 'data-testid': `${four.testid}pair-${name}` },
      h('legend', {}, shape(name), name),
      this.mode.node,
      this.fields.map((f) => f.node),
      (this.verdict = h('p', { class: 'pair-verdict', hidden: true, 'data-testid': `${four.testid}verdict-${name}` })),
    );
    this.marks = this.fields.map((f) => /** @type {HTMLElement} */ (f.node.querySelector('.mark')));
  }

  /** @param {number} k @param {import('../model/store.js').Store} store */
  #field(k, store) {
    const index = 2 * this.pair + k;
    const { four } = this;
    const id = `${four.testid}pole-field-${index}`;
    return new NumberField({
      label: `${NAMES[this.pair]} ${four.whose}pole ${index + 1}`,
      testid: id,
      field: `${four.field}.${index}`,
      min: -LIMIT,
      max: LIMIT,
      slider: { min: -20, max: 4 },
      onInput: (v, stamp) => store.edit((d) => four.put(d, this.#changed(four.of(d), k, v)), { gesture: id, stamp }),
      onComplex: (p, stamp) => store.edit((d) => four.put(d, setComplex(four.of(d), index, p)), { gesture: id, stamp }),
      onCommit: () => store.commit(),
    });
  }

  /** @param {import('../types.js').Poles} poles @param {number} k @param {number} v */
  #changed(poles, k, v) {
    const index = 2 * this.pair;
    if (!isComplex(poles, this.pair)) return setReal(poles, index + k, v);
    const sign = Math.sign(poles[index].im) || 1;
    const { re, im } = poles[index];
    return setComplex(poles, index, k === 0 ? { re: v, im } : { re, im: sign * Math.max(Math.abs(v), 1e-3) });
  }

  /**
   * @param {import('../types.js').Poles} poles
   * @param {number} reach
   * @param {import('../model/requirements.js').Verdict|null} [verdict] on its axis' step
   */
  render(poles, reach, verdict = null) {
    const complex = isComplex(poles, this.pair);
    const [a, b] = [poles[2 * this.pair], poles[2 * this.pair + 1]];
    this.mode.set(complex ? 'complex' : 'real');
    const first = 2 * this.pair + 1;
    const names = complex ? ['Re', '\u00b1 Im'] : [0, 1].map((k) => `${this.four.letter}${'₁₂₃₄'[first - 1 + k]}`);
    this.marks.forEach((m, i) => m.textContent !== names[i] && m.replaceChildren(names[i]));
    const spoken = complex ? ['real part', 'imaginary part'] : [`pole ${first}`, `pole ${first + 1}`];
    this.fields.forEach((f, i) =>
      setAttr(f.input, 'aria-label', `${NAMES[this.pair]} ${this.four.whose}${spoken[i]}, rad/s`),
    );
    this.fields[0].setRange({ min: -reach, max: 0.2 * reach });
    this.fields[1].setRange(complex ? { min: 0, max: reach } : { min: -reach, max: 0.2 * reach });
    this.fields[0].set(a.re);
    this.fields[1].set(complex ? Math.abs(a.im) : b.re);
    this.verdict.hidden = !verdict;
    if (!verdict) return;
    this.verdict.classList.toggle('missed', !verdict.met);
    setAttr(this.verdict, 'title', verdict.text);
    setText(this.verdict, verdict.met ? `✓ ${verdict.text}` : `✕ ${verdict.text}`);
  }
}

export class PolesPanel {
  #reach = 0;

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.root = root;
    this.pairs = [new PairEditor(0, store), new PairEditor(1, store)];
    root.append(...this.pairs.map((p) => p.node));
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    const { design, dragging, requirements, reply } = state;
    if (!design) return;
    this.root.classList.toggle('unused', !placesPoles(state));
    const far = Math.max(1, ...design.poles.map((p) => Math.max(Math.abs(p.re), Math.abs(p.im))));
    if (!dragging && (far > this.#reach || far < this.#reach / 4)) {
      const step = niceStep(2 * far, 4);
      this.#reach = Math.ceil((1.5 * far) / step) * step;
    }
    for (const pair of this.pairs)
      pair.render(design.poles, this.#reach, verdictOf(reply, AXES[pair.pair], requirements));
  }
}
