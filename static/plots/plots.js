/**
 * Four plots over one time axis: θ, ψ in degrees, V_p, V_y in volts. The pointer's cursor is shared; the scene's time
 * is a line of its own, moved without redrawing anything.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../model/traces.js').Signal} Signal
 */
import { marksOf } from './characteristics.js';
import { fixed, say, t as word, typographic } from '../text/index.js';
import { extent, indexAt, isVoltage, pairAlone, rangeOf, SIGNALS, trace, TRACES, tracesOf } from '../model/index.js';
import { button, h, pictureScale, setText, symbol } from '../ui/index.js';
import { chartBody, ink, makeChart, scaled } from '../charts/index.js';
import { PlotGhosts } from './ghosts.js';
import { PlotMarks } from './marks.js';
import { plotMenu } from './menu.js';
import { plainPath } from './paths.js';
import {
  drawBand,
  drawReference,
  drawRegions,
  drawShades,
  limitOf,
  referenceOf,
  regionsOf,
  rulesOf,
  rulesSeen,
} from './rules.js';
import { PlotTexts } from './texts.js';

/** @type {Record<Signal, {base: string, sub?: string, title: string, unit: string}>} */
const ABOUT = {
  theta: { base: 'θ', title: 'pitch', unit: '°' },
  psi: { base: 'ψ', title: 'yaw', unit: '°' },
  V_p: { base: 'V', sub: 'p', title: 'pitch motor', unit: ' V' },
  V_y: { base: 'V', sub: 'y', title: 'yaw motor', unit: ' V' },
};
const AXIS_WIDTH = 42;
/** How the speed of a rotor is drawn. */
const ROTOR = [1.5, 2];
const PLAYED = { theta: 'pitch step', psi: 'yaw step', both: 'both steps' };

export class Plots {
  /** @type {Record<string, [number, number]|undefined>} */ #ranges = {};
  /** @type {[number, number]} */ #time = [0, 5];
  /** @type {[number, number]|null} */ #zoom = null;
  /** @type {unknown[]} */ #seen = [];
  /** @type {number|null} */ #hover = null;
  #playhead = 0;
  /** @type {import('../types.js').Cloud|null} */ #cloud = null;
  /** @type {import('../types.js').Requirements|null} */ #asked = null;
  /** @type {ReturnType<typeof tracesOf>|null} */ #data = null;
  /** Whether one plot is seen by itself. */ alone = false;

