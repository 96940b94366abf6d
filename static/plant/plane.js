/**
 * The s-plane of any system: its own poles and zeros, the poles that are placed and those of the observer, to be
 * dragged by mouse, finger or keys. Conjugates move together.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {{open: Complex[], zeros: Complex[], poles: Complex[], observer: Complex[], loop: Complex[]|null}} Scene
 *   loop: the poles that a method has chosen itself; then the placed ones are not looked at
 */
import { complexIn, fixed, say, significant } from '../text/index.js';
import { button, h, setAttr, setText, svg } from '../ui/index.js';
import { actOf, drawGrid, fit, keyStep, outgrown, pick, pinch, toPixel, toPlane, zoom } from '../splane/index.js';
import { moved } from './poles.js';

const REACH = 28; // px: how near a press must be to take a pole
const SNAP = 9; // px: how near the real axis a pair turns real
const CROSS = 'M -5.5 -5.5 L 5.5 5.5 M -5.5 5.5 L 5.5 -5.5';
const SMALL = 'M -4 -4 L 4 4 M -4 4 L 4 -4';
const DIAMOND = 'M 0 -5.5 L 5.5 0 L 0 5.5 L -5.5 0 Z';
const HINT =
  'Drag a pole, or move it by the arrow keys (Shift: fine, Page keys: coarse). A real pole that leaves the axis ' +
  'takes a real one with it: what it has just passed, or else the nearest.';
const written = (/** @type {Complex} */ p) => complexIn(p, { number: (v) => significant(v, 4) });

export class Plane {
  view = { cx: -2, cy: 0, scale: 40, width: 0, height: 0 };
  /** @type {Scene} */ scene = { open: [], zeros: [], poles: [], observer: [], loop: null };
  /** @type {SVGGElement[]} */ handles = [];
  /** @type {number[]} from the lowest to the topmost */ order = [];
  /** @type {{i: number, id: number, dx: number, dy: number}|null} */ #drag = null;
  /** @type {number|null} which pole a drag or keys are moving */ #moving = null;
  /** @type {Map<number, {x: number, y: number}>} */ #fingers = new Map();
  /** @type {{view: import('../splane/math.js').View, from: [{x: number, y: number}, {x: number, y: number}]}|null} */
  #pinch = null;
  /** @type {{x: number, y: number}|null} */ #pan = null;
  #manual = false;

