/**
 * Input elements that the panels share: a number field with an optional slider, and a choice of few.
 * A field says at itself what is wrong with a number and keeps the design as it was.
 */
import { h, setAttr } from './dom.js';
import { inField, parseComplex, parseNumber, significant } from '../text/index.js';

/**
 * @typedef {object} FieldOptions
 * @property {string} label  for assistive technology
 * @property {Node|string} [mark]  what is seen in front
 * @property {string} [unit]
 * @property {number} min
 * @property {number} max
 * @property {boolean} [positive]  zero is refused
 * @property {boolean} [integer]
 * @property {boolean} [optional]  the field may be empty, which reads as NaN
 * @property {string} testid
 * @property {string} [field]  the path under which the server names it
 * @property {{min: number, max: number, log?: boolean}} [slider]
 * @property {(v: number, stamp: number) => void} onInput
 * @property {(p: import('../types.js').Complex, stamp: number) => void} [onComplex] the field takes a complex number,
 *   too
 * @property {() => void} onCommit
 */

export class NumberField {
  /** @param {FieldOptions} options */
  constructor(options) {
    this.options = options;
    const { label, mark, unit, testid, field, slider } = options;
    const bubble = `${testid}-error`;
    this.input = h('input', {
      class: 'number',
      type: 'text',
      inputmode: 'decimal',
      autocomplete: 'off',
      spellcheck: 'false',
      'aria-label': label,
      'data-testid': testid,
      'data-field': field,
      'aria-describedby': bubble,
    });
    this.bubble = h('span', { class: 'field-error', id: bubble, role: 'status' });
    this.slider = slider
      ? h('input', {
          type: 'range',
          'aria-label': `${label}, slider`,
          'data-testid': `${testid}-slider`,
          min: 0,
          max: 1,
          step: 'any',
        })
      : null;
    /** @type {{min: number, max: number, log?: boolean}} */
    this.range = slider ?? { min: 0, max: 1 };
    this.node = h(
      'div',
      { class: `field${slider ? ' with-slider' : ''}` },
      h('span', { class: 'mark', 'aria-hidden': 'true' }, mark ?? label),
      this.slider,
      h('span', { class: 'entry' }, this.input, this.bubble),
      unit ? h('span', { class: 'unit', 'aria-hidden': 'true' }, unit) : null,
    );
    this.input.addEventListener('input', (e) => this.#typed(e.timeStamp));
    this.input.addEventListener('change', () => this.#done());
    this.input.addEventListener('keydown', (e) => this.#key(e));
    this.slider?.addEventListener('input', (e) => options.onInput(this.#fromSlider(), e.timeStamp));
    this.slider?.addEventListener('change', () => options.onCommit());
  }

  /** @type {number} */ value = NaN;
  #typing = false;
  #start = 0;

  #text() {
    return Number.isNaN(this.value) ? '' : inField(this.value);
  }

  /**
   * What stands in the empty field, and where the arrow keys start from it.
   * @param {string} text
   * @param {number} start
   */
  setBlank(text, start) {
    setAttr(this.input, 'placeholder', text);
    this.#start = start;
  }

  /** @param {number} v NaN: empty */
  set(v) {
    const changed = !Object.is(v, this.value);
    this.value = v;
    // Who types must not be corrected meanwhile; what comes from elsewhere (undo, another preset) replaces the text.
    const own = document.activeElement === this.input && (this.#typing || !changed);
    if (changed) this.#typing = false;
    if (!own && (changed || this.input.getAttribute('aria-invalid') !== 'true')) {
      this.complain('');
      const text = this.#text();
      if (this.input.value !== text) this.input.value = text;
    }
    if (this.slider && document.activeElement !== this.slider) this.#toSlider(v);
    if (this.slider) setAttr(this.slider, 'aria-valuetext', `${significant(v, 3)} ${this.options.unit ?? ''}`.trim());
  }

  /** @param {{min: number, max: number}} range */
  setRange(range) {
    if (range.min === this.range.min && range.max === this.range.max) return;
    this.range = { ...this.range, ...range };
    if (Number.isFinite(this.value)) this.#toSlider(this.value);
  }

  /** @param {string} message empty when all is well */
  complain(message) {
    if (message) this.input.setAttribute('aria-invalid', 'true');
    else this.input.removeAttribute('aria-invalid');
    if (this.bubble.textContent !== message) this.bubble.textContent = message;
  }

  /** @param {boolean} disabled */
  disable(disabled) {
    this.input.disabled = disabled;
    if (this.slider) this.slider.disabled = disabled;
  }

  /** @param {number} stamp */
  #typed(stamp) {
    const pole = this.options.onComplex ? parseComplex(this.input.value) : null;
    if (pole && pole.im !== 0) return this.#typedComplex(pole, stamp);
    const v = pole ? pole.re : parseNumber(this.input.value);
    const wrong = this.options.optional && !this.input.value.trim() ? '' : this.#objection(v);
    this.complain(wrong);
    if (wrong) return;
    this.#typing = true;
    this.options.onInput(v, stamp);
  }

  /** @param {import('../types.js').Complex} pole @param {number} stamp */
  #typedComplex(pole, stamp) {
    const wrong = [pole.re, pole.im].map((v) => this.#objection(v)).find(Boolean) ?? '';
    this.complain(wrong);
    if (wrong) return;
    this.#typing = true;
    this.options.onComplex?.(pole, stamp);
  }

  /** @param {number} v @returns {string} empty where it can be taken */
  #objection(v) {
    const { min, max, positive, integer } = this.options;
    if (!Number.isFinite(v)) return this.options.onComplex ? 'enter a number, or −3+2j' : 'enter a number';
    if (integer && !Number.isInteger(v)) return 'enter a whole number';
    if (positive && v <= 0) return 'must be positive';
    return v < min || v > max ? `${significant(min, 3)} to ${significant(max, 3)}` : '';
  }

  /** Leaving a field that holds nonsense puts the last good value back. */
  #done() {
    this.#typing = false;
    this.complain('');
    this.input.value = this.#text();
    this.options.onCommit();
  }

  /** @param {KeyboardEvent} e */
  #key(e) {
    if (e.key === 'Enter') this.#done();
    if (e.key !== 'ArrowUp' && e.key !== 'ArrowDown') return;
    e.preventDefault();
    const { min, max, integer } = this.options;
    const from = Number.isNaN(this.value) ? this.#start : this.value;
    const size = integer
      ? 1
      : 10 ** Math.floor(Math.log10(Math.max(Math.abs(from), 1e-3)) + 1e-9) * (e.shiftKey ? 0.01 : 0.1);
    const v = Math.max(min, Math.min(max, from + (e.key === 'ArrowUp' ? size : -size)));
    this.input.value = inField(Number(v.toPrecision(9)));
    this.#typed(e.timeStamp);
  }

  #fromSlider() {
    const s = Number(this.slider?.value);
    const { min, max, log } = this.range;
    const v = log ? min * (max / min) ** s : min + (max - min) * s;
    return Number(v.toPrecision(log ? 2 : 3)) || 0;
  }

