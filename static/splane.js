/**
 * The s-plane: four poles to drag, by mouse, finger or key, over the open loop's poles and those of the whole loop.
 * It draws the store's design at once, without waiting for the server.
 * @typedef {import('./types.js').State} State
 * @typedef {import('./types.js').Complex} Complex
 */
import { cloudWords, SPREADS } from './cloud.js';
import { h, setAttr, setText, svg } from './dom.js';
import { fixed, poleText, seconds } from './format.js';
import { placesPoles } from './methods.js';
import { character, drag, isComplex, nudge, pairOf, partner, tidy } from './poles.js';
import { drawCloud } from './splane_cloud.js';
import { drawGrid } from './splane_grid.js';
import { drawPins } from './splane_pins.js';
import { bounds, fit, keyStep, outgrown, toPixel, toPlane, zoom } from './splane_math.js';

const REACH = 26; // px: how near a press must be to take a pole
const SNAP = 9; // px: how near the real axis a complex pair turns real
const MEET = 13; // px: how near two real poles count as met
const CROSS = 'M -5.5 -5.5 L 5.5 5.5 M -5.5 5.5 L 5.5 -5.5';
const OPEN_MARK = 'M -4 -4 L 4 4 M -4 4 L 4 -4';
const LOOP_MARK = 'M 0 -5.5 L 5.5 0 L 0 5.5 L -5.5 0 Z';
const NAMES = ['pitch', 'yaw'];
/** @type {Record<string, [number, number]>} direction in the plane, in keyboard steps */
const KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1], PageUp: [10, 0], PageDown: [-10, 0] };

export class SPlane {
  #view = { cx: -5, cy: 0, scale: 20, width: 0, height: 0 };
  #manual = false;
  #readoutWidth = 190;
  /** @type {string|null} */ #preset = null;
  /** @type {number|null} */ #active = null;
  /** @type {{index: number, together: boolean, dx: number, dy: number}|null} */ #drag = null;
  /** @type {{x: number, y: number}|null} */ #pan = null;