  /** @param {{onMove: (which: 'poles'|'observer', poles: Complex[], held: boolean) => void}} how */
  constructor({ onMove }) {
    this.onMove = onMove;
    this.grid = svg('g');
    this.own = svg('g', { class: 'open-poles' });
    this.zeros = svg('g', { class: 'plant-zeros' });
    this.loop = svg('g', { class: 'loop-poles' });
    this.marks = svg('g', { 'aria-hidden': 'true' });
    this.taken = svg('g');
    const backdrop = svg(
      'svg',
      { class: 'splane-svg backdrop', 'aria-hidden': 'true' },
      svg(
        'defs',
        {},
        svg(
          'pattern',
          {
            id: 'plant-hatch',
            width: 8,
            height: 8,
            patternUnits: 'userSpaceOnUse',
            patternTransform: 'rotate(45)',
          },
          svg('line', { class: 'hatch-line', x1: 0, y1: 0, x2: 0, y2: 8 }),
        ),
      ),
      this.grid,
      this.own,
      this.zeros,
    );
    this.svg = svg(
      'svg',
      { class: 'splane-svg', 'data-testid': 'plant-plane', role: 'group', 'aria-label': 'Poles of the plant' },
      this.loop,
      this.marks,
      this.taken,
    );
    this.readout = h('p', { class: 'plant-readout', 'aria-hidden': 'true' });
    const tool = (/** @type {string} */ text, /** @type {string} */ name, /** @type {() => void} */ act) =>
      button({ 'aria-label': name, title: name, onclick: act }, text);
    const key = (/** @type {string} */ kind, /** @type {Element} */ shape, /** @type {string} */ words) =>
      h('span', {}, svg('svg', { class: kind, viewBox: '-8 -8 16 16', 'aria-hidden': 'true' }, shape), words);
    this.node = h(
      'div',
      { class: 'plant-plane' },
      h('div', { class: 'splane-stage' }, backdrop, this.svg),
      this.readout,
      h(
        'div',
        { class: 'splane-tools' },
        tool('+', 'Zoom in', () => this.#zoom(1.4)),
        tool('\u2212', 'Zoom out', () => this.#zoom(1 / 1.4)),
        tool('Fit', 'Fit all poles into view', () => this.fit()),
        h(
          'div',
          { class: 'splane-key' },
          key('open-poles', svg('path', { d: SMALL }), 'plant'),
          key('plant-zeros', svg('circle', { r: 4.5 }), 'zeros'),
          key('loop-poles', svg('path', { d: DIAMOND }), 'by LQR'),
        ),
      ),
      h('p', { class: 'caption' }, HINT),
    );
    this.#listen();
    new ResizeObserver(([entry]) => this.#resize(entry.contentRect.width, entry.contentRect.height)).observe(this.svg);
  }

  get held() {
    return this.#drag !== null;
  }

  /** All that can be dragged: the placed poles, then the observer's. */
  get #all() {
    return [...this.scene.poles, ...this.scene.observer];
  }

  /** @param {Scene} scene @param {boolean} [fresh] whether it is another system */
  show(scene, fresh = false) {
    this.scene = scene;
    if (!this.view.width) return;
    if (fresh || (!this.#manual && !this.held && outgrown(this.view, this.#all))) this.fit();
    else this.#draw(false);
  }

  fit() {
    this.#manual = false;
    if (!this.view.width) return;
    const { open, zeros, loop } = this.scene;
    this.view = fit(this.#all, [...open, ...zeros, ...(loop ?? [])], this.view);
    this.#draw(true);
  }

  /** @param {number} factor */
  #zoom(factor) {
    this.#look(zoom(this.view, factor, this.view.width / 2, this.view.height / 2));
  }

  /** @param {import('../splane/math.js').View} view */
  #look(view) {
    this.#manual = true;
    this.view = view;
    this.#draw(true);
  }

  /** @param {number} width @param {number} height */
  #resize(width, height) {
    if (width < 40 || height < 40) return;
    const first = !this.view.width;
    this.view = { ...this.view, width, height };
    if (first || !this.#manual) this.fit();
    else this.#draw(true);
  }

  /** @param {boolean} fresh whether the view is another one */
  #draw(fresh) {
    const { view, scene } = this;
    if (fresh) drawGrid(this.grid, view, 'plant-hatch');
    layer(this.own, scene.open, view, () => svg('path', { d: SMALL }));
    layer(this.zeros, scene.zeros, view, () => svg('circle', { r: 4.5 }));
    layer(this.loop, scene.loop ?? [], view, () => svg('path', { d: DIAMOND }));
    this.node.classList.toggle('unused', scene.loop !== null);
    const all = this.#all;
    if (this.handles.length !== all.length) this.#make(all.length);
    for (const [i, p] of all.entries()) {
      const [x, y] = toPixel(view, p).map((v) => v.toFixed(1));
      const place = `translate(${x} ${y})`;
      const kind = i < scene.poles.length ? 'placed' : 'observer';
      const mark = /** @type {SVGGElement} */ (this.marks.children[i]);
      setAttr(mark, 'class', `pole-mark ${kind} ${kind === 'placed' ? 'pitch' : 'yaw'}`);
      setAttr(mark, 'transform', place);
      setAttr(this.handles[i], 'transform', place);
      setAttr(this.handles[i], 'aria-label', this.#name(i));
      setAttr(this.handles[i], 'aria-valuenow', p.re);
      setAttr(this.handles[i], 'aria-valuetext', `${written(p)} rad/s`);
    }
    this.#read();
  }

  /** @param {number} i */
  #name(i) {
    const n = this.scene.poles.length;
    return i < n ? say`Pole ${i + 1}` : say`Observer pole ${i - n + 1}`;
  }

  /** @param {number} count */
  #make(count) {
    this.handles = Array.from({ length: count }, (_, i) =>
      svg(
        'g',
        {
          class: 'pole',
          'data-testid': `plant-pole-${i}`,
          tabindex: 0,
          role: 'slider',
          'aria-valuemin': -1e9,
          'aria-valuemax': 1e9,
          onkeydown: (/** @type {KeyboardEvent} */ e) => this.#key(e, i),
          onkeyup: () => this.#rest(),
          onfocus: () => this.#raise(i),
          onblur: () => this.#rest(),
        },
        svg('circle', { class: 'reach', r: REACH }),
        svg('circle', { class: 'hit', r: 19 }),
      ),
    );
    this.order = [...this.handles.keys()].reverse();
    this.taken.replaceChildren(...this.handles);
    this.marks.replaceChildren(
      ...this.handles.map((_, i) =>
        svg(
          'g',
          { 'data-testid': `plant-mark-${i}` },
          i < this.scene.poles.length
            ? svg('circle', { class: 'ring', r: 11 })
            : svg('rect', { class: 'ring', x: -8, y: -8, width: 16, height: 16, rx: 2 }),
          svg('path', { class: 'cross', d: CROSS }),
        ),
      ),
    );
  }

  /** @param {number} i */
  #raise(i) {
    this.order = [...this.order.filter((k) => k !== i), i];
    this.#read();
  }

