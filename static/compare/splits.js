/** All ways to deal the four poles to pitch's pair and yaw's: the same poles, other gains. */
import { fixed, significant } from '../text/index.js';
import { best, bodyOf, fromWire, FULL_RANK, inOrder, nameOf, pairText, sameSplit } from '../model/index.js';
import { compareSplits } from '../net/index.js';
import { button, h, head, Lazy, printed, setAttr, setText, shape, symbol, wide } from '../ui/index.js';

export class SplitsCard {
  /** @type {{row: HTMLElement, use: HTMLButtonElement, poles: import('../types.js').Poles}[]} */ #rows = [];

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.rows = h('tbody');
    this.words = h('p', { class: 'claim', 'data-testid': 'splits-words' });
    const column = (/** @type {string} */ name) =>
      h('th', { scope: 'col', class: 'pair-name' }, shape(name), ` ${name}`);
    const columns = [
      column('pitch'),
      column('yaw'),
      h('th', { scope: 'col', title: 'Frobenius norm of K' }, printed('‖K‖_F')),
      h('th', { scope: 'col', title: 'relative gain at s = 0, dimensionless' }, symbol('λ', '11')),
      h('th', {}, h('span', { class: 'sr' }, 'Use')),
    ];
    const table = h('table', { class: 'compare-table', 'data-testid': 'splits-table' }, head(columns), this.rows);
    const content = h('div', {}, wide('Table of the splits', table), this.words);
    root.append(content);
    this.lazy = new Lazy(root, content, store, {
      wait: 'Computing the splits…',
      ask: compareSplits,
      show: (answer) => this.#show(answer),
      // the rows keep their places whichever is in use
      body: (d) => ({ ...bodyOf(d), method: FULL_RANK, poles: inOrder(d.poles) }),
    });
  }

  /** @param {import('../contract.js').Split[]} splits */
  #show(splits) {
    const focused = this.#rows.findIndex((r) => r.use === document.activeElement);
    const texts = splits.map((s) => significant(s.norm, 4));
    const least = best(
      splits.map((s) => s.norm),
      texts,
    );
    this.#rows = splits.map((split, i) => {
      const poles = fromWire(split.poles);
      const use = button({ 'data-testid': `use-split-${i}`, onclick: () => this.#use(poles) }, 'Use');
      const row = h(
        'tr',
        { 'data-testid': `split-${i}` },
        h('td', { class: 'pair-name' }, pairText(poles.slice(0, 2))),
        h('td', { class: 'pair-name' }, pairText(poles.slice(2))),
        h('td', { class: least.has(i) ? 'best' : null, 'data-testid': `split-${i}-norm` }, texts[i]),
        h('td', {}, fixed(split.rga?.[0][0], 3)),
        h('td', {}, use),
      );
      return { row, use, poles };
    });
    this.rows.replaceChildren(...this.#rows.map((r) => r.row));
    this.render(this.store.state);
    if (focused >= 0) this.#rows[focused]?.use.focus({ preventScroll: true });
  }

  /**
   * Only full-rank placement tells the pairs apart, so it comes with them.
   * @param {import('../types.js').Poles} poles
   */
  #use(poles) {
    this.store.edit((d) =>
      d.method === FULL_RANK && sameSplit(d.poles, poles) ? d : { ...d, poles, method: FULL_RANK },
    );
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    this.lazy.render(state);
    const { design } = state;
    if (!design || !this.#rows.length) return;
    const own = design.method === FULL_RANK;
    for (const { row, use, poles } of this.#rows) {
      const present = own && sameSplit(design.poles, poles);
      row.classList.toggle('current', present);
      setAttr(use, 'aria-pressed', String(present));
      setText(use, present ? 'In use' : 'Use');
    }
    const structure = nameOf({ ...design, method: FULL_RANK });
    setText(
      this.words,
      `Full-rank, ${structure}.` +
        (own ? '' : ' The method in use does not tell the pairs apart: “Use” takes full-rank with the split.'),
    );
  }
}
