/** Matrices of any size with names on their borders, to be copied. */
import { inField, significant, t } from '../text/index.js';
import { copyButton, h, head, setText, symbol } from '../ui/index.js';

/** @param {string} letter @param {number} n @returns {[string, string][]} */
export const numbered = (letter, n) => Array.from({ length: n }, (_, i) => [letter, String(i + 1)]);

export class NumberMatrix {
  /** @type {HTMLElement[][]} */ #cells = [];
  #shape = '';

  /** @param {string} name @param {[string, string]} letters of rows and columns @param {string} about
   * @param {boolean} [exact] without zeros at the end, as it does not move under the hand */
  constructor(name, letters, about, exact = false) {
    this.name = name;
    this.exact = exact;
    this.letters = letters;
    /** @type {number[][]} */ this.values = [];
    this.table = h('table', { class: 'matrix plant-matrix', 'data-testid': `plant-${name}` });
    this.about = h('span', { class: 'caption' }, about);
    this.node = h(
      'figure',
      { class: 'plant-number' },
      h(
        'figcaption',
        {},
        h('b', { translate: 'no' }, name),
        this.about,
        copyButton(`plant-${name}`, () => (this.values.length ? [{ name, matrix: this.values }] : [])),
      ),
      h('div', { class: 'sideways', tabindex: 0, role: 'group', 'aria-label': about }, this.table),
    );
  }

  /** @param {number[][]|undefined} values */
  show(values) {
    this.node.hidden = !values?.length;
    if (!values?.length) return;
    this.values = values;
    const shape = `${values.length} ${values[0].length}`;
    if (shape !== this.#shape) this.#make(values.length, values[0].length);
    this.#shape = shape;
    values.forEach((row, i) => row.forEach((v, j) => setText(this.#cells[i][j], this.#format(v))));
  }

  /** @param {number} v */
  #format(v) {
    if (v === 0) return '0';
    return this.exact ? inField(Number(v.toPrecision(5))) : significant(v, 5);
  }

  /** @param {number} rows @param {number} columns */
  #make(rows, columns) {
    const [down, across] = this.letters;
    this.#cells = Array.from({ length: rows }, () => Array.from({ length: columns }, () => h('td')));
    this.table.replaceChildren(
      head([
        h('td', { class: 'name' }, h('span', { class: 'sr' }, t(this.name))),
        ...numbered(across, columns).map((own) => symbol(...own)),
      ]),
      h(
        'tbody',
        {},
        numbered(down, rows).map((own, i) => h('tr', {}, h('th', { scope: 'row' }, symbol(...own)), this.#cells[i])),
      ),
    );
  }
}
