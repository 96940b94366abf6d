/**
 * Two quiet words at the lower edge: what could not be taken from a link, until it is dismissed or the design changes; and that what is shown is an older
 * design's while the server is away.
 */
import { h, setText } from '../dom.js';

export class Notice {
  /** @type {string|null} */ #told = null;
  /** @type {unknown} */ #design = null;

  /** @param {HTMLElement} root @param {import('../store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.root = root;
    this.text = h('span', { role: 'status', 'data-testid': 'notice' });
    this.link = h('div', { class: 'notice', hidden: true }, this.text, h('button', { type: 'button', 'data-testid': 'notice-close', onclick: () => store.set({ notice: null }) }, 'Dismiss'));
    this.stale = h('div', { class: 'notice', role: 'status', hidden: true, 'data-testid': 'stale' }, 'No connection: responses and figures are those of the last answer. Your changes are kept and sent when it returns.');
    root.className = 'notices';
    root.append(this.stale, this.link);
  }

  /** @param {import('../types.js').State} state */
  render({ notice, design, answered, connection }) {
    const stale = connection === 'lost' && design !== null && answered !== design;
    this.stale.hidden = !stale;
    document.documentElement.classList.toggle('stale', stale);
    if (notice !== this.#told) {
      this.#told = notice;
      this.#design = design;
      this.link.hidden = !notice;
      setText(this.text, notice ?? '');
    } else if (notice && design !== this.#design) this.store.set({ notice: null });
  }
}
