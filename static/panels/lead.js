/**
 * Leads to a place on the page: opens what hides it, brings it into sight, gives it the focus, and marks it until the
 * focus leaves.
 */

/** @param {Element} node */
const usable = (node) => node.checkVisibility?.() !== false && !(/** @type {HTMLInputElement} */ (node).disabled);

/**
 * @param {string} selector of what takes the focus; its panel does where it is hidden or disabled
 * @param {Document} [page]
 * @returns {boolean} whether there was such a place
 */
export function leadTo(selector, page = document) {
  /** @type {HTMLElement|SVGElement|null} */ let node = selector ? page.querySelector(selector) : null;
  if (!node) return false;
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