  /** The pole in question, in words. */
  #read() {
    const i = this.#drag?.i ?? this.handles.findIndex((handle) => handle === document.activeElement);
    const p = this.#all[i];
    if (!p) {
      setText(this.readout, '');
      return;
    }
    const size = Math.hypot(p.re, p.im);
    const more = p.im && size ? `, ζ ${fixed(-p.re / size)}, ωₙ ${significant(size, 3)} rad/s` : '';
    setText(this.readout, `${this.#name(i)}: ${written(p)} rad/s${more}`);
  }

  /** @param {number} i @param {Complex} to */
  #move(i, to) {
    const { poles, observer } = this.scene;
    const own = i < poles.length;
    const snap = this.#drag ? SNAP / this.view.scale : keyStep(this.view) / 20;
    this.#moving = i;
    this.onMove(own ? 'poles' : 'observer', moved(own ? poles : observer, own ? i : i - poles.length, to, snap), true);
  }

  /** The hand rests. */
  #rest() {
    if (this.#moving === null) return;
    const which = this.#moving < this.scene.poles.length ? 'poles' : 'observer';
    this.#moving = null;
    this.onMove(which, this.scene[which], false);
  }

  /** @param {MouseEvent} e */
  #at(e) {
    const box = this.svg.getBoundingClientRect();
    const unit = box.width / this.view.width || 1;
    return { x: (e.clientX - box.left) / unit, y: (e.clientY - box.top) / unit };
  }

  #listen() {
    const { svg: plane } = this;
    plane.addEventListener('pointerdown', (e) => this.#down(e));
    plane.addEventListener('pointermove', (e) => this.#moveTo(e));
    for (const end of /** @type {const} */ (['pointerup', 'pointercancel', 'lostpointercapture']))
      plane.addEventListener(end, (e) => this.#up(e));
    plane.addEventListener('dblclick', (e) => pick(this.view, this.#all, this.order, this.#at(e), REACH) ?? this.fit());
    plane.addEventListener(
      'wheel',
      (e) => {
        e.preventDefault();
        const { x, y } = this.#at(e);
        this.#look(zoom(this.view, Math.exp(-e.deltaY * (e.deltaMode ? 0.05 : e.ctrlKey ? 0.01 : 0.0015)), x, y));
      },
      { passive: false },
    );
    plane.addEventListener(
      'touchstart',
      (e) => (e.touches.length > 1 || this.#drag) && e.cancelable && e.preventDefault(),
      { passive: false },
    );
  }

  /** @param {PointerEvent} e */
  #down(e) {
    if (e.button !== 0) return;
    const at = this.#at(e);
    const i = this.order.length ? pick(this.view, this.#all, this.order, at, REACH) : null;
    if (e.pointerType === 'touch') {
      this.#fingers.set(e.pointerId, at);
      if (this.#fingers.size === 2 && !this.#drag) {
        const [a, b] = [...this.#fingers.values()];
        this.#pinch = { view: this.view, from: [a, b] };
      }
    }
    if (i !== null) {
      const [x, y] = toPixel(this.view, this.#all[i]);
      this.#drag = { i, id: e.pointerId, dx: x - at.x, dy: y - at.y };
      this.handles[i].focus({ preventScroll: true });
    } else if (e.pointerType === 'touch')
      return; // a finger beside the poles scrolls the page
    else this.#pan = at;
    this.svg.setPointerCapture(e.pointerId);
    e.preventDefault();
  }

  /** @param {PointerEvent} e */
  #moveTo(e) {
    const at = this.#at(e);
    const v = this.view;
    if (this.#fingers.has(e.pointerId)) this.#fingers.set(e.pointerId, at);
    if (this.#drag?.id === e.pointerId) {
      const { i, dx, dy } = this.#drag;
      const inside = (/** @type {number} */ value, /** @type {number} */ most) =>
        Math.max(6, Math.min(most - 6, value));
      const raw = toPlane(v, inside(at.x + dx, v.width), inside(at.y + dy, v.height));
      const grain = 10 ** Math.floor(Math.log10(1 / v.scale)); // pixels carry no more digits than this
      this.#move(i, { re: Math.round(raw.re / grain) * grain, im: Math.round(raw.im / grain) * grain });
    } else if (this.#pinch && this.#fingers.size === 2) {
      const [a, b] = [...this.#fingers.values()];
      this.#look(pinch(this.#pinch.view, this.#pinch.from, [a, b]));
    } else if (this.#pan) {
      this.#look({ ...v, cx: v.cx - (at.x - this.#pan.x) / v.scale, cy: v.cy + (at.y - this.#pan.y) / v.scale });
      this.#pan = at;
    }
  }

  /** @param {PointerEvent} e */
  #up(e) {
    this.#fingers.delete(e.pointerId);
    if (this.#fingers.size < 2) this.#pinch = null;
    this.#pan = null;
    if (this.#drag?.id !== e.pointerId) return;
    this.#drag = null;
    this.#rest();
  }

  /** @param {KeyboardEvent} e @param {number} i */
  #key(e, i) {
    const act = actOf(e, this.view);
    if (!act) return;
    const { re, im } = this.#all[i];
    if ('view' in act) this.#look(act.view);
    else if ('fit' in act) this.fit();
    else this.#move(i, { re: re + act.by.re, im: im + act.by.im });
    e.preventDefault();
  }
}

/**
 * Marks that are not dragged.
 * @param {SVGGElement} into @param {readonly Complex[]} at @param {import('../splane/math.js').View} view
 * @param {() => SVGElement} make
 */
function layer(into, at, view, make) {
  while (into.childElementCount < at.length) into.append(make());
  while (into.childElementCount > at.length) into.lastElementChild?.remove();
  for (const [i, p] of at.entries()) {
    const [x, y] = toPixel(view, p);
    setAttr(/** @type {Element} */ (into.children[i]), 'transform', `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
  }
}
