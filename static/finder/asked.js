/**
 * The figures that count, as rows that can be changed: which, of which response, within which limit, and whether better
 * is wished for.
 * @typedef {import('./settings.js').Row} Row
 * @typedef {import('./settings.js').Settings} Settings
 */
import { say, t } from '../text/index.js';
import { MEASURED_FIGURES } from '../kernel/index.js';
import { button, check, h, keepingFocus, NumberField } from '../ui/index.js';
import {
  choicesOf,
  GROUPS,
  isHigher,
  MOST_ROWS,
  rowOf,
  shownValue,
  titleOf,
  unitOf,
  valueOfShown,
} from './settings.js';

const LISTED = new Set(GROUPS.flatMap(([, names]) => names));

/** All figures, the usual ones first. @param {boolean} uncertain whether shares of rigs mean anything */
const figureOptions = (uncertain) =>
  /** @type {[string, string[]][]} */ ([
    ...GROUPS.filter(([name]) => uncertain || name !== 'Uncertain rigs'),
    ['Others', [...MEASURED_FIGURES.keys()].filter((name) => !LISTED.has(name))],
  ]).map(([label, names]) =>
    h(
      'optgroup',
      { label },
      names.map((value) => h('option', { value }, titleOf(value))),
    ),
  );

/** @param {[string, string][]} options */
const optionsOf = (options) => options.map(([value, text]) => h('option', { value }, text));

/** A row's controls. */
class RowView {
  /**
   * @param {Row} row
   * @param {number} i
   * @param {boolean} uncertain
   * @param {(part: Partial<Row>|null) => void} change null: it goes
   */
  constructor(row, i, uncertain, change) {
    const { measure } = row;
    const title = t(titleOf(measure));
    const can = choicesOf(measure);
    const select = (
      /** @type {string} */ id,
      /** @type {string} */ label,
      /** @type {Node[]} */ options,
      /** @type {(value: string) => void} */ take,
    ) => {
      const node = h('select', { 'data-testid': `find-${id}-${i}`, 'aria-label': label }, options);
      node.addEventListener('change', () => take(node.value));
      return node;
    };
    this.figure = select('figure', say`Figure ${i + 1}`, figureOptions(uncertain), (name) => change({ measure: name }));
    /** @type {[string, string][]} */
    const places = [
      ['both', can.motor && !can.axis ? 'both motors' : 'both axes'],
      ...(can.axis
        ? /** @type {[string, string][]} */ ([
            ['theta', 'pitch step'],
            ['psi', 'yaw step'],
          ])
        : []),
      ...(can.motor
        ? /** @type {[string, string][]} */ ([
            ['V_p', 'pitch motor'],
            ['V_y', 'yaw motor'],
          ])
        : []),
    ];
    this.where = select('where', say`${title}: of which response`, optionsOf(places), (where) => change({ where }));
    this.model = select(
      'model',
      say`${title}: of which model`,
      optionsOf([
        ['nonlinear', 'nonlinear'],
        ['linear', 'linear'],
        ...(can.together
          ? /** @type {[string, string][]} */ ([
              ['nonlinear together', 'nonlinear, both stepped'],
              ['linear together', 'linear, both stepped'],
            ])
          : []),
      ]),
      (value) => {
        const [model, steps] = value.split(' ');
        change({
          model: /** @type {Row['model']} */ (model),
          steps: steps === 'together' ? 'together' : 'alone',
        });
      },
    );
    this.sign = select(
      'sign',
      say`${title}: at most or at least`,
      optionsOf([
        ['max', '≤'],
        ['min', '≥'],
      ]),
      (sign) => change({ most: sign === 'max' }),
    );
    this.limit = new NumberField({
      label: say`${title}: limit, ${unitOf(measure) || 'number'}; empty: none`,
      mark: '',
      unit: unitOf(measure),
      min: -1e9,
      max: 1e9,
      optional: true,
      testid: `find-limit-${i}`,
      onInput: (v) => change({ limit: Number.isFinite(v) ? valueOfShown(measure, v) : null }),
      onCommit: () => {},
    });
    this.limit.setBlank(t('none'), 1);
    this.share = new NumberField({
      label: say`${title}: on how many of the uncertain rigs, percent; empty: on the nominal rig`,
      mark: 'on',
      unit: '%',
      min: 0,
      max: 100,
      optional: true,
      testid: `find-share-${i}`,
      onInput: (v) => change({ share: Number.isFinite(v) ? Number((v / 100).toPrecision(12)) : null }),
      onCommit: () => {},
    });
    this.share.setBlank('–', 95);
    this.better = check(
      {
        'data-testid': `find-better-${i}`,
        onchange: () => change({ better: this.better.box.checked }),
      },
      isHigher(measure) ? 'maximize' : 'minimize',
      h('span', { class: 'sr' }, say`, ${title}`),
    );
    const remove = button(
      {
        class: 'small-tool',
        'data-testid': `find-remove-${i}`,
        'aria-label': say`Leave ${title} out`,
        title: say`Leave ${title} out`,
        onclick: () => change(null),
      },
      '×',
    );
    const shares = uncertain && MEASURED_FIGURES.has(measure);
    this.node = h(
      'li',
      { class: 'find-row', 'data-testid': `find-row-${i}` },
      this.figure,
      h('span', { class: 'find-of' }, places.length > 1 ? this.where : null, can.model ? this.model : null),
      h('span', { class: 'find-limit' }, this.sign, this.limit.node, shares ? this.share.node : null),
      this.better.node,
      remove,
    );
    this.set(row);
  }

