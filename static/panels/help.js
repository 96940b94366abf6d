/**
 * Help for hands without a hover: while it is on, a tap, a click or the focus on what has a title opens the title's
 * words beside it, and does nothing else. Escape ends it. Fetched when it is first asked for.
 */
import { t } from '../text/index.js';
import { closePopup, showTip } from '../ui/index.js';

const NAMELESS = ':disabled[title]'; // a browser sends these no press
const REACHED = 'a, button, input, select, summary, textarea, [tabindex]';
const LENT = 'data-help-stop';

/** @param {Element} node @returns {HTMLElement|null} what explains it */
const titled = (node) =>
  node.closest('[title]') ?? node.closest('.field, .select, .check')?.querySelector('[title]') ?? null;

/** @param {Event} e @returns {HTMLElement|null} */
function under(e) {
  if (!(e.target instanceof Element) || e.target.closest('[data-testid="help"], .popup')) return null;
  const { clientX: x, clientY: y } = /** @type {MouseEvent} */ (e);
  const still = /** @type {HTMLElement[]} */ ([...document.querySelectorAll(NAMELESS)]).find((node) => {
    const box = node.getBoundingClientRect();
    return x >= box.left && x <= box.right && y >= box.top && y <= box.bottom;
  });
  return still ?? titled(e.target);
}

/**
 * Lays the help over the page; its button and its key turn it on and off.
 * @param {HTMLElement} opener
 * @returns {(wanted?: boolean) => void} turns it; by itself to the other side
 */
export function help(opener) {
  const root = document.documentElement;
  const on = () => root.classList.contains('helping');

  const turn = (wanted = !on()) => {
    if (wanted === on()) return;
    root.classList.toggle('helping', wanted);
    opener.setAttribute('aria-pressed', String(wanted));
    // what takes no focus by itself takes it meanwhile, so that keys reach each
    for (const node of document.querySelectorAll(wanted ? '[title]' : `[${LENT}]`)) {
      if (!wanted) node.removeAttribute('tabindex');
      else if (node.matches(REACHED) || node.querySelector(REACHED) || node.closest('[aria-hidden=true]')) continue;
      else node.setAttribute('tabindex', '0');
      node.toggleAttribute(LENT, wanted);
    }
    if (wanted) showTip(opener, t('Tap or focus what is outlined to read what it is. ? or Esc ends the help.'));
    else closePopup();
  };
  for (const kind of ['pointerdown', 'mousedown', 'click'])
    document.addEventListener(
      kind,
      (e) => {
        const node = on() ? under(e) : null;
        if (!node) return;
        e.preventDefault();
        e.stopPropagation();
        if (kind === 'click') showTip(node, node.title);
      },
      { capture: true },
    );
  document.addEventListener('focusin', (e) => {
    if (!on() || !(e.target instanceof Element) || e.target === opener) return;
    const node = titled(e.target);
    if (node && e.target.matches(':focus-visible')) showTip(node, node.title);
  });
  document.addEventListener('keydown', (e) => e.key === 'Escape' && turn(false));
  return turn;
}
