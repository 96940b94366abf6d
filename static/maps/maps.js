/**
 * Maps: behind the s-plane in colour what each place would give for the pair in hand; for a real pair its own plane;
 * and for the PI loops a field each, in which the point is dragged.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('./types.d.ts').Asked} Asked
 * @typedef {import('./types.d.ts').Choice} Choice
 * @typedef {import('./types.d.ts').Move} Move
 * @typedef {ConstructorParameters<typeof MapFeed>[0]} Show
 */
import { axisOf, handlesOf, hides, isComplex, kindOf, placesPoles, presetOf, setReal, tidy } from '../model/index.js';
import { h, setAttr } from '../ui/index.js';
import { toPixel } from '../splane/index.js';
import { Bar, fieldsButton, LOW } from './bar.js';
import { choiceOf, CHOICES, linkOf, measureOf } from './choices.js';
import { emptierSide } from './corner.js';
import { MapFeed } from './feed.js';
import { Legend } from './legend.js';
import { lookOf, lookOfPage } from './look.js';
import { Pad } from './pad.js';
import { PlaneMap } from './plane_map.js';
import { Scale } from './scale.js';
import { fromServer, saveButton } from './server.js';
import { Teller } from './told.js';

const NAMES = /** @type {const} */ (['pitch', 'yaw']);
const AXES = /** @type {const} */ (['theta', 'psi']);
/** Of the rigs, where the page shows no cloud. */
const SPREAD = 0.1;
/** Of the plane in which a real pair's own has room, px. */
const LEAST = 205;
/** Poles this near to the imaginary axis are on none of the maps, of what is seen. */
const EDGE = 1e-3;

export class Maps {
  /** The pair that was touched last. @type {0|1} */ #hand = 0;
  /** Whether the loops' fields are wanted in a low window; null: where the plane has no map. @type {boolean|null} */
  #fields = null;
  #low = matchMedia(LOW);
  /** @type {Design|null} */ #seen = null;
  /** @type {State|null} */ #state = null;
  /** The plane's, for which maps were asked. @type {import('../splane/splane.js').SPlane['view']|null} */ #view = null;

