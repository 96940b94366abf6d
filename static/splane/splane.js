/**
 * The s-plane: four poles to drag, by mouse, finger or key, over the open loop's poles and those of the whole loop. It
 * draws the store's design at once, without waiting for the server. Its parts: splane_gestures (input), _marks, _grid,
 * _pins and _requirements (drawing), _readout (words), _math (pure).
 * @typedef {import('../types.js').State} State
 */
import { handlesOf, pairAlone, placesPoles } from '../model/index.js';
import { button, drawingUnit, h, setText, svg } from '../ui/index.js';
import { loopPaths } from './loop_paths.js';
import { Gestures } from './gestures.js';
import { drawGrid } from './grid.js';
import { Marks, sample } from './marks.js';
import { fit, outgrown, slower, zoom } from './math.js';
import { drawPins } from './pins.js';
import { Readout } from './readout.js';
import { drawForbidden, hatchings, RequirementsBar } from './requirements.js';

/** So many times faster than the slower ones, poles that nobody placed do not make the rest tiny. */
const FAR = 6;
/** Relative uncertainties of the rigs in a cloud. */
const SPREADS = [0, 0.05, 0.1, 0.2];

/** @param {number} spread */
const spreadOption = (spread) =>
  h('option', { value: spread }, spread ? `± ${Number((100 * spread).toPrecision(6))} %` : 'none');