  /**
   * @param {HTMLElement} root
   * @param {import('../model/store.js').Store} store
   * @param {{onSeek: (t: number) => void, onPeek: (t: number|null) => void}} handlers
   */
  constructor(root, store, { onSeek, onPeek }) {
    this.store = store;
    this.onSeek = onSeek;
    this.onPeek = onPeek;
    this.root = root;
    this.at = h('span');
    this.played = h('span', { class: 'played' });
    this.when = h('span', { class: 'when', 'data-testid': 'plot-time' }, this.at, this.played);
    this.unzoom = button(
      {
        class: 'unzoom',
        hidden: true,
        'data-testid': 'unzoom',
        title: 'Show the whole time again (Escape)',
        onclick: () => this.#zoomTo(null),
      },
      'Whole time',
    );
    this.plots = SIGNALS.map((signal) => this.#build(signal));
  }

  /** @param {Signal} signal */
  #build(signal) {
    const about = ABOUT[signal];
    const values = ['theta', 'psi'].map((axis) =>
      h('span', {
        class: `at ${axis === 'theta' ? 'pitch' : 'yaw'}`,
        title: `${axis === 'theta' ? 'pitch' : 'yaw'} step`,
      }),
    );
    const body = chartBody(
      `${about.title}: left and right move the time, plus and minus zoom, Escape shows the whole time`,
      (e) => this.#key(e),
    );
    const turning = h('span', { 'data-testid': `turning-${signal}`, hidden: true }, '; dotted: its rotor’s speed');
    const first = signal === SIGNALS[0] ? [this.when, this.unzoom] : [];
    const menu = plotMenu(this.store, signal, `${about.title} over time`, () => ({
      x: this.#zoom ?? this.#time,
      y: this.#ranges[signal] ?? [0, 1],
      rules: rulesOf(this.store.shown.reply, signal),
      regions: regions(),
      marks: this.#marks(signal),
    }));
    const figure = h(
      'figure',
      {
        class: `plot ${isVoltage(signal) ? 'volts' : 'angle'}`,
        'data-testid': `plot-${signal}`,
        'data-signal': signal,
      },
      h(
        'figcaption',
        {},
        symbol(about.base, about.sub),
        h('span', { class: 'what' }, `${about.title}, ${about.unit.trim() === '°' ? 'deg' : 'V'}`, turning),
        first,
        h('span', { class: 'values' }, values),
        menu,
      ),
      body,
    );
    this.root.append(figure);
    const rules = () => rulesOf(this.store.shown.reply, signal);
    const regions = () => regionsOf(this.store.shown.reply, signal, this.store.shown.requirements);
    const line = (/** @type {string} */ color, /** @type {number} */ width, /** @type {number[]} */ dash = []) => ({
      color,
      width,
      dash,
      auto: false,
      paths: plainPath,
    });
    const last = () =>
      this.alone || signal === 'V_y' || (signal === 'V_p' && this.root.classList.contains('two-columns'));
    /** @type {PlotGhosts|undefined} */ let ghosts;
    /** @type {PlotMarks|undefined} */ let marks;
    /** @type {PlotTexts|undefined} */ let texts;
    // auto: false, as the ranges are ours: no trace is searched for its extremes a second time.
    const chart = makeChart(body, {
      lines: [
        line('halo', 7),
        line('pitch', 1.25, [7, 4]),
        line('yaw', 1.25, [2, 3]),
        line('yaw', 1.5),
        line('pitch', 2.4),
        line('yaw', 1, ROTOR),
        line('pitch', 1, ROTOR),
      ],
      data: [[0, 1], ...Array(TRACES.length).fill([null, null])],
      height: 120,
      padding: [scaled(6), scaled(12), 2, 0],
      scales: {
        x: { range: () => this.#zoom ?? this.#time },
        y: { range: () => this.#ranges[signal] ?? [0, 1] },
      },
      axes: [
        { gap: 4, size: () => (last() ? scaled(22)() : 4), values: () => [] },
        { size: AXIS_WIDTH, space: 26, values: () => [] },
      ],
      cursor: {
        drag: { x: true, y: false, setScale: false },
        sync: {
          key: 'heli2dof',
          filters: { pub: (/** @type {string} */ type) => type === 'mousemove' || type === 'mouseleave' },
        },
        bind: { dblclick: () => () => (this.#zoomTo(null), null) },
      },
      hooks: {
        drawAxes: [
          (u) => drawShades(u, rules(), ink),
          (u) => drawRegions(u, regions(), ink),
          (u) => drawBand(u, signal, this.#cloud, ink),
        ],
        draw: [
          (u) => drawReference(u, rules(), ink),
          (u) => texts?.draw(rulesSeen(u, rules()), pictureScale().type),
          () => ghosts?.draw(ink),
          () => marks?.place(),
        ],
        setCursor: [(u) => this.#hovered(u)],
        setSelect: [(u) => this.#selected(u)],
      },
      onSize: () => this.#movePlayhead(),
    });
    texts = new PlotTexts(chart, {
      time: (v, end) => (last() ? `${Number(v.toFixed(3))}${end ? ' s' : ''}` : ''),
      axis: (v) => typographic(String(Number(v.toPrecision(6)))),
    });
    ghosts = new PlotGhosts(chart, signal);
    marks = new PlotMarks(chart, this.onSeek);
    const head = h('div', { class: 'playhead' });
    chart.over.append(head);
    chart.over.addEventListener('click', () => {
      if (chart.cursor.left !== undefined && chart.cursor.left >= 0)
        this.onSeek(chart.posToVal(chart.cursor.left, 'x'));
    });
    return { signal, chart, values, head, ghosts, marks, turning };
  }

  /** @param {State} state @returns {boolean} whether anything was drawn */
  render(state) {
    if (state.cloud !== this.#cloud || state.requirements !== this.#asked) {
      this.#cloud = state.cloud;
      this.#asked = state.requirements;
      for (const { signal, chart } of this.plots) if (!isVoltage(signal)) chart.redraw(false);
    }
    const alone = pairAlone(state);
    const seen = [state.reply, state.motion, state.showLinear, state.showMarks, state.pins, state.beside, alone];
    if (!state.reply || seen.every((v, i) => v === this.#seen[i])) return false;
    this.#seen = seen;
    this.alone = alone !== null;
    const fresh = this.#data === null;
    const data = (this.#data = tracesOf(state.reply, state.motion, state.showLinear, alone));
    const end = data.t[data.t.length - 1];
    const whole = end !== this.#time[1];
    this.#time = [0, end];
    if (whole && this.#zoom) this.#zoomTo(null);
    const empty = Array(data.t.length).fill(null);
    const beside = state.beside?.plotted ? state.beside : undefined;
    for (const { signal, chart, ghosts, marks, turning } of this.plots) {
      ghosts.take(state.pins);
      const [played, dashPitch, dashYaw, yaw, pitch, ...rotors] = data.plots[signal];
      turning.hidden = !rotors.some(Boolean);
      this.#ranges[signal] = rangeOf({
        solid: extent([played, yaw, pitch, ...rotors, beside && trace(beside, signal, false)]),
        dashed: extent([dashPitch, dashYaw, ghosts.extent]),
        include: [0, referenceOf(state.reply, signal) ?? 0],
        limit: limitOf(state.reply, signal),
        previous: fresh ? undefined : this.#ranges[signal],
      });
      const columns = /** @type {uPlot.AlignedData} */ ([data.t, ...data.plots[signal].map((v) => v ?? empty)]);
      chart.batch(() => chart.setData(columns));
      marks.show(this.#marks(signal));
    }
    this.#movePlayhead();
    return true;
  }

  /** The figures beside the plots, at the cursor or at the scene's time. @param {State} state */
  renderValues({ reply, motion }) {
    if (reply && this.#data) this.#showValues(motion);
  }

  /** @param {Signal} signal */
  #marks(signal) {
    const { reply, showMarks } = this.store.shown;
    return showMarks ? marksOf(reply, signal, this.alone) : [];
  }

  /** @param {uPlot} u */
  #hovered(u) {
    const { left } = u.cursor;
    this.#hover = left === undefined || left < 0 ? null : u.posToVal(left, 'x');
    this.onPeek(this.#hover);
    this.#showValues();
  }

  /** @param {uPlot} u */
  #selected(u) {
    if (u.select.width < 8) return;
    this.#zoomTo([u.posToVal(u.select.left, 'x'), u.posToVal(u.select.left + u.select.width, 'x')]);
    u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  }

  /** @param {[number, number]|null} range */
  #zoomTo(range) {
    this.#zoom = range;
    const [min, max] = range ?? this.#time;
    this.unzoom.hidden = !range;
    for (const { chart } of this.plots) chart.setScale('x', { min, max });
    this.#movePlayhead();
  }

  /** @param {KeyboardEvent} e */
  #key(e) {
    const [from, to] = this.#zoom ?? this.#time;
    const step = { ArrowLeft: -1, ArrowRight: 1 }[e.key];
    const factor = { '+': 0.5, '=': 0.5, '-': 2 }[e.key];
    if (e.ctrlKey || e.metaKey || e.altKey) return;
    if (step)
      this.onSeek(
        Math.max(0, Math.min(this.#time[1], this.#playhead + (step * (to - from)) / (e.shiftKey ? 200 : 50))),
      );
    else if (factor) {
      const width = Math.min(this.#time[1], factor * (to - from));
      const left = Math.max(0, Math.min(this.#time[1] - width, this.#playhead - width / 2));
      this.#zoomTo(width >= this.#time[1] ? null : [left, left + width]);
    } else if (e.key === 'Escape' && this.#zoom) this.#zoomTo(null);
    else return;
    e.preventDefault();
  }

  /** The scene's time. @param {number} t */
  setTime(t) {
    this.#playhead = t;
    this.#movePlayhead();
    if (this.#hover === null) this.#showValues();
  }

  #movePlayhead() {
    for (const { chart, head } of this.plots) {
      const x = chart.valToPos(this.#playhead, 'x');
      // the element's own width would have the page laid out anew
      const inside = Number.isFinite(x) && x >= 0 && x <= chart.bbox.width / devicePixelRatio;
      head.hidden = !inside;
      if (inside) head.style.transform = `translateX(${x.toFixed(1)}px)`;
    }
  }

  #showValues(motion = this.store.state.motion) {
    if (!this.#data) return;
    const i = indexAt(this.#data.t, this.#hover ?? this.#playhead);
    setText(this.at, say`at ${fixed(this.#data.t[i], 2)} s`);
    setText(this.played, say`, ${word(PLAYED[motion])} in 3D`);
    for (const { signal, values } of this.plots) {
      ['theta', 'psi'].forEach((axis, k) => {
        const v = this.#data?.plots[signal][k === 0 ? 4 : 3]?.[i];
        setText(values[k], v === undefined ? '' : `${fixed(v, isVoltage(signal) ? 1 : 2)}${ABOUT[signal].unit}`);
      });
    }
  }
}
