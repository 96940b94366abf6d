/**
 * A small card for the symbol under the pointer, the finger or the keyboard's focus: name, meaning, value now, unit. A
 * formula is one stop of the Tab key;
 * the arrow keys walk through its symbols.
 */
import { formula, h, setText } from '../ui/index.js';
import { figure } from './math.js';
import { rich } from './rich.js';
import { Glossary, symbolsIn, worthOf } from './symbols.js';

/** @typedef {import('./symbols.js').Term} Term @typedef {import('./symbols.js').Now} Now */
const LEAVE_MS = 220; // long enough to move onto the card
const MARGIN = 8;
const HINT = 'symbol-hint';

/** The one card of the page. @type {HTMLElement|undefined} */ let card;
/** @type {SymbolCards|null} */ let owner = null;
/** @type {Element|null} */ let shown = null;
/** @type {ReturnType<typeof setTimeout>|undefined} */ let leaving;

/** @param {HTMLElement} root it is drawn above all, so any landmark will do */
function make(root) {
  const node = h('div', {
    class: 'symbol-card',
    id: 'symbol-card',
    role: 'tooltip',
    popover: 'manual',
    'data-testid': 'symbol-card',
  });
  node.addEventListener('pointerenter', () => clearTimeout(leaving));
  node.addEventListener('pointerleave', leave);
  root.append(
    node,
    h(
      'p',
      { id: HINT, class: 'sr' },
      'The arrow keys walk through the symbols; each shows its name, meaning, value and unit.',
    ),
  );
  addEventListener('scroll', () => shown && place(), { passive: true, capture: true });
  addEventListener('keydown', (e) => {
    if (e.key === 'Escape' && shown) close();
  });
  addEventListener('pointerdown', (e) => {
    if (shown && !(/** @type {Element} */ (e.target).closest('[data-symbol], .symbol-card'))) close();
  });
  return node;
}

function close() {
  clearTimeout(leaving);
  for (const node of document.querySelectorAll('.same-symbol')) node.classList.remove('same-symbol');
  shown?.removeAttribute('aria-describedby');
  shown = owner = null;
  if (card?.matches(':popover-open')) card.hidePopover();
}

function leave() {
  clearTimeout(leaving);
  leaving = setTimeout(() => {
    if (shown !== document.activeElement) close();
  }, LEAVE_MS);
}

function place() {
  if (!card || !shown) return;
  const a = shown.getBoundingClientRect();
  if (a.bottom < 0 || a.top > innerHeight) return close();
  const { width, height } = card.getBoundingClientRect();
  const above = a.top - 6 - height >= MARGIN;
  const top = above ? a.top - 6 - height : a.bottom + 6;
  const left = Math.max(MARGIN, Math.min(a.left + a.width / 2 - width / 2, innerWidth - width - MARGIN));
  Object.assign(card.style, { left: `${left}px`, top: `${top}px` });
}

export class SymbolCards {
  /** @type {Glossary|undefined} */ #glossary;
  /** @type {WeakMap<Element, Term>} */ #terms = new WeakMap();

  /** @param {HTMLElement} root in which symbols have cards @param {() => Now} now */
  constructor(root, now) {
    this.root = root;
    this.now = now;
    const at = (/** @type {Event} */ e) =>
      /** @type {Element|null} */ (/** @type {Element} */ (e.target).closest?.('[data-symbol]'));
    root.addEventListener('pointerover', (e) => {
      const symbol = at(e);
      if (symbol && e.pointerType !== 'touch') this.#open(symbol);
    });
    root.addEventListener('pointerout', (e) => {
      if (at(e)) leave();
    });
    root.addEventListener('focusin', (e) => {
      const symbol = at(e);
      if (symbol) this.#open(symbol);
    });
    root.addEventListener('focusout', (e) => {
      if (at(e) === shown) leave();
    });
    root.addEventListener('click', (e) => {
      const symbol = at(e);
      if (symbol) this.#open(symbol);
    });
    root.addEventListener('keydown', (e) => this.#walk(e));
  }

  /** @param {Term[]} terms */
  learn(terms) {
    card ??= make(this.root); // with the hint that the formulas refer to
    this.#glossary = new Glossary(terms, (mathml) => /** @type {Element} */ (formula(mathml)));
  }

  /**
   * Makes the symbols of all formulas in there known; what they mean depends on the chapter.
   * @param {Element} part
   * @param {string} [chapter]
   */
  mark(part, chapter = '') {
    const glossary = this.#glossary;
    if (!glossary) return;
    for (const math of part.querySelectorAll('math:not(.sym > *)')) {
      const found = symbolsIn(math, (sign, applied) => glossary.find(sign, applied, chapter));
      for (const { element: sign, term } of found) {
        const element = /** @type {Element} */ (sign);
        element.setAttribute('data-symbol', term.name);
        element.setAttribute('tabindex', '-1');
        this.#terms.set(element, term);
      }
      const box = math.closest('.scroll');
      if (found.length && box) box.setAttribute('aria-describedby', HINT);
    }
  }

  /** The values have changed. */
  refresh() {
    if (shown && owner === this) this.#fill(shown);
  }

  /** @param {Element} symbol */
  #open(symbol) {
    clearTimeout(leaving);
    if (symbol === shown) return;
    close();
    owner = this;
    shown = symbol;
    this.#fill(symbol);
    symbol.setAttribute('aria-describedby', 'symbol-card');
    const name = symbol.getAttribute('data-symbol');
    for (const other of symbol.closest('article, .card')?.querySelectorAll(`[data-symbol="${name}"]`) ?? [])
      other.classList.add('same-symbol');
    card?.showPopover();
    place();
  }