export class SPlane {
  view = { cx: -5, cy: 0, scale: 20, width: 0, height: 0 };
  /** CSS pixels to one of the drawing, which grows with the page. */ unit = 1;
  #manual = false;
  /** @type {string|null} */ #preset = null;
  #known = false;
  /** @type {0|1|null} */ #alone = null;
  /** @type {number|null} */ #active = null;
  /**
   * What is drawn over the plane by others, told whether the view is a new one.
   * @type {((fresh: boolean) => void)|null}
   */
  over = null;
  /** What is drawn under its poles by others. @type {(() => void)|null} */ under = null;
  /** @type {import('./math.js').View|null} */ #drawn = null;
  /** @type {import('../types.js').Requirements|null} */ #asked = null;
  /** @type {import('../types.js').Reply|null} whose paths they are */ #solved = null;
  /** @type {import('./loop_paths.js').Paths|null} */ #paths = null;

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.root = root;
    this.grid = svg('g');
    this.forbidden = svg('g');
    this.marks = new Marks();
    // The grid has a drawing of its own, which is not painted again while a pole moves.
    this.backdrop = svg(
      'svg',
      { class: 'splane-svg backdrop', 'aria-hidden': 'true' },
      svg(
        'defs',
        {},
        svg(
          'pattern',
          { id: 'hatch', width: 8, height: 8, patternUnits: 'userSpaceOnUse', patternTransform: 'rotate(45)' },
          svg('line', { class: 'hatch-line', x1: 0, y1: 0, x2: 0, y2: 8 }),
        ),
        hatchings(),
      ),
      this.grid,
      this.forbidden,
    );
    this.svg = svg(
      'svg',
      { class: 'splane-svg', 'data-testid': 'splane', role: 'group', 'aria-label': 'Poles in the s-plane' },
      this.marks.nodes,
    );
    this.readout = new Readout();
    this.spread = h(
      'select',
      {
        'data-testid': 'spread',
        title:
          'Model uncertainty: the same controller on rigs whose parameters differ by so much; their poles as dots, ' +
          'their responses as bands',
        onchange: () => store.set({ spread: Number(this.spread.value) }),
      },
      SPREADS.map(spreadOption),
    );
    const tool = (
      /** @type {string} */ text,
      /** @type {string} */ name,
      /** @type {string} */ key,
      /** @type {string} */ id,
      /** @type {() => void} */ act,
    ) => button({ title: `${name} (${key}, on a pole)`, 'aria-label': name, 'data-testid': id, onclick: act }, text);
    const tools = h(
      'div',
      { class: 'splane-tools' },
      tool('+', 'Zoom in', '+', 'zoom-in', () => this.#zoomBy(1.4)),
      tool('\u2212', 'Zoom out', '\u2212', 'zoom-out', () => this.#zoomBy(1 / 1.4)),
      tool('Fit', 'Fit all poles into view', 'F', 'fit', () => this.fit()),
      (this.more = h('span')),
      (this.key = h(
        'div',
        { class: 'splane-key', 'data-testid': 'splane-key' },
        h(
          'span',
          { title: 'poles of the whole loop: PI moves the poles that you placed' },
          sample('loop'),
          (this.loopName = h('span')),
        ),
        h('span', { title: 'poles of the rig without feedback' }, sample('open'), 'open loop'),
      )),
    );
    this.bar = new RequirementsBar(store);
    const extra = h(
      'div',
      { class: 'splane-extra' },
      h('label', { class: 'select' }, h('span', {}, 'Model uncertainty'), this.spread),
      this.bar.opener,
      this.bar.node,
    );
    root.append(h('div', { class: 'splane-stage' }, this.backdrop, this.svg, this.readout.node), tools, extra);
    this.gestures = new Gestures(this);
    new ResizeObserver(([entry]) => this.#resize(entry.contentRect.width, entry.contentRect.height)).observe(this.svg);
  }

  /** Names the pole that the readout is about; while one is held, it is that one. */
  activate = (/** @type {number|null} */ index) => {
    const held = this.gestures.held;
    if (index === this.#active || (held !== null && index !== held)) return;
    this.#active = index;
    this.readout.draw(this.store.shown, index, this.view, this.unit, this.#target());
    this.#link(true);
  };

  /** Takes a view that the user chose; it stays until asked to fit. */
  look = (/** @type {import('./math.js').View} */ view) => {
    this.#manual = true;
    this.view = view;
    this.#draw(this.store.shown);
  };

  fit = (state = this.store.shown) => {
    const { design, reply } = state;
    if (!design || !this.view.width) return;
    this.#manual = false;
    const own = this.#own(state);
    const room = pairAlone(state) === null ? [] : own.map((p) => ({ re: p.re, im: p.re })); // to swing
    this.view = fit([...own, ...room], [...(reply?.loop_poles ?? []), ...(reply?.open_loop_poles ?? [])], this.view);
    this.#draw(state);
  };

  /** What the view is to show: what is dragged; of a method that chooses its own poles, these. @param {State} state */
  #own(state) {
    const { design, reply, answered } = state;
    const own = placesPoles(state) || answered?.method !== design?.method ? undefined : reply?.gains.optimal_poles;
    const placed =
      own ??
      handlesOf(/** @type {import('../types.js').Design} */ (design), pairAlone(state)).filter((p) => p !== undefined);
    const kalman = design?.observer?.method === 'kalman' && design.scenario.measured === 'observer';
    return slower([...placed, ...((kalman && reply?.observer?.poles) || [])], own || kalman ? FAR : Infinity);
  }

  /** @param {number} width @param {number} height CSS pixels */
  #resize(width, height) {
    this.unit = drawingUnit();
    this.view = { ...this.view, width: width / this.unit, height: height / this.unit };
    for (const drawn of [this.backdrop, this.svg])
      drawn.setAttribute('viewBox', `0 0 ${this.view.width} ${this.view.height}`);
    if (this.#manual) this.look(this.view);
    else this.fit();
  }

  /** @param {number} factor */
  #zoomBy(factor) {
    this.look(zoom(this.view, factor, this.view.width / 2, this.view.height / 2));
  }

  /** @param {State} state */
  render(state) {
    const { design, reply, answered, dragging } = state;
    if (!design || !this.view.width) return;
    const fresh = design.preset !== this.#preset || pairAlone(state) !== this.#alone;
    const known = answered?.preset === design.preset; // and so are its loop's poles
    const first = known && !this.#known && !this.#manual;
    this.#known = known;
    this.#preset = design.preset;
    this.#alone = pairAlone(state);
    const watched = [...this.#own(state), ...(reply?.loop_poles ?? []).filter((p) => p.re >= 0)];
    if (!dragging && (fresh || first || (!this.#manual && outgrown(this.view, watched)))) this.fit(state);
    else this.#draw(state);
  }

  /** What is read beside the pole in question. @param {State} state */
  renderReadout({ design, methods, reply, answered, requirements, view, motion }) {
    this.readout.write({ design, methods, reply, answered, requirements, view, motion }, this.#active, this.#target());
  }

  /** Where the PI loops take the pole in question; of what is shown last, as all figures are. */
  #target() {
    const { reply, answered } = this.store.shown;
    if (this.#active === null || !placesPoles(this.store.shown)) return undefined;
    if (reply !== this.#solved) [this.#solved, this.#paths] = [reply, loopPaths(reply, answered)];
    return this.#paths?.[this.#active]?.at(-1);
  }

  /** Draws the way of the pole in question to its pole of the whole loop. @param {boolean} fresh */
  #link(fresh) {
    const to = this.#target();
    this.marks.drawPath(
      to && this.#active !== null && this.#paths ? { index: this.#active, path: this.#paths[this.#active] } : null,
      this.view,
      fresh,
    );
  }

  /** One that a link asks for is offered, too. @param {number} spread */
  #offer(spread) {
    if (Number(this.spread.value) === spread) return;
    this.spread.value = String(spread);
    if (this.spread.selectedIndex >= 0) return;
    this.spread.append(spreadOption(spread));
    this.spread.value = String(spread);
  }

  /** @param {State} state */
  #draw(state) {
    const { design, requirements, spread, pins } = state;
    if (!design) return;
    const fresh = this.view !== this.#drawn;
    this.#drawn = this.view;
    if (fresh) drawGrid(this.grid, this.view);
    if (fresh || requirements !== this.#asked) drawForbidden(this.forbidden, this.view, requirements);
    this.#asked = requirements;
    const unused = !placesPoles(state); // then the loop's own poles are all there is to see
    this.root.classList.toggle('unused', unused);
    const more = (state.reply?.loop_poles.length ?? 0) > 6 || design.outer === 'none'; // rotors, filters, an observer
    setText(this.loopName, unused || more ? 'whole loop' : 'with PI');
    this.marks.draw(state, this.view, fresh);
    drawPins(this.svg, this.view, pins);
    this.#offer(spread);
    this.under?.();
    this.readout.draw(state, this.#active, this.view, this.unit, this.#target());
    this.#link(fresh);
    this.over?.(fresh);
    this.bar.render(state);
  }
}
