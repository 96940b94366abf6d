/**
 * The table of the pinned designs: their figures, how far each is from the present design's, and the best of each
 * column.
 */
import { polesText } from '../text/index.js';
import { differenceTable, FIGURES, nameOf } from '../model/index.js';
import { button, groupedHead, h, keepingFocus, printed, setAttr, setText, whileSeen, wide } from '../ui/index.js';
import { badge } from '../panels/index.js';

/** @typedef {import('../types.js').Pin} Pin @typedef {import('../types.js').Design} Design */

/** @param {Design} design */
const described = (design) =>
  [polesText(design.poles), nameOf(design), design.outer === 'pi' ? 'PI' : 'inner loop alone'].join(' · ');

/** @param {import('../model/pins.js').Figure} f */
const heading = (f) =>
  f.symbol?.startsWith('V_') ? h('span', {}, printed(f.symbol), ` ${f.name}`) : f.symbol ? printed(f.symbol) : f.name;

/** A figure and its difference, written in place while a pole moves. */
class Cell {
  /** @param {string} testid */
  constructor(testid) {
    this.text = h('span');
    this.best = h('span', { class: 'sr' });
    this.mark = h('span', { 'aria-hidden': 'true' });
    this.shift = h('span');
    this.verdict = h('span', { class: 'sr' });
    this.small = h('small', {}, this.mark, this.shift, this.verdict);
    this.node = h('td', { 'data-testid': testid }, this.text, this.best, this.small);
  }

  /** @param {ReturnType<typeof differenceTable>[number][number]} c */
  show({ text, shift, best, better }) {
    setAttr(this.node, 'class', best ? 'best' : '');
    setAttr(this.small, 'class', !shift ? '' : better ? 'better' : 'worse');
    setText(this.text, text);
    setText(this.best, best ? ', best' : '');
    setText(this.mark, !shift ? '' : better ? '▲ ' : '▼ ');
    setText(this.shift, shift);
    setText(this.verdict, !shift ? '' : better ? ', better' : ', worse');
  }
}

const UNSTABLE = '✕ unstable';

export class PinsPanel {
  /** @type {unknown[]} */ #seen = [];
  /** @type {Pin[]} */ #pins = [];
  /** @type {Cell[][]} */ #cells = [];
  #visible = false;
  /** @type {number|null} */ #naming = null;

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.root = root;
    this.store = store;
    this.rows = h('tbody');
    this.unstable = h('b', { class: 'unstable-word' });
    const table = h(
      'table',
      { class: 'compare-table pins-table', 'data-testid': 'pins-table' },
      groupedHead('Design', FIGURES, heading),
      this.rows,
    );
    root.append(
      h(
        'p',
        { class: 'caption' },
        'Below each figure, how far it is from the present design’s: ▲ better, ▼ worse. The best of a column is in ' +
          'bold.',
      ),
      wide('Table of the pinned designs', table),
    );
    whileSeen(table, (seen) => {
      this.#visible = seen;
      this.render(store.state);
    });
  }

  /** @param {import('../types.js').State} state */
  render({ pins, reply }) {
    this.root.hidden = !pins.length;
    if (!this.#visible || !pins.length || this.#naming !== null) return;
    const now = [pins, reply];
    if (now.every((v, i) => v === this.#seen[i])) return;
    this.#seen = now;
    if (pins !== this.#pins) this.#build(pins);
    setText(this.unstable, reply && !reply.stable ? UNSTABLE : '');
    differenceTable([reply, ...pins.map((p) => p.reply)]).forEach((row, i) =>
      row.forEach((c, j) => this.#cells[i][j].show(c)),
    );
  }

  /** @param {Pin[]} pins */
  #build(pins) {
    this.#pins = pins;
    this.#cells = ['present', ...pins.map((p) => String(p.index))].map((id) =>
      FIGURES.map((f) => new Cell(`pin-${id}-${f.id}`)),
    );
    const nodes = (/** @type {number} */ i) => this.#cells[i].map((c) => c.node);
    const present = h(
      'tr',
      { class: 'current', 'data-testid': 'pin-row-present' },
      h('th', { scope: 'row', class: 'method-name' }, h('span', {}, 'Present design'), ' ', this.unstable),
      nodes(0),
    );
    const rows = pins.map((pin, i) => this.#row(pin, nodes(i + 1)));
    keepingFocus(this.rows, () => this.rows.replaceChildren(present, ...rows));
  }

  /** @param {Pin} pin @param {HTMLElement[]} cells */
  #row(pin, cells) {
    const tool = (
      /** @type {string} */ id,
      /** @type {string} */ text,
      /** @type {string} */ label,
      /** @type {() => void} */ act,
    ) => button({ 'data-testid': `pin-${id}-${pin.index}`, 'aria-label': label, title: label, onclick: act }, text);
    const name = h('span', { class: 'pin-name' }, pin.name);
    const head = h(
      'th',
      { scope: 'row', class: 'method-name', title: described(pin.design) },
      badge(pin.index),
      ' ',
      name,
      pin.reply && !pin.reply.stable ? [' ', h('b', { class: 'unstable-word' }, UNSTABLE)] : null,
      h('small', {}, pin.refused ? `Not computed: ${pin.refused}` : described(pin.design)),
      h(
        'span',
        { class: 'tools' },
        tool('use', 'Use', `Make ${pin.name} the present design`, () => this.store.usePin(pin.id)),
        tool('rename', 'Rename', `Rename ${pin.name}`, () => this.#rename(pin, name)),
        tool('delete', 'Unpin', `Unpin ${pin.name}`, () => this.store.unpin(pin.id)),
      ),
    );
    return h('tr', { 'data-testid': `pin-row-${pin.index}` }, head, cells);
  }

  /** @param {Pin} pin @param {HTMLElement} name */
  #rename(pin, name) {
    this.#naming = pin.id;
    const input = h('input', {
      class: 'pin-rename',
      maxlength: 60,
      'aria-label': `Name of ${pin.name}`,
      'data-testid': `pin-name-${pin.index}`,
    });
    input.value = pin.name;
    const finish = (/** @type {boolean} */ keep) => {
      if (this.#naming !== pin.id) return;
      this.#naming = null;
      this.#seen = [];
      this.#pins = [];
      setText(name, pin.name);
      const text = input.value.trim();
      if (keep && text && text !== pin.name) this.store.changePin(pin.id, { name: text });
      else this.render(this.store.state);
    };
    input.addEventListener('keydown', (e) => {
      if (e.key !== 'Enter' && e.key !== 'Escape') return;
      finish(e.key === 'Enter');
      requestAnimationFrame(() =>
        /** @type {HTMLElement|null} */ (this.rows.querySelector(`[data-testid="pin-rename-${pin.index}"]`))?.focus(),
      );
    });
    input.addEventListener('blur', () => finish(true));
    name.replaceChildren(input);
    input.select();
  }
}
