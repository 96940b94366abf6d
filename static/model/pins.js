/**
 * Pinned designs: their letters, and how their figures differ from those of the present design. Pure.
 * @typedef {import('../types.js').Reply} Reply
 * @typedef {import('../types.js').Pin} Pin
 */
import { best, hardest, worseMargins } from './compare_math.js';
import { decibel, degrees, fixed, seconds, significant, t } from '../text/index.js';

export const COLORS = 6;

/** A, B, … Z, A2, B2, … @param {number} index */
export const letterOf = (index) =>
  `${String.fromCharCode(65 + (index % 26))}${index < 26 ? '' : Math.floor(index / 26) + 1}`;

/** @param {number} index */
export const colorOf = (index) => `pin-${index % COLORS}`;

const metric = (/** @type {string} */ axis, /** @type {string} */ name) => (/** @type {Reply} */ r) =>
  r.stable ? r.axis_steps?.[/** @type {'theta'|'psi'} */ (axis)]?.nonlinear.metrics?.[axis]?.[name] : undefined;
/** Endless where it has not settled within the window. */
const settling = (/** @type {string} */ axis) => (/** @type {Reply} */ r) =>
  metric(axis, 'settled')(r) === false ? Infinity : metric(axis, 'settling_time')(r);
const other = (/** @type {'theta'|'psi'} */ axis) => (/** @type {Reply} */ r) =>
  r.stable ? r.axis_steps?.[axis]?.nonlinear.metrics?.coupling_peak : undefined;
const peaks = (/** @type {Reply} */ r) =>
  hardest(Object.fromEntries(Object.entries(r.axis_steps ?? {}).map(([axis, pair]) => [axis, pair.nonlinear.metrics])));
const size = (/** @type {(r: Reply) => number|undefined} */ of) => (/** @type {Reply} */ r) => {
  const v = of(r);
  return v === undefined ? undefined : Math.abs(v);
};
const percents = (/** @type {number|undefined} */ v) => (v === undefined ? '–' : `${fixed(v, 1)} %`);
const volts = (/** @type {number|undefined} */ v) => (v === undefined ? '–' : `${fixed(v, 1)} V`);
const gain = (/** @type {number|undefined} */ v) => (v === Infinity ? '∞' : decibel(v));

/**
 * `of` gives the figure, `text` shows it, `shift` shows a difference, `sign` is 1 where less is better and −1 where
 * more is.
 * @typedef {{id: string, axis?: 'theta'|'psi', name: string, sub?: string, title: string, sign: 1|-1, of: (r: Reply) =>
 *   number|undefined, text: (v: number|undefined) => string, shift?: (d: number, v: number) => string}} Figure
 * @type {Figure[]}
 */
