/** What is folded away behind a summary; Escape and a cross close it, and the focus returns. */
import { button, h } from '../ui/index.js';

/**
 * @param {{testid: string, kind: string, summary: HTMLElement, what: string}} how  what: is closed, in a few words
 * @param {(close: HTMLElement) => import('../ui/dom.js').Child[]} content
 */
export function folded({ testid, kind, summary, what }, content) {
  const close = () => {
    details.open = false;
    summary.focus();
  };
  const cross = button(
    {
      class: 'quiet close',
      'data-testid': `${testid}-close`,
      'aria-label': `Close the ${what}`,
      title: 'Close (Esc)',
      onclick: close,
    },
    '✕',
  );
  const body = h('div', { class: `${testid}-body`, 'data-testid': `${testid}-body` }, content(cross));
  const details = h('details', { class: kind }, summary, body);
  details.addEventListener('keydown', (e) => e.key === 'Escape' && close());
  return details;
}
