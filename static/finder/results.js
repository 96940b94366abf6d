/**
 * What was found: in words, as a scatter that one brushes, as a table; and where nothing meets all, what contradicts
 * and what each would have to give.
 * @typedef {import('./shapes.js').Found} Found
 * @typedef {import('./shapes.js').SoFar} SoFar
 * @typedef {import('./scatter_math.js').Range} Range
 * @typedef {import('../types.js').Design} Design
 */
import { count, say, significant } from '../text/index.js';
import { button, h, setText } from '../ui/index.js';
import { Candidates } from './candidates.js';
import { Scatter, rangeWords } from './scatter.js';
import { isSame } from './settings.js';
import { axisTitle, begun, brushed, firstAxes, soFarOn } from './scatter_math.js';
import { FoundTable } from './table.js';

export class Results {
  /** @type {Candidates|null} */ #candidates = null;
  /** @type {Map<number, Range>} ranges of figures that are kept */ #brushes = new Map();
  #axes = { x: 0, y: 0 };
  /** @type {SoFar|null} of the search that goes on */ #soFar = null;
  /** @type {import('./shapes.js').Drawn|null} it by itself: nothing was found before in its figures */ #begun = null;

  /**
   * @param {import('../model/store.js').Store} store
   * @param {import('./preview.js').Preview} preview
   * @param {(requirement: Found['requirements'][number], value: number) => void} give
   */
  constructor(store, preview, give) {
    this.store = store;
    this.preview = preview;
    this.give = give;
    const tell = {
      look: (/** @type {number} */ i) => this.#look(i),
      take: (/** @type {number} */ i) => this.#take(i),
      pin: (/** @type {number} */ i) => this.#pin(i),
    };
    this.scatter = new Scatter({
      ...tell,
      press: (i, touched) => this.#press(i, touched),
      brush: (x, y) => this.#brush(x, y),
      clear: () => this.#clear(),
    });
    this.table = new FoundTable(tell);
    const axis = (/** @type {'x'|'y'} */ name, /** @type {string} */ label) => {
      const node = h('select', { 'data-testid': `find-${name}`, 'aria-label': label });
      node.addEventListener('change', () => {
        this.#axes = { ...this.#axes, [name]: Number(node.value) };
        this.#show();
      });
      return node;
    };
    this.axes = { y: axis('y', 'Figure upwards'), x: axis('x', 'Figure to the right') };
    this.words = h('p', { class: 'find-words', 'data-testid': 'find-words', role: 'status' });
    this.stale = h(
      'p',
      { class: 'caption warning', hidden: true, 'data-testid': 'find-stale', role: 'status' },
      'The rig, the experiment or what is not free has changed since: these figures are of before. Find again.',
    );
    this.why = h('div', { class: 'find-why', hidden: true, 'data-testid': 'find-why' });
    this.chips = h('div', { class: 'find-chips' });
    this.touched = h('div', { class: 'row find-touched', hidden: true });
    this.picture = h(
      'div',
      { class: 'find-picture' },
      h(
        'div',
        { class: 'row find-axes' },
        h('label', { class: 'select' }, '↑ ', this.axes.y),
        h('label', { class: 'select' }, '→ ', this.axes.x),
        this.chips,
      ),
      this.scatter.node,
      h(
        'p',
        { class: 'caption find-hint' },
        matchMedia('(hover: none)').matches
          ? 'The page shows the design that you tap. A second tap takes it, a third pins it; Undo gives yours back.'
          : 'The page shows the design under the pointer. A click takes it, another pins it; Undo gives yours ' +
              'back. A drag keeps those within a rectangle.',
      ),
      this.touched,
      this.table.node,
    );
    this.node = h('div', { class: 'find-results', hidden: true }, this.words, this.stale, this.why, this.picture);
    // after a touch the design stays in sight until something else is touched
    document.addEventListener('pointerdown', (e) => {
      if (e.pointerType === 'touch' && e.target instanceof Node && !this.picture.contains(e.target)) this.preview.end();
    });
  }

  /** @param {Found} found @param {Design} from the design that the search began with */
  put(found, from) {
    this.preview.end();
    this.#soFar = null;
    this.#candidates = new Candidates(found, from);
    this.#brushes.clear();
    for (const name of /** @type {const} */ (['x', 'y']))
      this.axes[name].replaceChildren(
        ...found.figures.map((figure, k) => h('option', { value: k }, axisTitle(figure))),
      );
    this.#setAxes(firstAxes(found));
    this.#tell(found);
    this.render(this.store.state);
  }

