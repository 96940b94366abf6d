/**
 * What is wanted of a system: poles as text, method, weights, observer.
 * @typedef {import('./wish.js').Wish} Wish
 * @typedef {import('./wish.js').Weights} Weights
 */
import { say, t } from '../text/index.js';
import { check, h, setAttr, setText } from '../ui/index.js';
import { Line, reader } from './line.js';
import { methodName } from './wish.js';
import { polesIn, polesLine } from './poles.js';

const LEAST = 1e-12; // of a weight that must not be 0

export class Controls {
  /** @type {Weights|null} */ #given = null;
  sizes = { n: 0, p: 0, q: 0 };
  /** @type {readonly import('../contract.js').Method[]} */ methods = [];

  /** @param {(change: Partial<Wish>) => void} onChange @param {() => void} onObserver */
  constructor(onChange, onObserver) {
    const poles = (/** @type {string} */ text) => {
      const found = polesIn(text);
      if (!found) return say`Write poles as -1, -2±3j.`;
      return found.length === this.sizes.n
        ? found
        : say`These are ${found.length} poles, and ${this.sizes.n} are wanted.`;
    };
    this.poles = new Line('Poles, rad/s', 'plant-poles', { read: poles, take: (value) => onChange({ poles: value }) });
    this.observer = new Line('Observer’s poles', 'plant-observer-poles', {
      read: poles,
      take: (value) => onChange({ observer: value }),
    });
    const { box, node } = check({ 'data-testid': 'plant-observer', onchange: onObserver }, 'Observer');
    this.box = box;
    this.observerCheck = node;
    const diagonal = (
      /** @type {string} */ name,
      /** @type {'n'|'p'|'q'} */ size,
      /** @type {keyof Weights} */ part,
      least = LEAST,
      /** @type {string|undefined} */ title = undefined,
    ) =>
      new Line(`${name}, diagonal`, `plant-${name}`, {
        read: reader(() => this.sizes[size], { least }),
        take: (values) => onChange({ weights: { ...this.#weights, [part]: values } }),
        title,
      });
    this.states = diagonal('Q', 'n', 'states', 0);
    this.inputs = diagonal('R', 'p', 'inputs');
    const told = 'Weights of the integrated errors ∫ (r − y) dt, one per output';
    this.integrals = diagonal('Q_z', 'q', 'integrals', LEAST, told);
    this.method = h('select', {
      'aria-label': 'Method',
      'data-testid': 'plant-method',
      onchange: () => onChange({ method: this.method.value }),
    });
    this.node = h(
      'div',
      { class: 'plant-controls' },
      this.poles.node,
      h('label', { class: 'plant-field' }, h('span', {}, 'Method'), this.method),
      this.states.node,
      this.inputs.node,
      this.integrals.node,
      this.observerCheck,
      this.observer.node,
    );
  }

  /** @returns {Weights} */
  get #weights() {
    const { n, p } = this.sizes;
    return this.#given ?? { states: Array(n).fill(1), inputs: Array(p).fill(1) };
  }

  /** @param {readonly import('../contract.js').Method[]} methods */
  offer(methods) {
    if (this.methods.length || !methods.length) return;
    this.methods = methods;
    this.method.append(...methods.map((own) => h('option', { value: own.name }, methodName(own))));
  }

  /** @param {string} name of a method @returns {Partial<import('../contract.js').Method>} */
  about(name) {
    return this.methods.find((method) => method.name === name) ?? {};
  }

  /** @param {Wish} wish @param {{n: number, p: number, q: number}} sizes q: 0 where there is no C */
  show(wish, sizes) {
    const { title, weighted, integrates, places_poles } = this.about(wish.method);
    this.#given = wish.weights;
    this.sizes = sizes;
    this.poles.set(polesLine(wish.poles));
    setText(this.poles.label, places_poles === false ? 'Poles (LQR chooses its own)' : 'Poles, rad/s');
    this.method.value = wish.method;
    setAttr(this.method, 'title', t(title ?? ''));
    this.states.node.hidden = this.inputs.node.hidden = !weighted;
    this.integrals.node.hidden = !integrates || !sizes.q;
    const { states, inputs, integrals } = this.#weights;
    this.states.set(states.join(', '));
    this.inputs.set(inputs.join(', '));
    this.integrals.set((integrals ?? Array(sizes.q).fill(1)).join(', '));
    this.box.checked = wish.observer !== null;
    this.box.disabled = !sizes.q;
    this.observer.node.hidden = !wish.observer;
    if (wish.observer) this.observer.set(polesLine(wish.observer));
  }
}
