/** The paper, step by step: its equations derived again, its numbers recomputed, its errata proved. Fetched when it is first seen. */
import { getPaper, ProblemError, walkThrough } from '../api.js';
import { h } from '../dom.js';
import { Lazy } from '../lazy.js';
import { FULL_RANK } from '../methods.js';
import { placeIn } from '../permalink.js';
import { anchorOf, countsOf, shortOf } from '../paper_math.js';
import { rich } from '../rich.js';
import { bodyOf } from '../store.js';
import { consequence } from './paper_consequence.js';
import { PaperCurves } from './paper_curves.js';
import { chapters, mark } from './paper_equations.js';
import { errata } from './paper_errata.js';
import { LiveNumbers } from './paper_live.js';
import { numbers } from './paper_numbers.js';
import { CHAPTERS, MARKS, MEANINGS } from './paper_words.js';

/** @typedef {import('../paper_math.js').Paper} Paper */
/** The place in this section to which the address leads. */
const place = () => placeIn(location.hash)?.match(/^(paper|eq|fig|table|erratum)\b.*/)?.[0];
const WAIT = 'Reading the paper: its formulas are derived, its numbers recomputed, its errata proved. The first time this takes some seconds.';

/** A refusal is an answer too: it is told beside the formulas. @param {any} body */
async function walk(body) {
  if (body.method !== FULL_RANK) return { refused: 'Only the full-rank method has these steps; choose it to see them.' };
  try {
    return await walkThrough(body);
  } catch (error) {
    if (!(error instanceof ProblemError)) throw error;
    return { refused: [error.message, error.problem.hint].filter(Boolean).join(' ') };
  }
}

/** Prints this section alone. */
function print() {
  document.body.classList.add('printing-paper');
  window.print();
  document.body.classList.remove('printing-paper');
}

export class PaperPanel {
  /** @type {LiveNumbers|null} */ #live = null;
  /** @type {Lazy|null} */ #numbers = null;

  /** @param {HTMLElement} root @param {import('../store.js').Store} store */
  constructor(root, store) {
    this.root = root;
    this.store = store;
    this.body = h('div', { class: 'paper-body', 'data-testid': 'paper' });
    root.append(this.body);
    this.lazy = new Lazy(root, this.body, store, { wait: WAIT, body: () => 'paper', ask: getPaper, show: (paper) => this.#show(paper) });
    if (place()) root.scrollIntoView();
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    this.lazy.render(state);
    this.#live?.render(state);
    this.#numbers?.render(state);
  }

  /** @param {Paper} paper */
  #show(paper) {
    const live = (this.#live = new LiveNumbers());
    const curves = new PaperCurves(() => this.store.state.presets.find((p) => p.name.endsWith('manual'))?.limits.theta);
    const figures = new Map(paper.figures.map((f) => [`Fig. ${f.number}`, f]));
    const text = h('div', { class: 'paper-text' }, this.#introduction(paper),
      chapters(paper, (number) => live.at(number), (number) => { const f = figures.get(number); return f ? curves.draw(f) : null; }),
      numbers(paper), errata(paper), consequence(paper));
    this.body.replaceChildren(this.#contents(paper, live), text);
    this.#numbers = new Lazy(this.body, h('div'), this.store, { wait: '', body: bodyOf, ask: walk, show: (answer) => live.show(answer) });
    live.rig.after(this.#numbers.status);
    live.render(this.store.state);
    const at = place();
    if (at) requestAnimationFrame(() => location.replace(`#${at}`)); // now there is something to lead to
  }

  /** @param {Paper} paper */
  #introduction(paper) {
    const c = countsOf(paper);
    return h('div', { class: 'prose introduction' },
      h('p', { class: 'cited' }, h('cite', {}, paper.title), h('br'), paper.authors),
      h('p', {}, rich('The paper places the four poles of a laboratory helicopter by a state feedback that is written out in symbols, and closes PI loops around it. Here it is followed line by line, from the Lagrangian to $K$ and the relative gain array. Every formula is derived again from the energies and every number recomputed; where the paper and the derivation part, both are shown. Beside the formulas stand their values on the rig and with the poles chosen above, and they follow when you change them.')),
      h('p', { class: 'tally', 'data-testid': 'paper-tally' }, h('b', {}, `${c.reproduced} of ${c.derivable}`), ` numbers that follow from a formula come out to every printed digit. `, h('b', {}, String(c.errata)), ` errata, ${c.proofs === c.errata ? 'each with its proof' : `${c.proofs} of them proved`}.`),
      h('ul', { class: 'marks' }, Object.keys(MARKS).map((status) => h('li', {}, mark(status), h('span', {}, `${MEANINGS[status]} (${c.status[status] ?? 0})`)))));
  }

  /** @param {Paper} paper @param {LiveNumbers} live */
  #contents(paper, live) {
    const link = (/** @type {string} */ href, /** @type {string} */ text) => h('a', { href }, text);
    return h('nav', { class: 'contents', 'aria-label': 'Contents of the paper' },
      h('ol', {}, CHAPTERS.map(({ name, title }) => h('li', {}, link(`#paper-${name}`, title),
        h('div', { class: 'stops' }, paper.equations.filter((e) => e.chapter === name).map((e) => h('a', { class: e.status, href: `#${anchorOf(e.number)}`, title: `${e.number}: ${e.title}, ${e.status}` }, shortOf(e.number)))))),
      h('li', {}, link('#paper-numbers', 'Every printed number')), h('li', {}, link('#paper-errata', 'Errata')), h('li', {}, link('#paper-consequence', 'What the unequal digits mean'))),
      h('div', { class: 'present-box' }, h('h3', {}, 'The present rig'), live.rig),
      h('button', { type: 'button', class: 'print', onclick: print }, 'Print this section'));
  }
}