  /** @param {Element} symbol */
  #fill(symbol) {
    const term = this.#terms.get(symbol);
    if (!term || !card) return;
    card.replaceChildren(...cardOf(term, this.now()));
    place();
  }

  /** Arrow keys from symbol to symbol of one formula; Escape leaves to the formula. @param {KeyboardEvent} e */
  #walk(e) {
    if (
      e.altKey ||
      e.ctrlKey ||
      e.metaKey ||
      !['ArrowLeft', 'ArrowRight', 'Home', 'End', 'Enter', 'Escape'].includes(e.key)
    )
      return;
    const target = /** @type {Element} */ (e.target);
    const box = /** @type {HTMLElement|null} */ (target.closest('.scroll'));
    const inside = target.hasAttribute('data-symbol');
    if (!box || (target !== box && !inside)) return;
    const all = /** @type {HTMLElement[]} */ ([...box.querySelectorAll('[data-symbol]')]);
    if (!all.length || (!inside && ['ArrowLeft', 'Escape'].includes(e.key)) || (inside && e.key === 'Enter')) return;
    e.preventDefault();
    if (e.key === 'Escape') {
      close();
      return box.focus({ preventScroll: true });
    }
    const i = all.indexOf(/** @type {HTMLElement} */ (target));
    const to =
      e.key === 'Home' || !inside
        ? e.key === 'End'
          ? all.length - 1
          : 0
        : e.key === 'End'
          ? all.length - 1
          : i + (e.key === 'ArrowRight' ? 1 : -1);
    const next = all[Math.max(0, Math.min(all.length - 1, to))];
    next.focus({ preventScroll: true });
    next.scrollIntoView({ block: 'nearest', inline: 'nearest' });
  }
}

/** Unit as it is written; 1 is none. @param {string} unit */
const unitOf = (unit) => (unit === '1' ? 'dimensionless' : unit);

/** A symbol by itself: the bracket that tells a function from a letter is left out. @param {Term} term */
function signFor(term) {
  const sign = /** @type {Element} */ (formula(term.mathml));
  if (term.latex?.endsWith('(')) for (const mo of sign.querySelectorAll('mo')) if (mo.textContent === '(') mo.remove();
  return sign;
}

/** @param {Term} term @param {Now} now @returns {Node[]} */
function cardOf(term, now) {
  const { text, matrix, of } = worthOf(term.name, now, term.part);
  const sign = signFor(term);
  const value = matrix ? small(matrix) : h('span', { class: 'worth' }, text ?? 'no value for this rig');
  return [
    h('p', { class: 'meaning' }, h('span', { class: 'sign' }, sign), h('span', {}, rich(term.meaning))),
    h(
      'dl',
      {},
      h('dt', {}, of ? `now, ${of}` : 'now'),
      h('dd', { 'data-testid': 'symbol-value' }, value),
      ...(term.unit ? [h('dt', {}, 'unit'), h('dd', { 'data-testid': 'symbol-unit' }, unitOf(term.unit))] : []),
    ),
  ];
}

/** @param {number[][]} matrix */
const small = (matrix) =>
  h(
    'table',
    { class: 'small-matrix' },
    h(
      'tbody',
      {},
      matrix.map((row) =>
        h(
          'tr',
          {},
          row.map((v) => h('td', {}, figure(v, 4))),
        ),
      ),
    ),
  );

/** All symbols as a list: the way to the cards' content without pointing at anything. */
export class SymbolList {
  /** @type {{name: string, cell: HTMLElement}[]} */ #values = [];

  /** @param {Term[]} terms */
  constructor(terms) {
    this.node = h(
      'dl',
      { class: 'symbol-list', 'data-testid': 'symbol-list' },
      terms.map((term) => {
        const cell = h('span', { class: 'worth' });
        this.#values.push({ name: term.name, cell });
        return h(
          'div',
          {},
          h('dt', {}, signFor(term)),
          h('dd', {}, rich(term.meaning), term.unit && term.unit !== '1' ? ` (${term.unit})` : '', cell),
        );
      }),
    );
  }

  /** @param {Now} now */
  render(now) {
    for (const { name, cell } of this.#values) {
      const { text, matrix } = worthOf(name, now);
      setText(cell, text ? `: ${text}` : matrix ? `: ${matrix.length} × ${matrix[0].length}` : '');
    }
  }
}
