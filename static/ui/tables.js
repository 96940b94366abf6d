/** What the page's tables share: heads, scrolling by themselves where they are wide, the focus where rows are new. */
import { h } from './dom.js';

const AXES = /** @type {const} */ ([
  ['theta', 'pitch'],
  ['psi', 'yaw'],
]);

/** What is pitch's or yaw's is told apart by a shape. @param {string} name */
export const shape = (name) => h('span', { class: `shape ${name}`, 'aria-hidden': 'true' });

/**
 * Changes what is in a node; what had the focus, has it again in its new form.
 * @param {Element} root
 * @param {() => void} change
 */
export function keepingFocus(root, change) {
  const testid = document.activeElement?.getAttribute('data-testid');
  change();
  if (!testid || document.activeElement?.getAttribute('data-testid')) return;
  const again = /** @type {HTMLElement|null} */ (root.querySelector(`[data-testid="${CSS.escape(testid)}"]`));
  again?.focus({ preventScroll: true });
}

/** Scrolls by the keys too. @param {string} label @param {Node} table @param {string} [kind] */
export const wide = (label, table, kind = 'scroll sideways') =>
  h('div', { class: kind, tabindex: 0, role: 'group', 'aria-label': label }, table);

/** A head of one row. @param {(string|Node)[]} cells what they hold, or cells with attributes of their own */
export const head = (cells) =>
  h(
    'thead',
    {},
    h(
      'tr',
      {},
      cells.map((cell) => (cell instanceof HTMLTableCellElement ? cell : h('th', { scope: 'col' }, cell))),
    ),
  );

/**
 * A head of two rows, where the columns of an axis' step stand under its name.
 * @template {{axis?: string, title: string}} C
 * @param {string} first
 * @param {C[]} columns
 * @param {(column: C) => import('./dom.js').Child|import('./dom.js').Child[]} nameOf
 * @param {Node[]} [last]
 */
export function groupedHead(first, columns, nameOf, last = []) {
  const cell = (/** @type {C} */ c) => h('th', { scope: 'col', title: c.title, rowspan: c.axis ? 1 : 2 }, nameOf(c));
  const [from, to] = [columns.findIndex((c) => c.axis), columns.findLastIndex((c) => c.axis) + 1];
  const grouped = columns.slice(from, to);
  const groups = AXES.map(([axis, name]) =>
    h(
      'th',
      { scope: 'colgroup', colspan: grouped.filter((c) => c.axis === axis).length, class: 'group' },
      shape(name),
      ` ${name} step`,
    ),
  );
  return h(
    'thead',
    {},
    h(
      'tr',
      {},
      h('th', { scope: 'col', rowspan: 2, class: 'method-name' }, first),
      columns.slice(0, from).map(cell),
      groups,
      columns.slice(to).map(cell),
      last,
    ),
    h('tr', {}, grouped.map(cell)),
  );
}
