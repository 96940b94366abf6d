/**
 * The table of the methods: a row for each, its figures, the best of each column, and "Use", which makes it the
 * design's own.
 */
import {
  AXIS,
  best,
  bodyOf,
  DESIGN,
  figureIn,
  FULL_RANK,
  hardest,
  keyOf,
  LOOP,
  MARGINS,
  MOTOR,
  nameOf,
  partOf,
  scenarioOf,
  signOf,
  textOf,
  worseMargins,
} from '../model/index.js';
import { compareMethods } from '../net/index.js';
import { button, Choice, groupedHead, h, keepingFocus, Lazy, printed, setAttr, setText, wide } from '../ui/index.js';
import { motorText } from '../panels/index.js';
import { rowDetail } from './detail.js';

/**
 * @typedef {import('../types.js').Axis} Axis
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Motor} Motor
 * @typedef {import('../contract.js').ComparisonRow} Row
 */
const ROUNDING = 1e-9; // below it all pole errors are equally good
const step = (/** @type {Row} */ row, /** @type {Axis} */ axis) =>
  row.stable ? row.axis_metrics?.[axis]?.[axis] : undefined;
const voltage = (/** @type {Row} */ row, /** @type {Motor} */ name) => hardest(row.axis_metrics)[name];

/** @param {Row} row */
function marginText(row) {
  const worse = worseMargins(row.margins);
  return worse
    ? `${Number.isFinite(worse.gain) ? textOf(MARGINS.gain, worse.gain) : '∞'} · ` +
        `${Number.isFinite(worse.phase) ? textOf(MARGINS.phase, worse.phase) : '∞'}`
    : '–';
}

/**
 * `cost` is least for the best row; `cross` says whether the loops are paired crosswise.
 * @typedef {import('../model/figures.js').Figure} Known
 * @typedef {{id: string, axis?: Axis, name: () => (Node|string)[], title: string, text: (row: Row) => string, cost?:
 *   (row: Row, cross: boolean) => number|undefined, warn?: (row: Row) => boolean}} Column
 */

/**
 * What the registry says of a figure.
 * @param {string} id
 * @param {Known} f
 * @param {(row: Row) => number|undefined} of
 * @returns {Column}
 */
const column = (id, f, of = (r) => figureIn(r, f.name)) => ({
  id,
  name: () => [f.short ?? ''],
  title: f.hint ?? '',
  text: (r) => textOf(f, of(r)),
  cost: (r) => {
    const v = of(r);
    return f.better === 'none' || v === undefined ? undefined : signOf(f) * v;
  },
});

/** A figure of the state feedback, under its symbol. @param {string} id @param {Known} f @returns {Column} */
const designColumn = (id, f) => ({ ...column(id, f), name: () => [f.symbol ? printed(f.symbol) : (f.short ?? '')] });

/** @param {Axis} axis @param {'rise'|'overshoot'|'undershoot'} key @returns {Column} */
const axisColumn = (axis, key) => ({
  ...column(`${key}-${axis}`, AXIS[key], (r) => figureIn(step(r, axis), AXIS[key].name)),
  axis,
  title: `${AXIS[key].hint}, nonlinear rig`,
});

/** @type {Column[]} */
const COLUMNS = [
  designColumn('norm', DESIGN.norm),
  designColumn('spectral', DESIGN.spectral),
  {
    ...designColumn('error', DESIGN.error),
    text: (r) => (r.pole_error === undefined ? 'own poles' : textOf(DESIGN.error, r.pole_error)),
    cost: (r) => (r.pole_error === undefined ? undefined : Math.max(r.pole_error, ROUNDING)),
  },
  designColumn('kappa', DESIGN.kappa),
  {
    ...designColumn('lambda', DESIGN.lambda),
    text: (r) => textOf(DESIGN.lambda, r.rga?.[0][0]),
    cost: (r, cross) => (r.rga ? Math.abs(r.rga[0][cross ? 1 : 0] - 1) : undefined),
  },
  .../** @type {Axis[]} */ (['theta', 'psi']).flatMap((axis) =>
    /** @type {const} */ (['rise', 'overshoot', 'undershoot']).map((key) => axisColumn(axis, key)),
  ),
  .../** @type {Motor[]} */ (['V_p', 'V_y']).map((name) => ({
    id: name,
    name: () => [printed(name), ` ${MOTOR.peak.short}`],
    title: `${name === 'V_p' ? 'pitch' : 'yaw'} ${MOTOR.peak.hint}; or the longer share of time at its limit`,
    text: (/** @type {Row} */ r) => motorText({ [name]: voltage(r, name) }, name),
    cost: (/** @type {Row} */ r) => {
      const m = voltage(r, name);
      return !r.stable || !m || m.saturated > 0 ? undefined : m.peak;
    },
    warn: (/** @type {Row} */ r) => (voltage(r, name)?.saturated ?? 0) > 0,
  })),
  {
    id: 'margin',
    name: () => ['Gain · phase margin'],
    title: MARGINS.gain.hint ?? '',
    text: marginText,
    cost: (r) => {
      const worse = worseMargins(r.margins);
      return worse && -worse.phase;
    },
  },
  {
    ...column('lag', LOOP.lag),
    text: (r) => (r.stable && r.lag_margin === undefined ? '∞' : textOf(LOOP.lag, r.lag_margin)),
    cost: (r) => (r.stable ? -(r.lag_margin ?? Infinity) : undefined),
  },
  {
    id: 'stable',
    name: () => ['Stable'],
    title: 'the whole loop, with the outer loops in use',
    text: (r) => (r.stable ? 'yes' : 'no'),
    warn: (r) => !r.stable,
  },
];

