/**
 * Leads to a place on the page: opens what hides it, brings it into sight, gives it the focus, and marks it until the
 * focus leaves. A place whose room is still being loaded is led to when it is there.
 */

import { goTo } from './views.js';

/** Ends the wait for a place. */
let unawait = () => {};

/** @param {Element} node */
const usable = (node) => node.checkVisibility?.() !== false && !(/** @type {HTMLInputElement} */ (node).disabled);

/** @param {string} selector of what takes the focus; its panel does where it is hidden or disabled */
export function leadTo(selector) {
  unawait();
  if (!selector || led(selector)) return;
  const arrival = new MutationObserver(() => led(selector) && unawait());
  const elsewhere = new AbortController(); // whoever does something else meanwhile is left there
  unawait = () => {
    arrival.disconnect();
    elsewhere.abort();
  };
  arrival.observe(document.body, { childList: true, subtree: true, attributeFilter: ['class'] });
  for (const act of ['pointerdown', 'keydown'])
    document.addEventListener(act, () => unawait(), { capture: true, signal: elsewhere.signal });
}

/** @param {string} selector @returns {boolean} whether there was such a place */
function led(selector) {
  /** @type {HTMLElement|SVGElement|null} */ let node = document.querySelector(selector);
  if (!node) return false;
  const [view] = node.closest('.elsewhere')?.getAttribute('data-views')?.split(' ') ?? [];
  if (view) {
    goTo(/** @type {import('../types.js').View} */ (view));
    return false; // it is there with the view
  }
  for (let outer = node.closest('details'); outer; outer = outer.parentElement?.closest('details') ?? null)
    outer.open = true;
  if (!usable(node)) {
    node = /** @type {HTMLElement|null} */ (node.closest('.panel, .plot, section'));
    if (!node) return false;
    if (!node.hasAttribute('tabindex')) node.setAttribute('tabindex', '-1');
  }
  const marked = node;
  marked.scrollIntoView({ block: 'nearest', inline: 'nearest' });
  marked.focus({ preventScroll: true });
  marked.classList.add('pointed');
  marked.addEventListener('blur', () => marked.classList.remove('pointed'), { once: true });
  return true;
}