  /**
   * @param {import('../splane/splane.js').SPlane} plane
   * @param {HTMLElement} loops  the panel of the PI loops
   * @param {import('../model/store.js').Store} store
   */
  constructor(plane, loops, store) {
    this.plane = plane;
    this.store = store;
    this.loops = loops;
    const hand = {
      busy: () => store.busy,
      now: () => performance.now(),
      later: (/** @type {() => void} */ act, /** @type {number} */ ms) => setTimeout(act, ms),
      cancel: (/** @type {ReturnType<typeof setTimeout>|undefined} */ timer) => clearTimeout(timer),
    };
    this.legend = new Legend();
    this.scale = new Scale(hand.busy, () => this.#rescale());
    this.map = new PlaneMap(plane, store, () => {
      this.scale.lead(this.map.map && this.map.map.asked.measure.name, this.map.levels);
      this.#tell();
    });
    this.bar = new Bar((choice) => store.set({ map: linkOf(choice) }));
    const stage = /** @type {HTMLElement} */ (plane.svg.parentElement);
    this.saves = saveButton(store, () => this.map.map && { asked: this.map.map.asked, spread: this.#spread });
    this.legend.node.append(this.saves);
    this.teller = new Teller(() => this.#all.forEach((feed) => feed.again()));
    stage.append(this.teller.node);
    stage.after(this.bar.node, this.legend.node);
    plane.key.before(this.bar.toggle);
    const again = () => this.#state && this.#ask(this.#state);
    this.fieldsButton = fieldsButton(() => {
      this.#fields = this.fieldsButton.getAttribute('aria-pressed') !== 'true';
      again();
    });
    loops.querySelector('[data-testid="suggest-pi"]')?.before(this.fieldsButton);
    this.#low.addEventListener('change', again);
    this.planeFeed = new MapFeed(
      (...map) => this.map.show(...map),
      fromServer,
      hand,
      true,
      (told) => {
        this.map.fade(told.computing);
        this.teller.put('plane', told);
      },
    );
    this.pair = new Pad({
      kind: 'pitch',
      testid: 'map-pair',
      title: 'Both real poles of the pair: drag the point',
      x: 'p₁',
      y: 'p₂',
      busy: () => store.busy,
      move: (p, q, stamp) => this.#movePair(p, q, stamp),
      end: () => store.commit(),
      free: () => this.#isFree(this.#pair),
      scale: (name) => this.scale.of(name),
    });
    stage.append(h('div', { class: 'map-pair' }, this.pair.node));
    const fieldFeed = (/** @type {Pad} */ pad, /** @type {string} */ name, /** @type {Show} */ show) =>
      new MapFeed(show, fromServer, hand, false, (told) => {
        pad.tell(told);
        this.teller.put(name, told);
      });
    this.pairFeed = fieldFeed(this.pair, 'pair', (...map) => this.pair.show(...map));
    this.pads = NAMES.map((name) => this.#loopPad(name));
    this.feeds = this.pads.map((pad, i) =>
      fieldFeed(pad, NAMES[i], (...map) => {
        this.scale.put(NAMES[i], ...map);
        pad.show(...map);
        this.#tell();
      }),
    );
    plane.svg.addEventListener('focusin', (e) =>
      this.#touched(Number(/** @type {SVGElement} */ (e.target).dataset.index)),
    );
    const under = plane.under;
    plane.under = () => {
      under?.();
      if (this.#state && plane.view !== this.#view) this.#ask(this.#state);
    };
  }

  /** What computes them; null: the server alone. @param {import('../kernel/index.js').Designs|null} designs */
  take(designs) {
    for (const feed of this.#all) feed.take(designs);
    this.#ask(this.store.state);
  }

  /** @param {State} state */
  render(state) {
    const { design, map, locks, task, spread, requirements, view, presets, methods, connection } = state;
    const read = { design, map, locks, task, spread, requirements, view, presets, methods, connection };
    this.#state = { ...this.store.state, ...read };
    if (design && this.#seen && design.poles !== this.#seen.poles) this.#follow(this.#seen, design);
    this.#seen = design;
    this.#ask(this.#state);
  }

  get #all() {
    return [this.planeFeed, this.pairFeed, ...this.feeds];
  }

  /** What is seen now. @param {State} state @returns {Choice|null} */
  #choice(state) {
    const choice = choiceOf(state.map);
    const hidden = choice && CHOICES[choice.name].hidden;
    const kept = hidden !== undefined && hidden !== null && hides(state, hidden);
    return choice && !kept && !hides(state, 'poles') && state.view === 'design' ? choice : null;
  }

  /** @returns {0|1} whose places are shown */
  get #pair() {
    const choice = choiceOf(this.store.state.map);
    if (choice && choice.pair !== 'hand') return choice.pair === 'pitch' ? 0 : 1;
    const other = /** @type {0|1} */ (1 - this.#hand);
    return this.#isFree(this.#hand) || !this.#isFree(other) ? this.#hand : other; // where a lab's step locks one
  }

  /** @param {0|1} pair */
  #isFree(pair) {
    return !this.plane.marks.handles[2 * pair].hasAttribute('aria-disabled');
  }

  /** Of uncertain rigs. */
  get #spread() {
    return this.store.state.spread || SPREAD;
  }

  /** @param {State} state */
  #ask(state) {
    this.#view = this.plane.view;
    const choice = this.#choice(state);
    const { design } = state;
    const preset = presetOf(state);
    this.bar.render(choice, (name) => Boolean(CHOICES[name].hidden && hides(state, CHOICES[name].hidden)));
    this.plane.root.classList.toggle('with-map', choice !== null);
    if (!design || !preset || !choice) {
      for (const feed of this.#all) feed.render(null);
      this.loops.classList.remove('with-pads');
      this.fieldsButton.hidden = true;
      this.pair.node.hidden = true;
      return;
    }
    const wanted = (/** @type {Asked|null} */ asked) => asked && { design, preset, asked, spread: this.#spread };
    const own = this.#pair;
    const domain = this.#domain();
    const places = placesPoles(state);
    const pair = {
      move: /** @type {Move} */ (`${NAMES[own]}-pair`),
      measure: measureOf(choice, AXES[own]),
      limits: limitsOf(state, AXES[own]),
    };
    this.bar.explain(places, design.outer === 'pi');
    this.planeFeed.render(wanted(places && domain ? { ...pair, real: false, domain } : null));
    const real = places && domain && !isComplex(design.poles, own) && this.plane.view.height >= LEAST;
    this.pair.node.hidden = !real;
    if (real) {
      const both = { x: { ...domain.x, to: 0 }, y: { ...domain.x, to: 0 } };
      this.pair.node.classList.toggle('yaw', own === 1);
      if (!this.store.busy) this.#clear(design); // under a hand it stays where it is
      this.pair.place(both, { x: design.poles[2 * own].re, y: design.poles[2 * own + 1].re });
      this.pairFeed.render(wanted({ ...pair, real: true, domain: both }));
    } else this.pairFeed.render(null);
    const loops = design.outer === 'pi';
    const fields = loops && (!this.#low.matches || (this.#fields ?? !places));
    this.fieldsButton.hidden = !loops || !this.#low.matches;
    setAttr(this.fieldsButton, 'aria-pressed', String(fields));
    this.loops.classList.toggle('with-pads', fields);
    for (const [i, feed] of this.feeds.entries()) {
      const { kp, ti } = design.loops[NAMES[i]];
      const shown = loopDomain(preset.loops[NAMES[i]]);
      this.pads[i].place(shown, { x: kp, y: ti });
      const seen = fields && this.pads[i].isSeen;
      const measure = measureOf(choice, AXES[i]);
      const move = /** @type {Move} */ (`${NAMES[i]}-pi`);
      const limits = limitsOf(state, AXES[i]);
      feed.render(wanted(seen ? { move, real: false, domain: shown, measure, limits } : null));
    }
  }

  /** What of the plane is seen, left of the imaginary axis, and above the real one. */
  #domain() {
    const { cx, cy, scale, width, height } = this.plane.view;
    if (!width || !height) return null;
    const [left, right] = [cx - width / 2 / scale, Math.min(0, cx + width / 2 / scale)];
    const top = Math.max(Math.abs(cy + height / 2 / scale), Math.abs(cy - height / 2 / scale));
    if (!(left < right)) return null;
    return {
      x: { from: left, to: right - EDGE * (right - left), log: false },
      y: { from: 0, to: top, log: false },
    };
  }

  /** Puts the pair's own plane where it hides least. @param {Design} design */
  #clear(design) {
    const { view } = this.plane;
    const poles = [...handlesOf(design), ...(this.store.state.reply?.loop_poles ?? [])];
    const marks = poles.flatMap((p) => (p ? [toPixel(view, p)] : []));
    setAttr(/** @type {Element} */ (this.pair.node.parentElement), 'data-side', emptierSide(marks, view));
  }

  /** A hand on a pole. @param {number} index */
  #touched(index) {
    if (!(index >= 0) || kindOf(index) !== 'placed') return;
    this.#hand = /** @type {0|1} */ (axisOf(index));
    if (this.#state) this.#ask(this.#state);
  }

  /** Poles that were moved by other means. @param {Design} before @param {Design} after */
  #follow(before, after) {
    const moved = [0, 1].filter((own) => [0, 1].some((k) => before.poles[2 * own + k] !== after.poles[2 * own + k]));
    if (moved.length === 1) this.#hand = /** @type {0|1} */ (moved[0]);
  }

  /** @param {number} p @param {number} q @param {number} stamp */
  #movePair(p, q, stamp) {
    const own = this.#pair;
    this.store.edit((d) => ({ ...d, poles: setReal(setReal(d.poles, 2 * own, tidy(p)), 2 * own + 1, tidy(q)) }), {
      gesture: `map-pair-${own}`,
      stamp,
    });
  }

  /** @param {'pitch'|'yaw'} name */
  #loopPad(name) {
    const { store, loops } = this;
    const pi = /** @type {HTMLElement} */ (loops.querySelector(`.pi.${name}`));
    const pad = new Pad({
      kind: name,
      testid: `map-${name}-pi`,
      title: 'Drag the point: to the right more gain, upwards more integral time',
      x: 'kₚ, V/rad',
      y: 'Tᵢ, s',
      busy: () => store.busy,
      move: (kp, ti, stamp) =>
        store.edit((d) => ({ ...d, loops: { ...d.loops, [name]: { ...d.loops[name], kp, ti } } }), {
          gesture: `map-${name}-pi`,
          stamp,
        }),
      end: () => store.commit(),
      free: () => ![...pi.querySelectorAll('input')].some(({ disabled }) => disabled),
      scale: (own) => this.scale.of(own),
      range: true,
      seen: () => this.#state && this.#ask(this.#state),
    });
    pi.append(pad.node);
    return pad;
  }

  /** Other colours mean other values. */
  #rescale() {
    for (const pad of [this.pair, ...this.pads]) pad.repaint();
    this.#tell();
  }

