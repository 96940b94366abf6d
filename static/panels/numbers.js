/** K and the RGA as matrices, and what the RGA says, in words. */
import { h, setAttr, setText, symbol } from '../dom.js';
import { fixed, significant } from '../format.js';

const dotted = (/** @type {string} */ s) => h('span', { class: 'sym' }, h('i', {}, `${s}\u0307`));
const STATES = [{ name: 'θ', unit: 'V/rad' }, { name: 'ψ', unit: 'V/rad' }, { name: 'θ̇', unit: 'V·s/rad' }, { name: 'ψ̇', unit: 'V·s/rad' }];
const MOTORS = ['V_p', 'V_y'];

/** A matrix with names on its borders. */
class Matrix {
  /** @param {string} testid @param {Node} name @param {Node[]} rows @param {Node[]} columns @param {(i: number, j: number) => string} title */
  constructor(testid, name, rows, columns, title) {
    this.title = title;
    this.cells = rows.map((_r, i) => columns.map((_c, j) => h('td', { 'data-testid': `${testid}-${i}${j}` })));
    this.node = h('table', { class: 'matrix', 'data-testid': testid },
      h('thead', {}, h('tr', {}, h('th', { class: 'name' }, name), columns.map((c) => h('th', { scope: 'col' }, c)))),
      h('tbody', {}, rows.map((r, i) => h('tr', {}, h('th', { scope: 'row' }, r), this.cells[i]))));
  }

  /** @param {number[][]|undefined} values @param {(v: number) => string} format */
  render(values, format) {
    this.cells.forEach((row, i) => row.forEach((cell, j) => {
      setText(cell, values ? format(values[i][j]) : '–');
      setAttr(cell, 'title', `${this.title(i, j)}${values ? `\n${significant(values[i][j], 8)}` : ''}`);
    }));
  }
}

/** What the RGA and the Niederlinski index mean for the pairing in use. @param {import('../types.js').Reply} reply @param {'diagonal'|'cross'} pairing */
export function pairingWords({ rga }, pairing) {
  if (!rga?.rga) return { level: 'info', text: 'No steady state, so no relative gains: a pole lies at 0.' };
  const advised = rga.pairing?.[0]?.[1] === 'V_y' ? 'cross' : 'diagonal';
  const gain = pairing === 'cross' ? rga.rga[0][1] : rga.rga[0][0];
  const strength = Math.abs(gain - 1) < 0.05 ? 'hardly any interaction' : gain > 0.7 && gain < 2 ? 'moderate interaction' : gain <= 0 ? 'the loops fight each other' : 'strong interaction';
  const n = rga.niederlinski;
  const index = n === undefined ? '' : ` Niederlinski ${fixed(n)}${n > 0 ? '' : ': unstable with integral action'}.`;
  if (advised !== pairing) return { level: 'warning', text: `The RGA advises ${advised === 'cross' ? 'the crosswise' : 'the diagonal'} pairing: λ = ${fixed(gain, 3)} as paired now, ${strength}.${index}` };
  return { level: 'good', text: `${pairing === 'cross' ? 'Crosswise' : 'Diagonal'} pairing is right: λ = ${fixed(gain, 3)}, ${strength}.${index}` };
}

export class NumbersPanel {
  /** @param {HTMLElement} root */
  constructor(root) {
    const motors = () => [symbol('V', 'p'), symbol('V', 'y')];
    this.k = new Matrix('k-matrix', h('b', {}, 'K'), motors(), [symbol('θ'), symbol('ψ'), dotted('θ'), dotted('ψ')],
      (i, j) => `k${'₁₂'[i]}${'₁₂₃₄'[j]}: ${STATES[j].unit}, what ${MOTORS[i]} gets back of ${STATES[j].name}`);
    this.rga = new Matrix('rga-matrix', h('b', {}, 'RGA'), [symbol('θ'), symbol('ψ')], [symbol('v', 'p'), symbol('v', 'y')],
      (i, j) => `λ${'₁₂'[i]}${'₁₂'[j]}: relative gain from ${['v_p', 'v_y'][j]} to ${['θ', 'ψ'][i]} at s = 0, dimensionless`);
    this.words = h('p', { class: 'pairing-words', 'data-testid': 'pairing-words' });
    root.append(h('div', { class: 'matrices' }, this.k.node, this.rga.node), this.words);
  }

  /** @param {import('../types.js').State} state */
  render({ reply, design }) {
    this.k.render(reply?.gains.K, (v) => significant(v, 4));
    this.rga.render(reply?.rga?.rga, (v) => fixed(v, 3));
    if (!reply || !design) return;
    const { level, text } = pairingWords(reply, design.pairing);
    this.words.className = `pairing-words ${level}`;
    setText(this.words, text);
  }
}