  /** @param {number} v */
  #toSlider(v) {
    const { min, max, log } = this.range;
    const s = log ? Math.log(Math.max(v, 1e-12) / min) / Math.log(max / min) : (v - min) / (max - min);
    const text = String(Math.max(0, Math.min(1, s)));
    if (this.slider && this.slider.value !== text) this.slider.value = text;
  }
}

/**
 * A choice of few, seen all at once: radio buttons in the shape of a switch.
 * @template {string} V
 */
export class Choice {
  /**
   * @param {{label: string, testid: string, options: [V, string, string?][], onChange: (value: V) => void}} o
   *   options: value, text, explanation
   */
  constructor({ label, testid, options, onChange }) {
    this.inputs = options.map(([value]) =>
      h('input', {
        type: 'radio',
        name: testid,
        value,
        'data-testid': `${testid}-${value}`,
        onchange: () => onChange(value),
      }),
    );
    this.node = h(
      'div',
      { class: 'choice', role: 'radiogroup', 'aria-label': label, 'data-testid': testid },
      options.map(([, text, title], i) => h('label', { title }, this.inputs[i], h('span', {}, text))),
    );
  }

  /** @param {string} value */
  set(value) {
    for (const input of this.inputs) input.checked = input.value === value;
  }

  /** @param {boolean} disabled */
  disable(disabled) {
    for (const input of this.inputs) input.disabled = disabled;
  }
}

/**
 * A number of the design. One gesture changes it as often as the hand moves, and is one step of undo.
 * @param {import('../model/store.js').Store} store
 * @param {string} gesture
 * @param {(d: import('../types.js').Design, v: number) => import('../types.js').Design} change
 * @param {Omit<FieldOptions, 'onInput'|'onCommit'|'testid'> & {testid?: string}} options
 */
export const designField = (store, gesture, change, options) =>
  new NumberField({
    testid: gesture,
    ...options,
    onInput: (v, stamp) => store.edit((d) => change(d, v), { gesture, stamp }),
    onCommit: () => store.commit(),
  });
