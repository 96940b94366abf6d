/**
 * Whether goals are met, from the page's own numbers, so that they tick while a hand drags: the same figures, rounding
 * and rules as the server's marks (heli2dof_core/labs), which hold. What the page does not know is judged there alone.
 * Pure.
 * @typedef {import('./shapes.js').Goal} Goal
 * @typedef {import('../types.js').Reply} Reply
 * @typedef {import('../types.js').Axis} Axis
 * @typedef {import('../types.js').Motor} Motor
 * @typedef {import('../types.js').State} State
 * @typedef {import('../model/figures.js').Figure} Figure
 * @typedef {number|undefined} Value  undefined: there is none
 * @typedef {{met: boolean|null, text: string}} Now  met: null where the page cannot tell
 */
import { fixed, inField, percent, t } from '../text/index.js';
import { AXIS, figureIn, textOf } from '../model/index.js';
import { MEASURED_FIGURES } from '../kernel/index.js';
import { bodyFrom } from '../bodies/index.js';

const SLACK = 1e-9;
/** Of these no value says that there is no limit. */
const UNLIMITED = [...MEASURED_FIGURES.values()].filter((own) => own.unlimited).map((own) => own.figure);
const AXES = /** @type {Axis[]} */ (['theta', 'psi']);
const MOTORS = /** @type {Motor[]} */ (['V_p', 'V_y']);

/** @type {Now} */
const UNKNOWN = { met: null, text: '' };

/** A figure of the registry. @param {Pick<Goal, 'of'|'figure'>} goal @returns {Figure|undefined} */
export const figureOf = ({ of, figure }) => {
  const known = MEASURED_FIGURES.get(figure ?? '');
  return known?.of === of ? known?.figure : undefined;
};

/** A share is shown in percent, below one percent with a decimal, and never as none. */
const isShare = (/** @type {Figure} */ { scale }) => scale === 100;

/** @param {number} v @param {number} digits */
const decimals = (v, digits) => Number(v.toFixed(digits));

/**
 * What is shown of a value, as a number in the unit that people read.
 * @param {Figure} figure
 * @param {number} value
 */
export function shown(figure, value) {
  const { notation, digits, scale = 1, signed } = figure;
  const v = signed ? Math.abs(value) : value;
  if (isShare(figure)) return v > 0 && v < 0.0005 ? 0.05 : decimals(100 * v, v < 0.01 ? 1 : 0);
  if (notation === 'seconds') return v < 0.1 ? decimals(1e3 * v, v < 0.01 ? 1 : 0) / 1e3 : decimals(v, 2);
  if (notation === 'decibel') return decimals(20 * Math.log10(v), 1);
  const read = v * scale;
  if (notation === 'exponent') return Number(read.toExponential(digits));
  if (notation !== 'significant' || read === 0) return decimals(read, digits);
  const size = Math.abs(read);
  if (size >= 1e6 || size < 1e-4) return Number(read.toExponential(Math.max(0, digits - 2)));
  const leading = Math.floor(Math.log10(size));
  return decimals(read, Math.max(0, digits - (leading >= 0 ? leading + 1 : leading === -1 ? 1 : leading + 2)));
}

/** A limit in the unit that people read. @param {Figure} figure @param {number} limit in the figure's own */
const inShown = ({ notation, scale = 1 }, limit) =>
  notation === 'decibel' ? 20 * Math.log10(limit) : notation === 'seconds' ? limit : limit * scale;

/**
 * Whether a value, as it is shown, lies within limits.
 * @param {Figure} figure
 * @param {Value} value
 * @param {Pick<Goal, 'max'|'min'>} limits in the figure's unit
 */
export function meets(figure, value, { max, min }) {
  const [high, low] = [max ?? Infinity, min ?? -Infinity].map((v) => (Number.isFinite(v) ? inShown(figure, v) : v));
  if (value === undefined || Number.isNaN(value)) return UNLIMITED.includes(figure) && high === Infinity;
  const v = shown(figure, value);
  const slack = (/** @type {number} */ limit) => SLACK * Math.max(1, Math.abs(limit));
  return (high === Infinity || v <= high + slack(high)) && (low === -Infinity || v >= low - slack(low));
}

/**
 * Of several values the one that limits are judged by: the first that fails, or else the nearest to a limit.
 * @param {Figure} figure @param {Value[]} values @param {Pick<Goal, 'max'|'min'>} limits
 */
export function worst(figure, values, limits) {
  const failing = values.filter((v) => !meets(figure, v, limits));
  const judged = failing.length ? failing : values.filter((v) => v !== undefined);
  const extreme = Number.isFinite(limits.max ?? NaN) ? Math.max : Math.min;
  return judged.includes(undefined) || !judged.length ? undefined : extreme(.../** @type {number[]} */ (judged));
}

