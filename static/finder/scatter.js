/**
 * The scatter of two figures: each point a design. Under the pointer, or by the arrow keys, the page shows it; a click
 * or Enter takes it, another pins it; a drag keeps those within a rectangle. What a search has so far is grey.
 * @typedef {import('./shapes.js').Drawn} Drawn
 * @typedef {import('./scatter_math.js').Point} Point
 * @typedef {import('./scatter_math.js').Range} Range
 */
import { say, significant, t } from '../text/index.js';
import { letterOf } from '../model/index.js';
import { drawingUnit, h, setAttr, setText, svg } from '../ui/index.js';
import { EDGE, frameOf } from './scatter_frame.js';
import { limitsOn, nearest, pointsOf, rangeOf, readOf, shortTitle, stepped } from './scatter_math.js';

const DRAG = 6; // px that make a click a brush

/**
 * @typedef {{found: Drawn, kept: Set<number>, active: number, taken: number, pins: Map<number, number>,
 *   x: number, y: number, soFar: {x: number, y: number}[]|null}} Seen
 *   active: that is looked at; taken: that is the present one; pins: letters by design; soFar: the front of a search
 *   that goes on
 */
export class Scatter {
  /** @type {Seen|null} */ #seen = null;
  /** @type {Point[]} in pixels */ #pixels = [];
  /** @type {Point[]} in figures */ #points = [];
  /** @type {{x: Range, y: Range}} */ #ranges = { x: [0, 1], y: [0, 1] };
  #size = { width: 0, height: 0 };
  #unit = 1;
  /** @type {Map<number, SVGGElement>} */ #nodes = new Map();
  /** @type {{x: number, y: number, far: boolean, id: number}|null} */ #down = null;
  /** Whether it is the pointer that shows a design. */ #pointed = false;

