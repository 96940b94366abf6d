/**
 * The table of the methods: a row for each, its figures, the best of each column, and "Use", which makes it the
 * design's own.
 */
import { decibel, degrees, fixed, seconds, significant } from '../text/index.js';
import { best, bodyOf, FULL_RANK, hardest, keyOf, nameOf, partOf, scenarioOf, worseMargins } from '../model/index.js';
import { compareMethods } from '../net/index.js';
import { h, Lazy, setAttr, setText, symbol } from '../ui/index.js';
import { motorText } from '../panels/index.js';
import { rowDetail } from './detail.js';

/** @typedef {'theta'|'psi'} Axis */
const ROUNDING = 1e-9; // below it all pole errors are equally good
const norm = (/** @type {string} */ sub) => h('span', { class: 'sym' }, '‖', h('i', {}, 'K'), '‖', h('sub', {}, sub));
const step = (/** @type {any} */ row, /** @type {Axis} */ axis) =>
  row.stable ? row.axis_metrics?.[axis]?.[axis] : undefined;
const percents = (/** @type {number|undefined} */ v) => (v === undefined ? '–' : `${fixed(v, 1)} %`);
const voltage = (/** @type {any} */ row, /** @type {'V_p'|'V_y'} */ name) => hardest(row.axis_metrics)[name];

/** @param {any} row */
function marginText(row) {
  const worse = worseMargins(row.margins);
  return worse
    ? `${Number.isFinite(worse.gain) ? decibel(worse.gain) : '∞'} · ` +
        `${Number.isFinite(worse.phase) ? degrees(worse.phase, 0) : '∞'}`
    : '–';
}

/**
 * `cost` is least for the best row; `cross` says whether the loops are paired crosswise.
 * @typedef {{id: string, group?: Axis, name: () => (Node|string)[], title: string, text: (row: any) => string, cost?:
 *   (row: any, cross: boolean) => number|undefined, warn?: (row: any) => boolean}} Column
 * @type {Column[]}
 */
const COLUMNS = [
  {
    id: 'norm',
    name: () => [norm('F')],
    title: 'Frobenius norm of K: the size of all its gains',
    text: (r) => significant(r.norm, 4),
    cost: (r) => r.norm,
  },
  {
    id: 'spectral',
    name: () => [norm('2')],
    title: 'spectral norm of K: the most it can amplify a state',
    text: (r) => significant(r.spectral_norm, 4),
    cost: (r) => r.spectral_norm,
  },
  {
    id: 'error',
    name: () => ['Pole error'],
    title: 'farthest distance of a computed pole from the placed one, rad/s',
    text: (r) =>
      r.pole_error === undefined
        ? 'own poles'
        : r.pole_error === 0
          ? '0'
          : r.pole_error.toExponential(0).replace('-', '\u2212'),
    cost: (r) => (r.pole_error === undefined ? undefined : Math.max(r.pole_error, ROUNDING)),
  },
  {
    id: 'kappa',
    name: () => [symbol('κ', '2'), '(', symbol('X'), ')'],
    title: 'condition number of the eigenvectors of A − BK: how sensitive the poles are, at best 1',
    text: (r) => significant(r.eigenvector_condition, 3),
    cost: (r) => r.eigenvector_condition,
  },
  {
    id: 'lambda',
    name: () => [symbol('λ', '11')],
    title: 'relative gain at s = 0, dimensionless: at 1 the diagonal loops do not feel each other',
    text: (r) => fixed(r.rga?.[0][0], 3),
    cost: (r, cross) => (r.rga ? Math.abs(r.rga[0][cross ? 1 : 0] - 1) : undefined),
  },
  .../** @type {Axis[]} */ (['theta', 'psi']).flatMap((axis) => [
    {
      id: `rise-${axis}`,
      group: axis,
      name: () => ['Rise'],
      title: '10 to 90 % of this axis’ step, nonlinear rig',
      text: (/** @type {any} */ r) => seconds(step(r, axis)?.rise_time),
      cost: (/** @type {any} */ r) => step(r, axis)?.rise_time,
    },
    {
      id: `overshoot-${axis}`,
      group: axis,
      name: () => ['Over\u00adshoot'],
      title: 'beyond the reference of this axis’ step, nonlinear rig',
      text: (/** @type {any} */ r) => percents(step(r, axis)?.overshoot),
      cost: (/** @type {any} */ r) => step(r, axis)?.overshoot,
    },
    {
      id: `undershoot-${axis}`,
      group: axis,
      name: () => ['Under\u00adshoot'],
      title: 'from the start away from the reference of this axis’ step, nonlinear rig',
      text: (/** @type {any} */ r) => percents(step(r, axis)?.undershoot),
      cost: (/** @type {any} */ r) => step(r, axis)?.undershoot,
    },
  ]),
  .../** @type {('V_p'|'V_y')[]} */ (['V_p', 'V_y']).map((name) => ({
    id: name,
    name: () => [symbol('V', name[2]), ' peak'],
    title:
      `${name === 'V_p' ? 'pitch' : 'yaw'} motor over both steps, trim included; or the longer share of time ` +
      'at its limit',
    text: (/** @type {any} */ r) => motorText({ [name]: voltage(r, name) ?? {} }, name),
    cost: (/** @type {any} */ r) => {
      const m = voltage(r, name);
      return !r.stable || !m || m.saturated > 0 ? undefined : m.peak;
    },
    warn: (/** @type {any} */ r) => (voltage(r, name)?.saturated ?? 0) > 0,
  })),
  {
    id: 'margin',
    name: () => ['Gain · phase margin'],
    title: 'the smaller of both motors’, everything else closed',
    text: marginText,
    cost: (r) => {
      const worse = worseMargins(r.margins);
      return worse && -worse.phase;
    },
  },
  {
    id: 'stable',
    name: () => ['Stable'],
    title: 'the whole loop, with the outer loops in use',
    text: (r) => (r.stable ? 'yes' : 'no'),
    warn: (r) => !r.stable,
  },
];

