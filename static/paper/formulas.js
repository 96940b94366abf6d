/**
 * K and the RGA as typeset formulas, each entry of K beside its present value. Fetched once per structure, when first
 * seen.
 */
import { messageOf, significant } from '../text/index.js';
import { bodyOf, FULL_RANK, presetOf } from '../model/index.js';
import { getSymbolic } from '../net/index.js';
import { copyButton, formula, h, Lazy, setText, whileSeen } from '../ui/index.js';
import { SymbolCards } from './symbol_cards.js';
import { walk } from './walk.js';

const SUB = '₀₁₂₃₄';
/** @typedef {import('../contract.js').Symbolic} Symbolic */
/** @type {[import('../types.js').KeysOf<Symbolic, import('../contract.js').Formula>, string][]} */
const OTHERS = [
  ['RGA', 'Relative gain array at s = 0'],
  ['A', 'System matrix A'],
  ['B', 'Input matrix B'],
  ['T', 'Luenberger’s transformation T'],
  ['Q', 'Q'],
  ['closed_loop', 'Closed loop A − BK'],
  ['canonical_closed_loop', 'Closed loop in Luenberger’s basis, T(A − BK)T⁻¹'],
  ['G', 'Closed loop Ĝ(s)'],
];

export class FormulasPanel {
  #structure = '';
  #visible = false;
  /** @type {{cell: Node, i: number, j: number}[]} */ #values = [];
  /** @type {import('./walk.js').Walk|null} */ #walk = null;

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.body = h('div', { class: 'formulas-body', 'data-testid': 'formulas' });
    root.append(this.body);
    this.cards = new SymbolCards(root, () => ({
      parameters: { ...presetOf(store.state)?.parameters, ...store.state.design?.parameters },
      components: {},
      walk: this.#walk,
    }));
    this.lazy = new Lazy(root, h('div'), store, {
      wait: '',
      body: bodyOf,
      ask: walk,
      show: (answer) => {
        this.#walk = answer;
        this.cards.refresh();
      },
    });
    whileSeen(root, (seen) => {
      this.#visible = seen;
      this.render(store.state);
    });
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    const { design, reply } = state;
    this.lazy.render(state);
    if (!design || !this.#visible) return;
    const structure = `${design.coupling}/${design.lead}`;
    if (structure !== this.#structure) {
      this.#structure = structure;
      this.#load(design.coupling, design.lead, structure);
    }
    for (const { cell, i, j } of this.#values)
      // another method's K is not this formula's
      setText(cell, reply && design.method === FULL_RANK ? significant(reply.gains.K[i][j], 6) : '–');
  }

  /** @param {string} coupling @param {string} lead @param {string} structure */
  async #load(coupling, lead, structure) {
    this.body.setAttribute('aria-busy', 'true');
    if (!this.body.childElementCount) this.body.append(h('p', {}, 'Deriving…'));
    try {
      const symbolic = await getSymbolic(coupling, lead);
      if (structure === this.#structure) this.#show(symbolic);
    } catch (error) {
      this.#structure = '';
      this.body.replaceChildren(h('p', { class: 'failure' }, `The formulas could not be fetched: ${messageOf(error)}`));
    }
    this.body.removeAttribute('aria-busy');
  }

  /** @param {Symbolic} symbolic */
  #show(symbolic) {
    this.#values = [];
    const known = Object.fromEntries(Object.entries(symbolic.definitions ?? {}).map(([name, d]) => [name, d.sympy]));
    const copy = (/** @type {string} */ name, /** @type {import('../contract.js').Formula} */ f) =>
      copyButton(
        `formula-${name}`,
        () => [{ name, latex: f.latex, sympy: f.sympy, definitions: known }],
        `Copy the formula of ${name}`,
      );
    const entries = Object.entries(symbolic.entries?.K ?? {});
    const gains = entries.length
      ? h(
          'div',
          { class: 'entries', 'data-testid': 'k-formulas' },
          entries.map(([name, entry]) => this.#entry(name, entry, copy(name, entry))),
        )
      : h('div', { class: 'scroll', 'data-testid': 'k-formulas' }, formula(symbolic.K?.mathml));
    const cards = OTHERS.filter(([key]) => symbolic[key]?.mathml).map(([key, title]) =>
      h(
        'section',
        { class: `card ${key === 'RGA' ? 'wide' : ''}` },
        h('h3', {}, title, ' ', copy(key, symbolic[key])),
        h(
          'div',
          { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': title, 'data-testid': `formula-${key}` },
          formula(symbolic[key].mathml),
        ),
      ),
    );
    const marks = new Map((symbolic.symbols ?? []).map((s) => [s.name, s.mathml]));
    const definitions = Object.entries(symbolic.definitions ?? {}).map(([name, d]) =>
      h('div', { class: 'definition' }, formula(marks.get(name)), h('span', {}, '='), formula(d.mathml)),
    );
    const symbols = h(
      'section',
      { class: 'card' },
      h('h3', {}, 'Symbols'),
      h(
        'table',
        { class: 'symbols' },
        h(
          'tbody',
          {},
          (symbolic.symbols ?? []).map((s) =>
            h(
              'tr',
              {},
              h(
                'th',
                { scope: 'row' },
                s.mathml
                  ? [h('span', { class: 'sr' }, s.name), h('span', { 'aria-hidden': 'true' }, formula(s.mathml))]
                  : s.name,
              ),
              h('td', {}, s.meaning),
              h('td', {}, s.unit),
            ),
          ),
        ),
      ),
    );
    this.body.replaceChildren(
      h(
        'section',
        { class: 'card gains' },
        h('h3', {}, 'State feedback K, u = −Kx + v ', symbolic.K ? copy('K', symbolic.K) : null),
        gains,
        h('div', { class: 'definitions' }, 'with', definitions),
      ),
      ...cards,
      symbols,
    );
    this.cards.learn(symbolic.symbols ?? []);
    for (const part of this.body.querySelectorAll('.card')) this.cards.mark(part);
    this.render(this.store.state);
  }

  /** @param {string} name like k_12 @param {{mathml: string}} entry @param {Node} tool */
  #entry(name, entry, tool) {
    const [i, j] = [...(name.match(/\d/g) ?? ['1', '1'])].map((d) => Number(d));
    const cell = h('output', { class: 'value' });
    this.#values.push({ cell, i: i - 1, j: j - 1 });
    return h(
      'div',
      { class: 'entry' },
      h('span', { class: 'sym' }, h('i', {}, 'k'), `${SUB[i]}${SUB[j]} =`),
      h(
        'div',
        { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': `k${SUB[i]}${SUB[j]}` },
        formula(entry.mathml),
      ),
      h('span', { class: 'equals' }, '= ', cell, ' ', tool),
    );
  }
}
