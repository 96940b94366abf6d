/** The rig's parameters and limits as fields, each beside what the preset says. */
import { inField, say, t } from '../text/index.js';
import {
  asProposed,
  changedWords,
  isOfRig,
  isChanged,
  presetOf,
  proposedShown,
  quantities,
  valueOf,
  without,
  withValue,
} from '../model/index.js';
import { button, h, designField, setAttr, setText, symbol } from '../ui/index.js';

/** The parts of the panel, by where their quantities stand. */
const PARTS = /** @type {[import('../model/rig.js').Kind, string][]} */ ([
  ['parameters', ''],
  ['limits', ''],
  ['rotors.pitch', 'Pitch rotor'],
  ['rotors.yaw', 'Yaw rotor'],
  ['friction.pitch', 'Friction in pitch'],
  ['friction.yaw', 'Friction in yaw'],
]);

/** @param {import('../model/rig.js').Quantity} q @param {number|string} v as shown */
const words = (q, v) => (typeof v === 'string' ? t(v) : Number.isNaN(v) ? t(q.free) : inField(v));

/**
 * A choice of few in the shape of a field.
 * @param {import('../model/rig.js').Quantity} q
 * @param {HTMLElement} mark
 * @param {(v: string) => void} choose
 */
function choiceField(q, mark, choose) {
  const input = h(
    'select',
    {
      'aria-label': q.meaning,
      'data-testid': `rig-${q.kind}.${q.name}`,
      'data-field': `${q.kind}.${q.name}`,
      onchange: () => choose(input.value),
    },
    q.words?.map((word) => h('option', { value: word }, word)),
  );
  const set = (/** @type {number|string} */ v) => {
    input.value = String(v);
  };
  return { input, set, node: h('label', { class: 'field' }, mark, input) };
}

class Row {
  /** @param {import('../model/rig.js').Quantity} q @param {RigPanel} panel */
  constructor(q, panel) {
    this.q = q;
    const { store } = panel;
    const id = `rig-${q.kind === 'parameters' ? '' : q.kind === 'limits' ? 'limit-' : `${q.kind}.`}${q.name}`;
    this.was = h('span', { class: 'was', 'data-testid': `${id}-preset` });
    const mark = h(
      'span',
      { class: 'about' },
      symbol(...q.symbol),
      h('span', { class: 'meaning' }, q.meaning),
      this.was,
    );
    const changed = (/** @type {import('../types.js').Design} */ d, /** @type {number|string} */ v) =>
      panel.preset ? withValue(d, panel.preset, q, v) : d;
    const numeric = q.words
      ? null
      : designField(store, id, changed, {
          label: `${q.name}: ${q.meaning}, ${q.unit === '°' ? 'degrees; empty: free' : q.unit}`,
          field: `${q.kind}.${q.name}`,
          unit: q.unit,
          min: q.min,
          max: q.max,
          optional: Boolean(q.free),
          mark,
        });
    /** @type {{input: HTMLElement, node: HTMLElement, set: (v: number|string) => void}} */
    this.field = numeric
      ? { input: numeric.input, node: numeric.node, set: (v) => numeric.set(Number(v)) }
      : choiceField(q, mark, (v) => store.edit((d) => changed(d, v)));
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
    if (q.free) numeric?.setBlank(t(q.free), q.name === 'theta' ? 45 : 0);
    this.node = h('div', { class: 'rig-row' }, this.field.node, this.reset);
  }

  /** @param {import('../types.js').Design} design @param {import('../types.js').Preset} preset */
  render(design, preset) {
    const changed = isChanged(design, this.q);
    const own = words(this.q, proposedShown(preset, this.q));
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

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
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
    this.parts = PARTS.map(([kind, title]) =>
      h('fieldset', { 'aria-label': title || kind }, title && h('p', { class: 'caption' }, title)),
    );
    root.append(
      h(
        'div',
        { class: 'rig-body', 'data-testid': 'rig-body' },
        h('div', { class: 'row' }, this.source, this.all),
        this.problem,
        h('div', { class: 'rig-parts' }, this.parts),
      ),
    );
  }

  #reset() {
    this.store.edit(asProposed);
    this.rows[0]?.field.input.focus();
  }

  /** @param {import('../types.js').State} state */
  render({ presets, design, problem }) {
    const preset = presetOf({ presets, design });
    if (!design || !preset) return;
    this.preset = preset;
    if (!this.rows.length) {
      this.rows = quantities(preset).map((q) => new Row(q, this));
      for (const [i, [kind]] of PARTS.entries())
        this.parts[i].append(...this.rows.filter((r) => r.q.kind === kind).map((r) => r.node));
    }
    const changed = changedWords(design);
    this.all.hidden = !changed;
    setText(this.source, preset.source);
    const concerned = isOfRig(problem?.field);
    setText(this.problem, concerned ? `✕ ${[problem?.detail, problem?.hint].filter(Boolean).join(' ')}` : '');
    for (const row of this.rows) row.render(design, preset);
  }
}