export const FIGURES = [
  {
    id: 'norm',
    name: '‖K‖',
    sub: 'F',
    title: 'Frobenius norm of K: the size of all its gains',
    sign: 1,
    of: (r) => r.gains.norm,
    text: (v) => significant(v, 4),
  },
  .../** @type {('theta'|'psi')[]} */ (['theta', 'psi']).flatMap(
    (axis) =>
      /** @type {Figure[]} */ ([
        {
          id: `rise-${axis}`,
          axis,
          name: 'Rise',
          title: '10 to 90 % of this axis’ step, nonlinear rig',
          sign: 1,
          of: metric(axis, 'rise_time'),
          text: seconds,
        },
        {
          id: `settling-${axis}`,
          axis,
          name: 'Settling',
          title: 'to within 2 % of this axis’ step, nonlinear rig',
          sign: 1,
          of: settling(axis),
          text: (v) => (v === Infinity ? t('not settled') : seconds(v)),
        },
        {
          id: `overshoot-${axis}`,
          axis,
          name: 'Over\u00adshoot',
          title: 'beyond the reference of this axis’ step',
          sign: 1,
          of: metric(axis, 'overshoot'),
          text: percents,
        },
        {
          id: `undershoot-${axis}`,
          axis,
          name: 'Under\u00adshoot',
          title: 'from the start away from the reference of this axis’ step',
          sign: 1,
          of: metric(axis, 'undershoot'),
          text: percents,
        },
        {
          id: `error-${axis}`,
          axis,
          name: 'Error',
          title: 'size of the error at the end',
          sign: 1,
          of: size(metric(axis, 'steady_state_error')),
          text: (v) => degrees(v, 2),
        },
        {
          id: `coupling-${axis}`,
          axis,
          name: 'Other axis',
          title: 'largest deviation of the axis that is not stepped',
          sign: 1,
          of: other(axis),
          text: (v) => degrees(v, 2),
        },
      ]),
  ),
  {
    id: 'V_p',
    name: 'V',
    sub: 'p',
    title: 'peak of the pitch motor over both steps, trim included',
    sign: 1,
    of: (r) => peaks(r).V_p?.peak,
    text: volts,
  },
  {
    id: 'V_y',
    name: 'V',
    sub: 'y',
    title: 'peak of the yaw motor over both steps, trim included',
    sign: 1,
    of: (r) => peaks(r).V_y?.peak,
    text: volts,
  },
  {
    id: 'gain',
    name: 'Gain margin',
    title: 'the smaller of both motors’, everything else closed',
    sign: -1,
    of: (r) => worseMargins(r.margins)?.gain,
    text: gain,
    shift: (d, v) => decibel(v / (v - d)),
  },
  {
    id: 'phase',
    name: 'Phase margin',
    title: 'the smaller of both motors’, everything else closed',
    sign: -1,
    of: (r) => {
      const p = worseMargins(r.margins)?.phase;
      return Number.isFinite(p) ? p : undefined;
    },
    text: (v) => degrees(v, 0),
  },
  {
    id: 'disk',
    name: 'Disk margin',
    title: 'both motors at once',
    sign: -1,
    of: (r) => r.sensitivity?.disk_margin,
    text: (v) => fixed(v, 2),
  },
];

/**
 * @param {Figure} figure
 * @param {number|undefined} v
 * @param {number|undefined} reference the present design's
 * @returns {string} with its sign; empty where they read the same
 */
export function shiftText(figure, v, reference) {
  if (
    v === undefined ||
    reference === undefined ||
    !Number.isFinite(v) ||
    !Number.isFinite(reference) ||
    figure.text(v) === figure.text(reference)
  )
    return '';
  const d = v - reference;
  const text = (figure.shift ?? figure.text)(figure.shift ? d : Math.abs(d), v).replace('\u2212', '');
  return `${d < 0 ? '\u2212' : '+'}${text}`;
}

/**
 * A row for each reply, a cell for each figure. The best of a column is marked; where most are alike, none is.
 * @param {(Reply|null)[]} replies the present design's first
 * @returns {{text: string, shift: string, best: boolean, better: boolean, worse: boolean}[][]}
 */
export function differenceTable(replies) {
  const values = replies.map((r) => FIGURES.map((f) => (r ? f.of(r) : undefined)));
  const marks = FIGURES.map((f, j) =>
    best(
      values.map((row) => cost(f, row[j])),
      values.map((row) => f.text(row[j])),
    ),
  );
  return values.map((row, i) =>
    row.map((v, j) => {
      const shift = i === 0 ? '' : shiftText(FIGURES[j], v, values[0][j]);
      const up = shift !== '' && shift[0] === '+';
      const better = shift !== '' && up === FIGURES[j].sign < 0;
      return { text: FIGURES[j].text(v), shift, best: marks[j].has(i), better, worse: shift !== '' && !better };
    }),
  );
}

/** @param {Figure} figure @param {number|undefined} v */
const cost = (figure, v) =>
  v === undefined ? undefined : v === Infinity ? (figure.sign < 0 ? -Number.MAX_VALUE : undefined) : figure.sign * v;
