/**
 * A field in which a point is dragged over a map: k_p × T_i of an axis, or both poles of a real pair. It is for
 * pointers; keys move the sliders or poles that it stands beside.
 * @typedef {import('./types.d.ts').Span} Span
 */
import { fixed, significant, t } from '../text/index.js';
import { niceStep, ticks } from '../model/index.js';
import { drawingUnit, h, setAttr, setText, svg } from '../ui/index.js';
import { placeIn, shareIn } from './feed.js';
import { layersOf, upright } from './layers.js';
import { lookOf, lookOfPage } from './look.js';
import { inUnit, rangeText, valueText } from './choices.js';
import { between } from './contours.js';
import { paintMap } from './picture.js';
import { beyond, known, levelsIn } from './scale.js';

/** Room for the axes' numbers, in the drawing's units. */
const [LEFT, BOTTOM, TOP, RIGHT] = [34, 20, 6, 8];

export class Pad {
  /** @type {{field: import('./types.d.ts').Field, asked: import('./types.d.ts').Asked}|null} */ #map = null;
  /** @type {{x: Span, y: Span}|null} */ #domain = null;
  /** @type {{x: number, y: number}|null} */ #point = null;
  /** @type {import('./types.d.ts').Field|null} */ #painted = null;
  #size = [0, 0];
  /** CSS pixels to one of the drawing's. */ #unit = 1;
  /** Of its own, beyond the scale. @type {number[]} */ #levels = [];
  /** @type {import('./layers.js').Layers|null} */ layers = null;
  #held = false;
  #stale = false;
  /** Whether its axes are. @type {true|null} */ #drawn = null;

