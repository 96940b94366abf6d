/**
 * The derivation as a reading view along the paper: its equations derived again, its numbers recomputed, its errata
 * proved. Fetched when it is first seen.
 */
import { bodyOf, presetOf } from '../model/index.js';
import { getPaper } from '../net/index.js';
import { button, h, Lazy } from '../ui/index.js';
import { placeIn } from '../link/index.js';
import { countsOf } from './math.js';
import { rich } from './rich.js';
import { SymbolCards, SymbolList } from './symbol_cards.js';
import { toldOf } from './symbols.js';
import { walk } from './walk.js';
import { Beyond } from './beyond.js';
import { consequence } from './consequence.js';
import { contents, follow } from './contents.js';
import { PaperCurves } from './curves.js';
import { chapters, mark } from './equations.js';
import { watchEnds } from './ends.js';
import { errata } from './errata.js';
import { chapter } from './forms.js';
import { LiveNumbers } from './live.js';
import { numbers } from './numbers.js';
import { askStructure, StructureForms, structureOf } from './structure.js';
import { MARKS, MEANINGS } from './words.js';

/** @typedef {import('./math.js').Paper} Paper @typedef {import('./symbols.js').Term[]} Symbols */
/** The place in this section to which the address leads. */
const place = () => placeIn(location.hash)?.match(/^(paper|eq|fig|table|erratum)\b.*/)?.[0];
const WAIT =
  'Reading the paper: its formulas are derived, its numbers recomputed, its errata proved. The first time this ' +
  'takes some seconds.';

/** Prints this section alone. */
function print() {
  document.body.classList.add('printing-paper');
  window.print();
  document.body.classList.remove('printing-paper');
}

export class PaperPanel {
  /** @type {LiveNumbers|null} */ #live = null;
  /** @type {Beyond|null} */ #beyond = null;
  /** @type {Record<string, import('./symbols.js').Term[]>} by part */ #terms = {};
  /** @type {{render: (state: import('../types.js').State) => void, status: HTMLElement}[]} */ #lazy = [];
  /** @type {import('./walk.js').Walk|null} */ #walk = null;

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.root = root;
    this.store = store;
    this.body = h('div', { class: 'paper-body', 'data-testid': 'paper' });
    root.append(this.body);
    watchEnds(root);
    this.cards = new SymbolCards(root, () => this.#now());
    this.lazy = new Lazy(root, this.body, store, {
      wait: WAIT,
      body: () => 'paper',
      ask: getPaper,
      show: (paper) => this.#show(paper),
    });
    if (place()) root.scrollIntoView();
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    this.lazy.render(state);
    this.#live?.render(state);
    this.#beyond?.render(state);
    for (const lazy of this.#lazy) lazy.render(state);
  }

  /** What the symbols of a part mean, beside those of the others. @param {string} part @param {Symbols} terms */
  #learn(part, terms) {
    this.#terms[part] = terms;
    this.cards.learn(Object.values(this.#terms).flat());
  }

  /** What the symbols are worth. @returns {import('./symbols.js').Now} */
  #now() {
    const preset = presetOf(this.store.state);
    return {
      parameters: { ...preset?.parameters, ...this.store.state.design?.parameters },
      components: preset?.components ?? {},
      walk: toldOf(this.#walk, this.store.state),
    };
  }

  /** @param {Paper} paper */
  #show(paper) {
    this.#learn('paper', paper.symbols);
    const live = (this.#live = new LiveNumbers());
    const curves = new PaperCurves(() => this.store.state.presets.find((p) => p.name.endsWith('manual'))?.limits.theta);
    const figures = new Map(paper.figures.map((f) => [`Fig. ${f.number}`, f]));
    const chosen = new StructureForms((part, chapter) => this.cards.mark(part, chapter));
    const list = new SymbolList(paper.symbols);
    const beyond = (this.#beyond = new Beyond(this.store, {
      learn: (part, terms) => this.#learn(part, terms),
      mark: (node, chapter) => this.cards.mark(node, chapter),
    }));
    const text = h(
      'div',
      { class: 'paper-text' },
      this.#introduction(paper),
      chapters(paper, {
        live: (number) => live.at(number),
        curves: (number) => {
          const f = figures.get(number);
          return f ? curves.draw(f) : null;
        },
        structure: (e) => chosen.at(e),
      }),
      beyond.chapters,
      numbers(paper),
      errata(paper),
      consequence(paper),
      chapter(
        'symbols',
        'Symbols',
        h(
          'p',
          { class: 'prose' },
          'What the formulas’ symbols mean, with their values on the present rig. In a formula each shows this ' +
            'under the pointer, at a tap, and with the arrow keys.',
        ),
        list.node,
      ),
    );
    for (const step of text.querySelectorAll('article.eq'))
      this.cards.mark(step, /** @type {HTMLElement} */ (step).dataset.chapter);
    const nav = contents(
      paper.equations,
      h('div', { class: 'present-box' }, h('h3', {}, 'The present rig'), live.rig),
      button({ class: 'print', onclick: print }, 'Print this section'),
    );
    this.body.replaceChildren(nav, text);
    follow(nav, text);
    const show = (/** @type {import('./walk.js').Walk} */ answer) => {
      this.#walk = answer;
      live.show(answer);
      beyond.show(answer);
      list.render(this.#now());
      this.cards.refresh();
    };
    this.#lazy = [
      new Lazy(this.body, h('div'), this.store, { wait: '', body: bodyOf, ask: walk, show }),
      new Lazy(this.body, h('div'), this.store, {
        wait: '',
        body: structureOf,
        ask: askStructure,
        show: (answer) => chosen.show(answer),
      }),
    ];
    for (const { status } of this.#lazy) live.rig.after(status);
    live.render(this.store.state);
    beyond.render(this.store.state);
    const at = place();
    if (at) requestAnimationFrame(() => location.replace(`#${at}`)); // now there is something to lead to
  }

  /** @param {Paper} paper */
  #introduction(paper) {
    const c = countsOf(paper);
    return h(
      'div',
      { class: 'prose introduction' },
      h('p', { class: 'cited' }, h('cite', {}, paper.title), h('br'), paper.authors),
      h(
        'p',
        {},
        rich(
          'The paper places the four poles of a laboratory helicopter by a state feedback that is written out in ' +
            'symbols, and closes PI loops around it. Here the derivation is followed step by step, from the ' +
            'energies to $K$, the relative gain array and the PI loops. Every formula is derived again and every ' +
            'number recomputed; where paper and derivation differ, both are shown. Beside the formulas stand their ' +
            'values for the rig and poles chosen above. Point at a symbol for its name, value and unit.',
        ),
      ),
      h(
        'p',
        { class: 'tally', 'data-testid': 'paper-tally' },
        h('b', {}, `${c.reproduced} of ${c.derivable}`),
        ` numbers that follow from a formula come out to every printed digit. `,
        h('b', {}, String(c.errata)),
        ` errata are confirmed by the paper’s own numbers; ${c.unclear} more places are unclear in our copy. ` +
          `${c.proofs === c.errata + c.unclear ? 'Each has its proof.' : `${c.proofs} of them are proved.`}`,
      ),
      h(
        'ul',
        { class: 'marks' },
        Object.keys(MARKS).map((status) =>
          h('li', {}, mark(status), h('span', {}, `${MEANINGS[status]} (${c.status[status] ?? 0})`)),
        ),
      ),
    );
  }
}
