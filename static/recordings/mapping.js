/** Which column of a recording is what, in which units, with which signs; how its text was split; its first rows. */
import { significant } from '../text/index.js';
import { allowed } from '../model/index.js';
import { h, head, NumberField, setText, symbol, wide } from '../ui/index.js';
import { DECIMALS, ROLES, SEPARATORS, TIME_UNITS } from './recordings.js';

/**
 * @typedef {import('../types.js').RecordingColumns} RecordingColumns
 * @typedef {import('../contract.js').Preview} Preview
 */

const ANGLE_UNITS = { rad: 'radians', deg: 'degrees' };

/**
 * @template {string} K
 * @param {Record<K, string>} choices
 * @param {Record<string, unknown>} attributes
 * @param {string} value
 */
function select(choices, attributes, value) {
  const node = h(
    'select',
    attributes,
    Object.entries(choices).map(([key, text]) => h('option', { value: key }, text)),
  );
  node.value = value;
  return /** @type {HTMLSelectElement & {value: K}} */ (node);
}

export class RecordingMapping {
  /** @type {unknown} */ #shown = null;
  /** @type {HTMLElement|undefined} */ #timeless;
  /** @type {HTMLElement|undefined} */ #timed;

  /** @param {import('./feed.js').RecordingFeed} feed @param {import('../model/store.js').Store} store */
  constructor(feed, store) {
    this.feed = feed;
    this.store = store;
    this.controls = h('div', { class: 'recording-mapping' });
    /** How text is split; shown apart, since it is wanted where nothing could be read, too. */
    this.text = h('div', { class: 'recording-mapping', hidden: true });
    this.findings = h('ul', { class: 'recording-remarks' });
    this.table = h('table', { class: 'compare-table', 'data-testid': 'recording-preview' });
    this.head = wide('First rows of the file', this.table);
    this.node = h('div', {}, this.controls, this.findings, this.head);
  }

