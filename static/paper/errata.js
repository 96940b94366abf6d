/**
 * The paper's errata, and what is unclear in our copy: printed, corrected, why, what follows, the paper's numbers that
 * confirm it, and the proof that the server has just computed. Each stands at its step; the lists lead there.
 */
import { h } from '../ui/index.js';
import { countsOf } from './math.js';
import { rich } from './rich.js';
import { chapter, typeset } from './forms.js';
import { COPY } from './words.js';

/** @type {Record<string, string>} */
const STANDING = { confirmed: 'Erratum', unclear: 'Unclear in our copy' };

/** @param {import('./math.js').Erratum} e */
export function erratum({ name, where, printed, correct, why, effect, standing, evidence, proof }) {
  const anchor = `erratum-${name}`;
  const value = (/** @type {'correct'|'printed'} */ kind, /** @type {string} */ label) =>
    h(
      'div',
      { class: `residual ${kind}` },
      h('span', { class: 'which' }, label),
      typeset(proof[kind], `${where}, proof, ${label}`),
    );
  return h(
    'div',
    {
      class: 'erratum',
      role: 'group',
      id: anchor,
      'aria-labelledby': `${anchor}-title`,
      'data-testid': 'erratum',
      'data-holds': String(proof.holds),
    },
    h(
      'div',
      { class: 'erratum-head' },
      h('h5', { id: `${anchor}-title` }, `${STANDING[standing]}, `, rich(where, anchor)),
      h('a', { class: 'permalink', href: `#${anchor}`, 'aria-label': `Link to ${name}` }, name.replaceAll('-', ' ')),
    ),
    h(
      'div',
      { class: 'change' },
      h(
        'figure',
        { class: 'form printed corrected' },
        h('figcaption', {}, 'printed'),
        typeset(printed, `${where}, printed`),
      ),
      h(
        'figure',
        { class: 'form derived corrected' },
        h('figcaption', {}, 'corrected'),
        typeset(correct, `${where}, corrected`),
      ),
    ),
    h('p', {}, rich(why, anchor)),
    evidence
      ? h('p', { class: 'evidence' }, h('b', {}, 'Confirmed by the paper’s own numbers. '), rich(evidence, anchor))
      : null,
    h('p', { class: 'effect' }, h('b', {}, 'Effect. '), rich(effect, anchor)),
    h(
      'div',
      { class: 'proof' },
      h('p', {}, h('b', {}, 'Proof. '), rich(proof.statement, anchor)),
      value('correct', proof.labels[0]),
      value('printed', proof.labels[1]),
      h(
        'p',
        { class: `holds ${proof.holds ? '' : 'broken'}` },
        proof.holds ? '✓ holds, computed by the server for this page' : '✗ does not hold',
      ),
    ),
  );
}

/** @param {import('./math.js').Erratum[]} slips @param {string} testid */
const list = (slips, testid) =>
  h(
    'ul',
    { class: 'errata', 'data-testid': testid },
    slips.map(({ name, where, effect, proof }) =>
      h(
        'li',
        {},
        h('a', { href: `#erratum-${name}` }, `${where}: ${name.replaceAll('-', ' ')}`),
        h('span', { class: 'effect' }, 'Effect: ', rich(effect)),
        h('span', { class: proof.holds ? 'holds' : 'holds broken' }, proof.holds ? '✓ proved' : '✗ not proved'),
      ),
    ),
  );

/** @param {import('./math.js').Paper} paper */
export function errata(paper) {
  const { errata: confirmed, unclear } = countsOf(paper);
  const having = (/** @type {string} */ standing) => paper.errata.filter((e) => e.standing === standing);
  return chapter(
    'errata',
    'Errata',
    h(
      'p',
      { class: 'prose' },
      `${confirmed} errata, each confirmed by the paper’s own printed numbers and proved. They stand at the steps ` +
        'where they occur.',
    ),
    list(having('confirmed'), 'errata'),
    h('h4', {}, 'Unclear in our copy'),
    h(
      'p',
      { class: 'prose' },
      `${unclear} more places in our copy are wrong, which is proved too, but no printed number of the paper shows ` +
        `them. ${COPY}`,
    ),
    list(having('unclear'), 'unclear'),
  );
}
