/**
 * Three quiet words at the lower edge: what could not be taken from a link, until it is dismissed or the design
 * changes; that a part of the page fails, until it is dismissed; and that what is shown is an older design's while the
 * server is away.
 */
import { button, h, setText } from '../ui/index.js';

/** A line that can be dismissed. */
class Line {
  /** @param {string} name @param {() => void} dismiss */
  constructor(name, dismiss) {
    this.text = h('span', { role: 'status', 'data-testid': name });
    this.node = h(
      'div',
      { class: 'notice', hidden: true },
      this.text,
      button({ 'data-testid': `${name}-close`, onclick: dismiss }, 'Dismiss'),
    );
  }

  /** @param {string|null} words */
  say(words) {
    this.node.hidden = !words;
    setText(this.text, words ?? '');
  }
}

export class Notice {
  /** @type {string|null} */ #told = null;
  /** @type {unknown} */ #design = null;

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.root = root;
    this.link = new Line('notice', () => store.set({ notice: null }));
    this.fault = new Line('fault', () => store.set({ fault: null }));
    this.stale = h(
      'div',
      { class: 'notice', role: 'status', hidden: true, 'data-testid': 'stale' },
      'No connection: responses and figures show the last answer. Your changes are kept and sent when it returns.',
    );
    root.className = 'notices';
    root.append(this.stale, this.fault.node, this.link.node);
  }

  /** @param {import('../types.js').State} state */
  render({ notice, fault, design, answered, heard, connection, problem }) {
    const unheard = connection === 'lost' && design !== null && answered !== design;
    this.stale.hidden = !unheard;
    document.documentElement.classList.toggle('unheard', unheard);
    // a refused design has no figures: those shown are older
    document.documentElement.classList.toggle('stale', unheard || problem !== null);
    // numbers of this design, computed here, beside what the server said of an earlier one
    document.documentElement.classList.toggle('earlier', heard !== answered);
    this.fault.say(fault);
    if (notice !== this.#told) {
      this.#told = notice;
      this.#design = design;
      this.link.say(notice);
    } else if (notice && design !== this.#design) this.store.set({ notice: null });
  }
}
