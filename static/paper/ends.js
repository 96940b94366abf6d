/**
 * What is wider than its place scrolls in itself, by the keys too; here it is said on which side more of it lies, for
 * the style to show. And the style of formulas and of the paper, with their font, which the first view does without.
 */
const SLACK = 2; // px, by which a browser may round

/** @param {Element} box @returns {'left'|'right'|'both'|''} */
export function hiddenSide({ scrollLeft, clientWidth, scrollWidth }) {
  const left = scrollLeft > SLACK;
  const right = scrollLeft + clientWidth < scrollWidth - SLACK;
  return left ? (right ? 'both' : 'left') : right ? 'right' : '';
}

/** @param {Element} box */
function tell(box) {
  const side = hiddenSide(box);
  if (side) box.setAttribute('data-more', side);
  else box.removeAttribute('data-more');
}

/** Watches everything in there that scrolls sideways, also what comes later. @param {HTMLElement} root */
export function watchEnds(root) {
  const sizes = new ResizeObserver((entries) => {
    for (const box of new Set(entries.map(({ target }) => target.closest('.scroll')))) if (box) tell(box);
  });
  /** @type {WeakSet<Element>} */ const watched = new WeakSet();
  const find = () => {
    for (const box of root.querySelectorAll('.scroll'))
      for (const node of [box, ...box.children]) {
        if (watched.has(node)) continue;
        watched.add(node);
        sizes.observe(node);
      }
  };
  const isNew = (/** @type {MutationRecord} */ { addedNodes }) => [...addedNodes].some((n) => n instanceof Element);
  new MutationObserver((changes) => changes.some(isNew) && find()).observe(root, { childList: true, subtree: true });
  root.addEventListener(
    'scroll',
    ({ target }) => {
      if (target instanceof Element && target.matches('.scroll')) tell(target);
    },
    { passive: true, capture: true },
  );
  find();
}

/** Has the font of formulas fetched; math.css names it. Without it others do. */
export const formulaFont = () => document.fonts.load('1em "STIX Two Math"').catch(console.warn);
