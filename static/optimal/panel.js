/**
 * Q and R as sliders, each as a weight or as the largest value accepted that it stands for (Bryson's rule), and ρ,
 * which scales R as a whole and moves the poles along the symmetric root locus.
 * @typedef {import('./weights.js').Weight} Weight
 * @typedef {import('../types.js').State} State
 */
import { polesText, say } from '../text/index.js';
import { presetOf, QUANTITIES } from '../model/index.js';
import { button, check, Choice, designField, h, setText, symbol } from '../ui/index.js';
import {
  acceptedOf,
  DEAREST,
  proposedWeight,
  rhoOf,
  weightFor,
  weightOf,
  WEIGHTS,
  withoutWeights,
  withRho,
  withWeight,
} from './weights.js';

const DECADES = 1e4;
/** By path: symbol, index and name. @type {Record<string, [string, string|undefined, string]>} */
const NAMES = {
  'weights.states.theta': ['θ', undefined, 'pitch angle θ'],
  'weights.states.psi': ['ψ', undefined, 'yaw angle ψ'],
  'weights.states.theta_dot': ['θ̇', undefined, 'pitch rate'],
  'weights.states.psi_dot': ['ψ̇', undefined, 'yaw rate'],
  'weights.integrals.theta': ['∫θ', undefined, 'integral of the pitch error'],
  'weights.integrals.psi': ['∫ψ', undefined, 'integral of the yaw error'],
  'weights.inputs.V_p': ['V', 'p', 'pitch motor’s voltage'],
  'weights.inputs.V_y': ['V', 'y', 'yaw motor’s voltage'],
};

/** As few digits as a field has room for. @param {number} v */
const short = (v) => Number(v.toPrecision(4));

export class WeightsPanel {
  /** @type {'accepted'|'weight'} what the fields show */ #as = 'accepted';

  /**
   * @param {HTMLElement} root
   * @param {import('../model/store.js').Store} store
   * @param {() => void} changed what is shown is to be
   */
  constructor(root, store, changed) {
    this.store = store;
    this.rows = WEIGHTS.map((w) => this.#row(w));
    this.rho = designField(store, 'weights-rho', (d, v) => this.#with((preset) => withRho(d, preset, v), d), {
      label: 'ρ, factor on R',
      mark: h('i', {}, 'ρ'),
      field: 'weights.rho',
      min: 1 / DEAREST,
      max: DEAREST,
      slider: { min: 1 / DEAREST, max: DEAREST, log: true },
    });
    const locus = check({ 'data-testid': 'show-locus', checked: true, onchange: changed }, 'root locus');
    this.locus = locus.box;
    this.reset = button(
      {
        class: 'quiet',
        'data-testid': 'weights-reset',
        'data-field': 'weights',
        'aria-label': 'Reset the weights',
        title: 'Back to 10° of error, 1 rad/s, half a second of that error, and the motors’ limits',
        onclick: () => store.edit(withoutWeights),
      },
      'Reset',
    );
    this.as = new Choice({
      label: 'What the fields show',
      testid: 'weights-as',
      options: [
        ['accepted', 'largest accepted', 'what weighs 1 in the cost: weight = 1/(largest accepted)²'],
        ['weight', 'weights', 'the diagonals of Q and R, SI units'],
      ],
      onChange: (as) => {
        this.#as = as;
        changed();
      },
    });
    this.words = h('p', { class: 'weights-words', 'data-testid': 'optimal-words', role: 'status' });
    this.node = h(
      'div',
      { class: 'weights', 'data-testid': 'weights', role: 'group', 'aria-label': 'Weights', hidden: true },
      h('div', { class: 'weights-head' }, h('b', {}, 'Q, R'), this.as.node, this.reset),
      this.rows.map((row) => row.node),
      h('div', { class: 'weights-rho' }, this.rho.node, locus.node),
      h('p', { class: 'aside' }, 'Weight = 1/(largest accepted)²: Bryson’s rule (Bryson and Ho, 1975, 5.2).'),
      this.words,
    );
    root.append(this.node);
  }

  /** Whether the track is asked for. */
  get showsLocus() {
    return this.locus.checked;
  }

  /**
   * @param {(preset: import('../types.js').Preset) => import('../types.js').Design} change
   * @param {import('../types.js').Design} design
   */
  #with(change, design) {
    const { preset } = this.store;
    return preset ? change(preset) : design;
  }

  /** @param {Weight} w */
  #row(w) {
    const [base, index, name] = NAMES[w.path];
    const id = w.path.replaceAll('.', '-');
    const { unit, min = 0, max = Infinity } = QUANTITIES[w.path] ?? {};
    const accepted = designField(
      this.store,
      `${id}-accepted`,
      (d, v) => this.#with((preset) => withWeight(d, preset, w, weightFor(w, v)), d),
      {
        label: `largest ${name} accepted, ${w.unit}`,
        mark: h('span', {}, symbol(base, index), h('small', { translate: 'no' }, w.unit)),
        unit: w.unit,
        field: w.path,
        min: w.scale / Math.sqrt(max),
        max: min ? w.scale / Math.sqrt(min) : Infinity,
        positive: true,
        optional: w.zero,
        slider: { min: 1, max: 10, log: true },
      },
    );
    if (w.zero) accepted.setBlank('any', w.scale);
    const weight = designField(this.store, id, (d, v) => this.#with((preset) => withWeight(d, preset, w, v), d), {
      label: `weight of the ${name}, ${unit}`,
      mark: symbol(base, index),
      field: w.path,
      min,
      max,
      slider: { min: 1, max: 10, log: true },
    });
    return { w, accepted, weight, node: h('div', { class: 'weights-row' }, accepted.node, weight.node) };
  }

  /** @param {State} state @param {boolean} weighted whether the method has weights */
  render(state, weighted) {
    const { design, reply, methods, answered } = state;
    const preset = presetOf(state);
    this.node.hidden = !weighted;
    if (!design || !preset || !weighted) return;
    const integrates = methods.find((m) => m.name === design.method)?.integrates === true;
    for (const { w, accepted, weight, node } of this.rows) {
      node.hidden = w.kind === 'integrals' && !integrates;
      const [v, usual] = [weightOf(design, preset, w), proposedWeight(preset, w)];
      const ends = [acceptedOf(w, usual * DECADES), acceptedOf(w, usual / DECADES)];
      weight.setRange({ min: usual / DECADES, max: usual * DECADES });
      accepted.setRange({ min: ends[0], max: ends[1] });
      weight.set(short(v));
      accepted.set(v === 0 ? NaN : short(acceptedOf(w, v)));
      if (v === 0 && accepted.slider) accepted.slider.value = '1';
      weight.node.hidden = this.#as === 'accepted';
      accepted.node.hidden = !weight.node.hidden;
    }
    this.as.set(this.#as);
    this.rho.set(rhoOf(design, preset));
    this.reset.disabled = !design.weights;
    const poles = answered?.method === design.method ? reply?.gains.optimal_poles : undefined;
    setText(
      this.words,
      poles ? say`LQR’s poles: ${polesText(poles)} rad/s. Your placed poles are dimmed and ignored.` : '',
    );
  }
}
