/** The small menu beside matrices and formulas: each of them, in each form, by one click. */
import { copyText } from './clipboard.js';
import { allOf, FORMATS, textOf } from './copy_formats.js';
import { button, h, setText } from './dom.js';
import { Choice } from './fields.js';
import { recall, remember } from './memory.js';

/** @typedef {import('./copy_formats.js').Item} Item @typedef {import('./copy_formats.js').Format} Format */
const TITLES = { LaTeX: 'for a document', Python: 'NumPy or SymPy', MATLAB: 'MATLAB or Octave', Text: 'plain text' };
const SHOWN_MS = 1400;
const [MEMORY, FEW] = ['copy-digits', 4];

/** How many digits numbers are copied with, as it was last chosen. @returns {import('./copy_formats.js').Digits} */
const digits = () => (recall(MEMORY) === String(FEW) ? FEW : undefined);

/** The choice between few digits and all. */
function digitsChoice() {
  const choice = new Choice({
    label: 'Digits of copied numbers',
    testid: MEMORY,
    options: [
      [String(FEW), '4 digits'],
      ['all', 'all digits'],
    ],
    onChange: (value) => remember(MEMORY, value),
  });
  choice.set(digits() ? String(FEW) : 'all');
  return choice.node;
}

/** @param {Item[]} items */
export function copyMenu(items) {
  if (!items.length) return [h('p', { class: 'caption' }, 'There is nothing to copy yet.')];
  const told = h('p', { class: 'told', role: 'status', 'data-testid': 'copied' });
  const cell = (/** @type {string} */ name, /** @type {Format} */ format, /** @type {() => string|undefined} */ text) =>
    h(
      'td',
      {},
      button(
        {
          disabled: !text(),
          title: `${name}: ${TITLES[format]}`,
          'aria-label': `Copy ${name} as ${format}`,
          'data-testid': `copy-${name}-${format}`,
          onclick: (/** @type {Event} */ e) => copy(e, name, format, text() ?? '', told),
        },
        format,
      ),
    );
  const rows = items.map((item) =>
    h(
      'tr',
      {},
      h('th', { scope: 'row', title: item.note ?? '' }, item.name),
      FORMATS.map((format) => cell(item.name, format, () => textOf(item, format, digits()))),
    ),
  );
  if (items.length > 1)
    rows.push(
      h(
        'tr',
        {},
        h('th', { scope: 'row' }, 'all'),
        FORMATS.map((format) => cell('all', format, () => allOf(items, format, digits()))),
      ),
    );
  const numbers = items.some((item) => 'matrix' in item || 'poles' in item);
  const table = h('table', { class: 'copy-menu' }, h('tbody', {}, rows));
  return numbers ? [table, digitsChoice(), told] : [table, told];
}

/** @param {Event} e @param {string} name @param {Format} format @param {string} text @param {HTMLElement} told */
async function copy(e, name, format, text, told) {
  const pressed = /** @type {HTMLElement} */ (e.currentTarget);
  const done = await copyText(text);
  setText(told, done ? `${name} copied as ${format}.` : 'The browser blocked copying. Select the text and copy it:');
  if (!done) told.after(h('textarea', { class: 'by-hand', readonly: true, rows: 5 }, text));
  pressed.classList.toggle('done', done);
  setTimeout(() => pressed.classList.remove('done'), SHOWN_MS);
}