  /** @param {Row} row */
  set({ measure, where, model, steps, limit, most, share, better }) {
    this.figure.value = measure;
    this.where.value = where;
    this.model.value = steps === 'together' ? `${model} together` : model;
    this.sign.value = most ? 'max' : 'min';
    this.limit.set(limit === null ? NaN : Number(shownValue(measure, limit).toPrecision(9)));
    this.share.set(share === null ? NaN : Number((100 * share).toPrecision(9)));
    this.better.box.checked = better;
  }
}

export class AskedRows {
  /** @type {RowView[]} */ #views = [];
  #key = '';
  /** @type {Row[]} */ #rows = [];

  /** @param {(rows: Row[]) => void} change */
  constructor(change) {
    this.change = change;
    this.list = h('ol', { class: 'find-rows', 'data-testid': 'find-rows' });
    this.add = button({ class: 'quiet', 'data-testid': 'find-add', onclick: () => this.#add() }, '+ another figure');
    this.node = h('div', {}, this.list, this.add);
  }

  /** The first that is not there yet. */
  #add() {
    const there = new Set(this.#rows.map((row) => row.measure));
    const next = GROUPS.flatMap(([, names]) => names).find((name) => !there.has(name)) ?? 'settling_time';
    this.change([...this.#rows, rowOf(next)]);
    this.#views.at(-1)?.figure.focus();
  }

  /** @param {number} i @param {Partial<Row>|null} part */
  #changed(i, part) {
    const rows = [...this.#rows];
    if (part === null) rows.splice(i, 1);
    else if (part.measure) rows[i] = rowOf(part.measure, { better: rows[i].better });
    else rows[i] = { ...rows[i], ...part };
    this.change(rows);
  }

  /** @param {Settings} settings */
  render({ rows, spread }) {
    const key = [spread > 0, ...rows.map((row) => row.measure)].join();
    if (rows === this.#rows && key === this.#key) return;
    this.#rows = rows;
    if (key === this.#key) return this.#views.forEach((view, i) => view.set(rows[i]));
    this.#key = key;
    this.#views = rows.map((row, i) => new RowView(row, i, spread > 0, (part) => this.#changed(i, part)));
    keepingFocus(this.list, () => this.list.replaceChildren(...this.#views.map((view) => view.node)));
    this.add.disabled = rows.length >= MOST_ROWS;
  }
}
