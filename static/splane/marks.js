/**
 * What is drawn for the poles: four handles that take focus and speak, under each its mark (pitch round, yaw square),
 * the link of each pair, and the crosses and diamonds of the open and the whole loop.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {import('../types.js').State} State
 * @typedef {import('./math.js').View} View
 */
import { poleText, say } from '../text/index.js';
import {
  axisOf,
  guideWords,
  HANDLES,
  handlesOf,
  isAsked,
  kindOf,
  numeralOf,
  pairAlone,
  placesPoles,
} from '../model/index.js';
import { setAttr, svg } from '../ui/index.js';
import { toPixel } from './math.js';

export const NAMES = ['pitch', 'yaw'];
const CROSS = 'M -5.5 -5.5 L 5.5 5.5 M -5.5 5.5 L 5.5 -5.5';
const OPEN_MARK = 'M -4 -4 L 4 4 M -4 4 L 4 -4';
const LOOP_MARK = 'M 0 -5.5 L 5.5 0 L 0 5.5 L -5.5 0 Z';
const TITLE =
  'Drag, or use the arrow keys (Shift: fine, Page keys: coarse). Drag two real poles of a pair together, then off ' +
  'the axis: they turn complex.\n' +
  'Where marks overlap, Tab or 1 to 6 brings another to the top.';
const RINGS = /** @type {const} */ ({
  placed: { pitch: ['circle', { r: 11 }], yaw: ['rect', { x: -10, y: -10, width: 20, height: 20, rx: 2 }] },
  rotor: { pitch: ['path', { d: 'M 0 -12 L 11 8 L -11 8 Z' }], yaw: ['path', { d: 'M 0 12 L 11 -8 L -11 -8 Z' }] },
  observer: { pitch: ['circle', { r: 8 }], yaw: ['rect', { x: -7, y: -7, width: 14, height: 14, rx: 2 }] },
});
const WHOSE = { placed: '', rotor: 'rotor ', observer: 'observer ' };

/** @param {number} i */
export const nameOf = (i) => `${NAMES[axisOf(i)]} ${WHOSE[kindOf(i)]}pole ${numeralOf(i)}`;

/** @param {number} i a handle: what is pressed, focused and heard */
function handle(i) {
  return svg(
    'g',
    {
      class: `pole ${kindOf(i)}`,
      'data-testid': `pole-${i}`,
      'data-index': i,
      tabindex: 0,
      role: 'slider',
      'aria-label': nameOf(i),
      'aria-valuemin': -1e5,
      'aria-valuemax': 1e5,
    },
    svg('title', {}, TITLE),
    svg('circle', { class: 'reach', r: 28 }),
    svg('circle', { class: 'hit', r: 19 }),
  );
}

/** @param {number} i a mark: what is seen */
function mark(i) {
  const name = /** @type {'pitch'|'yaw'} */ (NAMES[axisOf(i)]);
  const [tag, shape] = RINGS[kindOf(i)][name];
  return svg(
    'g',
    { class: `pole-mark ${kindOf(i)} ${name}`, 'data-testid': `pole-mark-${i}` },
    svg(tag, { class: 'ring', ...shape }),
    svg('path', { class: 'cross', d: CROSS }),
  );
}

/** Its number, over all marks. @param {number} i */
const numeral = (i) => svg('text', { class: `name ${NAMES[axisOf(i)]}`, x: 14 }, numeralOf(i));

/** A sample of the two kinds of marks that are not dragged, for the key. @param {'open'|'loop'} kind */
export const sample = (kind) =>
  svg(
    'svg',
    { class: `${kind}-poles`, 'aria-hidden': 'true', viewBox: '-7 -7 14 14' },
    svg('path', { d: kind === 'open' ? OPEN_MARK : LOOP_MARK }),
  );

export class Marks {
  /** Indices of the poles from the lowest to the topmost mark. */
  order = HANDLES.toReversed();

  constructor() {
    this.open = svg('g', { class: 'open-poles', 'data-testid': 'open-poles' });
    this.loop = svg('g', { class: 'loop-poles', 'data-testid': 'loop-poles' });
    /** Of a pair, by the handle of its first pole. @type {Record<number, SVGElement>} */
    this.links = Object.fromEntries(
      [0, 2, 6, 8].map((i) => [i, svg('line', { class: `link ${kindOf(i)} ${NAMES[axisOf(i)]}` })]),
    );
    this.path = svg('path', { class: 'loop-path', 'data-testid': 'loop-path', 'aria-hidden': 'true' });
    this.handles = HANDLES.map(handle);
    this.marks = HANDLES.map(mark);
    this.names = HANDLES.map(numeral);
    for (const i of HANDLES) if (kindOf(i) !== 'placed') this.#show(i, false);
    this.seen = svg(
      'g',
      { 'aria-hidden': 'true' },
      this.order.map((i) => this.marks[i]),
    );
    this.nodes = [
      this.open,
      ...Object.values(this.links),
      this.path,
      this.loop,
      this.seen,
      svg('g', { 'aria-hidden': 'true' }, this.names),
      ...this.handles,
    ];
  }

