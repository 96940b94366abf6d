/**
 * Mouse, touch, wheel and keys over the s-plane, turned into edits of the poles and views of the plane. One pointer
 * drags a pole or, as a mouse, pans;
 * two fingers zoom and pan; one finger beside the poles scrolls the page.
 * @typedef {import('./math.js').View} View
 * @typedef {{x: number, y: number}} Point  pixels of the view
 */
import { dragHandle, handlesOf, nudgeHandle, pairAlone, tidy } from '../model/index.js';
import { actOf, pick, pinch, toPixel, toPlane, zoom } from './math.js';

export const REACH = 28; // px: how near a press must be to take a pole
const SNAP = 9; // px: how near the real axis a complex pair turns real
const MEET = 13; // px: how near two real poles count as met
/**
 * @typedef {object} Plane  what the gestures act on
 * @property {SVGSVGElement} svg
 * @property {import('./marks.js').Marks} marks
 * @property {import('../model/store.js').Store} store
 * @property {View} view
 * @property {number} unit  CSS pixels to one of the view's
 * @property {(view: View) => void} look
 * @property {() => void} fit
 * @property {(index: number|null) => void} activate  names the pole that the readout is about
 */

export class Gestures {
  /** @type {{index: number, id: number, together: boolean, moved: boolean, dx: number, dy: number}|null} */ #drag =
    null;
  /** @type {Point|null} */ #pan = null;
  /** @type {{view: View, from: [Point, Point]}|null} */ #pinch = null;
  /** @type {Map<number, Point>} */ #fingers = new Map();
  /** @type {DOMRect|null} where the plane is while a gesture lasts */ #box = null;

