/** A typeset formula with its button for copying: scrolls in itself, set smaller where it is long. */
import { copyButton, formula, h } from '../ui/index.js';
import { rich } from './rich.js';

/** @typedef {import('./math.js').Form} Form */
const DENSE = 4000; // characters of MathML, above which a matrix's fractions are set small
const LONG = 7500; // and above which it is set smaller still on paper, where nothing scrolls

const sizeOf = (/** @type {Form} */ { mathml = '' }) =>
  mathml.length > LONG ? 'dense long' : mathml.length > DENSE ? 'dense' : '';

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
  h(
    'div',
    { class: `scroll ${sizeOf(form)}`, tabindex: 0, role: 'group', 'aria-label': label },
    form.mathml ? formula(form.mathml) : h('span', { class: 'plain' }, rich(form.text ?? form.latex ?? '–')),
  );
