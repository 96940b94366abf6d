/**
 * The chapters of the derivation: prose, and each step with its mark, one plain sentence, its formulas, its figure,
 * what it comes to on the present rig, and its errata.
 */
import { h } from '../ui/index.js';
import { freeBody } from './figures.js';
import { anchorOf } from './math.js';
import { rich } from './rich.js';
import { erratum } from './errata.js';
import { chapter, typeset } from './forms.js';
import { CHAPTERS, MARKS } from './words.js';

/**
 * @typedef {import('./math.js').Equation} Equation
 * @typedef {import('./math.js').Form} Form
 * @typedef {import('./math.js').Erratum} Erratum
 */
/**
 * @typedef {{live: (number: string) => Element|null, curves: (number: string) => Element|null, structure: (e: Equation)
 *   => Element|null}} Parts what else a step shows
 */
/** @type {Record<string, Record<string, string>>} what stands above a form */
const CAPTIONS = {
  both: { printed: 'printed', derived: 'derived' },
  corrected: { printed: 'printed', derived: 'corrected' },
  printed: { printed: 'as printed' },
  derived: { derived: 'derived' },
};

/** @param {string} status */
export const mark = (status) =>
  h('span', { class: `mark ${status}` }, h('span', { 'aria-hidden': 'true' }, MARKS[status]), status);

/** @param {Equation} e */
function forms(e) {
  const kinds = /** @type {('printed'|'derived')[]} */ (['printed', 'derived']).filter((kind) => e[kind]);
  const captions = CAPTIONS[kinds.length < 2 ? kinds[0] : e.status === 'corrected' ? 'corrected' : 'both'];
  const whose = (/** @type {string} */ kind) =>
    kind === 'derived' && e.formulas.length
      ? `${captions[kind]}, in the paper’s structure: triangular, pitch leads`
      : captions[kind];
  return kinds.map((kind) =>
    h(
      'figure',
      { class: `form ${kind} ${e.status}` },
      h('figcaption', {}, whose(kind)),
      typeset(/** @type {Form} */ (e[kind]), `${e.number}, ${captions[kind]}`),
    ),
  );
}

/**
 * @param {Equation} e
 * @param {Map<string, Erratum>} errata
 * @param {Set<string>} told errata that stand further up
 * @param {Parts} parts
 */
function card(e, errata, told, { live, curves, structure }) {
  const anchor = anchorOf(e.number);
  const named = /^(Eqs?\.|Fig\.|Table) /.test(e.number);
  const fresh = e.errata.filter((name) => !told.has(name));
  const again = e.errata.filter((name) => told.has(name));
  for (const name of fresh) told.add(name);
  return h(
    'article',
    {
      class: 'eq',
      id: anchor,
      'aria-labelledby': `${anchor}-title`,
      'data-testid': 'paper-equation',
      'data-number': e.number,
      'data-chapter': e.chapter,
    },
    h(
      'div',
      { class: 'margin' },
      h(
        'a',
        {
          class: `eq-number ${named ? '' : 'aside'}`,
          href: `#${anchor}`,
          'aria-label': named ? undefined : `unnumbered: ${e.title}`,
        },
        named ? e.number : 'unnumbered',
      ),
      mark(e.status),
    ),
    h(
      'div',
      { class: 'eq-main' },
      h('h4', { id: `${anchor}-title` }, rich(e.title, anchor)),
      h('p', { class: 'plainly' }, rich(e.plain, anchor)),
      h(
        'div',
        { class: 'eq-body' },
        e.number === 'Fig. 1' ? freeBody() : null,
        forms(e),
        structure(e),
        live(e.number),
        curves(e.number),
      ),
      e.note || again.length
        ? h(
            'p',
            { class: 'note' },
            rich(e.note, anchor),
            again.map((name) =>
              h(
                'a',
                { class: 'see', href: `#erratum-${name}` },
                `${errata.get(name)?.standing === 'unclear' ? 'unclear in our copy' : 'erratum'}, ` +
                  `${errata.get(name)?.where ?? name}`,
              ),
            ),
          )
        : null,
      fresh.flatMap((name) => {
        const own = errata.get(name);
        return own ? [erratum(own)] : [];
      }),
    ),
  );
}

/** @param {import('./math.js').Paper} paper @param {Parts} parts */
export function chapters(paper, parts) {
  const errata = new Map(paper.errata.map((e) => [e.name, e]));
  const told = /** @type {Set<string>} */ (new Set());
  return CHAPTERS.map(({ name, title, text, look }, i) =>
    chapter(
      name,
      [h('span', { class: 'ordinal' }, String(i + 1)), title],
      h(
        'div',
        { class: 'prose' },
        h('p', {}, rich(text)),
        h('p', { class: 'look' }, h('b', {}, 'Look at this. '), rich(look)),
      ),
      paper.equations.filter((e) => e.chapter === name).map((e) => card(e, errata, told, parts)),
    ),
  );
}
