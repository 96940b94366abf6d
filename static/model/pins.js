/**
 * Pinned designs: their letters, and how their figures differ from those of the present design. Pure.
 * @typedef {import('../types.js').Reply} Reply
 * @typedef {import('../types.js').Pin} Pin
 */
import { t } from '../text/index.js';
import { best, hardest, worseMargins } from './compare_math.js';
import { signOf, textOf, valueIn } from './figure_texts.js';
import { AXIS, DESIGN, LOOP, MARGINS, MOTOR, RESPONSE, SENSITIVITY } from './figures.js';

export const COLORS = 6;

/** A, B, … Z, A2, B2, … @param {number} index */
export const letterOf = (index) =>
  `${String.fromCharCode(65 + (index % 26))}${index < 26 ? '' : Math.floor(index / 26) + 1}`;

/** @param {number} index */
export const colorOf = (index) => `pin-${index % COLORS}`;

/** The figures of an axis' step, of a loop that is stable. @param {Reply} r @param {'theta'|'psi'} axis */
const metrics = (r, axis) => (r.stable ? r.axis_steps?.[axis]?.nonlinear.metrics : undefined);
const peaks = (/** @type {Reply} */ r) =>
  hardest(Object.fromEntries(Object.entries(r.axis_steps ?? {}).map(([axis, pair]) => [axis, pair.nonlinear.metrics])));
/**
 * `of` gives the figure, `text` shows it, `shift` shows a difference, `sign` is 1 where less is better and −1 where
 * more is.
 * @typedef {{id: string, axis?: 'theta'|'psi', name: string, symbol?: string, title: string, sign: 1|-1, of: (r: Reply)
 *   => number|undefined, text: (v: number|undefined) => string, shift?: (d: number, v: number) => string}} Figure
 * @typedef {import('./figures.js').Figure} Known
 */

/**
 * What the registry says of a figure.
 * @param {string} id
 * @param {Known} f
 * @param {(r: Reply) => number|undefined} of
 * @returns {Figure}
 */
const column = (id, f, of) => ({
  id,
  name: f.short ?? '',
  title: f.hint ?? '',
  sign: signOf(f),
  of: f.signed ? (/** @type {Reply} */ r) => size(of(r)) : of,
  text: (/** @type {number|undefined} */ v) => textOf(f, v),
});
const size = (/** @type {number|undefined} */ v) => (v === undefined ? undefined : Math.abs(v));

const MODEL = ', nonlinear rig'; // named where both models are timed

/** @param {'theta'|'psi'} axis @param {string} key @param {Known} f @returns {Figure} */
const ofAxis = (axis, key, f) => {
  const own = column(`${key}-${axis}`, f, (r) => valueIn(metrics(r, axis), axis, key, f));
  return { ...own, axis, title: own.title + (f.notation === 'seconds' ? MODEL : '') };
};

/**
 * A time that is endless where the axis has not settled within the window.
 * @param {'theta'|'psi'} axis
 * @param {Figure} own
 * @returns {Figure}
 */
const endless = (axis, own) => ({
  ...own,
  of: (r) => (metrics(r, axis)?.[axis]?.settled === false ? Infinity : own.of(r)),
  text: (v) => (v === Infinity ? t('not settled') : own.text(v)),
});

/** @param {'V_p'|'V_y'} motor @param {string} name */
const ofMotor = (motor, name) => ({
  ...column(motor, MOTOR.peak, (r) => peaks(r)[motor]?.peak),
  symbol: motor,
  title: `peak of the ${name} ${MOTOR.peak.hint}`,
});

/** Without end where the loop bears any. */
const lag = column('lag', LOOP.lag, (r) => (r.stable ? (r.lag_margin ?? Infinity) : undefined));
const gain = column('gain', MARGINS.gain, (r) => worseMargins(r.margins)?.gain);

/** @type {Figure[]} */
export const FIGURES = [
  { ...column('norm', DESIGN.norm, (r) => r.gains.norm), symbol: DESIGN.norm.symbol },
  .../** @type {('theta'|'psi')[]} */ (['theta', 'psi']).flatMap((axis) =>
    Object.entries(RESPONSE)
      .filter(([, f]) => f.short && f.better !== 'none')
      .map(([key, f]) => (f === AXIS.settling ? endless(axis, ofAxis(axis, key, f)) : ofAxis(axis, key, f))),
  ),
  ofMotor('V_p', 'pitch'),
  ofMotor('V_y', 'yaw'),
  {
    ...gain,
    text: (v) => (v === Infinity ? '∞' : gain.text(v)),
    shift: (d, v) => gain.text(v / (v - d)),
  },
  column('phase', MARGINS.phase, (r) => {
    const p = worseMargins(r.margins)?.phase;
    return Number.isFinite(p) ? p : undefined;
  }),
  column('disk', SENSITIVITY.disk, (r) => r.sensitivity?.disk_margin),
  { ...lag, text: (v) => (v === Infinity ? '∞' : lag.text(v)) },
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
