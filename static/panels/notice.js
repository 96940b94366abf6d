/** A quiet word on what could not be taken from a link, until it is dismissed or the design changes. */
import { h, setText } from '../dom.js';

export class Notice {
  /** @type {string|null} */ #told = null;
  /** @type {unknown} */ #design = null;

  /** @param {HTMLElement} root @param {import('../store.js').Store} store */
  constructor(root, store) {
    this.root = root;
    this.store = store;
    this.text = h('span', { role: 'status', 'data-testid': 'notice' });
    root.className = 'notice';
    root.hidden = true;
    root.append(this.text, h('button', { type: 'button', 'data-testid': 'notice-close', onclick: () => store.set({ notice: null }) }, 'Dismiss'));
  }

  /** @param {import('../types.js').State} state */
  render({ notice, design }) {
    if (notice !== this.#told) {
      this.#told = notice;
      this.#design = design;
      this.root.hidden = !notice;
      setText(this.text, notice ?? '');
    } else if (notice && design !== this.#design) this.store.set({ notice: null });
  }
}