  #tell() {
    const { scale, map } = this;
    this.saves.hidden = !map.map;
    if (map.map || !scale.fields.length) this.legend.draw(map, NAMES[this.#pair], this.#spread);
    else this.legend.draw(this.#ofFields(), null, this.#spread);
  }

  /** What the fields of the loops have in common, where the plane has no map. @returns {import('./legend.js').Shown} */
  #ofFields() {
    const { name, levels, fields } = this.scale;
    const [{ asked }] = fields;
    const alike = fields.every((own) => own.asked.measure.axis === asked.measure.axis);
    const layers = this.pads.flatMap((pad) => pad.layers ?? []);
    return {
      map: { asked: { measure: alike ? asked.measure : { name } } },
      layers: {
        unsettled: layers.flatMap(({ unsettled }) => unsettled),
        missed: layers.flatMap(({ missed }) => missed),
      },
      levels,
      look: () => lookOf(name, levels, lookOfPage(this.loops, 11)),
    };
  }
}

/** As far as the sliders go. @param {{kp: number, ti: number}} own  the preset's */
const loopDomain = ({ kp, ti }) => ({
  x: { from: kp / 60, to: kp * 6, log: true },
  y: { from: Math.min(0.01, ti / 10), to: Math.max(5, ti * 5), log: true },
});

/**
 * What is required, of steps of the axis whose pair or loop moves: the other hardly feels it, and has its own verdict.
 * @param {State} state @param {import('../types.js').Axis} axis
 * @returns {Asked['limits']}
 */
function limitsOf(state, axis) {
  if (hides(state, 'requirements')) return [];
  const { settling, overshoot, lag } = state.requirements;
  return [
    ...(settling === null ? [] : [{ measure: { name: 'settling_time', axis }, max: settling }]),
    ...(overshoot === null ? [] : [{ measure: { name: 'overshoot', axis }, max: overshoot }]),
    ...(lag === null ? [] : [{ measure: { name: 'lag_margin' }, min: lag }]),
  ];
}
