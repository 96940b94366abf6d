/**
 * A lab's text as elements of the page. They are made one by one of the tree that parse.js reads: no text is ever taken
 * for HTML. Formulas are MathML, made by the server of the LaTeX that the text has.
 * @typedef {import('./parse.js').Inline} Inline
 * @typedef {import('./parse.js').Block} Block
 * @typedef {Record<string, string>} Formulas  MathML by LaTeX
 */
import { formula, h } from '../ui/index.js';
import { inline, parse } from './parse.js';

const WORDS = { translate: 'no' }; // of the lab's author, in the author's language

/** @param {string} latex @param {Formulas} formulas @param {boolean} alone whether it has lines of its own */
function drawn(latex, formulas, alone) {
  if (!Object.hasOwn(formulas, latex)) return h('code', WORDS, latex);
  const node = formula(formulas[latex]);
  if (!(node instanceof Element)) return h('code', WORDS, latex);
  node.setAttribute('display', alone ? 'block' : 'inline');
  node.setAttribute('aria-label', latex);
  return node;
}

/** What ends a sentence or clause, which begins no line. */
const CLOSING = /^[.,;:!?)\]]+/;

/** @param {Inline[]} parts @param {Formulas} formulas @returns {(Node|string)[]} */
const written = (parts, formulas) =>
  parts.map((part, i) => {
    const next = parts[i + 1];
    switch (part.kind) {
      case 'text': {
        const own = parts[i - 1]?.kind === 'math' ? part.text.replace(CLOSING, '') : part.text;
        return document.createTextNode(own.replaceAll('\n', ' '));
      }
      case 'code':
        return h('code', WORDS, part.text);
      case 'math': {
        const closing = next?.kind === 'text' && CLOSING.exec(next.text);
        const own = drawn(part.text, formulas, false);
        return closing ? h('span', { class: 'held' }, own, closing[0]) : own;
      }
      case 'strong':
      case 'em':
        return h(part.kind, WORDS, written(part.inside, formulas));
      case 'link': {
        const away = part.to.startsWith('#') ? {} : { target: '_blank', rel: 'noopener noreferrer' };
        return h('a', { href: part.to, ...away }, written(part.inside, formulas));
      }
      default:
        return h('br');
    }
  });

/** @param {Block} block @param {Formulas} formulas @param {number} top level of the highest heading @returns {Node} */
function built(block, formulas, top) {
  const own = (/** @type {Inline[]} */ parts) => written(parts, formulas);
  const inner = (/** @type {Block[]} */ blocks) => blocks.map((one) => built(one, formulas, top));
  switch (block.kind) {
    case 'heading':
      return h(/** @type {'h3'} */ (`h${Math.min(6, top + block.level - 1)}`), WORDS, own(block.inside));
    case 'code':
      return h('pre', { tabindex: 0 }, h('code', WORDS, block.text));
    case 'math':
      // wide ones scroll by themselves, also by the keys
      return h(
        'div',
        { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': 'Formula' },
        drawn(block.text, formulas, true),
      );
    case 'quote':
      return h('blockquote', {}, inner(block.blocks));
    case 'list': {
      // of a tight list the items are no paragraphs
      const items = block.items.map((item) =>
        h(
          'li',
          WORDS,
          item.flatMap((one) => (one.kind === 'paragraph' ? [own(one.inside)].flat() : [built(one, formulas, top)])),
        ),
      );
      return block.ordered ? h('ol', { start: block.start }, items) : h('ul', {}, items);
    }
    case 'table':
      return h(
        'div',
        { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': 'Table' },
        h(
          'table',
          {},
          h(
            'thead',
            {},
            h(
              'tr',
              {},
              block.head.map((cell) => h('th', { scope: 'col', translate: 'no' }, own(cell))),
            ),
          ),
          h(
            'tbody',
            {},
            block.rows.map((row) =>
              h(
                'tr',
                {},
                row.map((cell) => h('td', WORDS, own(cell))),
              ),
            ),
          ),
        ),
      );
    default:
      return h('p', WORDS, own(block.inside));
  }
}

/**
 * A text as the page shows it.
 * @param {string|undefined} text
 * @param {Formulas} [formulas]
 * @param {number} [top] level of the highest heading
 * @returns {Node[]}
 */
export const markdown = (text, formulas = {}, top = 3) => parse(text ?? '').map((block) => built(block, formulas, top));

/** A line of it, as in a label. @param {string|undefined} text @param {Formulas} [formulas] */
export const markdownLine = (text, formulas = {}) => written(inline(text ?? ''), formulas);
