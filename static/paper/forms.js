/**
 * What the section is made of: chapters, and typeset formulas with their button for copying that scroll in themselves
 * and are set smaller where they are long.
 */
import { copyButton, formula, h, wide } from '../ui/index.js';
import { rich } from './rich.js';

/** @typedef {import('./math.js').Form} Form */
const DENSE = 4000; // characters of MathML, above which a matrix's fractions are set small
const LONG = 7500; // and above which it is set smaller still on paper, where nothing scrolls

const sizeOf = (/** @type {Form} */ { mathml = '' }) =>
  mathml.length > LONG ? 'dense long' : mathml.length > DENSE ? 'dense' : '';

/**
 * @param {string} name
 * @param {import('../ui/dom.js').Child|readonly import('../ui/dom.js').Child[]} title
 * @param {import('../ui/dom.js').Children} content
 */
export const chapter = (name, title, ...content) =>
  h(
    'section',
    { class: 'chapter', id: `paper-${name}`, 'aria-labelledby': `paper-${name}-title` },
    h('h3', { id: `paper-${name}-title` }, title),
    ...content,
  );

/** A formula that scrolls in itself, and can be copied. @param {Form} form @param {string} label */
export const typeset = (form, label) =>
  h(
    'div',
    { class: 'with-copy' },
    scrolling(form, label),
    form.latex
      ? copyButton(
          'formula',
          () => [{ name: label, latex: form.latex, text: form.text ?? form.latex }],
          `Copy ${label}`,
        )
      : null,
  );

/** @param {Form} form @param {string} label */
const scrolling = (form, label) =>
  wide(
    label,
    form.mathml ? formula(form.mathml) : h('span', { class: 'plain' }, rich(form.text ?? form.latex ?? '–')),
    `scroll ${sizeOf(form)}`,
  );