  /** What is chosen at present. */
  get #latest() {
    return /** @type {RecordingColumns} */ (this.store.state.recorded.columns);
  }

  /** @param {Preview} preview @param {RecordingColumns} columns */
  show(preview, columns) {
    this.controls.replaceChildren(
      ...ROLES.map((role) => this.#role(role, preview, columns)),
      ...this.#units(columns),
      this.#axis('theta', 'θ', 'pitch'),
      this.#axis('psi', 'ψ', 'yaw'),
      (this.#timeless = this.#number(
        'sample-time',
        'Sample time where no column is the time',
        'sample time',
        's',
        allowed('columns.sample_time'),
        columns.sample_time ?? NaN,
        (v) => this.feed.change({ sample_time: v || null }),
      )),
      this.#number(
        'decimate',
        'Keep one of so many rows; voltages are averaged in between',
        'keep one row of',
        '',
        { ...allowed('columns.decimate'), integer: true },
        columns.decimate,
        (v) => this.feed.change({ decimate: v }),
      ),
    );
    this.findings.replaceChildren(
      ...preview.findings.filter((f) => f.code !== 'synthetic').map((f) => h('li', {}, f.message)),
    );
    this.#rows(preview);
    this.render(columns);
  }

  /** @param {RecordingColumns} columns */
  render(columns) {
    if (this.#timeless) this.#timeless.hidden = Boolean(columns.names.time);
    if (this.#timed) this.#timed.hidden = !columns.names.time;
  }

  /**
   * Lets the user say how text is split.
   * @param {import('../contract.js').Dialect|null} dialect as it was; null: it is no text
   */
  dialect(dialect) {
    this.text.hidden = !dialect;
    if (!dialect || dialect === this.#shown) return;
    this.#shown = dialect;
    const again = () =>
      this.feed.reread({
        ...(separator.value && { separator: separator.value }),
        ...(decimal.value && { decimal: decimal.value }),
      });
    const separator = select(
      { '': 'judged', ...SEPARATORS },
      { 'data-testid': 'recording-separator', onchange: again },
      dialect.separator,
    );
    const decimal = select(
      { '': 'judged', ...DECIMALS },
      { 'data-testid': 'recording-decimal', onchange: again },
      dialect.decimal,
    );
    this.text.replaceChildren(
      h('label', { class: 'recording-role' }, h('span', {}, 'separator'), separator),
      h('label', { class: 'recording-role' }, h('span', {}, 'decimal mark'), decimal),
    );
  }

  /** @param {(typeof ROLES)[number]} role @param {Preview} preview @param {RecordingColumns} columns */
  #role({ role, base, sub, title }, preview, columns) {
    const names = preview.columns.map((name) => h('option', { value: name, translate: 'no' }, name));
    const node = h(
      'select',
      {
        'data-testid': `recording-column-${role}`,
        'aria-label': title,
        onchange: () => this.feed.change({ names: { ...this.#latest.names, [role]: node.value } }),
      },
      h('option', { value: '' }, '–'),
      names,
    );
    node.value = columns.names[role] ?? '';
    return h('label', { class: 'recording-role', title }, symbol(base, sub), node);
  }

  /** @param {RecordingColumns} columns */
  #units(columns) {
    const time = select(
      TIME_UNITS,
      {
        'data-testid': 'recording-time-unit',
        'aria-label': 'Unit of time',
        onchange: () => this.feed.change({ time_unit: time.value }),
      },
      columns.time_unit,
    );
    const pitch = select(
      ANGLE_UNITS,
      {
        'data-testid': 'recording-unit',
        'aria-label': 'Unit of the angles',
        onchange: () => this.feed.change({ unit: pitch.value, units: yaw.value ? { psi: yaw.value } : {} }),
      },
      columns.unit,
    );
    const yaw = select(
      { '': 'as pitch', ...ANGLE_UNITS },
      {
        'data-testid': 'recording-unit-psi',
        'aria-label': 'Unit of yaw',
        onchange: () => this.feed.change({ units: yaw.value ? { psi: yaw.value } : {} }),
      },
      columns.units.psi ?? '',
    );
    const volts = select(
      { V: 'V', mV: 'mV' },
      {
        'data-testid': 'recording-voltage-unit',
        'aria-label': 'Unit of the voltages',
        onchange: () => this.feed.change({ voltage_unit: volts.value }),
      },
      columns.voltage_unit,
    );
    const labelled = (/** @type {string} */ text, /** @type {HTMLElement} */ node) =>
      h('label', { class: 'recording-role' }, h('span', {}, text), node);
    this.#timed = labelled('time in', time);
    return [this.#timed, labelled('angles in', pitch), labelled('yaw in', yaw), labelled('voltages in', volts)];
  }

  /** @param {'theta'|'psi'} name @param {string} letter @param {string} spoken */
  #axis(name, letter, spoken) {
    const sign = select(
      { 1: '+1', '-1': '−1' },
      {
        'data-testid': `recording-sign-${name}`,
        'aria-label': `Sign of the ${spoken} encoder`,
        onchange: () => this.feed.change({ signs: { ...this.#latest.signs, [name]: Number(sign.value) } }),
      },
      '1',
    );
    const field = new NumberField({
      label: `Offset of the ${spoken} angle, in its unit`,
      mark: '+',
      min: -1e4,
      max: 1e4,
      testid: `recording-offset-${name}`,
      onInput: (v) => {
        field.set(v);
      },
      onCommit: () => this.feed.change({ offsets: { ...this.#latest.offsets, [name]: field.value } }),
    });
    field.set(0);
    return h('span', { class: 'recording-role' }, symbol(letter), sign, field.node);
  }

  /**
   * @param {string} id
   * @param {string} label
   * @param {string} mark
   * @param {string} unit
   * @param {{min: number, max: number, integer?: boolean}} range
   * @param {number} value
   * @param {(v: number) => void} commit
   */
  #number(id, label, mark, unit, range, value, commit) {
    const field = new NumberField({
      label,
      mark,
      unit,
      ...range,
      optional: Number.isNaN(value),
      testid: `recording-${id}`,
      onInput: (v) => {
        field.set(v);
      },
      onCommit: () => commit(field.value),
    });
    field.set(value);
    return h('span', { class: 'recording-role' }, field.node);
  }

  /** @param {Preview} preview */
  #rows(preview) {
    const columns = preview.columns.map((/** @type {string} */ name) =>
      h('th', { scope: 'col', translate: 'no' }, preview.units[name] ? `${name} (${preview.units[name]})` : name),
    );
    const row = (/** @type {(number|null)[]} */ cells, /** @type {number} */ i) =>
      h(
        'tr',
        {},
        h('th', { scope: 'row' }, String(preview.first_row + i)),
        cells.map((v) => h('td', {}, v === null ? '–' : significant(v, 5))),
      );
    const caption = h('caption', {});
    setText(caption, 'First rows, as they stand in the file');
    this.table.replaceChildren(caption, head(['Row', ...columns]), h('tbody', {}, preview.preview.map(row)));
  }
}
