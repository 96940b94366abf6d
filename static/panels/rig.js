/**
 * The rig's parameters and limits as fields, each beside what the preset says. Folded away; the header's line says how
 * many differ.
 */
import { inField, say } from '../text/index.js';
import {
  asProposed,
  changedWords,
  isChanged,
  presetOf,
  proposedShown,
  quantities,
  valueOf,
  without,
  withValue,
} from '../model/index.js';
import { button, h, designField, setAttr, setText, symbol } from '../ui/index.js';
import { folded } from './folded.js';

const CONCERNED = /^(parameters|limits)(\.|$)/;

/** @param {string} name as in K_pp @returns {HTMLElement} */
const symbolOf = (name) => (name === 'theta' ? symbol('θ', 'max') : symbol(name.split('_')[0], name.split('_')[1]));

/** @param {number} v */
const words = (v) => (Number.isNaN(v) ? 'free' : inField(v));

class Row {
  /** @param {import('../model/rig.js').Quantity} q @param {RigPanel} panel */
  constructor(q, panel) {
    this.q = q;
    const { store } = panel;
    const id = `rig-${q.kind === 'limits' ? 'limit-' : ''}${q.name}`;
    this.was = h('span', { class: 'was', 'data-testid': `${id}-preset` });
    this.field = designField(store, id, (d, v) => (panel.preset ? withValue(d, panel.preset, q, v) : d), {
      label: `${q.name}: ${q.meaning}, ${q.unit === '°' ? 'degrees; empty: free' : q.unit}`,
      field: `${q.kind}.${q.name}`,
      unit: q.unit,
      min: q.min,
      max: q.max,
      optional: q.free,
      mark: h('span', { class: 'about' }, symbolOf(q.name), h('span', { class: 'meaning' }, q.meaning), this.was),
    });
    this.reset = button(
      {
        class: 'quiet',
        'data-testid': `rig-reset-${q.kind}-${q.name}`,
        onclick: () => {
          store.edit((d) => without(d, q));
          this.field.input.focus();
        },
      },
      '↺',
    );
    if (q.free) this.field.setBlank('free', 45);
    this.node = h('div', { class: 'rig-row' }, this.field.node, this.reset);
  }

  /** @param {import('../types.js').Design} design @param {import('../types.js').Preset} preset */
  render(design, preset) {
    const changed = isChanged(design, this.q);
    const own = words(proposedShown(preset, this.q));
    this.field.set(valueOf(design, preset, this.q));
    this.node.classList.toggle('changed', changed);
    this.reset.hidden = !changed;
    setText(this.was, changed ? say`● preset ${own}` : '');
    setAttr(this.reset, 'title', say`Back to the preset’s ${own}`);
    setAttr(this.reset, 'aria-label', say`${this.q.name} back to the preset’s ${own}`);
  }
}

export class RigPanel {
  /** @type {import('../types.js').Preset|undefined} */ preset;
  /** @type {Row[]} */ rows = [];

  /** @param {import('../model/store.js').Store} store */
  constructor(store) {
    this.store = store;
    this.name = h('span');
    this.summary = h('summary', { 'data-testid': 'rig', title: 'The rig’s parameters and limits' }, this.name);
    this.source = h('p', { class: 'rig-source', 'data-testid': 'rig-source' });
    this.all = button(
      {
        class: 'quiet',
        'data-testid': 'rig-reset',
        title: 'All parameters and limits back to the preset’s; poles and loops stay',
        onclick: () => this.#reset(),
      },
      'Reset all',
    );
    this.problem = h('p', { class: 'experiment-warning', role: 'status', 'data-testid': 'rig-problem' });
    this.parameters = h('fieldset', { 'aria-label': 'Parameters' });
    this.limits = h('fieldset', { 'aria-label': 'Limits' });
    const how = { testid: 'rig', kind: 'rig-details', summary: this.summary, what: 'parameters' };
    this.node = folded(how, (close) => [
      h('div', { class: 'row' }, this.source, this.all, close),
      this.problem,
      this.parameters,
      this.limits,
    ]);
  }

  #reset() {
    this.store.edit(asProposed);
    this.summary.focus();
  }

  /** @param {import('../types.js').State} state */
  render({ presets, design, problem }) {
    const preset = presetOf({ presets, design });
    if (!design || !preset) return;
    this.preset = preset;
    if (!this.rows.length) {
      this.rows = quantities(preset).map((q) => new Row(q, this));
      for (const [kind, node] of /** @type {const} */ ([
        ['parameters', this.parameters],
        ['limits', this.limits],
      ]))
        node.append(...this.rows.filter((r) => r.q.kind === kind).map((r) => r.node));
    }
    const changed = changedWords(design);
    setText(this.name, changed || 'Parameters');
    this.summary.classList.toggle('changed', Boolean(changed));
    this.all.hidden = !changed;
    setText(this.source, preset.source);
    const concerned = CONCERNED.test(problem?.field ?? '');
    this.summary.classList.toggle('refused', concerned);
    setText(this.problem, concerned ? `✕ ${[problem?.detail, problem?.hint].filter(Boolean).join(' ')}` : '');
    for (const row of this.rows) row.render(design, preset);
  }
}
