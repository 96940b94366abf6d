/** The button of the small menu beside matrices and formulas; the menu comes after the first view. */
import { h } from './dom.js';
import { icon, popupButton } from './popup.js';

/** @typedef {import('./copy_formats.js').Item} Item */
/** @type {typeof import('./copy_menu.js')|undefined} */ let menus;

/** Fetches the menu. */
export async function readyToCopy() {
  menus ??= await import('./copy_menu.js');
  return menus;
}

/** @param {string} testid @param {() => Item[]} items what there is at the moment it opens @param {string} [label] */
export function copyButton(testid, items, label = 'Copy as LaTeX, Python, MATLAB or text') {
  const late = () => [h('p', { class: 'caption' }, 'The page is still loading. Open this again in a moment.')];
  return popupButton({
    label,
    text: icon('copy'),
    testid: `copy-${testid}`,
    content: () => (menus ? menus.copyMenu(items()) : readyToCopy().then((own) => own.copyMenu(items()), late)),
  });
}
