/**
 * How well it does, in figures: one column for the step of each axis, from the nonlinear rig; the linear model's in
 * parentheses where they differ.
 */
import {
  brief,
  decibel,
  DEGREE,
  degrees,
  differs,
  fixed,
  percent,
  say,
  seconds,
  significant,
  t,
} from '../text/index.js';
import { AXES, verdictOf } from '../model/index.js';
import { h, recall, remember, setAttr, setText, symbol } from '../ui/index.js';

/** @typedef {import('../types.js').Reply} Reply */
/** @typedef {'theta'|'psi'} Axis */
/** @typedef {'V_p'|'V_y'} Motor */

const OPEN = 'figures';

/** @param {number|undefined} v */
const volts = (v) => (v === undefined ? '–' : `${fixed(v, 1)} V`);

/** @param {number|undefined} v */
const effort = (v) => significant(v, 3);

/** @param {number|undefined} v an angle's integral over time */
const angleTime = (v) => significant(v === undefined ? v : v * DEGREE, 3);

/** Peaks may be plain numbers or carry their share of saturation. @param {any} m @param {Motor} motor */
const motor = (m, motor) => (typeof m?.[motor] === 'object' ? m[motor] : { peak: undefined, saturated: undefined });

/** The share of time at the limit. @param {any} m @param {Motor} name @returns {string|undefined} */
function limitText(m, name) {
  const { saturated } = motor(m, name);
  return saturated > 0 ? `limit ${percent(saturated, saturated < 0.01 ? 1 : 0)}` : undefined;
}

/** The peak, or the share of time at the limit. @param {any} m @param {Motor} name */
export function motorText(m, name) {
  const limit = limitText(m, name);
  return limit ? `at ${limit}` : volts(motor(m, name).peak);
}

/**
 * What the linear model asks of a motor, trim included.
 * @param {import('../types.js').Step|undefined} step
 * @param {Motor} name
 */
export function linearPeak(step, name) {
  if (!step) return undefined;
  let peak = 0;
  for (let i = 0; i < step[name].length; i++) peak = Math.max(peak, Math.abs(step[name][i] + step.trim[name]));
  return peak;
}

/**
 * One figure of an axis' step. `value` is compared with the linear model's and shown by `text`; `most` replaces that
 * text where the rig has something else to say.
 * @typedef {{id: string, group: string, more?: boolean, name: () => (Node|string)[], title: string, text: (v:
 *   number|undefined) => string, value: (m: any, axis: Axis, step?: import('../types.js').Step) => number|undefined,
 *   least?: number, linear?: (step: import('../types.js').Step|undefined, axis: Axis) => number|undefined, most?: (m:
 *   any, axis: Axis) => string|undefined}} Figure
 * One figure of the loop: per motor, or of both at once.
 * @typedef {{id: string, group: string, more?: boolean, name: () => (Node|string)[], title: string, margin?: (g: any)
 *   => string, both?: (s: NonNullable<Reply['sensitivity']>) => string}} Robustness
 */
const OGATA = 'Ogata, Modern Control Engineering, 2010, section 5.3';
const GRAHAM = 'Graham and Lathrop, Trans. AIEE 72 (1953) 273';

/** What stands in place of a settling time that lies beyond the window. @param {any} m @param {Axis} axis */
export const notSettled = (m, axis) => (m?.[axis]?.settled === false ? t('not settled') : undefined);

/** @param {Motor} name @returns {Figure[]} */
const motorRows = (name) => [
  {
    id: name,
    group: 'motors',
    name: () => [symbol('V', name[2]), ' peak'],
    title:
      `Largest voltage of the ${name === 'V_p' ? 'pitch' : 'yaw'} motor, trim included; or the share of time ` +
      'at its limit. In parentheses what the linear model asks for.',
    text: volts,
    value: (m) => motor(m, name).peak,
    least: 0.5,
    linear: (step) => linearPeak(step, name),
    most: (m) => limitText(m, name),
  },
  {
    id: `effort-${name}`,
    group: 'motors',
    more: true,
    name: () => [symbol('V', name[2]), ' effort, V²s'],
    title:
      '∫ (V − V_trim)² dt over the time shown: what control costs beyond holding still; the inputs’ part of the ' +
      'quadratic cost (Anderson and Moore, Optimal Control, 1990)',
    text: effort,
    value: (m) => motor(m, name).effort,
    least: 0.05,
  },
];

