/** The chapters of the paper: prose, and each equation with its mark, its typeset forms, its figure and what it comes to on the present rig. */
import { copyButton } from '../copy_menu.js';
import { h } from '../dom.js';
import { formula } from '../mathml.js';
import { freeBody, piLoops, stateFeedback } from '../paper_figures.js';
import { anchorOf } from '../paper_math.js';
import { rich } from '../rich.js';
import { CHAPTERS, MARKS } from './paper_words.js';

/** @typedef {import('../paper_math.js').Equation} Equation @typedef {import('../paper_math.js').Form} Form */
const DENSE = 4000; // characters of MathML, above which a matrix's fractions are set small
const LONG = 7500; // and above which it is set smaller still on paper, where nothing scrolls
/** @type {Record<string, () => Element>} */
const DRAWINGS = { 'Fig. 1': freeBody, 'Fig. 2': stateFeedback, 'Fig. 3': piLoops };
/** @type {Record<string, Record<string, string>>} what stands above a form */
const CAPTIONS = {
  both: { printed: 'printed', derived: 'derived' }, corrected: { printed: 'printed', derived: 'right' }, printed: { printed: 'as printed' }, derived: { derived: 'derived' },
};

/** @param {string} status */
export const mark = (status) => h('span', { class: `mark ${status}` }, h('span', { 'aria-hidden': 'true' }, MARKS[status]), status);

const sizeOf = (/** @type {Form} */ { mathml = '' }) => (mathml.length > LONG ? 'dense long' : mathml.length > DENSE ? 'dense' : '');

/** A formula that scrolls in itself, and can be copied. @param {Form} form @param {string} label */
export const typeset = (form, label) => h('div', { class: 'with-copy' }, scrolling(form, label), form.latex ? copyButton('formula', () => [{ name: label, latex: form.latex, text: form.text ?? form.latex }], `Copy ${label}`) : null);

/** @param {Form} form @param {string} label */
const scrolling = (form, label) => h('div', { class: `scroll ${sizeOf(form)}`, tabindex: 0, role: 'group', 'aria-label': label }, form.mathml ? formula(form.mathml) : h('span', { class: 'plain' }, rich(form.text ?? form.latex ?? '–')));

/** @param {Equation} e */
function forms(e) {
  const kinds = /** @type {('printed'|'derived')[]} */ (['printed', 'derived']).filter((kind) => e[kind]);
  const captions = CAPTIONS[kinds.length < 2 ? kinds[0] : e.status === 'corrected' ? 'corrected' : 'both'];
  return kinds.map((kind) => h('figure', { class: `form ${kind} ${e.status}` }, h('figcaption', {}, captions[kind]), typeset(/** @type {Form} */ (e[kind]), `${e.number}, ${captions[kind]}`)));
}

/** @param {Equation} e @param {Map<string, string>} errata name → where @param {(number: string) => Element|null} live what an equation comes to @param {(number: string) => Element|null} curves */
function card(e, errata, live, curves) {
  const anchor = anchorOf(e.number);
  const named = /^(Eqs?\.|Fig\.|Table) /.test(e.number);
  return h('article', { class: 'eq', id: anchor, 'data-testid': 'paper-equation', 'data-number': e.number },
    h('div', { class: 'margin' }, h('a', { class: `eq-number ${named ? '' : 'aside'}`, href: `#${anchor}` }, named ? e.number : 'unnumbered'), mark(e.status)),
    h('div', { class: 'eq-main' }, h('h4', {}, rich(e.title, anchor)),
      h('div', { class: 'eq-body' }, DRAWINGS[e.number]?.() ?? null, forms(e), live(e.number), curves(e.number)),
      e.note || e.errata.length ? h('p', { class: 'note' }, rich(e.note, anchor), e.errata.map((name) => h('a', { class: 'see', href: `#erratum-${name}` }, `erratum, ${errata.get(name) ?? name}`))) : null));
}

/** @param {import('../paper_math.js').Paper} paper @param {(number: string) => Element|null} live @param {(number: string) => Element|null} curves */
export function chapters(paper, live, curves) {
  const errata = new Map(paper.errata.map((e) => [e.name, e.where]));
  return CHAPTERS.map(({ name, title, text, look }, i) => h('section', { class: 'chapter', id: `paper-${name}`, 'aria-labelledby': `paper-${name}-title` },
    h('h3', { id: `paper-${name}-title` }, h('span', { class: 'ordinal' }, String(i + 1)), title),
    h('div', { class: 'prose' }, h('p', {}, rich(text)), h('p', { class: 'look' }, h('b', {}, 'Look at this. '), rich(look))),
    paper.equations.filter((e) => e.chapter === name).map((e) => card(e, errata, live, curves))));
}