/** @param {any} row */
const marginTitle = (row) =>
  Object.entries(row.margins ?? {})
    .map(
      ([motor, m]) =>
        `${motor}: ${m.gain_margin === undefined ? '∞' : decibel(m.gain_margin)} · ${degrees(m.phase_margin, 0)}`,
    )
    .join('\n');

export class CompareTable {
  /** @type {Map<string, {row: HTMLElement, use: HTMLButtonElement|null}>} */ #rows = new Map();
  /** @type {Set<string>} */ #open = new Set();

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.rows = h('tbody');
    this.claim = h('p', { class: 'claim', 'data-testid': 'claim' });
    const content = h(
      'div',
      {},
      h(
        'div',
        { class: 'scroll sideways', tabindex: 0, role: 'group', 'aria-label': 'Table of the methods' },
        h('table', { class: 'compare-table', 'data-testid': 'compare-table' }, this.#head(), this.rows),
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
        coupling: 'triangular',
        lead: 'pitch',
        scenario: scenarioOf(d),
      }),
    });
  }

  #head() {
    const cell = (/** @type {Column} */ c, /** @type {number} */ rows) =>
      h('th', { scope: 'col', rowspan: rows, title: c.title }, c.name());
    const [first, grouped] = [COLUMNS.findIndex((c) => c.group), COLUMNS.filter((c) => c.group).length];
    const pair = (/** @type {Axis} */ axis) => {
      const name = axis === 'theta' ? 'pitch' : 'yaw';
      return h(
        'th',
        { scope: 'colgroup', colspan: grouped / 2, class: 'group' },
        h('span', { class: `shape ${name}`, 'aria-hidden': 'true' }),
        ` ${name} step`,
      );
    };
    return h(
      'thead',
      {},
      h(
        'tr',
        {},
        h('th', { scope: 'col', rowspan: 2, class: 'method-name' }, 'Method'),
        COLUMNS.slice(0, first).map((c) => cell(c, 2)),
        pair('theta'),
        pair('psi'),
        COLUMNS.slice(first + grouped).map((c) => cell(c, 2)),
        h('th', { rowspan: 2 }, h('span', { class: 'sr' }, 'Use')),
      ),
      h(
        'tr',
        {},
        COLUMNS.slice(first, first + grouped).map((c) => cell(c, 1)),
      ),
    );
  }

  /** @param {{rows: any[], claim: string}} answer */
  #show({ rows, claim }) {
    const focused = document.activeElement?.getAttribute('data-testid');
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
    this.rows.replaceChildren(...rows.flatMap((row, i) => this.#row(row, marks, rows[i - 1])));
    setText(this.claim, claim);
    this.render(this.store.state);
    if (focused && !document.activeElement?.getAttribute('data-testid'))
      /** @type {HTMLElement|null} */ (this.rows.querySelector(`[data-testid="${CSS.escape(focused)}"]`))?.focus({
        preventScroll: true,
      });
  }

  /** @param {any} row @param {Set<any>[]} marks @param {any} above @returns {HTMLElement[]} */
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
          h('div', { class: 'why' }, h('b', {}, 'Not available for this rig. '), why),
        ),
      );
      this.#rows.set(key, { row: line, use: null });
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
    const use = h(
      'button',
      {
        type: 'button',
        'data-testid': `use-${key}`,
        onclick: () => this.store.edit((d) => (keyOf(d) === key ? d : { ...d, ...partOf(key) })),
      },
      'Use',
    );
    const detail = h(
      'tr',
      { class: 'detail', id: `detail-${key}`, hidden: !this.#open.has(key) },
      h('td', { colspan: COLUMNS.length + 2 }, rowDetail(row, key, title)),
    );
    const toggle = h(
      'button',
      {
        type: 'button',
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
    this.#rows.set(key, { row: line, use });
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
    for (const [key, { row, use }] of this.#rows) {
      const own = key === present;
      row.classList.toggle('current', own);
      if (!use) continue;
      setAttr(use, 'aria-pressed', String(own));
      setText(use, own ? 'In use' : 'Use');
    }
  }
}