/** @type {Figure[]} */
const FIGURES = [
  {
    id: 'rise',
    group: 'response',
    name: () => ['Rise time'],
    title: `Time from 10 % to 90 % of the step (${OGATA})`,
    text: seconds,
    value: (m, a) => m?.[a]?.rise_time,
    least: 0.01,
  },
  {
    id: 'settling',
    group: 'response',
    name: () => ['Settling time'],
    title: `Time after which the angle stays within 2 % of the step around its reference (${OGATA})`,
    text: seconds,
    value: (m, a) => m?.[a]?.settling_time,
    least: 0.01,
    most: notSettled,
  },
  {
    id: 'overshoot',
    group: 'response',
    name: () => ['Overshoot'],
    title: `Largest excess beyond the reference, in percent of the step (${OGATA})`,
    text: (v) => (v === undefined ? '–' : `${fixed(v, 1)} %`),
    value: (m, a) => m?.[a]?.overshoot,
    least: 1,
  },
  {
    id: 'undershoot',
    group: 'response',
    more: true,
    name: () => ['Undershoot'],
    title:
      'Largest excursion from the start away from the reference, in percent of the step (Skogestad and ' +
      'Postlethwaite, Multivariable Feedback Control, 2005, section 5.6)',
    text: (v) => (v === undefined ? '–' : `${fixed(v, 1)} %`),
    value: (m, a) => m?.[a]?.undershoot,
    least: 1,
  },
  {
    id: 'error',
    group: 'response',
    name: () => ['Error at the end'],
    title: 'Reference minus the last angle shown',
    text: (v) => degrees(v, 2),
    value: (m, a) => m?.[a]?.steady_state_error,
    least: 1e-3,
  },
  {
    id: 'coupling',
    group: 'response',
    name: () => ['Other axis moves'],
    title: 'Largest deviation of the axis that is not stepped',
    text: (v) => degrees(v, 2),
    value: (m) => m?.coupling_peak,
    least: 1e-3,
  },
  {
    id: 'iae',
    group: 'response',
    more: true,
    name: () => ['IAE, °s'],
    title: `∫ |e| dt, integral of the absolute error over the time shown (${GRAHAM})`,
    text: angleTime,
    value: (m, a) => m?.[a]?.iae,
    least: 1e-4,
  },
  {
    id: 'itae',
    group: 'response',
    more: true,
    name: () => ['ITAE, °s²'],
    title: `∫ t |e| dt, the absolute error weighted with time, over the time shown (${GRAHAM})`,
    text: angleTime,
    value: (m, a) => m?.[a]?.itae,
    least: 1e-4,
  },
  ...motorRows('V_p'),
  ...motorRows('V_y'),
];