/**
 * The loops that a row was computed with, in a design; a method with its own integrators asks for none.
 * @param {Design} design @param {Row} row
 * @returns {Partial<Design>}
 */
function loopsOf(design, { outer, loops, integral }) {
  if (!outer || integral) return {};
  const same =
    loops &&
    AXES_OF.every((axis) => loops[axis].kp === design.loops[axis].kp && loops[axis].ti === design.loops[axis].ti);
  return { outer, ...(loops && !same && { loops }) };
}
const AXES_OF = /** @type {const} */ (['pitch', 'yaw']);

/** Whether a row shows the design's own method and loops. @param {Design} design @param {Row} row */
const isIn = (design, row) =>
  keyOf(design) === keyOf(row) &&
  Object.entries(loopsOf(design, row)).every(([name, value]) => design[/** @type {keyof Design} */ (name)] === value);

/** @param {Row} row */
const marginTitle = (row) =>
  Object.entries(row.margins ?? {})
    .map(
      ([motor, m]) =>
        `${motor}: ${m.gain_margin === undefined ? '∞' : textOf(MARGINS.gain, m.gain_margin)} · ` +
        textOf(MARGINS.phase, m.phase_margin),
    )
    .join('\n');

/**
 * Under which outer loops the methods are compared.
 * @typedef {import('../contract.js').Comparison['tuning']} Tuning
 * @type {[Tuning, string, string][]}
 */
const TUNINGS = [
  ['placed', 'as placed', 'the inner loop alone, behind the static prefilter'],
  ['tuned', 'loops tuned by one rule', 'PI values of its own for each method, by one rule with the same target'],
  ['kept', 'present PI values', 'the same PI values for all, whatever poles they were tuned for'],
];

export class CompareTable {
  /** @type {Tuning} */ #tuning = 'placed';
  /** @type {Map<string, {row: HTMLElement, use: HTMLButtonElement|null, of: Row}>} */ #rows = new Map();
  /** @type {Set<string>} */ #open = new Set();

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.rows = h('tbody');
    this.claim = h('p', { class: 'claim', 'data-testid': 'claim' });
    this.choice = new Choice({
      label: 'Outer loops of all methods',
      testid: 'tuning',
      options: TUNINGS,
      onChange: (tuning) => {
        this.#tuning = tuning;
        this.lazy.render(store.state);
      },
    });
    this.choice.set(this.#tuning);
    this.rule = h('p', { class: 'rule', 'data-testid': 'tuning-rule', role: 'status' });
    root.append(h('div', { class: 'tuning' }, this.choice.node, this.rule));
    const content = h(
      'div',
      {},
      wide(
        'Table of the methods',
        h(
          'table',
          { class: 'compare-table', 'data-testid': 'compare-table' },
          groupedHead('Method', COLUMNS, (c) => c.name(), [h('th', { rowspan: 2 }, h('span', { class: 'sr' }, 'Use'))]),
          this.rows,
        ),
      ),
      this.claim,
    );
    root.append(content);
    this.lazy = new Lazy(root, content, store, {
      wait: 'Computing every method; the first time takes a few seconds…',
      ask: compareMethods,
      show: (answer) => this.#show(answer),
      // Which method is in use makes no difference to the comparison of all.
      body: (d) => ({
        ...bodyOf(d),
        method: FULL_RANK,
        tuning: this.#tuning,
        coupling: /** @type {const} */ ('triangular'),
        lead: /** @type {const} */ ('pitch'),
        scenario: scenarioOf(d),
      }),
    });
  }

