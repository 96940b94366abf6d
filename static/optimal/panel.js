/**
 * Q and R as sliders: a row for each weight, with the largest value accepted that it stands for (Bryson's rule), and ρ,
 * which scales R as a whole and moves the poles along the symmetric root locus.
 * @typedef {import('./weights.js').Weight} Weight
 * @typedef {import('../types.js').State} State
 */
import { polesText, say } from '../text/index.js';
import { presetOf, QUANTITIES } from '../model/index.js';
import { button, check, designField, h, setText, symbol } from '../ui/index.js';
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

export class WeightsPanel {
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
        title: 'Back to 10° of error, 1 rad/s, half a second of that error, and the motors’ limits',
        onclick: () => store.edit(withoutWeights),
      },
      'Reset weights',
    );
    this.words = h('p', { class: 'weights-words', 'data-testid': 'optimal-words', role: 'status' });
    this.node = h(
      'div',
      { class: 'weights', 'data-testid': 'weights', role: 'group', 'aria-label': 'Weights', hidden: true },
      h(
        'div',
        { class: 'weights-head', 'aria-hidden': 'true' },
        h('span', {}, 'largest accepted'),
        h('span', {}, 'weight in Q, R'),
      ),
      this.rows.map((row) => row.node),
      h('div', { class: 'weights-rho' }, this.rho.node, locus.node, this.reset),
      h(
        'p',
        { class: 'aside' },
        'Bryson’s rule: weight = 1/(largest accepted)² (Bryson and Ho, 1975). Less ρ: effort is cheap, poles are fast. ' +
          'Dashed: their symmetric root locus over ρ, a ring where ρ = 1.',
      ),
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
        mark: symbol(base, index),
        unit: w.unit,
        field: w.path,
        min: w.scale / Math.sqrt(max),
        max: min ? w.scale / Math.sqrt(min) : Infinity,
        positive: true,
        optional: w.zero,
      },
    );
    if (w.zero) accepted.setBlank('any', w.scale);
    const weight = designField(this.store, id, (d, v) => this.#with((preset) => withWeight(d, preset, w, v), d), {
      label: `weight of the ${name}, ${unit}`,
      mark: '',
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
      weight.setRange({ min: usual / DECADES, max: usual * DECADES });
      weight.set(v);
      accepted.set(acceptedOf(w, v));
    }
    this.rho.set(rhoOf(design, preset));
    this.reset.disabled = !design.weights;
    const poles = answered?.method === design.method ? reply?.gains.optimal_poles : undefined;
    setText(
      this.words,
      poles ? say`LQR’s poles: ${polesText(poles)} rad/s. The placed poles, dimmed, are ignored.` : '',
    );
  }
}