  /** @param {Plane} plane */
  constructor(plane) {
    this.plane = plane;
    const { svg, marks, store } = plane;
    svg.addEventListener('pointerdown', (e) => this.#down(e));
    svg.addEventListener('pointermove', (e) => this.#move(e));
    for (const end of /** @type {const} */ (['pointerup', 'pointercancel', 'lostpointercapture']))
      svg.addEventListener(end, (e) => this.#up(e));
    svg.addEventListener('pointerleave', () => plane.activate(this.#focused()));
    svg.addEventListener('dblclick', (e) => this.#under(e) === null && plane.fit());
    svg.addEventListener('wheel', (e) => this.#wheel(e), { passive: false });
    // Two fingers, or one that holds a pole, belong to the plane; the browser would scroll the page with them.
    svg.addEventListener(
      'touchstart',
      (e) => (e.touches.length > 1 || this.#drag) && e.cancelable && e.preventDefault(),
      { passive: false },
    );
    for (const [i, handle] of marks.handles.entries()) {
      handle.addEventListener('keydown', (e) => this.#key(e, i));
      handle.addEventListener('keyup', () => store.commit());
      handle.addEventListener('focus', () => {
        marks.raise(i);
        plane.activate(i);
      });
      handle.addEventListener('blur', () => plane.activate(null));
    }
  }

  /** Whether a pole is held, and which. */
  get held() {
    return this.#drag ? this.#drag.index : null;
  }

  /** @param {MouseEvent} e @returns {Point} */
  #at(e) {
    const box = this.#box ?? this.plane.svg.getBoundingClientRect();
    const { unit } = this.plane;
    return { x: (e.clientX - box.left) / unit, y: (e.clientY - box.top) / unit };
  }

  /** @param {MouseEvent} e @returns {number|null} the pole that a press here would take */
  #under(e) {
    const { state } = this.plane.store;
    if (!state.design) return null;
    const { handles, order } = this.plane.marks;
    const poles = handlesOf(state.design, pairAlone(state));
    // one that a lab's step fixes is not in the way of one below it
    const free = state.task ? poles.map((p, i) => (handles[i].hasAttribute('aria-disabled') ? undefined : p)) : poles;
    return pick(this.plane.view, free, order, this.#at(e), REACH);
  }

  /** @param {PointerEvent} e */
  #down(e) {
    const { svg, store, view, marks, activate } = this.plane;
    if (e.button !== 0 || !store.state.design) return;
    this.#box ??= svg.getBoundingClientRect();
    const at = this.#at(e);
    if (e.pointerType === 'touch') {
      this.#fingers.set(e.pointerId, at);
      if (this.#fingers.size > 1) return this.#spread(e);
    }
    const index = this.#under(e);
    const pole = index === null ? undefined : handlesOf(store.state.design)[index];
    if (index !== null && pole) {
      const [px, py] = toPixel(view, pole);
      this.#drag = { index, id: e.pointerId, together: false, moved: false, dx: px - at.x, dy: py - at.y };
      marks.raise(index);
      marks.handles[index].focus({ preventScroll: true });
      activate(index);
      store.set({ dragging: true });
    } else if (e.pointerType === 'touch')
      return undefined; // a finger beside the poles scrolls the page
    else this.#pan = at;
    svg.setPointerCapture(e.pointerId);
    return e.preventDefault();
  }

  /** A second finger: what the first one began gives way, unless it already moves a pole. @param {PointerEvent} e */
  #spread(e) {
    if (this.#drag?.moved || this.#fingers.size !== 2) return;
    this.#release();
    const [a, b] = [...this.#fingers.values()];
    this.#pinch = { view: this.plane.view, from: [a, b] };
    for (const id of this.#fingers.keys()) this.plane.svg.setPointerCapture(id);
    e.preventDefault();
  }

  /** @param {PointerEvent} e */
  #move(e) {
    const { plane } = this;
    const at = this.#at(e);
    if (this.#fingers.has(e.pointerId)) this.#fingers.set(e.pointerId, at);
    if (this.#pinch) {
      const [a, b] = [...this.#fingers.values()];
      if (a && b) plane.look(pinch(this.#pinch.view, this.#pinch.from, [a, b]));
    } else if (this.#pan) {
      const v = plane.view;
      plane.look({ ...v, cx: v.cx - (at.x - this.#pan.x) / v.scale, cy: v.cy + (at.y - this.#pan.y) / v.scale });
      this.#pan = at;
    } else if (this.#drag) {
      if (e.pointerId === this.#drag.id) this.#dragTo(at.x + this.#drag.dx, at.y + this.#drag.dy, e.timeStamp);
    } else if (e.pointerType !== 'touch') {
      const near = this.#under(e);
      plane.svg.classList.toggle('grabbable', near !== null);
      plane.activate(near ?? this.#focused());
    }
  }

  /** @param {number} x @param {number} y @param {number} stamp */
  #dragTo(x, y, stamp) {
    const gesture = this.#drag;
    if (!gesture) return;
    const v = this.plane.view;
    gesture.moved = true;
    const inside = (/** @type {number} */ value, /** @type {number} */ size) => Math.max(6, Math.min(size - 6, value));
    const raw = toPlane(v, inside(x, v.width), inside(y, v.height));
    const grain = 10 ** Math.floor(Math.log10(1 / v.scale)); // pixels carry no more digits than this
    const to = { re: tidy(Math.round(raw.re / grain) * grain), im: tidy(Math.round(raw.im / grain) * grain) };
    this.plane.store.edit(
      (d) => {
        const moved = dragHandle(d, gesture.index, to, {
          snap: SNAP / v.scale,
          meet: MEET / v.scale,
          together: gesture.together,
        });
        gesture.together = moved.together;
        return moved.design;
      },
      { gesture: `drag-${gesture.index}`, stamp },
    );
  }

  /** @param {PointerEvent} e */
  #up(e) {
    this.#fingers.delete(e.pointerId);
    if (this.#fingers.size < 2) this.#pinch = null;
    this.#pan = null;
    if (!this.#drag || this.#drag.id === e.pointerId) this.#release();
    if (this.#fingers.size === 0) this.#box = null;
  }

  #release() {
    if (!this.#drag) return;
    this.#drag = null;
    this.plane.store.commit();
    this.plane.store.set({ dragging: false });
  }

  /** @param {WheelEvent} e */
  #wheel(e) {
    e.preventDefault();
    const { x, y } = this.#at(e);
    const rate = e.deltaMode ? 0.05 : e.ctrlKey ? 0.01 : 0.0015; // lines, a pinch on a touchpad, pixels
    this.plane.look(zoom(this.plane.view, Math.exp(-e.deltaY * rate), x, y));
  }

  /** @param {KeyboardEvent} e @param {number} index */
  #key(e, index) {
    const { plane } = this;
    const act = actOf(e, plane.view);
    if (!act) {
      if (!/^[1-6]$/.test(e.key) || e.altKey || e.ctrlKey || e.metaKey) return;
      plane.marks.handles[Number(e.key) - 1].focus();
    } else if ('view' in act) plane.look(act.view);
    else if ('fit' in act) plane.fit();
    else
      plane.store.edit((d) => nudgeHandle(d, index, act.by), {
        gesture: `key-${index}`,
        stamp: e.timeStamp,
      });
    e.preventDefault();
  }

  #focused() {
    const handles = this.plane.marks.handles;
    const i = handles.findIndex((handle) => handle === document.activeElement);
    return i >= 0 && handles[i].matches(':focus-visible') ? i : null;
  }
}