  /** @param {import('../contract.js').Comparison} answer */
  #show({ rows, claim, rule, tuning }) {
    setText(this.rule, rule);
    this.rule.classList.toggle('warning', tuning === 'kept' && rows.some((r) => r.outer === 'pi'));
    const cross = this.store.state.design?.pairing === 'cross';
    const able = rows.filter((r) => !r.unavailable);
    const marks = COLUMNS.map((c) => {
      const { cost } = c;
      const found = cost
        ? best(
            able.map((r) => cost(r, cross)),
            able.map(c.text),
          )
        : new Set();
      return new Set(able.filter((_r, i) => found.has(i)));
    });
    this.#rows.clear();
    keepingFocus(this.rows, () =>
      this.rows.replaceChildren(...rows.flatMap((row, i) => this.#row(row, marks, rows[i - 1]))),
    );
    setText(this.claim, claim);
    this.render(this.store.state);
  }

  /** @param {Row} row @param {Set<Row>[]} marks @param {Row|undefined} above @returns {HTMLElement[]} */
  #row(row, marks, above) {
    const key = keyOf(row);
    const full = row.method === FULL_RANK;
    const name = [full ? h('span', { class: 'aside' }, 'Full-rank ') : '', nameOf(row)];
    const title = [row.title, this.#method(row.method)?.source].filter(Boolean).join('\n');
    if (row.unavailable) {
      const { detail, hint } = row.unavailable;
      const same = above?.unavailable?.detail === detail;
      const why = same
        ? `For the same reason as ${nameOf(above)}.`
        : [detail[0].toUpperCase() + detail.slice(1), hint].join(' ');
      const line = h(
        'tr',
        { class: 'unavailable', 'data-testid': `compare-row-${key}` },
        h('th', { scope: 'row', class: 'method-name', title }, h('span', { class: 'no-toggle' }, name)),
        h(
          'td',
          { colspan: COLUMNS.length + 1, title: detail },
          h(
            'div',
            { class: 'why' },
            h(
              'b',
              {},
              row.unavailable.code === 'invalid_input' ? 'No loops by this rule. ' : 'Not available for this rig. ',
            ),
            why,
          ),
        ),
      );
      this.#rows.set(key, { row: line, use: null, of: row });
      return [line];
    }
    const cells = COLUMNS.map((c, i) =>
      h(
        'td',
        {
          'data-testid': `compare-${key}-${c.id}`,
          class: [marks[i].has(row) ? 'best' : '', c.warn?.(row) ? 'warn' : ''].join(' ').trim() || null,
          title: c.id === 'margin' ? marginTitle(row) : null,
        },
        c.text(row),
      ),
    );
    const use = button(
      {
        'data-testid': `use-${key}`,
        onclick: () => this.store.edit((d) => (isIn(d, row) ? d : { ...d, ...partOf(key), ...loopsOf(d, row) })),
      },
      'Use',
    );
    const detail = h(
      'tr',
      { class: 'detail', id: `detail-${key}`, hidden: !this.#open.has(key) },
      h('td', { colspan: COLUMNS.length + 2 }, rowDetail(row, key, title)),
    );
    const toggle = button(
      {
        class: 'toggle',
        'data-testid': `open-${key}`,
        title,
        'aria-expanded': String(!detail.hidden),
        'aria-controls': detail.id,
        onclick: () => {
          detail.hidden = !detail.hidden;
          setAttr(toggle, 'aria-expanded', String(!detail.hidden));
          if (detail.hidden) this.#open.delete(key);
          else this.#open.add(key);
        },
      },
      h('span', { class: 'caret', 'aria-hidden': 'true' }),
      h('span', {}, name),
    );
    const line = h(
      'tr',
      { 'data-testid': `compare-row-${key}` },
      h('th', { scope: 'row', class: 'method-name' }, toggle),
      cells,
      h('td', {}, use),
    );
    this.#rows.set(key, { row: line, use, of: row });
    return [line, detail];
  }

  /** @param {string} name */
  #method(name) {
    return this.store.state.methods.find((m) => m.name === name);
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    this.lazy.render(state);
    if (!state.design) return;
    const present = keyOf(state.design);
    for (const [key, { row, use, of }] of this.#rows) {
      const own = isIn(state.design, of); // with these loops, too
      row.classList.toggle('current', key === present);
      if (!use) continue;
      setAttr(use, 'aria-pressed', String(own));
      setText(use, own ? 'In use' : 'Use');
    }
  }
}
