/** A matrix of numbers with names on its borders, and what the entries of K are called. */
import { copyButton } from './copy_button.js';
import { h, setAttr, setText } from './dom.js';
import { symbol } from './mathml.js';
import { head } from './tables.js';
import { significant, t } from '../text/index.js';

/**
 * @typedef {{name: string, note?: string}|(() => import('./copy_formats.js').Item[])} Copied the name under which a
 *   matrix is copied, or all that its button copies
 */
const STATES = [
  { name: 'θ', unit: 'V/rad' },
  { name: 'ψ', unit: 'V/rad' },
  { name: 'θ̇', unit: 'V·s/rad' },
  { name: 'ψ̇', unit: 'V·s/rad' },
  { name: 'v_p', unit: 'V/V' },
  { name: 'v_y', unit: 'V/V' },
];
const MOTORS = ['V_p', 'V_y'];
const motors = () => [symbol('V', 'p'), symbol('V', 'y')];

export class Matrix {
  /** @type {number[][]|undefined} */ values;
  /** How many of its columns are shown: of a gain those of the states that it feeds back. */ width;

  /**
   * @param {string} testid
   * @param {Node} name
   * @param {Node[]} rows
   * @param {Node[]} columns
   * @param {(i: number, j: number) => string} title
   * @param {Copied} [copied]  without it there is no button
   */
  constructor(testid, name, rows, columns, title, copied) {
    this.title = title;
    this.columns = columns;
    this.width = columns.length;
    const items =
      typeof copied === 'function' ? copied : () => (copied && this.values ? [{ ...copied, matrix: this.values }] : []);
    const tool = copied ? copyButton(testid, items) : null;
    this.cells = rows.map((_r, i) => columns.map((_c, j) => h('td', { 'data-testid': `${testid}-${i}${j}` })));
    this.node = h(
      'table',
      { class: 'matrix', 'data-testid': testid },
      head([h('td', { class: 'name' }, name, tool), ...columns]),
      h(
        'tbody',
        {},
        rows.map((r, i) => h('tr', {}, h('th', { scope: 'row' }, r), this.cells[i])),
      ),
    );
  }

  /** @param {number[][]|undefined} values @param {(v: number) => string} format */
  render(values, format) {
    this.values = values;
    this.width = values?.[0].length ?? this.width;
    for (const [j, { parentElement: head }] of this.columns.entries()) if (head) head.hidden = j >= this.width;
    this.cells.forEach((row, i) =>
      row.forEach((cell, j) => {
        cell.hidden = j >= this.width;
        if (cell.hidden) return;
        setText(cell, values ? format(values[i][j]) : '–');
        setAttr(cell, 'title', `${t(this.title(i, j))}${values ? `\n${significant(values[i][j], 8)}` : ''}`);
      }),
    );
  }
}

/** The state feedback, u = −Kx + v. @param {string} testid @param {Copied} [copied] */
export function gainMatrix(testid, copied) {
  const matrix = new Matrix(
    testid,
    symbol('𝐊'),
    motors(),
    [symbol('θ'), symbol('ψ'), symbol('θ̇'), symbol('ψ̇'), symbol('v', 'p'), symbol('v', 'y')],
    (i, j) => `k${'₁₂'[i]}${'₁₂₃₄₅₆'[j]}: ${STATES[j].unit}, feedback from ${STATES[j].name} to ${MOTORS[i]}`,
    copied,
  );
  matrix.width = 4;
  return matrix;
}

/** The feedback of the integrated errors, where a method brings its own. @param {string} testid */
export const integralMatrix = (testid) =>
  new Matrix(
    testid,
    symbol('𝐊', 'I'),
    motors(),
    [h('span', { class: 'sym' }, '∫', symbol('e', 'θ')), h('span', { class: 'sym' }, '∫', symbol('e', 'ψ'))],
    (i, j) => `V/(rad·s), feedback from the integrated error of ${STATES[j].name} to ${MOTORS[i]}`,
  );

/** What K is, where it is copied. */
export const GAIN = {
  name: 'K',
  note: 'u = -K x + v, x = [theta, psi, theta_dot, psi_dot] in rad, rad/s; u = [V_p, V_y] in V',
};

/** The relative gain array. @param {string} testid */
export const relativeGains = (testid) =>
  new Matrix(
    testid,
    h('b', {}, 'RGA'),
    [symbol('θ'), symbol('ψ')],
    [symbol('v', 'p'), symbol('v', 'y')],
    (i, j) =>
      `λ${'₁₂'[i]}${'₁₂'[j]}: relative gain from ${['v_p', 'v_y'][j]} to ${['θ', 'ψ'][i]} at s = 0, dimensionless`,
  );