  /** @param {HTMLElement} root @param {import('./store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.root = root;
    this.grid = svg('g');
    this.open = svg('g', { class: 'open-poles', 'data-testid': 'open-poles' });
    this.loop = svg('g', { class: 'loop-poles', 'data-testid': 'loop-poles' });
    this.links = NAMES.map((name) => svg('line', { class: `link ${name}` }));
    this.handles = [0, 1, 2, 3].map((i) => this.#handle(i));
    // The grid has a drawing of its own, which is not painted again while a pole moves.
    const backdrop = svg('svg', { class: 'splane-svg backdrop', 'aria-hidden': 'true' },
      svg('defs', {}, svg('pattern', { id: 'hatch', width: 8, height: 8, patternUnits: 'userSpaceOnUse', patternTransform: 'rotate(45)' },
        svg('line', { class: 'hatch-line', x1: 0, y1: 0, x2: 0, y2: 8 }))),
      this.grid);
    this.svg = svg('svg', { class: 'splane-svg', 'data-testid': 'splane', role: 'group', 'aria-label': 'Poles in the s-plane' },
      this.open, ...this.links, this.loop, ...this.handles);
    this.readout = h('div', { class: 'readout', hidden: true, 'data-testid': 'readout' });
    this.spread = h('select', { 'data-testid': 'spread', 'aria-label': 'Uncertainty of the rig', title: 'The same controller on rigs whose parameters differ by so much: their poles as dots, their responses as bands',
      onchange: () => store.set({ spread: Number(this.spread.value) }) }, SPREADS.map((v) => h('option', { value: v }, v ? `± ${100 * v} %` : 'exact rig')));
    this.cloud = h('canvas', { class: 'cloud', 'aria-hidden': 'true' });
    this.cloudText = h('div', { class: 'cloud-words', 'data-testid': 'cloud-words', role: 'status' });
    const tools = h('div', { class: 'splane-tools' },
      h('button', { type: 'button', title: 'Zoom in', 'aria-label': 'Zoom in', onclick: () => this.#zoomBy(1.4) }, '+'),
      h('button', { type: 'button', title: 'Zoom out', 'aria-label': 'Zoom out', onclick: () => this.#zoomBy(1 / 1.4) }, '\u2212'),
      h('button', { type: 'button', title: 'Fit all poles into view', 'data-testid': 'fit', onclick: () => this.fit() }, 'Fit'),
      this.spread);
    this.key = h('div', { class: 'splane-key', 'data-testid': 'splane-key' },
      h('span', { title: 'poles of the whole loop: PI moves the poles that you placed' }, svg('svg', { class: 'loop-poles', 'aria-hidden': 'true', viewBox: '-7 -7 14 14' }, svg('path', { d: LOOP_MARK })), (this.loopName = h('span'))),
      h('span', { title: 'poles of the rig without feedback' }, svg('svg', { class: 'open-poles', 'aria-hidden': 'true', viewBox: '-7 -7 14 14' }, svg('path', { d: OPEN_MARK })), 'open loop'));
    root.append(backdrop, this.cloud, this.svg, this.readout, tools, this.key, this.cloudText);
    this.#listen();
    new ResizeObserver(([entry]) => {
      if (entry.contentRect.width) this.#readoutWidth = entry.borderBoxSize[0].inlineSize;
    }).observe(this.readout);
    new ResizeObserver(([entry]) => this.#resize(entry.contentRect.width, entry.contentRect.height)).observe(this.svg);
  }

  /** @param {number} i */
  #handle(i) {
    const name = NAMES[pairOf(i)];
    const ring = name === 'pitch' ? svg('circle', { class: 'ring', r: 11 }) : svg('rect', { class: 'ring', x: -10, y: -10, width: 20, height: 20, rx: 2 });
    return svg('g', { class: `pole ${name}`, 'data-testid': `pole-${i}`, 'data-index': i, tabindex: 0, role: 'slider', 'aria-label': `${name} pole ${i + 1}`,
      'aria-valuemin': -1e5, 'aria-valuemax': 1e5 },
      svg('circle', { class: 'hit', r: 20 }), ring, svg('path', { class: 'cross', d: CROSS }), svg('text', { class: 'name', x: 14, y: -10 }, String(i + 1)));
  }

  #listen() {
    const s = this.svg;
    s.addEventListener('pointerdown', (e) => this.#down(e));
    s.addEventListener('pointermove', (e) => this.#move(e));
    s.addEventListener('pointerup', () => this.#up());
    s.addEventListener('pointercancel', () => this.#up());
    s.addEventListener('lostpointercapture', () => this.#up());
    s.addEventListener('pointerleave', () => this.#activate(this.#focused()));
    s.addEventListener('dblclick', (e) => this.#nearest(e) === null && this.fit());
    s.addEventListener('wheel', (e) => {
      e.preventDefault();
      const box = s.getBoundingClientRect();
      this.#look(zoom(this.#view, Math.exp(-e.deltaY * (e.deltaMode ? 0.05 : 0.0015)), e.clientX - box.left, e.clientY - box.top));
    }, { passive: false });
    for (const [i, handle] of this.handles.entries()) {
      handle.addEventListener('keydown', (e) => this.#key(e, i));
      handle.addEventListener('keyup', () => this.store.commit());
      handle.addEventListener('focus', () => this.#activate(i));
      handle.addEventListener('blur', () => this.#activate(null));
    }
  }

  /** @param {MouseEvent} e @returns {[number, number]} */
  #at(e) {
    const box = this.svg.getBoundingClientRect();
    return [e.clientX - box.left, e.clientY - box.top];
  }

  /** @param {MouseEvent} e @returns {number|null} the pole under the pointer */
  #nearest(e) {
    const poles = this.store.state.design?.poles;
    if (!poles) return null;
    const [x, y] = this.#at(e);
    const distances = poles.map((p) => {
      const [px, py] = toPixel(this.#view, p);
      return Math.hypot(px - x, py - y);
    });
    const best = distances.indexOf(Math.min(...distances));
    return distances[best] <= REACH ? best : null;
  }

  /** @param {PointerEvent} e */
  #down(e) {
    if (e.button !== 0 || !this.store.state.design) return;
    const index = this.#nearest(e);
    const [x, y] = this.#at(e);
    if (index === null) {
      if (e.pointerType === 'touch') return; // a finger beside the poles scrolls the page
      this.#pan = { x, y };
    } else {
      const [px, py] = toPixel(this.#view, this.store.state.design.poles[index]);
      this.#drag = { index, together: false, dx: px - x, dy: py - y };
      this.handles[index].focus({ preventScroll: true });
      this.#activate(index);
      this.store.set({ dragging: true });
    }
    this.svg.setPointerCapture(e.pointerId);
    e.preventDefault();
  }

  /** @param {PointerEvent} e */
  #move(e) {
    const [x, y] = this.#at(e);
    if (this.#pan) {
      const v = this.#view;
      this.#look({ ...v, cx: v.cx - (x - this.#pan.x) / v.scale, cy: v.cy + (y - this.#pan.y) / v.scale });
      this.#pan = { x, y };
    } else if (this.#drag) {
      this.#dragTo(x + this.#drag.dx, y + this.#drag.dy, e.timeStamp);
    } else if (e.pointerType !== 'touch') {
      const near = this.#nearest(e);
      this.svg.classList.toggle('grabbable', near !== null);
      this.#activate(near ?? this.#focused());
    }
  }

  /** @param {number} x @param {number} y @param {number} stamp */
  #dragTo(x, y, stamp) {
    const gesture = this.#drag;
    if (!gesture) return;
    const v = this.#view;
    const inside = (/** @type {number} */ value, /** @type {number} */ size) => Math.max(6, Math.min(size - 6, value));
    const raw = toPlane(v, inside(x, v.width), inside(y, v.height));
    const grain = 10 ** Math.floor(Math.log10(1 / v.scale)); // pixels carry no more digits than this
    const to = { re: tidy(Math.round(raw.re / grain) * grain), im: tidy(Math.round(raw.im / grain) * grain) };
    this.store.edit((d) => {
      const moved = drag(d.poles, gesture.index, to, { snap: SNAP / v.scale, meet: MEET / v.scale, together: gesture.together });
      gesture.together = moved.together;
      return { ...d, poles: moved.poles };
    }, { gesture: `drag-${gesture.index}`, stamp });
  }

  #up() {
    this.#pan = null;
    if (!this.#drag) return;
    this.#drag = null;
    this.store.commit();
    this.store.set({ dragging: false });
  }

  /** @param {KeyboardEvent} e @param {number} index */
  #key(e, index) {
    const direction = KEYS[e.key];
    if (!direction || e.ctrlKey || e.metaKey || e.altKey) return;
    e.preventDefault();
    const step = keyStep(this.#view) * (e.shiftKey ? 0.1 : 1);
    const by = { re: direction[0] * step, im: direction[1] * step };
    this.store.edit((d) => ({ ...d, poles: nudge(d.poles, index, by) }), { gesture: `key-${index}`, stamp: e.timeStamp });
  }

  #focused() {
    const i = this.handles.indexOf(/** @type {any} */ (document.activeElement));
    return i >= 0 && this.handles[i].matches(':focus-visible') ? i : null;
  }

  /** @param {number|null} index */
  #activate(index) {
    if (this.#drag && index !== this.#drag.index) return;
    if (index === this.#active) return;
    this.#active = index;
    this.#drawReadout();
  }

  /** @param {number} width @param {number} height */
  #resize(width, height) {
    this.#view = { ...this.#view, width, height };
    if (!this.#manual) this.fit();
    else this.#look(this.#view);
  }

  /** @param {number} factor */
  #zoomBy(factor) {
    this.#look(zoom(this.#view, factor, this.#view.width / 2, this.#view.height / 2));
  }

  /** Takes a view that the user chose; it stays until asked to fit. @param {import('./splane_math.js').View} view */
  #look(view) {
    this.#manual = true;
    this.#show(view);
  }

  fit() {
    const { design, reply } = this.store.state;
    if (!design || !this.#view.width) return;
    this.#manual = false;
    this.#show(fit(design.poles, [...(reply?.loop_poles ?? []), ...(reply?.open_loop_poles ?? [])], this.#view));
  }

  /** @param {import('./splane_math.js').View} view */
  #show(view) {
    this.#view = view;
    drawGrid(this.grid, view);
    this.#draw(this.store.state);
  }

  /** @param {State} state */
  render(state) {
    if (!state.design || !this.#view.width) return;
    const fresh = state.design.preset !== this.#preset;
    this.#preset = state.design.preset;
    const watched = [...state.design.poles, ...(state.reply?.loop_poles ?? []).filter((p) => p.re >= 0)];
    if (!state.dragging && (fresh || (!this.#manual && outgrown(this.#view, watched)))) this.fit();
    else this.#draw(state);
  }

  /** @param {State} state */
  #draw(state) {
    const { design, reply } = state;
    if (!design) return;
    const unused = !placesPoles(state); // then the loop's own poles are all there is to see
    this.root.classList.toggle('unused', unused);
    setText(this.loopName, unused ? 'whole loop' : 'with PI');
    for (const [i, handle] of this.handles.entries()) {
      const p = design.poles[i];
      const [x, y] = toPixel(this.#view, p);
      setAttr(handle, 'transform', `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
      setAttr(handle, 'aria-valuenow', p.re);
      setAttr(handle, 'aria-valuetext', poleText(design.poles, i));
      // Labels of a pair stand apart even where its poles meet or lie mirrored.
      const below = p.im < 0 || (p.im === 0 && i % 2 === 1);
      setAttr(/** @type {Element} */ (handle.lastChild), 'y', below ? 20 : -11);
    }
    for (const [pair, link] of this.links.entries()) {
      const [x1, y1] = toPixel(this.#view, design.poles[2 * pair]);
      const [x2, y2] = toPixel(this.#view, design.poles[2 * pair + 1]);
      for (const [name, value] of Object.entries({ x1, y1, x2, y2 })) setAttr(link, name, value.toFixed(1));
    }
    this.#marks(this.open, reply?.open_loop_poles ?? [], () => svg('path', { d: OPEN_MARK }));
    this.#marks(this.loop, design.outer === 'pi' || unused ? reply?.loop_poles ?? [] : [], () => svg('path', { d: LOOP_MARK }));
    drawPins(this.svg, this.#view, state.pins);
    drawCloud(this.cloud, this.#view, state.spread ? state.cloud : null);
    setText(this.cloudText, state.spread ? cloudWords(state.cloud, state.design?.scenario) : '');
    this.#drawReadout();
  }

  /** @param {SVGGElement} layer @param {Complex[]} poles @param {() => SVGElement} make */
  #marks(layer, poles, make) {
    while (layer.childElementCount < poles.length) layer.append(make());
    while (layer.childElementCount > poles.length) layer.lastElementChild?.remove();
    for (const [i, p] of poles.entries()) {
      const [x, y] = toPixel(this.#view, p);
      const mark = /** @type {Element} */ (layer.children[i]);
      setAttr(mark, 'transform', `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
      setAttr(mark, 'class', p.re >= 0 ? 'bad' : '');
    }
  }

  #drawReadout() {
    const design = this.store.state.design;
    const i = this.#active;
    this.readout.hidden = i === null || !design;
    if (i === null || !design) return;
    const p = design.poles[i];
    const pair = pairOf(i);
    const { wn, zeta, settling, overshoot } = character(p);
    const two = isComplex(design.poles, pair);
    const first = Math.min(i, partner(i)) + 1;
    const lines = [
      two ? `${NAMES[pair]} poles ${first}, ${first + 1}` : `${NAMES[pair]} pole ${i + 1}`,
      two ? `${fixed(p.re)} \u00b1 ${fixed(Math.abs(p.im))}j rad/s` : `${fixed(p.re)} rad/s`,
      `ζ ${fixed(zeta)}   ωₙ ${fixed(wn)} rad/s`,
      settling === undefined ? 'grows: unstable' : `settles in ${seconds(settling)}${overshoot === undefined ? '' : `, overshoot ${fixed(overshoot, 0)} %`}`,
    ];
    while (this.readout.childElementCount < lines.length) this.readout.append(h('div'));
    lines.forEach((line, k) => setText(this.readout.children[k], line));
    const [x, y] = toPixel(this.#view, p);
    this.readout.className = `readout ${NAMES[pair]}`;
    const b = bounds(this.#view);
    const low = p.im > (b.top + b.bottom) / 2 + (b.top - b.bottom) / 4;
    const column = Math.max(4, Math.min(x + 24, this.#view.width - this.#readoutWidth - 4));
    this.readout.style.transform = `translate(${column}px, ${low ? y + 26 : y - 26}px) translateY(${low ? '0' : '-100%'})`;
  }
}
