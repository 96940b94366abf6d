/**
 * Shows the view that the state names: what belongs to another one is not drawn, and takes no keys. Views are reached
 * by links, so that Back, new tabs and bookmarks know them; G and a letter does the same.
 * @typedef {import('../types.js').View} View
 */
import { say, t } from '../text/index.js';
import { isRead, VIEWS } from '../model/index.js';
import { button, h, remember, rescale } from '../ui/index.js';

const names = /** @type {View[]} */ (Object.keys(VIEWS));

/** Goes there as a link does. @param {View} view */
export const goTo = (view) => {
  location.hash = view;
};

/** The views' links, and the one to labs. */
export const viewLinks = () => [
  h(
    'nav',
    { class: 'views', 'aria-label': 'Views' },
    names.map((name) =>
      h(
        'a',
        {
          href: `#${name}`,
          'data-testid': `view-${name}`,
          title: say`${t(VIEWS[name].about)} (G, then ${VIEWS[name].key})`,
        },
        VIEWS[name].title,
      ),
    ),
  ),
  h(
    'span',
    { class: 'views to-labs' },
    h(
      'a',
      { href: '#labs', 'data-testid': 'view-labs', title: 'Steps with goals, alone or in a class (G, then L)' },
      'Labs',
    ),
  ),
];

/** @param {EventTarget|null} target */
const isTyping = (target) =>
  target instanceof HTMLElement &&
  target.matches('input:not([type=checkbox], [type=radio], [type=range]), textarea, select');

export class ViewSwitch {
  /** @type {View|null} */ #shown = null;
  /** @type {View|null} what is remembered */ #kept = null;
  #led = -Infinity;

  /** @param {import('../link/address.js').Address} address */
  constructor(address) {
    this.address = address;
    this.title = document.title;
    document.addEventListener('keydown', (e) => this.#key(e));
    const plane = button(
      {
        class: 'plane-toggle',
        'data-testid': 'plane-toggle',
        'aria-controls': 'splane',
        'aria-expanded': 'false',
        onclick: () => plane.setAttribute('aria-expanded', String(root.classList.toggle('plane-open'))),
      },
      's-plane',
    ); // where there is no room beside the text
    const root = document.documentElement;
    document.body.append(plane);
  }

  /** @param {KeyboardEvent} e */
  #key(e) {
    if (e.ctrlKey || e.metaKey || e.altKey || isTyping(e.target)) return;
    const key = e.key.toUpperCase();
    const to = key === 'L' ? 'labs' : names.find((name) => VIEWS[name].key === key);
    if (to && e.timeStamp - this.#led < 1500) {
      e.preventDefault();
      location.hash = to;
    }
    this.#led = key === 'G' ? e.timeStamp : -Infinity;
  }

  /** @param {{view: View, design: import('../types.js').Design|null}} state */
  render({ view, design }) {
    // before there is a design, nobody has chosen: what is remembered then would end a first visit
    if (design && view !== this.#kept) remember('view', (this.#kept = view));
    const first = this.#shown === null;
    if (view === this.#shown) return;
    this.#shown = view;
    const page = document.documentElement;
    page.dataset.view = view;
    rescale(); // views have types and lines of their own
    page.classList.toggle('reading', isRead(view));
    for (const node of document.querySelectorAll('[data-views]'))
      node.classList.toggle('elsewhere', !node.getAttribute('data-views')?.split(' ').includes(view));
    for (const name of names) {
      const link = document.querySelector(`[data-testid="view-${name}"]`);
      if (name === view) link?.setAttribute('aria-current', 'page');
      else link?.removeAttribute('aria-current');
    }
    document.title = view === 'explore' ? this.title : `${t(VIEWS[view].title)} · ${this.title}`;
    const place = this.address.place;
    if (place) document.getElementById(place)?.scrollIntoView();
    else if (!first || this.address.toTop) scrollTo(0, 0);
  }
}
