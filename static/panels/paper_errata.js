/** The paper's errata: what is printed, what is right, why, what follows, and the proof that the server has just computed. Each stands at its step; the list leads there. */
import { h } from '../dom.js';
import { countsOf } from '../paper_math.js';
import { rich } from '../rich.js';
import { typeset } from './paper_forms.js';
import { COPY } from './paper_words.js';

/** @param {import('../paper_math.js').Erratum} e */
export function erratum({ name, where, printed, correct, why, effect, proof }) {
  const anchor = `erratum-${name}`;
  const value = (/** @type {'correct'|'printed'} */ kind, /** @type {string} */ label) => h('div', { class: `residual ${kind}` }, h('span', { class: 'which' }, label), typeset(proof[kind], `${where}, proof, ${label}`));
  return h('div', { class: 'erratum', role: 'group', id: anchor, 'aria-labelledby': `${anchor}-title`, 'data-testid': 'erratum', 'data-holds': String(proof.holds) },
    h('div', { class: 'erratum-head' }, h('h5', { id: `${anchor}-title` }, 'Erratum, ', rich(where, anchor)), h('a', { class: 'permalink', href: `#${anchor}`, 'aria-label': `Link to the erratum ${name}` }, name.replaceAll('-', ' '))),
    h('div', { class: 'change' }, h('figure', { class: 'form printed corrected' }, h('figcaption', {}, 'printed'), typeset(printed, `${where}, printed`)),
      h('figure', { class: 'form derived corrected' }, h('figcaption', {}, 'right'), typeset(correct, `${where}, right`))),
    h('p', {}, rich(why, anchor)), h('p', { class: 'effect' }, h('b', {}, 'Effect. '), rich(effect, anchor)),
    h('div', { class: 'proof' }, h('p', {}, h('b', {}, 'Proof. '), rich(proof.statement, anchor)), value('correct', proof.labels[0]), value('printed', proof.labels[1]),
      h('p', { class: `holds ${proof.holds ? '' : 'broken'}` }, proof.holds ? '✓ holds, computed by the server for this page' : '✗ does not hold')));
}

/** @param {import('../paper_math.js').Paper} paper */
export function errata(paper) {
  const { errata: all, proofs } = countsOf(paper);
  return h('section', { class: 'chapter', id: 'paper-errata', 'aria-labelledby': 'paper-errata-title' },
    h('h3', { id: 'paper-errata-title' }, 'Errata'),
    h('p', { class: 'prose' }, `${all} errata, each with an identity or a computation that proves it; ${proofs === all ? 'all' : proofs} of the proofs hold. They stand at the steps where they occur. ${COPY}`),
    h('ul', { class: 'errata', 'data-testid': 'errata' }, paper.errata.map(({ name, where, effect, proof }) => h('li', {},
      h('a', { href: `#erratum-${name}` }, `${where}: ${name.replaceAll('-', ' ')}`), h('span', { class: 'effect' }, 'Effect: ', rich(effect)), h('span', { class: proof.holds ? 'holds' : 'holds broken' }, proof.holds ? '✓ proved' : '✗ not proved')))));
}
