/**
 * What was found, in figures: a row for each design that the brush keeps. A row under the pointer, or one that has the
 * focus, is shown by the whole page.
 * @typedef {import('./shapes.js').Found} Found
 * @typedef {import('./scatter.js').Seen & {found: Found}} Seen
 */
import { say, t } from '../text/index.js';
import { colorOf, letterOf } from '../model/index.js';
import { button, h, head, setAttr, wide } from '../ui/index.js';
import { isHigher } from './settings.js';
import { readOf } from './scatter_math.js';

export class FoundTable {
  /** @type {Found|null} */ #found = null;
  /** @type {HTMLTableRowElement[]} */ #rows = [];
  /** @type {number|null} the figure by which rows stand in order; null: as found */ #by = null;
  #order = '';

  /** @param {{look: (index: number) => void, take: (index: number) => void, pin: (index: number) => void}} tell */
  constructor(tell) {
    this.tell = tell;
    this.body = h('tbody');
    this.head = h('thead');
    this.table = h('table', { class: 'compare-table find-table', 'data-testid': 'find-table' }, this.head, this.body);
    this.node = wide('Designs found', this.table, 'scroll sideways find-scroll');
    const indexAt = (/** @type {Event} */ e) => {
      const row = /** @type {Element} */ (e.target).closest('tr[data-index]');
      return row ? Number(row.getAttribute('data-index')) : -1;
    };
    let pointed = false; // a row that has the focus stays shown, where it scrolls away under a pointer that rests
    this.body.addEventListener('pointermove', (e) => {
      if (e.pointerType === 'touch') return;
      pointed = true;
      tell.look(indexAt(e));
    });
    this.body.addEventListener('pointerleave', () => {
      if (pointed) tell.look(-1);
      pointed = false;
    });
    this.body.addEventListener('pointerup', (e) => e.pointerType === 'touch' && tell.look(indexAt(e)));
    this.body.addEventListener('focusin', (e) => {
      pointed = false;
      tell.look(indexAt(e));
    });
    this.body.addEventListener('focusout', (e) => {
      if (!(e.relatedTarget instanceof Node && this.body.contains(e.relatedTarget))) tell.look(-1);
    });
  }

  /** @param {Found} found */
  #build(found) {
    this.#found = found;
    this.#by = null;
    this.#order = '';
    const sorted = (/** @type {number} */ k) =>
      button(
        {
          class: 'find-sort',
          'data-testid': `find-sort-${k}`,
          title: 'In the order of this figure, the best first',
          onclick: () => {
            this.#by = this.#by === k ? null : k;
            if (this.#seen) this.show(this.#seen);
          },
        },
        found.figures[k].title,
      );
    this.head.replaceWith(
      (this.head = head([
        h('th', { scope: 'col' }, h('span', { class: 'sr' }, 'Design')),
        ...found.figures.map((_, k) => h('th', { scope: 'col', 'aria-sort': 'none' }, sorted(k))),
        h('th', { scope: 'col' }, h('span', { class: 'sr' }, 'What to do')),
      ])),
    );
    this.#rows = found.designs.map((design, i) => {
      const missed = found.requirements.flatMap(({ figure }, r) => (design.required[r]?.met ? [] : [figure]));
      const shares = found.requirements.flatMap(({ figure }, r) => {
        const share = design.required[r]?.share;
        return share === undefined ? [] : [{ figure, share }];
      });
      const name = say`Design ${i + 1}`;
      return h(
        'tr',
        { 'data-index': i, 'data-testid': `find-found-${i}` },
        h(
          'th',
          { scope: 'row', class: 'method-name' },
          h('span', { class: 'find-badge' }),
          h('span', { class: 'sr' }, name),
        ),
        found.figures.map((_, k) => {
          const { text } = design.figures[k];
          const share = shares.find(({ figure }) => figure === k)?.share;
          return h(
            'td',
            { class: missed.includes(k) ? 'warn' : undefined },
            missed.includes(k) ? h('span', { title: t('misses what is asked') }, '✕ ') : null,
            text,
            share === undefined ? null : h('small', {}, say` on ${Math.floor(1000 * share) / 10} %`),
          );
        }),
        h(
          'td',
          { class: 'find-tools' },
          button(
            {
              'data-testid': `find-take-${i}`,
              'aria-label': say`Take ${name}`,
              title: 'Makes it the present design; Undo takes it back',
              onclick: () => this.tell.take(i),
            },
            'Take',
          ),
          button(
            {
              'data-testid': `find-pin-${i}`,
              'aria-label': say`Pin ${name}`,
              title: 'Keeps it beside the present design',
              onclick: () => this.tell.pin(i),
            },
            'Pin',
          ),
        ),
      );
    });
  }

  /** @type {Seen|null} */ #seen = null;

  /** @param {Seen} seen */
  show(seen) {
    this.#seen = seen;
    const { found, kept, active, taken, pins } = seen;
    if (found !== this.#found) this.#build(found);
    const by = this.#by;
    const cost = (/** @type {number} */ i) => {
      const v = by === null ? i : (readOf(found, found.designs[i], by) ?? Infinity);
      return by !== null && isHigher(found.figures[by].measure) && Number.isFinite(v) ? -v : v;
    };
    const order = [...kept].sort((a, b) => cost(a) - cost(b) || a - b);
    const key = order.join();
    if (key !== this.#order) this.body.replaceChildren(...order.map((i) => this.#rows[i]));
    this.#order = key;
    [...this.head.querySelectorAll('th')].slice(1, -1).forEach((cell, k) => {
      const way = isHigher(found.figures[k].measure) ? 'descending' : 'ascending';
      setAttr(cell, 'aria-sort', k === by ? way : 'none');
    });
    this.#rows.forEach((row, i) => {
      row.classList.toggle('active', i === active);
      row.classList.toggle('current', i === taken);
      const mark = /** @type {Element} */ (row.querySelector('.find-badge'));
      const pin = pins.get(i);
      const text = pin !== undefined ? letterOf(pin) : i === taken ? '●' : '';
      if (mark.textContent !== text) mark.textContent = text;
      mark.className = `find-badge${pin === undefined ? '' : ` badge ${colorOf(pin)}`}`;
      const take = /** @type {HTMLButtonElement} */ (row.querySelector('[data-testid^="find-take"]'));
      take.setAttribute('aria-pressed', String(i === taken));
    });
  }
}
