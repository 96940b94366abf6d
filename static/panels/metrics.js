/**
 * How well it does, in figures: one column for the step of each axis, from the nonlinear rig; the linear model's in
 * parentheses where they differ.
 */
import { brief, differs, say, share, t } from '../text/index.js';
import {
  AXES,
  AXIS,
  figureIn,
  LOOP,
  MARGINS,
  missesLag,
  MOTOR,
  RESPONSE,
  SENSITIVITY,
  textOf,
  tipOf,
  valueIn,
  verdictOf,
} from '../model/index.js';
import { button, h, head, printed, recall, remember, setAttr, setText, shape } from '../ui/index.js';

/** @typedef {import('../types.js').Reply} Reply */
/** @typedef {import('../types.js').Axis} Axis @typedef {import('../types.js').Motor} Motor */
/** @typedef {import('../types.js').Metrics} Metrics @typedef {import('../types.js').Margins} Margins */

const OPEN = 'figures';

/**
 * As much of the motors' figures as says how hard each works.
 * @typedef {Partial<Record<Motor, Pick<import('../contract.js').MotorMetrics, 'peak'|'saturated'>>>} Motors
 */

/** The share of time at the limit. @param {Motors|undefined} m @param {Motor} name @returns {string|undefined} */
function limitText(m, name) {
  const saturated = m?.[name]?.saturated ?? 0;
  return saturated > 0 ? `limit ${share(saturated)}` : undefined;
}

/** The peak, or the share of time at the limit. @param {Motors|undefined} m @param {Motor} name */
export function motorText(m, name) {
  const limit = limitText(m, name);
  return limit ? `at ${limit}` : textOf(MOTOR.peak, m?.[name]?.peak);
}

/**
 * One figure of an axis' step, `known` of the registry. `value` is compared with the linear model's and shown as the
 * registry says; `most` replaces that text where the rig has something else to say.
 * @typedef {import('../model/figures.js').Figure} Known
 * @typedef {{id: string, group: string, known: Known, more?: boolean, name: () => (Node|string)[], title: string,
 *   value: (m: Metrics|undefined, axis: Axis) => number|undefined,
 *   most?: (m: Metrics|undefined, axis: Axis) => string|undefined}} Figure
 * One figure of the loop: per motor, or of both at once.
 * @typedef {{id: string, group: string, more?: boolean, name: () => (Node|string)[], title: string,
 *   margin?: (g: Margins|undefined) => string, both?: (s: NonNullable<Reply['sensitivity']>) => string,
 *   loop?: (r: Reply) => string}} Robustness
 */

/**
 * What stands in place of a settling time that lies beyond the window.
 * @param {Metrics|undefined} m
 * @param {Axis} axis
 */
export const notSettled = (m, axis) => (m?.[axis]?.settled === false ? t('not settled') : undefined);

/** What the registry says of a row. @param {string} id @param {string} group @param {Known} known */
const row = (id, group, known) => ({
  id,
  group,
  known,
  more: known.detail,
  name: () => /** @type {(Node|string)[]} */ ([known.head ?? '']),
  title: tipOf(known),
});

/** @param {[string, Known]} entry @returns {Figure} */
const responseRow = ([key, known]) => ({
  ...row(key, 'response', known),
  value: (m, axis) => valueIn(m, axis, key, known),
  most: known === AXIS.settling ? notSettled : undefined,
});

/** @param {Motor} name @returns {Figure[]} */
const motorRows = (name) =>
  Object.values(MOTOR)
    .filter((known) => known.head)
    .map((known) => ({
      ...row(known === MOTOR.peak ? name : `${known.name}-${name}`, 'motors', known),
      name: () => [printed(name), ` ${known.head}`],
      value: (m) => figureIn(m?.[name], known.name),
      ...(known === MOTOR.peak && {
        title:
          `${tipOf(known).replace('the motor', `the ${name === 'V_p' ? 'pitch' : 'yaw'} motor`)}; or the share of ` +
          'time at its limit. In parentheses what the linear model asks for.',
        most: (/** @type {Metrics|undefined} */ m) => limitText(m, name),
      }),
    }));

/** @type {Figure[]} */
const FIGURES = [...Object.entries(RESPONSE).map(responseRow), ...motorRows('V_p'), ...motorRows('V_y')];

/** A gain that may be without limit. @param {number|undefined} v @param {Known} known */
const limited = (v, known) => (v === undefined ? '∞' : textOf(known, v));

/** @param {NonNullable<Reply['sensitivity']>} s */
const gainsBorne = (s) =>
  `${textOf(SENSITIVITY.gain_low, s.gain_low)} to ${limited(s.gain_high, SENSITIVITY.gain_high)}`;

/** @param {NonNullable<Reply['sensitivity']>} s */
function peakText(s) {
  const peak = textOf(SENSITIVITY.sensitivity, s.peak);
  return s.peak < 1.005 ? peak : `${peak} at ${textOf(SENSITIVITY.peak_frequency, s.peak_frequency)}`;
}

/** What the loop bears of the rotors' lag. @param {Reply} r */
const lagText = (r) => (r.stable && r.lag_margin === undefined ? '∞' : textOf(LOOP.lag, r.lag_margin));

