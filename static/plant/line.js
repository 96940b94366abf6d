/** Fields of one line in view Plant: poles, and rows of numbers as people type them. */
import { parseNumber, say } from '../text/index.js';
import { h, setText } from '../ui/index.js';

/** A line of text that becomes a value where it is left, or Enter is pressed; at it what is wrong. @template T */
export class Line {
  /** Whether something is typed that is not taken yet. */ #typed = false;

  /**
   * @param {string} label @param {string} testid
   * @param {{read: (text: string) => T|string, take: (value: T) => void, title?: string}} how read: the value, or what
   *   is wrong
   */
  constructor(label, testid, { read, take, title }) {
    this.error = h('span', { class: 'field-error', id: `${testid}-error`, role: 'status' });
    this.input = h('input', {
      class: 'plant-line-field',
      type: 'text',
      autocomplete: 'off',
      spellcheck: 'false',
      'aria-label': label,
      ...(title && { title }),
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

/**
 * With blanks, commas or semicolons between them: `1 0 0 0`, `[1; 0; 0; 0]`, `x0 = [1, 0]';`, `np.array([[1], [0]])`.
 * @param {string} text
 * @returns {number[]|null} null where one is no finite number
 */
export function numbersIn(text) {
  const bare = text
    .replace(/^\s*\w+\s*=/, '')
    .replace(/\b(?:np|numpy)\.\w+|\.?['’]|\.T\b/g, ' ')
    .replace(/[[\](){}]/g, ' ');
  const found = bare
    .split(/[\s;,]+/)
    .filter(Boolean)
    .map(parseNumber);
  return found.every(Number.isFinite) ? found : null;
}

/**
 * How a field reads so many of them.
 * @param {() => number} many @param {{least?: number, most?: number}} [range] of each
 * @returns {(text: string) => number[]|string} the numbers, or what is wrong
 */
export const reader =
  (many, { least = -1e12, most = 1e12 } = {}) =>
  (text) => {
    const found = numbersIn(text);
    if (!found) return say`Write numbers with blanks between them.`;
    if (found.length !== many()) return say`These are ${found.length} numbers, and ${many()} are wanted.`;
    if (found.every((v) => v >= least && v <= most)) return found;
    return least < 0 ? say`Numbers within ±10¹² are wanted.` : say`Numbers from ${least} to 10¹² are wanted.`;
  };
