/**
 * One panel that opens beside the button that asked for it: light dismissal, Escape and the focus's return are the browser's (`popover`), the arrow keys are ours.
 */
import { h, svg } from './dom.js';

const MARGIN = 8; // px to the window's edge

/** @type {HTMLElement|undefined} */ let panel;
/** @type {HTMLElement|null} */ let owner = null;

function make() {
  const node = h('div', { class: 'popup', popover: 'auto', 'data-testid': 'popup' });
  node.addEventListener('toggle', (e) => {
    if (/** @type {any} */ (e).newState !== 'closed') return;
    owner?.setAttribute('aria-expanded', 'false');
    owner = null;
  });
  node.addEventListener('keydown', (e) => walk(node, e));
  document.body.append(node);
  return node;
}

/** Arrow keys walk through the grid of buttons. @param {HTMLElement} node @param {KeyboardEvent} e */
function walk(node, e) {
  const step = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: 0, ArrowUp: 0, Home: -Infinity, End: Infinity }[e.key];
  if (step === undefined || !(e.target instanceof HTMLButtonElement)) return;
  const all = [...node.querySelectorAll('button:not(:disabled)')];
  const at = all.indexOf(e.target);
  const here = e.target.getBoundingClientRect();
  let next = all[Math.max(0, Math.min(all.length - 1, at + step))];
  if (step === 0) {
    const down = e.key === 'ArrowDown';
    const rows = all.filter((b) => { const y = b.getBoundingClientRect().top; return down ? y > here.bottom - 2 : y < here.top - 2; });
    const away = (/** @type {Element} */ b) => { const box = b.getBoundingClientRect(); return Math.abs(box.top - here.top) * 1000 + Math.abs(box.left - here.left); };
    next = rows.sort((a, b) => away(a) - away(b))[0] ?? e.target;
  }
  /** @type {HTMLElement} */ (next).focus();
  e.preventDefault();
}

/** @param {HTMLElement} anchor */
function place(anchor) {
  if (!panel) return;
  const a = anchor.getBoundingClientRect();
  const { width, height } = panel.getBoundingClientRect();
  const below = a.bottom + 4 + height <= innerHeight - MARGIN || a.top - 4 - height < MARGIN;
  const left = Math.max(MARGIN, Math.min(a.right - width, innerWidth - width - MARGIN));
  const top = below ? Math.min(a.bottom + 4, innerHeight - height - MARGIN) : a.top - 4 - height;
  Object.assign(panel.style, { left: `${left}px`, top: `${Math.max(MARGIN, top)}px` });
}

/** Opens beside `anchor`, or closes what it had opened. @param {HTMLElement} anchor @param {string} label @param {() => (Node|string)[]} content */
export function togglePopup(anchor, label, content) {
  panel ??= make();
  if (owner === anchor) return panel.hidePopover();
  owner = anchor;
  panel.setAttribute('role', 'dialog');
  panel.setAttribute('aria-label', label);
  panel.replaceChildren(...content());
  anchor.setAttribute('aria-expanded', 'true');
  if (!panel.matches(':popover-open')) panel.showPopover();
  owner = anchor;
  place(anchor);
  /** @type {HTMLElement|null} */ (panel.querySelector('button, input'))?.focus({ preventScroll: true });
}

/** A button that opens a popup. @param {{label: string, text: string|Node, testid?: string, kind?: string, content: () => (Node|string)[]}} how */
export function popupButton({ label, text, testid, kind = 'small-tool', content }) {
  const button = h('button', { type: 'button', class: kind, title: label, 'aria-label': label, 'aria-haspopup': 'dialog', 'aria-expanded': 'false', 'data-testid': testid, onclick: () => togglePopup(button, label, content) }, text);
  return button;
}

/** Two sheets, or an arrow into a tray. @param {'copy'|'save'} kind */
export const icon = (kind) => svg('svg', { class: 'icon-tool', viewBox: '0 0 12 12', 'aria-hidden': 'true' },
  svg('path', { d: kind === 'copy' ? 'M 4.5 4.5 H 10.5 V 10.5 H 4.5 Z M 2.5 7.5 H 1.5 V 1.5 H 7.5 V 2.5' : 'M 6 1 V 7.5 M 3.2 4.8 L 6 7.6 L 8.8 4.8 M 1.5 10.5 H 10.5' }));