  /**
   * Brings a pole's mark to the top. The handles keep their order, which is that of the Tab key.
   * @param {number} index
   */
  raise(index) {
    if (this.order.at(-1) === index) return;
    this.order = [...this.order.filter((i) => i !== index), index];
    this.seen.append(this.marks[index]);
  }

  /** @param {State} state @param {View} view @param {boolean} fresh whether the view changed */
  draw(state, view, fresh) {
    const { design, reply, requirements } = state;
    if (!design) return;
    const alone = pairAlone(state);
    if (fresh || design !== this.#design || requirements !== this.#requirements || alone !== this.#alone)
      this.#drawPlaced(handlesOf(design, alone), view, requirements);
    this.#alone = alone;
    this.#design = design;
    this.#requirements = requirements;
    // where they are none but the placed ones, these are all there is to see
    const more = reply && reply.loop_poles.length > reply.gains.closed_loop_poles.length;
    const whole = design.outer === 'pi' || more || !placesPoles(state) ? reply?.loop_poles : undefined;
    if (fresh || reply?.open_loop_poles !== this.#shown.open)
      this.#drawOthers(this.open, OPEN_MARK, (this.#shown.open = reply?.open_loop_poles) ?? [], view);
    if (fresh || whole !== this.#shown.loop)
      this.#drawOthers(this.loop, LOOP_MARK, (this.#shown.loop = whole) ?? [], view);
  }

  /** @type {import('../types.js').Design|null} */ #design = null;
  /** @type {0|1|null} */ #alone = null;
  /** @type {import('../types.js').Requirements|null} */ #requirements = null;
  /** @type {{open?: Complex[], loop?: Complex[]}} */ #shown = {};

  /** @param {number} i @param {boolean} shown */
  #show(i, shown) {
    for (const node of [this.handles[i], this.marks[i], this.names[i], this.links[i]])
      if (node) setAttr(node, 'display', shown ? 'inline' : 'none');
  }

  /**
   * @param {readonly (Complex|undefined)[]} poles
   * @param {View} view
   * @param {import('../types.js').Requirements} requirements
   */
  #drawPlaced(poles, view, requirements) {
    const at = poles.map((p) => p && toPixel(view, p).map((v) => v.toFixed(1)));
    for (const i of HANDLES) {
      const p = poles[i];
      this.#show(i, Boolean(p));
      const place = `translate(${at[i]?.join(' ')})`;
      if (!p) continue;
      setAttr(this.handles[i], 'transform', place);
      setAttr(this.marks[i], 'transform', place);
      setAttr(this.names[i], 'transform', place);
      setAttr(this.handles[i], 'aria-valuenow', p.re);
      const guide = kindOf(i) === 'placed' && isAsked(requirements) ? guideWords(p, requirements) : '';
      setAttr(
        this.handles[i],
        'aria-valuetext',
        guide ? say`${poleText(p, nameOf(i))}, guide: alone ${guide} than asked` : poleText(p, nameOf(i)),
      );
      // Labels of a pair stand apart even where its poles meet or lie mirrored.
      const below = p.im < 0 || (p.im === 0 && i % 2 === 1);
      setAttr(this.names[i], 'y', below ? 20 : -11);
      const [link, other] = [this.links[i], at[i + 1]];
      if (!link || !other) continue;
      const [x1, y1, x2, y2] = [...(at[i] ?? []), ...other];
      for (const [name, value] of Object.entries({ x1, y1, x2, y2 })) setAttr(link, name, value);
    }
  }

  /** @type {readonly Complex[]|null} */ #way = null;

  /**
   * The way of a placed pole to where the PI loops take it, and that pole of the whole loop.
   * @param {{index: number, path: Complex[]}|null} way
   * @param {View} view
   * @param {boolean} fresh whether the view changed
   */
  drawPath(way, view, fresh) {
    if (!fresh && this.#way === (way?.path ?? null)) return;
    this.#way = way?.path ?? null;
    const at = way
      ? way.path.map((p) =>
          toPixel(view, p)
            .map((v) => v.toFixed(1))
            .join(' '),
        )
      : [];
    setAttr(this.path, 'd', at.length ? `M ${at.join(' L ')}` : '');
    setAttr(this.path, 'class', `loop-path ${way ? NAMES[axisOf(way.index)] : ''}`);
    const end = way?.path.at(-1);
    for (const [i, node] of [...this.loop.children].entries())
      node.classList.toggle('target', end !== undefined && this.#shown.loop?.[i] === end);
  }

  /** @param {SVGGElement} layer @param {string} d @param {Complex[]} poles @param {View} view */
  #drawOthers(layer, d, poles, view) {
    while (layer.childElementCount < poles.length) layer.append(svg('path', { d }));
    while (layer.childElementCount > poles.length) layer.lastElementChild?.remove();
    for (const [i, p] of poles.entries()) {
      const [x, y] = toPixel(view, p);
      const node = /** @type {Element} */ (layer.children[i]);
      setAttr(node, 'transform', `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
      setAttr(node, 'class', p.re >= 0 ? 'bad' : '');
    }
  }
}
