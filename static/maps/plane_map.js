/** The map behind the s-plane: painted under grid and poles, in both halves; its value under the pointer. */
import { h, setText } from '../ui/index.js';
import { toPixel, toPlane } from '../splane/index.js';
import { handlesOf } from '../model/index.js';
import { inUnit } from './choices.js';
import { shareIn } from './feed.js';
import { layersOf, mirrored } from './layers.js';
import { lookOf, lookOfPage } from './look.js';
import { valueAt } from './pad.js';
import { paintMap } from './picture.js';
import { known, levelsIn } from './scale.js';

/** Nearer to a pole than this the pole has the word, px. */
const POLE = 20;

export class PlaneMap {
  /** @type {{field: import('./types.d.ts').Field, asked: import('./types.d.ts').Asked}|null} */ map = null;
  /** @type {import('./layers.js').Layers|null} */ layers = null;
  /** @type {number[]} */ levels = [];
  /** What is painted: a map in a view. @type {unknown[]} */ #painted = [];
  /** @type {{x: number, y: number}|null} */ #pointer = null;
  #stale = false;

  /**
   * @param {import('../splane/splane.js').SPlane} plane
   * @param {import('../model/store.js').Store} store
   * @param {() => void} told  the layers are others
   */
  constructor(plane, store, told) {
    this.plane = plane;
    this.store = store;
    this.told = told;
    this.canvas = h('canvas', { class: 'map', hidden: true, 'aria-hidden': 'true' });
    this.here = h('div', { class: 'map-here', hidden: true, 'data-testid': 'map-here' });
    plane.backdrop.before(this.canvas);
    plane.readout.node.before(this.here);
    const before = plane.under;
    plane.under = () => {
      before?.();
      this.draw();
    };
    plane.svg.addEventListener('pointermove', (e) => this.#point(e));
    plane.svg.addEventListener('pointerleave', () => this.#leave());
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.repaint());
  }

  /** @param {import('./types.d.ts').Field|null} field @param {import('./types.d.ts').Asked|null} asked */
  show(field, asked) {
    if (!field || !asked) {
      this.map = this.layers = null;
      this.levels = [];
    } else {
      const { name } = asked.measure;
      const shown = (/** @type {number} */ v) => inUnit(name, v);
      // while something moves the colours keep their meaning, so that one sees the valley move
      if (!this.store.busy || !this.levels.length) this.levels = levelsIn(known(field, name), name);
      this.map = { field, asked };
      this.layers = layersOf(mirrored(field), shown, this.levels, [{}, ...asked.limits]);
    }
    this.told();
    this.draw();
  }

  /** While another is computed elsewhere what is there is of what was before. @param {boolean} stale */
  fade(stale) {
    this.canvas.classList.toggle('stale', stale);
    this.#stale = stale;
    this.#tell();
  }

  repaint() {
    this.#painted = [];
    this.told();
    this.draw();
  }

  /** How it looks now. @param {number} [type] px of its labels */
  look(type = 11) {
    return this.map && lookOf(this.map.asked.measure.name, this.levels, lookOfPage(this.canvas, type));
  }

  draw() {
    const { view, unit } = this.plane;
    const ratio = devicePixelRatio * unit;
    const now = [this.layers, view, ratio];
    if (now.every((v, i) => v === this.#painted[i])) return;
    this.#painted = now;
    this.plane.root.classList.toggle('mapped', this.layers !== null);
    this.canvas.hidden = !this.layers;
    this.canvas.dataset.nodes = String(this.map?.field.values.length ?? 0);
    if (!this.layers) return;
    const [width, height] = [view.width, view.height].map((v) => Math.round(v * ratio));
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    const ctx = this.canvas.getContext('2d');
    const look = this.look();
    if (!ctx || !look || !this.map) return;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, width, height);
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    const { design, reply } = this.store.state;
    const poles = [...(design ? handlesOf(design).filter((p) => p !== undefined) : []), ...(reply?.loop_poles ?? [])];
    paintMap(ctx, this.layers, this.box, look, { avoid: poles.map((p) => toPixel(view, p)) });
    this.#tell();
  }

  /** Where the map lies in the view, which may have moved on. */
  get box() {
    const { x, y } = /** @type {NonNullable<typeof this.map>} */ (this.map).asked.domain;
    const [left, top] = toPixel(this.plane.view, { re: x.from, im: y.to });
    const [right, bottom] = toPixel(this.plane.view, { re: x.to, im: -y.to });
    return { x: left, y: top, width: right - left, height: bottom - top };
  }

  /** @param {PointerEvent} e */
  #point(e) {
    if (this.store.state.dragging) return this.#leave();
    const { left, top } = this.plane.svg.getBoundingClientRect();
    const { unit } = this.plane;
    this.#pointer = { x: (e.clientX - left) / unit, y: (e.clientY - top) / unit };
    return this.#tell();
  }

  #leave() {
    if (!this.#pointer) return;
    this.#pointer = null;
    this.#tell();
  }

  /** What it is worth under the pointer. */
  #tell() {
    const [at, map, layers, { view, unit }] = [this.#pointer, this.map, this.layers, this.plane];
    const { design, dragging } = this.store.state;
    const near = (/** @type {import('../types.js').Complex|undefined} */ p) => {
      const [x, y] = p ? toPixel(view, p) : [Infinity, Infinity];
      return Boolean(at && Math.hypot(x - at.x, y - at.y) < POLE);
    };
    const text =
      at && map && layers && design && !dragging && !this.#stale && !handlesOf(design).some(near)
        ? this.#textAt(at, map, layers)
        : '';
    this.here.hidden = !text;
    if (!at || !text) return;
    setText(this.here, text);
    const side = at.x > view.width - 110 ? 'translate(calc(-100% - 1.2rem), -50%)' : 'translate(1.4rem, -50%)';
    this.here.style.transform = `translate(${at.x * unit}px, ${at.y * unit}px) ${side}`;
  }

  /**
   * @param {{x: number, y: number}} at
   * @param {NonNullable<typeof this.map>} map @param {import('./layers.js').Layers} layers
   */
  #textAt(at, { field, asked }, layers) {
    const { re, im } = toPlane(this.plane.view, at.x, at.y);
    const [s, t] = [shareIn(asked.domain.x, re), shareIn(asked.domain.y, Math.abs(im))];
    if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1)) return '';
    // of the layers' grid, which has both halves, the upper one
    const upper = { ...layers, grid: { ...layers.grid, rows: field.rows } };
    return valueAt(field, upper, s, t, asked.measure.name);
  }
}