  /**
   * @param {{kind: 'pitch'|'yaw', testid: string, title: string, x: string, y: string, busy: () => boolean,
   *   move: (x: number, y: number, stamp: number) => void, end: () => void, free: () => boolean,
   *   scale: (name: string) => number[], range?: boolean, seen?: () => void}} how  x, y: what stands at the axes;
   *   free: whether the point may be moved; scale: the levels of its colours; range: whether it tells its least and
   *   largest value; seen: it is now seen, or no more
   */
  constructor(how) {
    this.how = how;
    this.canvas = h('canvas', { class: 'pad-map' });
    this.axes = svg('g', { class: 'pad-axes' });
    this.here = svg('text', { class: 'pad-here', 'text-anchor': 'end' });
    const ring =
      how.kind === 'pitch' ? svg('circle', { r: 8 }) : svg('rect', { x: -7, y: -7, width: 14, height: 14, rx: 2 });
    this.point = svg('g', { class: `pad-point ${how.kind}` }, ring, svg('circle', { class: 'dot', r: 2.2 }));
    this.state = svg('text', { class: 'pad-state', 'text-anchor': 'middle' });
    this.svg = svg('svg', { class: 'splane-svg pad-svg' }, this.axes, this.point, this.here, this.state);
    this.node = h(
      'div',
      { class: `pad ${how.kind}`, 'data-testid': how.testid, title: how.title, 'aria-hidden': 'true' },
      this.canvas,
      this.svg,
    );
    this.svg.addEventListener('pointerdown', (e) => this.#down(e));
    this.svg.addEventListener('pointermove', (e) => this.#move(e));
    for (const end of /** @type {const} */ (['pointerup', 'pointercancel', 'lostpointercapture']))
      this.svg.addEventListener(end, () => this.#up());
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      this.#painted = null;
      this.draw();
    });
    this.svg.addEventListener('pointerleave', () => this.#tellRange());
    new ResizeObserver(([{ contentRect }]) => {
      const was = this.isSeen;
      const unit = (this.#unit = drawingUnit());
      this.#size = [contentRect.width / unit, contentRect.height / unit];
      setAttr(this.svg, 'viewBox', `0 0 ${this.#size.join(' ')}`);
      this.#painted = this.#drawn = null;
      this.draw();
      if (was !== this.isSeen) this.how.seen?.();
    }).observe(this.node);
  }

  /** @param {import('./types.d.ts').Field|null} field @param {import('./types.d.ts').Asked|null} asked */
  show(field, asked) {
    this.#map = field && asked && { field, asked };
    this.draw();
  }

  /** @param {{x: Span, y: Span}} domain @param {{x: number, y: number}} point */
  place(domain, point) {
    const same = this.#domain && JSON.stringify(domain) === JSON.stringify(this.#domain);
    if (!same) this.#painted = this.#drawn = null;
    this.#domain = domain;
    this.#point = point;
    this.draw();
  }

  /** What the server does for it. @param {import('./told.js').Told} told */
  tell({ computing, refused }) {
    this.node.classList.toggle('stale', computing);
    this.#stale = computing;
    setText(this.state, computing ? t('computing…') : refused ? t('no map') : '');
    this.#tellRange();
  }

  /** The scale is another. */
  repaint() {
    this.#painted = null;
    this.draw();
  }

  /** Whether there is room for it. */
  get isSeen() {
    return this.#size[0] > 0;
  }

  get #box() {
    const [width, height] = this.#size;
    return { x: LEFT, y: TOP, width: width - LEFT - RIGHT, height: height - TOP - BOTTOM };
  }

  draw() {
    const [domain, point, box] = [this.#domain, this.#point, this.#box];
    if (!domain || !point || box.width < 20 || box.height < 20) return;
    const share = (/** @type {number} */ s) => Math.max(0, Math.min(1, s));
    const [x, y] = [
      box.x + box.width * share(shareIn(domain.x, point.x)),
      box.y + box.height * (1 - share(shareIn(domain.y, point.y))),
    ];
    setAttr(this.point, 'transform', `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
    this.node.classList.toggle('fixed', !this.how.free());
    const field = this.#map?.field ?? null;
    if (this.#painted === field && field) return;
    if (!this.#drawn) this.#drawAxes(domain, box);
    this.#drawn = true;
    this.#paint(box);
    this.#painted = field;
    this.#tellRange();
  }

  /** @param {import('./picture.js').Box} box */
  #paint(box) {
    const ratio = devicePixelRatio * this.#unit;
    const [width, height] = this.#size.map((v) => Math.round(v * ratio));
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    const ctx = this.canvas.getContext('2d');
    if (!ctx) return;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, width, height);
    if (!this.#map) {
      this.layers = null;
      return;
    }
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    const { field, asked } = this.#map;
    const { name } = asked.measure;
    const shown = (/** @type {number} */ v) => inUnit(name, v);
    if (!this.how.busy() || !this.#levels.length) this.#levels = levelsIn(known(field, name), name);
    const scale = this.how.scale(name);
    const levels = beyond(scale, this.#levels);
    this.layers = layersOf(upright(field), shown, levels, [{}, ...asked.limits]);
    const look = lookOf(name, levels, lookOfPage(this.node, 10), scale.length ? scale : levels);
    paintMap(ctx, this.layers, box, look, { avoid: namesIn(box) });
  }

  /** @param {{x: Span, y: Span}} domain @param {import('./picture.js').Box} box */
  #drawAxes({ x, y }, box) {
    /** @type {SVGElement[]} */ const nodes = [
      svg('rect', { class: 'pad-frame', x: box.x, y: box.y, width: box.width, height: box.height }),
    ];
    const foot = box.y + box.height;
    for (const v of marksOf(x, box.width / 44)) {
      const at = box.x + box.width * shareIn(x, v);
      nodes.push(
        svg('line', { class: 'pad-tick', x1: at, x2: at, y1: foot, y2: foot + 3 }),
        svg('text', { x: at, y: foot + 14, 'text-anchor': 'middle' }, written(v)),
      );
    }
    for (const v of marksOf(y, box.height / 26)) {
      const at = box.y + box.height * (1 - shareIn(y, v));
      nodes.push(
        svg('line', { class: 'pad-tick', x1: box.x - 3, x2: box.x, y1: at, y2: at }),
        svg('text', { x: box.x - 5, y: at + 4, 'text-anchor': 'end' }, written(v)),
      );
    }
    nodes.push(
      svg('text', { class: 'pad-name', x: box.x + box.width, y: foot - 5, 'text-anchor': 'end' }, this.how.x),
      svg('text', { class: 'pad-name', x: box.x + 5, y: box.y + 13 }, this.how.y),
    );
    this.axes.replaceChildren(...nodes);
  }

  /** @param {PointerEvent} e @returns {{x: number, y: number, shares: [number, number]}|null} */
  #at(e) {
    if (!this.#domain) return null;
    const { left, top } = this.svg.getBoundingClientRect();
    const [unit, box] = [this.#unit, this.#box];
    const share = (/** @type {number} */ s) => Math.max(0, Math.min(1, s));
    const s = share(((e.clientX - left) / unit - box.x) / box.width);
    const t = share(1 - ((e.clientY - top) / unit - box.y) / box.height);
    return { x: placeIn(this.#domain.x, s), y: placeIn(this.#domain.y, t), shares: [s, t] };
  }

  /** @param {PointerEvent} e */
  #down(e) {
    if (e.button !== 0 || !this.how.free()) return;
    this.#held = true;
    this.svg.setPointerCapture(e.pointerId);
    this.#take(e);
    e.preventDefault();
  }

  /** @param {PointerEvent} e */
  #move(e) {
    if (this.#held) this.#take(e);
    this.#tell(e);
  }

  /** @param {PointerEvent} e */
  #take(e) {
    const at = this.#at(e);
    if (at) this.how.move(Number(at.x.toPrecision(3)), Number(at.y.toPrecision(3)), e.timeStamp);
  }

  /** @param {PointerEvent} e */
  #tell(e) {
    const [at, layers] = [this.#at(e), this.layers];
    if (!at || !layers || !this.#map || this.#stale) return;
    const { field, asked } = this.#map;
    const [s, t] = at.shares;
    const text = valueAt(field, layers, s, t, asked.measure.name);
    setText(this.here, text);
  }

  /** Where no pointer asks for more: from what to what its values go. */
  #tellRange() {
    const map = this.#map;
    const { x, y, width, height } = this.#box;
    setAttr(this.here, 'x', x + width - 5);
    setAttr(this.here, 'y', y + 13);
    setAttr(this.state, 'x', x + width / 2);
    setAttr(this.state, 'y', y + height / 2);
    const shown = map && this.how.range && !this.#stale;
    setText(this.here, shown ? rangeText(map.asked.measure.name, map.field) : '');
  }

  #up() {
    if (!this.#held) return;
    this.#held = false;
    this.how.end();
  }
}

/** Where the axes' names stand, which no label may cover. @param {import('./picture.js').Box} box */
const namesIn = ({ x, y, width, height }) =>
  /** @type {[number, number][]} */ ([
    [x + 10, y + 9],
    ...[12, 34].map((away) => [x + width - away, y + height - 9]),
    ...[12, 40, 68].map((away) => [x + width - away, y + 9]),
  ]);

/**
 * What a map says somewhere, in words.
 * @param {import('./types.d.ts').Field} field @param {import('./layers.js').Layers} layers  of it, its last row first
 * @param {number} s @param {number} t  shares of its width and height, from its first column and row
 * @param {string} name
 */
export function valueAt({ columns, rows, values, stable }, { grid }, s, t, name) {
  const node = Math.round(t * (rows - 1)) * columns + Math.round(s * (columns - 1));
  if (stable[node] === 0) return '–';
  if (stable[node] === 1) return 'unstable';
  if (!Number.isFinite(values[node])) return valueText(name, values[node]);
  const scale = inUnit(name, 1);
  return valueText(name, between(grid, s * (grid.columns - 1), (1 - t) * (grid.rows - 1)) / scale);
}

/** Round numbers along a span. @param {Span} span @param {number} most */
function marksOf({ from, to, log }, most) {
  if (!log) return ticks(from, to, niceStep(to - from, Math.max(2, most)));
  const all = [];
  for (let e = Math.floor(Math.log10(from)); e <= Math.ceil(Math.log10(to)); e++)
    for (const m of [1, 2, 5]) all.push(Number((m * 10 ** e).toPrecision(6)));
  const seen = all.filter((v) => v >= from && v <= to);
  const tens = seen.filter((v) => Math.abs(Math.log10(v) - Math.round(Math.log10(v))) < 1e-9);
  return seen.length <= most ? seen : tens;
}

/** @param {number} v */
const written = (v) => (Number.isInteger(v) ? fixed(v, 0) : significant(v, 2));
