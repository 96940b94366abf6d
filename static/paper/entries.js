/** A gain entry by entry, each formula beside its present value; and what the letters in it stand for. */
import { significant } from '../text/index.js';
import { copyButton, formula, h, setText, symbol } from '../ui/index.js';

const SUB = '₀₁₂₃₄₅₆';
/** @typedef {import('../contract.js').Formula} Formula */

export class Entries {
  /** @type {{cell: Node, i: number, j: number}[]} */ #values = [];

  /**
   * @param {Record<string, Formula>} entries by name, like k_12
   * @param {string} testid
   * @param {(name: string, entry: Formula) => Node} tool what stands behind the value
   * @param {Map<string, string>} [marks] MathML by name: the symbols, which have cards
   */
  constructor(entries, testid, tool, marks = new Map()) {
    this.node = h(
      'div',
      { class: 'entries', 'data-testid': testid },
      Object.entries(entries).map(([name, entry]) => this.#entry(name, entry, tool(name, entry), marks.get(name))),
    );
  }

  /** @param {number[][]|undefined|null} matrix */
  render(matrix) {
    for (const { cell, i, j } of this.#values)
      setText(cell, matrix?.[i]?.[j] === undefined ? '–' : significant(matrix[i][j], 6));
  }

  /** @param {string} name @param {Formula} entry @param {Node} tool @param {string|undefined} mark */
  #entry(name, entry, tool, mark) {
    const [i, j] = [...(name.match(/\d/g) ?? ['1', '1'])].map((d) => Number(d));
    const cell = h('output', { class: 'value', 'data-testid': `value-${name}` });
    this.#values.push({ cell, i: i - 1, j: j - 1 });
    const label = `${name[0]}${SUB[i]}${SUB[j]}`;
    return h(
      'div',
      { class: 'entry' },
      mark ? null : h('span', { class: 'before' }, symbol(name[0], `${i}${j}`), ' ='),
      h(
        'div',
        { class: `scroll ${mark ? 'equation' : ''}`, tabindex: 0, role: 'group', 'aria-label': label },
        mark ? [formula(mark), h('span', {}, '=')] : null,
        formula(entry.mathml),
      ),
      h('span', { class: 'equals' }, '= ', cell, ' ', tool),
    );
  }
}

/** Without those that are 0 for any rig. @param {Record<string, Formula>} entries */
export const nonzero = (entries) => Object.fromEntries(Object.entries(entries).filter(([, e]) => e.sympy !== '0'));

/**
 * What the short names stand for.
 * @param {Record<string, Formula>} definitions
 * @param {Map<string, string>} marks MathML by name
 */
export const defined = (definitions, marks) =>
  Object.entries(definitions).map(([name, d]) =>
    h(
      'div',
      { class: 'definition scroll', tabindex: 0, role: 'group', 'aria-label': name },
      formula(marks.get(name)),
      h('span', {}, '='),
      formula(d.mathml),
    ),
  );

/**
 * Makes the buttons that copy formulas, with what their letters stand for.
 * @param {{definitions: Record<string, Formula>}} of
 * @param {string} [place] where they stand, so that no two have the same name
 */
export function copying({ definitions }, place = 'formula') {
  const known = Object.fromEntries(Object.entries(definitions).map(([name, d]) => [name, d.sympy]));
  return (/** @type {string} */ name, /** @type {Formula} */ f) =>
    copyButton(
      `${place}-${name}`,
      () => [{ name, latex: f.latex, sympy: f.sympy, definitions: known }],
      `Copy the formula of ${name}`,
    );
}