/**
 * A goal's figure, several times where both axes or motors are meant; null where no such axis is stepped.
 * @param {Goal} goal
 * @param {Reply} reply
 * @returns {Value[]|null}
 */
export function valuesOf(goal, reply, theta0 = 0) {
  const { of, model = 'nonlinear', steps } = goal;
  const { name } = /** @type {Figure} */ (figureOf(goal));
  const courseOf = (/** @type {Axis} */ axis) => (steps === 'together' ? reply.step : reply.axis_steps[axis])?.[model];
  // an axis whose reference is where it rests is not stepped
  const axes = AXES.filter((axis) => {
    const reference = courseOf(axis)?.reference[axis];
    const meant = goal.axis === axis || !AXES.includes(/** @type {Axis} */ (goal.axis));
    return meant && reference !== undefined && reference !== (axis === 'theta' ? theta0 : 0);
  });
  const motors = MOTORS.filter((motor) => goal.motor === motor || !MOTORS.includes(/** @type {Motor} */ (goal.motor)));
  if (['axis', 'step', 'motor'].includes(of ?? '') && !axes.length) return null;
  if (of === 'axis' || of === 'step')
    return axes.map((axis) => {
      const metrics = courseOf(axis)?.metrics;
      return figureIn(of === 'step' ? metrics : metrics?.[axis], name);
    });
  if (of === 'motor') {
    const courses = steps === 'together' ? [reply.step[model]] : axes.flatMap((axis) => courseOf(axis) ?? []);
    return courses.flatMap((step) => motors.map((motor) => figureIn(step.metrics?.[motor], name)));
  }
  if (of === 'margins')
    return motors.map((motor) => figureIn(reply.margins?.[motor === 'V_p' ? 'pitch' : 'yaw'], name));
  if (of === 'sensitivity') return [figureIn(reply.sensitivity, name)];
  if (of === 'loop') return [figureIn(reply, name)];
  return [name === 'relative_gain' ? reply.rga?.rga?.[0][0] : figureIn(reply.gains, name)];
}

/** A value as it is shown; words where there is none. @param {Figure} figure @param {Value} value */
export function written(figure, value) {
  if (value === undefined) {
    if (UNLIMITED.includes(figure)) return t('unlimited');
    return figure === AXIS.settling ? t('not settled') : figure === AXIS.rise ? t('not reached') : t('none');
  }
  if (isShare(figure)) return value > 0 && value < 0.0005 ? '< 0.1 %' : percent(value, value < 0.01 ? 1 : 0);
  return `${textOf(figure, value).replace('e+', 'e')}${figure.head?.match(/, (\S+)$/)?.[1].replace(/^/, ' ') ?? ''}`;
}

/** What stands at a dotted path. @param {unknown} body @param {string} path */
const at = (body, path) =>
  path
    .split('.')
    .reduce(
      (inner, key) => /** @type {Record<string, unknown>|undefined} */ (inner)?.[key],
      /** @type {unknown} */ (body),
    );

/** A setting of the student's own within limits. @param {Goal} goal @param {import('../types.js').Design} design */
function settingJudged({ path = '', min, max, scale = 1, unit = '' }, design) {
  const own = at(bodyFrom(design), path);
  if (typeof own !== 'number') return UNKNOWN;
  const value = own * scale;
  const slack = (/** @type {number} */ limit) => SLACK * Math.max(1, Math.abs(limit));
  const met = value <= (max ?? Infinity) + slack(max ?? 0) && value >= (min ?? -Infinity) - slack(min ?? 0);
  return { met, text: `${inField(Number(value.toPrecision(6)))} ${unit}`.trim() };
}

/**
 * How far a goal is.
 * @param {Goal} goal
 * @param {Pick<State, 'reply'|'design'>} state whose numbers are the design's
 * @returns {Now}
 */
export function judged(goal, { reply, design }) {
  if (!reply || !design || goal.page === false) return UNKNOWN;
  if (goal.kind === 'setting') return settingJudged(goal, design);
  const figure = goal.kind === 'figure' ? figureOf(goal) : undefined;
  if (!figure) return UNKNOWN;
  if (!reply.stable && (!goal.unstable || ['margins', 'sensitivity', 'loop'].includes(goal.of ?? '')))
    return { met: false, text: t('unstable') };
  const values = valuesOf(goal, reply, design.theta0);
  if (!values) return { met: false, text: t('not stepped') };
  const value = worst(figure, values, goal);
  return { met: meets(figure, value, goal), text: written(figure, value) };
}

/** Points in words: whole ones without decimals. @param {number} points */
export const pointsText = (points) => fixed(points, 2).replace(/\.?0+$/, '');
