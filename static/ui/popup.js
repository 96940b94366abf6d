/**
 * One panel that opens beside the button that asked for it: light dismissal, Escape and the focus's return are the
 * browser's (`popover`), the arrow keys are ours.
 */
import { button, h, svg } from './dom.js';

const MARGIN = 8; // px to the window's edge
const GAP = 4; // px to the button

/** @typedef {() => (Node|string)[]|Promise<(Node|string)[]>} Content what a panel shows as it opens */
/** @type {HTMLElement|undefined} */ let panel;
/** @type {HTMLElement|null} */ let owner = null;
/** @type {HTMLElement|undefined} whose panel may still be fetched */ let wanted;

function make() {
  const node = h('div', { class: 'popup', popover: 'auto', 'data-testid': 'popup' });
  node.addEventListener('toggle', (e) => {
    if (/** @type {ToggleEvent} */ (e).newState !== 'closed') return;
    owner?.setAttribute('aria-expanded', 'false');
    owner = null;
  });
  node.addEventListener('keydown', (e) => walk(node, e));
  document.body.append(node);
  return node;
}

/** Arrow keys walk through the grid of buttons. @param {HTMLElement} node @param {KeyboardEvent} e */
function walk(node, e) {
  const all = /** @type {HTMLButtonElement[]} */ ([...node.querySelectorAll('button:not(:disabled)')]);
  const at = all.findIndex((button) => button === e.target);
  const next =
    at < 0
      ? undefined
      : stepIn(
          all.map((button) => button.getBoundingClientRect()),
          at,
          e.key,
        );
  if (next === undefined) return;
  all[next].focus();
  e.preventDefault();
}

/**
 * Where a key leads from one of several boxes in the order of reading; up and down lead to the nearest in the next row.
 * @typedef {{left: number, top: number, bottom: number}} Box
 * @param {Box[]} boxes
 * @param {number} at
 * @param {string} key
 * @returns {number|undefined} an index; undefined for other keys
 */
export function stepIn(boxes, at, key) {
  const step = { ArrowRight: 1, ArrowLeft: -1, Home: -Infinity, End: Infinity }[key];
  if (step !== undefined) return Math.max(0, Math.min(boxes.length - 1, at + step));
  if (key !== 'ArrowDown' && key !== 'ArrowUp') return undefined;
  const here = boxes[at];
  const away = (/** @type {number} */ i) =>
    Math.abs(boxes[i].top - here.top) * 1000 + Math.abs(boxes[i].left - here.left);
  const rows = [...boxes.keys()].filter((i) =>
    key === 'ArrowDown' ? boxes[i].top > here.bottom - 2 : boxes[i].top < here.top - 2,
  );
  return rows.sort((a, b) => away(a) - away(b))[0] ?? at;
}

/**
 * Below the button, or above it where only there is room; right edges together, within the window.
 * @param {{top: number, bottom: number, right: number}} a the button's box
 * @param {{width: number, height: number}} panel
 * @param {{width: number, height: number}} view
 * @returns {{left: number, top: number}} px
 */
export function placeBeside(a, { width, height }, view) {
  const below = a.bottom + GAP + height <= view.height - MARGIN || a.top - GAP - height < MARGIN;
  const left = Math.max(MARGIN, Math.min(a.right - width, view.width - width - MARGIN));
  const top = below ? Math.min(a.bottom + GAP, view.height - height - MARGIN) : a.top - GAP - height;
  return { left, top: Math.max(MARGIN, top) };
}

/** @param {HTMLElement} anchor */
function place(anchor) {
  if (!panel) return;
  const { left, top } = placeBeside(anchor.getBoundingClientRect(), panel.getBoundingClientRect(), {
    width: innerWidth,
    height: innerHeight,
  });
  Object.assign(panel.style, { left: `${left}px`, top: `${top}px` });
}

/**
 * Opens beside `anchor`, or closes what it had opened.
 * @param {HTMLElement} anchor
 * @param {string} label
 * @param {Content} content
 */
export function togglePopup(anchor, label, content) {
  if (panel && owner === anchor) return panel.hidePopover();
  wanted = anchor;
  const nodes = content();
  if (!(nodes instanceof Promise)) return open(anchor, label, nodes);
  return nodes.then((fetched) => wanted === anchor && open(anchor, label, fetched)); // the last that was asked for
}

/** @param {HTMLElement} anchor @param {string} label @param {(Node|string)[]} nodes */
function open(anchor, label, nodes) {
  panel ??= make();
  owner = anchor;
  panel.setAttribute('role', 'dialog');
  panel.setAttribute('aria-label', label);
  panel.replaceChildren(...nodes);
  anchor.setAttribute('aria-expanded', 'true');
  if (!panel.matches(':popover-open')) panel.showPopover();
  owner = anchor;
  place(anchor);
  /** @type {HTMLElement|null} */ (panel.querySelector('button, input'))?.focus({ preventScroll: true });
}

/** Says a few words beside an element; the focus stays. @param {HTMLElement} anchor @param {string} words */
export function showTip(anchor, words) {
  panel ??= make();
  closePopup();
  owner?.setAttribute('aria-expanded', 'false');
  owner = null;
  panel.setAttribute('role', 'status');
  panel.removeAttribute('aria-label');
  panel.replaceChildren(h('p', { class: 'tip', 'data-testid': 'tip' }, words));
  panel.showPopover();
  place(anchor);
}

/** Closes what is open. */
export function closePopup() {
  if (panel?.matches(':popover-open')) panel.hidePopover();
}

/**
 * A button that opens a popup.
 * @param {{label: string, text: string|Node, testid?: string, kind?: string, content: Content}} how
 */
export function popupButton({ label, text, testid, kind = 'small-tool', content }) {
  const opener = button(
    {
      class: kind,
      title: label,
      'aria-label': label,
      'aria-haspopup': 'dialog',
      'aria-expanded': 'false',
      'data-testid': testid,
      onclick: () => togglePopup(opener, label, content),
    },
    text,
  );
  return opener;
}

/** Two sheets, or an arrow into a tray. @param {'copy'|'save'} kind */
export const icon = (kind) =>
  svg(
    'svg',
    { class: 'icon-tool', viewBox: '0 0 12 12', 'aria-hidden': 'true' },
    svg('path', {
      d:
        kind === 'copy'
          ? 'M 4.5 4.5 H 10.5 V 10.5 H 4.5 Z M 2.5 7.5 H 1.5 V 1.5 H 7.5 V 2.5'
          : 'M 6 1 V 7.5 M 3.2 4.8 L 6 7.6 L 8.8 4.8 M 1.5 10.5 H 10.5',
    }),
  );
