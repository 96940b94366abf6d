/** Fields of one line in view Plant: poles, weights, an initial state. */
import { setText, h } from '../ui/index.js';

/** A line of text that becomes a value where it is left, or Enter is pressed; at it what is wrong. @template T */
export class Line {
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