/** @type {Robustness[]} */
const ROBUSTNESS = [
  {
    id: 'margin',
    group: 'robustness',
    name: () => ['Gain · phase margin'],
    title:
      'Smallest factor on this axis’ own motor, and smallest phase change there, that make the loop unstable, ' +
      'everything else closed (Ogata, Modern Control Engineering, 2010, section 7.7)',
    margin: (g) =>
      g?.gain_margin === undefined && g?.phase_margin === undefined
        ? '–'
        : `${g.gain_margin === undefined ? '∞' : decibel(g.gain_margin)} · ${degrees(g.phase_margin, 0)}`,
  },
  {
    id: 'delay',
    group: 'robustness',
    name: () => ['Delay margin'],
    title:
      'Smallest dead time at this axis’ own motor that makes the loop unstable: phase margin over crossover frequency',
    margin: (g) => seconds(g?.delay_margin),
  },
  {
    id: 'disk',
    group: 'robustness',
    more: true,
    name: () => ['Disk margin'],
    title:
      'Size α of the disks of gain and phase changes, at both motors at once and independent of each other, that ' +
      'the loop tolerates (Seiler, Packard and Gahinet, IEEE Control Systems 40 (2020) 78)',
    both: (s) =>
      `${fixed(s.disk_margin)}: × ${fixed(s.gain_low)} to ${s.gain_high === undefined ? '∞' : fixed(s.gain_high)}, ` +
      `± ${degrees(s.phase, 0)}`,
  },
  {
    id: 'sensitivity',
    group: 'robustness',
    more: true,
    name: () => ['Sensitivity peak'],
    title:
      'Largest singular value of S(jω) over all frequencies, at the motors: its inverse is the distance to ' +
      'instability under an additive change of the loop (Skogestad and Postlethwaite, Multivariable Feedback ' +
      'Control, 2005, section 2.4.3)',
    both: (s) => (s.peak < 1.005 ? fixed(s.peak) : `${fixed(s.peak)} at ${significant(s.peak_frequency, 3)} rad/s`),
  },
];

/** The disk margin in words. @param {Reply['sensitivity']} s */
function bothMotors(s) {
  if (!s) return '';
  const gains = `${fixed(s.gain_low)} to ${s.gain_high === undefined ? '∞' : fixed(s.gain_high)}`;
  const margins = say`gains × ${gains}, phases ± ${degrees(s.phase, 0)} (disk margin ${fixed(s.disk_margin)})`;
  return say`both motors at once: ${margins}; sensitivity peak ${fixed(s.peak)}`;
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
      row.both
        ? [h('td', { colspan: 2, 'data-testid': `metric-${row.id}` })]
        : AXES.map((axis) => h('td', { 'data-testid': `metric-${row.id}-${axis}` })),
    );
    this.key = h(
      'span',
      { class: 'linear', title: 'in parentheses: the linear model, where it differs by more than 5 %' },
      '(linear)',
    );
    this.more = h('button', {
      type: 'button',
      class: 'quiet',
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
        h(
          'thead',
          {},
          h(
            'tr',
            {},
            h('td', {}, this.more, ' ', this.key),
            h('th', { scope: 'col' }, h('span', { class: 'shape pitch', 'aria-hidden': 'true' }), 'pitch step'),
            h('th', { scope: 'col' }, h('span', { class: 'shape yaw', 'aria-hidden': 'true' }), 'yaw step'),
          ),
        ),
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
    setText(this.more, all ? 'Fewer figures' : 'More figures');
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
        const ideal = row.linear ? row.linear(pair?.linear, axis) : row.value(pair?.linear.metrics, axis);
        const most = row.most?.(metrics, axis);
        const missed = (row.id === 'settling' || row.id === 'overshoot') && verdict?.[row.id] === true;
        setText(own, missed ? `✕ ${most ?? row.text(value)}` : (most ?? row.text(value)));
        setAttr(own, 'title', missed ? 'misses the requirement' : '');
        const beside = showLinear && ideal !== undefined && (most !== undefined || differs(value, ideal, row.least));
        setText(linear, beside ? `(${brief(row.text(ideal)).replace(/ [V%s]$/, '')})` : '');
        cell.classList.toggle('warn', most !== undefined || missed);
      });
      const margin = reply.margins?.[axis === 'theta' ? 'pitch' : 'yaw'];
      ROBUSTNESS.forEach((row, i) => {
        if (row.margin) setText(this.robustness[i][j], row.margin(margin));
        else if (row.both && j === 0)
          setText(this.robustness[i][0], reply.sensitivity ? row.both(reply.sensitivity) : '–');
        if (row.id === 'margin') setAttr(this.robustness[i][j], 'title', bothMotors(reply.sensitivity));
      });
    });
  }
}