  /**
   * @param {object} tell
   * @param {(index: number) => void} tell.look −1: at none
   * @param {(index: number, touched: boolean) => void} tell.press
   * @param {(index: number) => void} tell.pin
   * @param {(x: Range, y: Range) => void} tell.brush
   * @param {() => void} tell.clear
   */
  constructor(tell) {
    this.tell = tell;
    this.frame = svg('g', { 'aria-hidden': 'true' });
    this.soFar = svg('g', { 'aria-hidden': 'true', 'data-testid': 'find-so-far' });
    this.marks = svg('g', { role: 'group', 'aria-label': 'Designs' });
    this.band = svg('rect', { class: 'find-band', visibility: 'hidden', 'aria-hidden': 'true' });
    this.svg = svg(
      'svg',
      {
        class: 'find-scatter',
        'data-testid': 'find-scatter',
        role: 'listbox',
        tabindex: 0,
        'aria-label':
          'Designs found, by two figures: left and right go from one to the next and show it, Enter takes it, P ' +
          'pins it, Escape leaves it',
      },
      this.frame,
      this.soFar,
      this.marks,
      this.band,
    );
    this.node = h('div', { class: 'find-stage' }, this.svg);
    this.svg.addEventListener('pointermove', (e) => this.#move(e));
    this.svg.addEventListener('pointerdown', (e) => this.#press(e));
    this.svg.addEventListener('pointerup', (e) => this.#release(e));
    this.svg.addEventListener('pointercancel', () => this.#drop());
    // what the keys show stays, where the page scrolls away under a pointer that rests
    this.svg.addEventListener('pointerleave', () => this.#pointed && !this.#down && this.#look(-1, false));
    this.svg.addEventListener('keydown', (e) => this.#key(e));
    this.svg.addEventListener('blur', () => tell.look(-1));
    new ResizeObserver(([{ contentRect }]) => {
      this.#unit = drawingUnit();
      this.#size = { width: contentRect.width / this.#unit, height: contentRect.height / this.#unit };
      this.svg.setAttribute('viewBox', `0 0 ${this.#size.width} ${this.#size.height}`);
      if (this.#seen) this.#draw(this.#seen);
    }).observe(this.svg);
  }

  /** @param {Seen} seen */
  show(seen) {
    const before = this.#seen;
    this.#seen = seen;
    const drawn = /** @type {const} */ (['found', 'x', 'y', 'soFar']);
    if (!before || drawn.some((k) => before[k] !== seen[k])) this.#draw(seen);
    else this.#mark(seen);
  }

  /** @param {PointerEvent} e @returns {[number, number]} in the drawing's pixels */
  #at(e) {
    const box = this.svg.getBoundingClientRect();
    return [(e.clientX - box.left) / this.#unit, (e.clientY - box.top) / this.#unit];
  }

  /** The design under the pointer. @param {PointerEvent} e */
  #under(e) {
    const kept = this.#pixels.filter((p) => this.#seen?.kept.has(p.index));
    return nearest(kept, ...this.#at(e));
  }

  /** @param {number} index @param {boolean} pointed whether the pointer shows it */
  #look(index, pointed) {
    this.#pointed = pointed;
    this.tell.look(index);
  }

  /** @param {PointerEvent} e */
  #move(e) {
    const [x, y] = this.#at(e);
    const down = this.#down;
    if (down && (down.far || Math.hypot(x - down.x, y - down.y) > DRAG)) {
      if (!down.far) this.tell.look(-1);
      down.far = true;
      const [left, top] = [Math.min(x, down.x), Math.min(y, down.y)];
      for (const [name, v] of Object.entries({
        x: left,
        y: top,
        width: Math.abs(x - down.x),
        height: Math.abs(y - down.y),
      }))
        this.band.setAttribute(name, v.toFixed(1));
      this.band.setAttribute('visibility', 'visible');
    } else if (!down && e.pointerType !== 'touch') this.#look(this.#under(e), true);
  }

  /** @param {PointerEvent} e */
  #press(e) {
    if (e.button !== 0) return;
    const [x, y] = this.#at(e);
    this.#down = { x, y, far: false, id: e.pointerId };
    if (e.pointerType !== 'touch') this.svg.setPointerCapture(e.pointerId);
  }

  /** @param {PointerEvent} e */
  #release(e) {
    const down = this.#down;
    this.#drop();
    if (!down || !this.#seen) return;
    if (!down.far) {
      const index = this.#under(e);
      if (index >= 0) this.tell.press(index, e.pointerType === 'touch');
      else this.tell.clear();
      return;
    }
    const [x, y] = this.#at(e);
    const inverse = (/** @type {'x'|'y'} */ axis, /** @type {number} */ at) => {
      const { width, height } = this.#size;
      const [low, high] = this.#ranges[axis];
      const share =
        axis === 'x'
          ? (at - EDGE.left) / (width - EDGE.left - EDGE.right)
          : (height - EDGE.bottom - at) / (height - EDGE.top - EDGE.bottom);
      return low + share * (high - low);
    };
    const range = (/** @type {'x'|'y'} */ axis, /** @type {number} */ a, /** @type {number} */ b) =>
      /** @type {Range} */ ([inverse(axis, a), inverse(axis, b)].sort((p, q) => p - q));
    this.tell.brush(range('x', x, down.x), range('y', y, down.y));
  }

  #drop() {
    this.#down = null;
    this.band.setAttribute('visibility', 'hidden');
  }

  /** @param {KeyboardEvent} e */
  #key(e) {
    const seen = this.#seen;
    if (!seen || e.ctrlKey || e.metaKey || e.altKey) return;
    const { active, kept } = seen;
    const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, Home: -Infinity, End: Infinity }[e.key];
    if (by !== undefined) this.#look(stepped(this.#points, kept, active, by), false);
    else if (active >= 0 && (e.key === 'Enter' || e.key === ' ')) this.tell.press(active, false);
    else if (active >= 0 && e.key.toLowerCase() === 'p') this.tell.pin(active);
    else if (e.key === 'Escape') active >= 0 ? this.tell.look(-1) : this.tell.clear();
    else return;
    e.preventDefault();
    e.stopPropagation();
  }

  /** @param {Seen} seen */
  #draw(seen) {
    const { width, height } = this.#size;
    if (!width) return;
    const { found, x, y, soFar } = seen;
    this.#points = pointsOf(found, x, y);
    const { present } = found;
    const own = present && [readOf(found, present, x), readOf(found, present, y)];
    const here = own && own[0] !== undefined && own[1] !== undefined ? { x: own[0], y: own[1] } : null;
    const all = [...this.#points, ...(here ? [here] : []), ...(soFar ?? [])];
    const range = (/** @type {'x'|'y'} */ axis, /** @type {number} */ k) => {
      const values = all.map((p) => p[axis]);
      const [low, high] = rangeOf(values);
      const near = limitsOn(found, k).flatMap(({ at }) =>
        at >= low - (high - low) / 2 && at <= high + (high - low) / 2 ? [at] : [],
      );
      return rangeOf([...values, ...near]);
    };
    const ranges = (this.#ranges = { x: range('x', x), y: range('y', y) });
    const [w, tall] = [width - EDGE.left - EDGE.right, height - EDGE.top - EDGE.bottom];
    const px = (/** @type {number} */ v) => EDGE.left + (w * (v - ranges.x[0])) / (ranges.x[1] - ranges.x[0]);
    const py = (/** @type {number} */ v) => EDGE.top + tall * (1 - (v - ranges.y[0]) / (ranges.y[1] - ranges.y[0]));
    this.#pixels = this.#points.map((p) => ({ index: p.index, x: px(p.x), y: py(p.y) }));
    this.frame.replaceChildren(...frameOf({ found, x, y, ranges, here, at: { px, py }, size: { width, height } }));
    this.soFar.replaceChildren(...(soFar ? greyed(soFar, { px, py }, width - EDGE.right) : []));
    this.#build(seen);
    this.#mark(seen);
  }

  /** @param {Seen} seen */
  #build({ found, x, y }) {
    const [a, b] = [found.figures[x], found.figures[y]];
    this.#nodes = new Map(
      this.#pixels.map(({ index, x: cx, y: cy }) => {
        const { met, figures } = found.designs[index];
        const words = say`${a.title} ${figures[x].text}, ${b.title} ${figures[y].text}`;
        const node = svg(
          'g',
          {
            id: idOf(index),
            role: 'option',
            'data-testid': idOf(index),
            'aria-label': met ? words : say`${words}, misses what is asked`,
            transform: `translate(${cx.toFixed(1)} ${cy.toFixed(1)})`,
          },
          met ? svg('circle', { r: 5.5 }) : svg('path', { d: 'M-4.5-4.5L4.5 4.5M4.5-4.5L-4.5 4.5' }),
          svg('circle', { class: 'find-ring', r: 11 }),
          svg('text', { class: 'find-letter', x: 8, y: -7, 'aria-hidden': 'true' }),
        );
        return [index, node];
      }),
    );
    this.marks.replaceChildren(...this.#nodes.values());
  }

  /** What changes with the pointer: the points themselves stay. @param {Seen} seen */
  #mark({ found, kept, active, taken, pins }) {
    for (const [index, node] of this.#nodes) {
      const kinds = {
        met: found.designs[index].met,
        missed: !found.designs[index].met,
        out: !kept.has(index),
        active: index === active,
        taken: index === taken,
      };
      const names = Object.entries(kinds).flatMap(([name, on]) => (on ? [name] : []));
      setAttr(node, 'class', ['find-point', ...names].join(' '));
      setAttr(node, 'aria-selected', String(index === active));
      setAttr(node, 'aria-disabled', String(!kept.has(index)));
      const pin = pins.get(index);
      setText(/** @type {Node} */ (node.lastChild), pin === undefined ? '' : letterOf(pin));
    }
    const top = this.#nodes.get(active);
    if (top && top !== this.marks.lastChild) this.marks.append(top);
    if (top) setAttr(this.svg, 'aria-activedescendant', idOf(active));
    else this.svg.removeAttribute('aria-activedescendant');
  }
}

/**
 * The front of a search that goes on, and what it is.
 * @param {{x: number, y: number}[]} points
 * @param {{px: (v: number) => number, py: (v: number) => number}} at @param {number} right
 */
function greyed(points, { px, py }, right) {
  const words = svg('text', { x: right, y: 15, 'text-anchor': 'end' });
  words.textContent = t('grey: found so far');
  return [...points.map(({ x, y }) => svg('circle', { cx: px(x).toFixed(1), cy: py(y).toFixed(1), r: 4 })), words];
}

const idOf = (/** @type {number} */ index) => `find-point-${index}`;

/** A brushed range in words. @param {Drawn} found @param {number} k @param {Range} range */
export const rangeWords = (found, k, [low, high]) =>
  `${shortTitle(found.figures[k])}: ${significant(low, 3)} … ${significant(high, 3)}`;