/** @type {Robustness[]} */
const ROBUSTNESS = [
  {
    id: 'margin',
    group: 'robustness',
    name: () => ['Gain · phase margin'],
    title:
      'Smallest factor on this axis’ own motor, and smallest phase change there, that make the loop unstable, ' +
      `everything else closed (${MARGINS.gain.source})`,
    margin: (g) =>
      g?.gain_margin === undefined && g?.phase_margin === undefined
        ? '–'
        : `${limited(g.gain_margin, MARGINS.gain)} · ${textOf(MARGINS.phase, g.phase_margin)}`,
  },
  { ...row('delay', 'robustness', MARGINS.delay), margin: (g) => textOf(MARGINS.delay, g?.delay_margin) },
  {
    ...row('disk', 'robustness', SENSITIVITY.disk),
    both: (s) =>
      `${textOf(SENSITIVITY.disk, s.disk_margin)}: × ${gainsBorne(s)}, ± ${textOf(SENSITIVITY.phase, s.phase)}`,
  },
  { ...row('sensitivity', 'robustness', SENSITIVITY.sensitivity), both: peakText },
  { ...row('lag', 'robustness', LOOP.lag), loop: lagText },
];

/** The disk margin in words. @param {Reply['sensitivity']} s */
function bothMotors(s) {
  if (!s) return '';
  const margin = textOf(SENSITIVITY.disk, s.disk_margin);
  const margins = say`gains × ${gainsBorne(s)}, phases ± ${textOf(SENSITIVITY.phase, s.phase)} (disk margin ${margin})`;
  return say`both motors at once: ${margins}; sensitivity peak ${textOf(SENSITIVITY.sensitivity, s.peak)}`;
}

/**
 * @param {{id: string, more?: boolean, name: () => (Node|string)[], title: string}} row
 * @param {HTMLElement[]} cells
 */
const tableRow = ({ more, name, title }, cells) =>
  h('tr', { class: more ? 'more-figures' : undefined }, h('th', { scope: 'row', title }, name()), cells);

export class MetricsPanel {
  /** @param {HTMLElement} root */
  constructor(root) {
    this.root = root;
    this.figures = FIGURES.map((row) =>
      AXES.map((axis) => {
        const own = h('span', { 'data-testid': `metric-${row.id}-${axis}` });
        const linear = h('span', {
          class: 'linear',
          title: 'the linear model, without limits',
          'data-testid': `metric-${row.id}-${axis}-linear`,
        });
        return { own, linear, cell: h('td', {}, linear, own) };
      }),
    );
    this.robustness = ROBUSTNESS.map((row) =>
      row.both || row.loop
        ? [h('td', { colspan: 2, 'data-testid': `metric-${row.id}` })]
        : AXES.map((axis) => h('td', { 'data-testid': `metric-${row.id}-${axis}` })),
    );
    this.key = h(
      'span',
      { class: 'linear', title: 'in parentheses: the linear model, where it differs by more than 5 %' },
      '(linear)',
    );
    this.more = button({
      class: 'quiet',
      title: 'More figures of merit, or the most important alone',
      'data-testid': 'more-figures',
      onclick: () => this.#show(!this.root.classList.contains('all-figures')),
    });
    const rows = [
      ...FIGURES.map((row, i) => ({ row, cells: this.figures[i].map((f) => f.cell) })),
      ...ROBUSTNESS.map((row, i) => ({ row, cells: this.robustness[i] })),
    ];
    root.append(
      h(
        'table',
        { class: 'metrics', 'data-testid': 'metrics' },
        head([
          h('td', {}, this.more, ' ', this.key),
          h('th', { scope: 'col' }, shape('pitch'), 'pitch step'),
          h('th', { scope: 'col' }, shape('yaw'), 'yaw step'),
        ]),
        [...new Set(rows.map(({ row }) => row.group))].map((group) =>
          h(
            'tbody',
            {},
            rows.filter(({ row }) => row.group === group).map(({ row, cells }) => tableRow(row, cells)),
          ),
        ),
      ),
    );
    this.#show(recall(OPEN) === 'all');
  }

  /** @param {boolean} all */
  #show(all) {
    this.root.classList.toggle('all-figures', all);
    this.more.setAttribute('aria-expanded', String(all));
    setText(this.more, all ? 'Fewer' : 'More');
    remember(OPEN, all ? 'all' : 'few');
  }

  /** @param {import('../types.js').State} state */
  render({ reply, showLinear, requirements }) {
    if (!reply) return;
    this.key.hidden = !showLinear;
    AXES.forEach((axis, j) => {
      const pair = reply.axis_steps?.[axis];
      const metrics = pair?.nonlinear.metrics;
      const verdict = verdictOf(reply, axis, requirements);
      FIGURES.forEach((row, i) => {
        const { own, linear, cell } = this.figures[i][j];
        const value = row.value(metrics, axis);
        const ideal = row.value(pair?.linear.metrics, axis);
        const most = row.most?.(metrics, axis);
        const missed = (row.id === 'settling' || row.id === 'overshoot') && verdict?.[row.id] === true;
        const text = most ?? textOf(row.known, value);
        setText(own, missed ? `✕ ${text}` : text);
        setAttr(own, 'title', missed ? 'misses the requirement' : '');
        const beside =
          showLinear && ideal !== undefined && (most !== undefined || differs(value, ideal, row.known.least));
        setText(linear, beside ? `(${brief(textOf(row.known, ideal)).replace(/ [V%s]$/, '')})` : '');
        cell.classList.toggle('warn', most !== undefined || missed);
      });
      const margin = reply.margins?.[axis === 'theta' ? 'pitch' : 'yaw'];
      ROBUSTNESS.forEach((row, i) => {
        if (row.margin) setText(this.robustness[i][j], row.margin(margin));
        else if (row.both && j === 0)
          setText(this.robustness[i][0], reply.sensitivity ? row.both(reply.sensitivity) : '–');
        else if (row.loop && j === 0) {
          const missed = missesLag(reply, requirements);
          setText(this.robustness[i][0], `${missed ? '✕ ' : ''}${row.loop(reply)}`);
          this.robustness[i][0].classList.toggle('warn', missed);
        }
        if (row.id === 'margin') setAttr(this.robustness[i][j], 'title', bothMotors(reply.sensitivity));
      });
    });
  }
}