  /** @param {Found} found */
  #tell(found) {
    const { designs, tried, seconds, stopped, requirements, why } = found;
    const spent = say`${tried.toLocaleString('en')} designs tried in ${significant(seconds, 2)} s`;
    const early = stopped ? say` The time was up before all were tried: another run may find more.` : '';
    const what = !found.met
      ? requirements.length
        ? designs.length
          ? say`No design meets all that is asked; nearest first:`
          : say`No design can meet all that is asked:`
        : say`No design is stable and settles.`
      : count(designs.length, '{0} design, the best', '{0} best compromises');
    setText(this.words, found.met ? `${what}; ${spent}.${early}` : `${what} ${spent}.${early}`);
    this.why.hidden = !why;
    if (!why) return this.why.replaceChildren();
    this.why.replaceChildren(
      h('p', { class: 'find-contradiction' }, why.message),
      h(
        'ul',
        {},
        why.gives.map(({ requirement, value, message }) => {
          const own = requirements[requirement];
          return h(
            'li',
            { 'data-testid': `find-give-${requirement}` },
            h('span', {}, message),
            value === undefined || !own
              ? null
              : button(
                  {
                    class: 'quiet',
                    title: 'Takes this as the limit and searches again',
                    onclick: () => this.give(own, value),
                  },
                  'Allow it',
                ),
          );
        }),
      ),
    );
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    const { pins, preview, design } = state; // also while there is nothing to mark: only what is read is watched
    const own = this.#candidates;
    if (!own) return;
    this.stale.hidden = own.follow(state);
    this.node.classList.toggle('stale', !this.stale.hidden);
    this.#show({ pins, preview, design });
  }

  /** Draws what a search has so far, until it ends. @param {SoFar|null} soFar */
  follow(soFar) {
    const there = soFar && soFar.points.length && soFar.figures.length > 1 ? soFar : null;
    if (there?.points === this.#soFar?.points) return;
    if (there && !this.#soFar) this.#begun = this.#turnedTo(there) ? null : begun(there);
    this.#soFar = there;
    this.#show();
  }

  /** Turns to figures that the search makes better. @param {SoFar} soFar @returns {boolean} whether they are there */
  #turnedTo(soFar) {
    const found = this.#candidates?.found;
    if (!found?.designs.length) return false;
    if (soFarOn(found, this.#axes.x, this.#axes.y, soFar)) return true;
    const [x, y] = soFar.figures.map((own) => found.figures.findIndex((figure) => isSame(figure, own)));
    if (x < 0 || y < 0) return false;
    this.#setAxes({ x, y });
    return true;
  }

  /** @param {{x: number, y: number}} axes */
  #setAxes(axes) {
    this.#axes = axes;
    for (const name of /** @type {const} */ (['x', 'y'])) this.axes[name].value = String(axes[name]);
  }

  /** @param {Pick<import('../types.js').State, 'pins'|'preview'|'design'>} [state] */
  #show(state = this.store.state) {
    const own = this.#candidates;
    const alone = this.#soFar && this.#begun;
    this.node.classList.toggle('begun', Boolean(alone));
    this.node.hidden = !own && !alone;
    this.picture.hidden = !own?.found.designs.length && !alone;
    const { x, y } = alone ? { x: 0, y: 1 } : this.#axes;
    const drawn = alone ?? own?.found;
    const soFar = this.#soFar && drawn ? soFarOn(drawn, x, y, this.#soFar) : null;
    if (alone)
      this.scatter.show({ found: alone, kept: new Set(), active: -1, taken: -1, pins: new Map(), x, y, soFar });
    if (alone || !own) return;
    const { found } = own;
    const kept = brushed(found, this.#brushes);
    const pins = new Map(state.pins.map((pin) => [own.indexOf(pin.design), pin.index]));
    const active = own.indexOf(state.preview?.design ?? null);
    const seen = { found, kept, active, taken: own.indexOf(state.design), pins, soFar, ...this.#axes };
    this.scatter.show(seen);
    this.table.show(seen);
    this.chips.replaceChildren(
      ...[...this.#brushes].map(([k, range]) =>
        button(
          {
            class: 'quiet',
            'data-testid': `find-brush-${k}`,
            title: 'Shows those beyond this range again',
            onclick: () => {
              this.#brushes.delete(k);
              this.#show();
            },
          },
          `${rangeWords(found, k, range)} ×`,
        ),
      ),
    );
  }

  /** @param {number} i */
  #design(i) {
    return this.#candidates?.design(i, this.store.state) ?? null;
  }

  /** @param {number} i −1: at none */
  #look(i) {
    const design = i < 0 ? null : this.#design(i);
    if (design) this.preview.show(design);
    else this.preview.end();
  }

  /** @param {number} i @param {boolean} touched the first touch only looks */
  #press(i, touched) {
    const design = this.#design(i);
    if (!design) return;
    if (touched && this.preview.design !== design && this.store.state.design !== design) this.#look(i);
    else if (this.store.state.design === design) this.#pin(i);
    else this.#take(i);
  }

  /** @param {number} i */
  #take(i) {
    const design = this.#design(i);
    if (design) this.preview.take(design);
  }

  /** Once. @param {number} i */
  #pin(i) {
    const design = this.#design(i);
    if (design && this.store.state.pins.every((pin) => pin.design !== design)) this.store.pin(design);
  }

  /** @param {Range} x @param {Range} y */
  #brush(x, y) {
    this.#brushes.set(this.#axes.x, x);
    this.#brushes.set(this.#axes.y, y);
    this.#show();
  }

  #clear() {
    this.preview.end();
    if (!this.#brushes.size) return;
    this.#brushes.clear();
    this.#show();
  }
}
