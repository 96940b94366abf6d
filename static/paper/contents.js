/** The table of contents: chapters, and of the chapter that is being read its steps. */
import { h } from '../ui/index.js';
import { anchorOf, shortOf } from './math.js';
import { BEYOND } from './beyond_words.js';
import { CHAPTERS, MARKS } from './words.js';

/** @typedef {import('./math.js').Equation} Equation */
const APPENDIX = [
  ['paper-numbers', 'Every printed number'],
  ['paper-errata', 'Errata'],
  ['paper-consequence', 'What the unequal digits mean'],
  ['paper-symbols', 'Symbols'],
];
const HERE = 0.25; // share of the window's height above which the step that is read begins

/** @param {Equation[]} equations @param {...Node} more below */
export function contents(equations, ...more) {
  const stop = (/** @type {Equation} */ e) =>
    h(
      'a',
      { class: e.status, href: `#${anchorOf(e.number)}`, title: `${e.number}: ${e.status}` },
      h('span', { class: 'stop-mark', 'aria-hidden': 'true' }, MARKS[e.status]),
      h('span', { class: 'stop-title' }, e.title),
      /^(Eq|Fig|Table)/.test(e.number) ? h('span', { class: 'stop-number' }, shortOf(e.number)) : null,
    );
  return h(
    'nav',
    { class: 'contents', 'aria-label': 'Contents of the paper', 'data-testid': 'paper-contents' },
    h(
      'ol',
      {},
      CHAPTERS.map(({ name, title }) =>
        h(
          'li',
          { 'data-chapter': name },
          h('a', { href: `#paper-${name}` }, title),
          h('div', { class: 'stops' }, equations.filter((e) => e.chapter === name).map(stop)),
        ),
      ),
      [...BEYOND.map(({ name, title }) => [`paper-${name}`, title]), ...APPENDIX].map(([id, title]) =>
        h('li', {}, h('a', { href: `#${id}` }, title)),
      ),
    ),
    more,
  );
}

/**
 * Marks the step at which the reader is, and opens its chapter's list.
 * @param {HTMLElement} nav
 * @param {HTMLElement} text
 */
export function follow(nav, text) {
  const links = new Map([...nav.querySelectorAll('a')].map((a) => [a.getAttribute('href')?.slice(1), a]));
  const places = /** @type {HTMLElement[]} */ ([...text.querySelectorAll('article.eq, section.chapter')]).filter((e) =>
    links.has(e.id),
  );
  const seen = new Set();
  const spy = new IntersectionObserver(
    (entries) => {
      for (const { target, isIntersecting } of entries) isIntersecting ? seen.add(target) : seen.delete(target);
      const here = places.filter((e) => seen.has(e)).at(-1); // a step lies within its chapter, and counts before it
      if (!here) return;
      for (const [id, link] of links)
        id === here.id ? link.setAttribute('aria-current', 'location') : link.removeAttribute('aria-current');
      const own = links.get(here.id)?.closest('li');
      for (const item of nav.querySelectorAll('li')) item.classList.toggle('current', item === own);
      const link = links.get(here.id);
      if (link && nav.scrollHeight > nav.clientHeight)
        nav.scrollTop = Math.max(0, link.offsetTop - nav.clientHeight / 2);
    },
    { rootMargin: `0px 0px -${100 * (1 - HERE)}% 0px` },
  );
  for (const place of places) spy.observe(place);
}
