/** A dialog over the page: Escape and the focus's return are the browser's. What is in it is made as it opens. */
import { button, h, setText } from '../ui/index.js';

/**
 * @typedef {object} Modal
 * @property {HTMLDialogElement} node
 * @property {HTMLElement} body
 * @property {(title: string|Node) => void} title
 * @property {() => void} close
 */

let made = 0;

/**
 * @param {string} testid @param {string|Node} title @param {{kind?: string, onClose?: () => void}} [how]
 * @returns {Modal} open; it leaves the page when it is closed
 */
export function openModal(testid, title, { kind = '', onClose } = {}) {
  const id = `modal-${++made}`;
  const heading = h('h2', { id, tabindex: -1 });
  const body = h('div', { class: 'modal-body' });
  const close = () => node.close();
  const node = h(
    'dialog',
    { class: `modal ${kind}`, 'aria-labelledby': id, 'data-testid': testid },
    h(
      'div',
      { class: 'modal-head' },
      heading,
      button({ class: 'modal-close', 'data-testid': `${testid}-close`, onclick: close }, 'Close'),
    ),
    body,
  );
  const say = (/** @type {string|Node} */ words) =>
    typeof words === 'string' ? setText(heading, words) : heading.replaceChildren(words);
  say(title);
  node.addEventListener('close', () => {
    node.remove();
    onClose?.();
  });
  // a press beside it; the dialog's own box is filled by its children
  node.addEventListener('pointerdown', (e) => e.target === node && close());
  document.body.append(node);
  node.showModal();
  heading.focus({ preventScroll: true });
  return { node, body, title: say, close };
}

/** A line that tells how an action went. @param {string} testid */
export function outcome(testid) {
  const node = h('p', { class: 'outcome', role: 'status', 'data-testid': testid });
  return {
    node,
    /** @param {string} words @param {boolean} [bad] */
    say(words, bad = false) {
      node.classList.toggle('bad', bad);
      setText(node, words);
    },
  };
}

/**
 * A button whose act talks to the server: it cannot be pressed twice meanwhile, and a refusal is told.
 * @param {Record<string, unknown>} attributes
 * @param {string} label
 * @param {() => Promise<unknown>} act
 * @param {(error: unknown) => void} onError
 */
export function actButton(attributes, label, act, onError) {
  const node = button(
    {
      ...attributes,
      onclick: async () => {
        if (node.getAttribute('aria-disabled')) return;
        node.setAttribute('aria-disabled', 'true'); // it keeps the focus
        try {
          await act();
        } catch (error) {
          onError(error);
        } finally {
          node.removeAttribute('aria-disabled');
        }
      },
    },
    label,
  );
  return node;
}

/** A field with its label above. @param {string} label @param {HTMLElement} field @param {...(Node|string)} after */
export const labelled = (label, field, ...after) =>
  h('label', { class: 'labelled' }, h('span', {}, label), field, ...after);

/**
 * A link that is there to be copied: it can be selected, too.
 * @param {string} testid @param {string} label @param {string} link @param {(text: string) => Promise<boolean>} copy
 */
export function linkField(testid, label, link, copy) {
  const field = h('input', { class: 'wide', readonly: true, 'data-testid': testid, value: link, spellcheck: 'false' });
  field.addEventListener('focus', () => field.select());
  const told = outcome(`${testid}-told`);
  const press = actButton(
    { 'data-testid': `${testid}-copy` },
    'Copy',
    async () => ((await copy(link)) ? told.say('Copied.') : (field.select(), told.say('Press Ctrl+C to copy it.'))),
    () => told.say('Select it and copy it.', true),
  );
  return h('div', { class: 'link-field' }, labelled(label, field), press, told.node);
}
