/** The recording in the main plots and as a ghost of the rig, aligned with the design's steps. */
import { DEGREE } from '../text/index.js';
import { isVoltage } from '../model/index.js';
import { ink, RECORDED } from '../charts/index.js';
import { check, h, NumberField, pictureScale, setText } from '../ui/index.js';
import { alignedTrace, alignmentWords, stepsOf, stepWords } from './alignment.js';

export class Beside {
  /** @type {import('../contract.js').OverlayReply|null} */ #overlay = null;
  #key = '';

  /** @param {import('../model/store.js').Store} store @param {import('../plots/plots.js').Plots} plots */
  constructor(store, plots) {
    this.store = store;
    this.shown = check({ 'data-testid': 'beside-plots', onchange: () => this.#tell() }, 'in the plots');
    this.ghost = check({ 'data-testid': 'beside-ghost', onchange: () => this.#tell() }, 'as a ghost of the rig');
    this.shifted = check(
      { checked: true, 'data-testid': 'beside-shifted', onchange: () => this.#tell() },
      'shifted to where the design begins',
    );
    this.from = new NumberField({
      label: 'time of the recording that is the plots’ zero, seconds',
      mark: 'from',
      unit: 's',
      min: 0,
      max: 1e6,
      testid: 'beside-from',
      onInput: (v) => {
        this.from.set(v);
      },
      onCommit: () => this.#tell(),
    });
    this.from.set(0);
    this.steps = h('select', {
      'data-testid': 'beside-step',
      'aria-label': 'Step of the recorded references',
      onchange: () => {
        if (this.steps.value !== '') this.from.set(Number(this.steps.value));
        this.#tell();
      },
    });
    this.words = h('p', { class: 'caption', role: 'status', 'data-testid': 'beside-words' });
    this.node = h(
      'div',
      { class: 'card wide', hidden: true },
      h('h3', {}, 'Beside the design'),
      h(
        'div',
        { class: 'row', role: 'group', 'aria-label': 'Show the recording' },
        h('span', {}, 'Show it'),
        this.shown.node,
        this.ghost.node,
        this.steps,
        this.from.node,
        this.shifted.node,
      ),
      this.words,
    );
    this.key = h(
      'span',
      { class: 'key', hidden: true, title: 'what was measured, aligned as its card under Recordings says' },
      h('span', { class: 'line recorded', 'aria-hidden': 'true' }),
      'recorded',
    );
    document.querySelector('[data-testid="legend"]')?.append(this.key);
    for (const { signal, chart } of plots.plots) (chart.hooks.draw ??= []).push((u) => this.#draw(u, signal));
  }

  #tell() {
    const { design, recorded } = this.store.state;
    const wanted = this.shown.box.checked || this.ghost.box.checked;
    const { overlay } = recorded;
    const known = wanted && overlay !== null && design !== null;
    const trace = known
      ? alignedTrace(overlay, {
          from: this.from.value,
          duration: design.scenario.duration,
          shifted: this.shifted.box.checked,
          theta0: design.theta0,
        })
      : null;
    this.store.set({
      beside: trace && { ...trace, plotted: this.shown.box.checked, ghost: this.ghost.box.checked },
    });
    setText(
      this.words,
      trace ? alignmentWords(trace) : known ? 'The recording ends before that time: choose an earlier one.' : '',
    );
  }

  /** @param {import('../types.js').State} state */
  render({ recorded, design, beside }) {
    const { overlay } = recorded;
    this.node.hidden = !overlay;
    this.key.hidden = !beside?.plotted;
    if (!design) return;
    if (overlay?.measured !== this.#overlay?.measured) {
      const first = stepsOf(overlay ?? { t: [] });
      this.steps.hidden = !first.length;
      this.steps.replaceChildren(
        h('option', { value: '' }, 'own time'),
        ...first.map((step) => h('option', { value: String(step.t) }, stepWords(step))),
      );
      if (first.length) this.steps.value = String(first[0].t);
      this.from.set(first[0]?.t ?? 0);
    }
    const key = JSON.stringify([overlay && overlay.duration, design.scenario.duration, design.theta0]);
    const fresh = overlay !== this.#overlay || key !== this.#key;
    this.#overlay = overlay;
    this.#key = key;
    if (fresh && (beside || this.shown.box.checked || this.ghost.box.checked)) queueMicrotask(() => this.#tell());
  }

  /** @param {uPlot} u @param {import('../model/traces.js').Signal} signal */
  #draw(u, signal) {
    const { beside } = this.store.state;
    if (!beside?.plotted) return;
    const scale = isVoltage(signal) ? 1 : DEGREE;
    const { left, top, width, height } = u.bbox;
    const { ctx } = u;
    const line = pictureScale().line * devicePixelRatio;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.clip();
    ctx.strokeStyle = ink('recorded');
    ctx.lineWidth = 1.6 * line;
    ctx.setLineDash(RECORDED.map((v) => v * line));
    ctx.beginPath();
    const values = beside[signal];
    for (let i = 0; i < values.length; i++)
      ctx.lineTo(u.valToPos(beside.t[i], 'x', true), u.valToPos(scale * values[i], 'y', true));
    ctx.stroke();
    ctx.restore();
  }
}
