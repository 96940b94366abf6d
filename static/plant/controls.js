/**
 * What is wanted of a system: poles as text, method, weights, observer.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {{poles: Complex[], observer: Complex[]|null, method: string, weights: {states: number[],
 *   inputs: number[]}|null}} Wish
 */
import { parseNumber, say } from '../text/index.js';
import { check, h, setText } from '../ui/index.js';
import { polesIn, polesLine } from './poles.js';

/** A line of text that becomes a value where it is left, or Enter is pressed; at it what is wrong. @template T */
class Line {
  /** Whether something is typed that is not taken yet. */ #typed = false;

  /**
   * @param {string} label @param {string} testid
   * @param {{read: (text: string) => T|string, take: (value: T) => void}} how read: the value, or what is wrong
   */
  constructor(label, testid, { read, take }) {
    this.error = h('span', { class: 'field-error', id: `${testid}-error`, role: 'status' });
    this.input = h('input', {
      class: 'plant-line-field',
      type: 'text',
      autocomplete: 'off',
      spellcheck: 'false',
      'aria-label': label,
      'aria-describedby': `${testid}-error`,
      'data-testid': testid,
      oninput: () => {
        this.#typed = true;
      },
      onblur: () => {
        this.#typed = false;
      },
      onchange: () => {
        this.#typed = false;
        const value = read(this.input.value);
        this.complain(typeof value === 'string' ? value : '');
        if (typeof value !== 'string') take(value);
      },
    });
    this.label = h('span', {}, label);
    this.node = h('label', { class: 'plant-field' }, this.label, h('span', { class: 'entry' }, this.input, this.error));
  }

  /** @param {string} words */
  complain(words) {
    setText(this.error, words);
    if (words) this.input.setAttribute('aria-invalid', 'true');
    else this.input.removeAttribute('aria-invalid');
  }

  /** @param {string} text */
  set(text) {
    if (this.#typed) return; // an answer that comes late takes no word from who is typing
    if (document.activeElement === this.input && this.input.getAttribute('aria-invalid')) return;
    if (this.input.value !== text) this.input.value = text;
    this.complain('');
  }
}

export class Controls {
  /** @type {Wish} */ wish = { poles: [], observer: null, method: 'full-rank', weights: null };
  sizes = { n: 0, p: 0 };

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
    const diagonal = (/** @type {number} */ least, /** @type {'n'|'p'} */ size) => (/** @type {string} */ text) => {
      const found = text
        .split(/[\s;]+|,\s*/)
        .filter(Boolean)
        .map(parseNumber);
      const many = this.sizes[size];
      if (found.length !== many) return say`${many} numbers are wanted.`;
      return found.every((v) => v >= 0 && v >= least && v <= 1e12) ? found : say`Numbers above 0 are wanted.`;
    };
    this.states = new Line('Q, diagonal', 'plant-Q', {
      read: diagonal(0, 'n'),
      take: (states) => onChange({ weights: { ...this.#weights, states } }),
    });
    this.inputs = new Line('R, diagonal', 'plant-R', {
      read: diagonal(1e-12, 'p'),
      take: (inputs) => onChange({ weights: { ...this.#weights, inputs } }),
    });
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
      this.observerCheck,
      this.observer.node,
    );
  }

  get #weights() {
    const { n, p } = this.sizes;
    return this.wish.weights ?? { states: Array(n).fill(1), inputs: Array(p).fill(1) };
  }

  /** @param {import('../contract.js').Method[]} methods */
  offer(methods) {
    if (this.method.options.length || !methods.length) return;
    this.method.append(...methods.map(({ name, title }) => h('option', { value: name }, title)));
  }

  /** @param {Wish} wish @param {{n: number, p: number}} sizes @param {boolean} observable whether there is a C */
  show(wish, sizes, observable) {
    this.wish = wish;
    this.sizes = sizes;
    const quadratic = wish.method.startsWith('lqr');
    this.poles.set(polesLine(wish.poles));
    setText(this.poles.label, quadratic ? 'Poles, rad/s (LQR chooses its own)' : 'Poles, rad/s');
    this.method.value = wish.method;
    this.states.node.hidden = this.inputs.node.hidden = !quadratic;
    this.states.set(this.#weights.states.join(', '));
    this.inputs.set(this.#weights.inputs.join(', '));
    this.box.checked = wish.observer !== null;
    this.box.disabled = !observable;
    this.observer.node.hidden = !wish.observer;
    if (wish.observer) this.observer.set(polesLine(wish.observer));
  }
}
