/**
 * Figures of many designs out of the rows that the kernel `run_designs` fills, as heli2dof_core/many.py reads them: NaN
 * where there is none, ±∞ where it is unlimited, as which is better. Pure.
 * @typedef {object} Measure
 * @property {string} name  of a figure (measured.js), or a share of uncertain rigs
 * @property {'theta'|'psi'|'both'} [axis]  that is stepped; both: the worse of them
 * @property {'V_p'|'V_y'|'both'} [motor]  absent: both
 * @property {'linear'|'nonlinear'} [model]  absent: nonlinear
 * @property {'alone'|'together'} [steps]  absent: each axis alone
 * @typedef {{together: boolean, alone: number[]}} Runs  the experiments of a row: whether the scenario's comes first,
 *   and the axes that are stepped alone
 * @typedef {{value: number, meant: boolean}} Own
 */
import { AT, AXIS, COURSE, ENDS, FIGURES, FOUND, MARGINS, MOTOR, OUTCOMES, SENSITIVITY } from './layout.js';
import { MEASURED_FIGURES, SHARES } from './measured.js';

const AXES = ['theta', 'psi'];
const MOTORS = ['V_p', 'V_y'];
const MODELS = ['linear', 'nonlinear'];
/** Columns of a course and of a motor's figures. */
const [OF_COURSE, OF_MOTOR] = [Object.keys(COURSE).length + 2, Object.keys(MOTOR).length]; // two of them are for both
/** @type {Record<string, number>} */
const OF_DESIGN = {
  norm: FIGURES.NORM,
  spectral_norm: FIGURES.SPECTRAL_NORM,
  pole_error: FIGURES.POLE_ERROR,
  pole_error_bound: FIGURES.POLE_ERROR_BOUND,
  eigenvector_condition: FIGURES.CONDITION,
  relative_gain: FIGURES.RELATIVE_GAIN,
};

/** The places in a list that are meant: one by its name, else all. @param {string[]} names @param {string} [name] */
const meant = (names, name) => (names.includes(name ?? '') ? [names.indexOf(name ?? '')] : names.map((_, i) => i));

/** Whether a figure is one of a response. @param {Measure} measure */
const isOfResponse = ({ name }) => ['axis', 'step', 'motor'].includes(MEASURED_FIGURES.get(name)?.of ?? '');

/**
 * Leaves out of a design's numbers what is not needed for these figures.
 * @param {Float64Array} numbers  as numbers.js fills them; changed
 * @param {readonly Measure[]} measures
 * @param {boolean} [unstable]  whether responses of unstable loops are wanted, too
 * @returns {Runs}
 */
export function leaveOut(numbers, measures, unstable = false) {
  const responses = measures.filter(isOfResponse);
  const kinds = measures.map(({ name }) => MEASURED_FIGURES.get(name)?.of);
  const models = responses.map(({ model = 'nonlinear' }) => model);
  const together = responses.some(({ steps }) => steps === 'together');
  const stepped = new Set(
    responses.filter(({ steps }) => steps !== 'together').flatMap(({ axis }) => meant(AXES, axis)),
  );
  const alone = [0, 1].filter((axis) => stepped.has(axis) && !Number.isNaN(numbers[AT.ASKED + axis]));
  const put = (/** @type {number} */ at, /** @type {boolean} */ value) => (numbers[at] = Number(value));
  put(AT.EACH_AXIS, alone.length > 0);
  put(AT.WITHOUT_MARGINS, !kinds.includes('margins') && !kinds.includes('sensitivity'));
  put(AT.WITHOUT_LAG_MARGIN, !kinds.includes('loop'));
  put(AT.WITHOUT_LINEAR, !models.includes('linear'));
  put(AT.WITHOUT_RIG, !models.includes('nonlinear'));
  put(AT.WITHOUT_SCENARIO, !together);
  put(AT.WITHOUT_UNSTABLE, !unstable);
  // uncertain rigs respond to the scenario as it is set
  if (!together && !measures.some(({ name }) => name === 'share_within_limits'))
    for (const axis of [0, 1]) if (!alone.includes(axis)) numbers[AT.ASKED + axis] = NaN;
  return { together, alone };
}

/** Whether a design exists. @param {Float64Array} found  its row */
export const exists = (found) => found[FOUND.FOUND_OUTCOME] === OUTCOMES.DONE;

/** Whether its loop is stable. @param {Float64Array} found */
export const isStable = (found) => found[FOUND.FOUND_FIGURES + FIGURES.STABLE] !== 0;

/**
 * @param {Measure} measure
 * @param {Float64Array} numbers  what was asked, one row
 * @param {Float64Array} found  what was found of it
 * @param {Runs} runs
 * @returns {number}
 */
export function valueOf(measure, numbers, found, runs) {
  if (!exists(found)) return NaN;
  if (SHARES.includes(measure.name))
    return found[SHARES.indexOf(measure.name) ? FOUND.SHARE_WITHIN : FOUND.SHARE_STABLE];
  const known = MEASURED_FIGURES.get(measure.name);
  return known ? worse(known, readings(known, measure, numbers, found, runs)) : NaN;
}

/**
 * @param {import('./measured.js').Measured} known @param {Measure} measure
 * @param {Float64Array} numbers @param {Float64Array} found @param {Runs} runs
 * @returns {Own[]}
 */
function readings({ of, own }, measure, numbers, found, runs) {
  const stable = isStable(found);
  if (of === 'margins') {
    const at = FOUND.FOUND_MARGINS + MARGINS.indexOf(own);
    return meant(MOTORS, measure.motor).map((m) => ({ value: found[at + m * MARGINS.length], meant: stable }));
  }
  if (of === 'sensitivity') return [{ value: ofSensitivity(own, found), meant: stable }];
  if (of === 'loop') return [{ value: found[FOUND.FOUND_FIGURES + FIGURES.LAG_MARGIN], meant: stable }];
  if (of === 'design') {
    const aims = !own.startsWith('pole_error') || numbers[AT.AIMS] !== 0;
    return [{ value: found[FOUND.FOUND_FIGURES + OF_DESIGN[own]], meant: aims }];
  }
  return ofResponses({ of, own }, measure, numbers, found, runs);
}

/**
 * @param {Pick<import('./measured.js').Measured, 'of'|'own'>} known @param {Measure} measure
 * @param {Float64Array} numbers @param {Float64Array} found @param {Runs} runs
 */
function ofResponses({ of, own }, measure, numbers, found, runs) {
  const model = MODELS.indexOf(measure.model ?? 'nonlinear');
  const together = measure.steps === 'together';
  /** @type {Own[]} */ const all = [];
  const courses = together && of === 'motor' ? [-1] : meant(AXES, measure.axis); // -1: of both axes
  for (const axis of courses) {
    const run = together ? 0 : Number(runs.together) + runs.alone.indexOf(axis);
    const stepped = axis < 0 || (moves(axis, numbers) && (together || runs.alone.includes(axis)));
    const n = 2 * run + model;
    const course = FOUND.FOUND_COURSES + n * OF_COURSE;
    const how = found[course + COURSE.OUTCOME];
    const ended = (how === ENDS.ENDED || how === ENDS.OUT_OF_BOUNDS) && run < found[FOUND.FOUND_RUNS];
    const whole = ended && !(of === 'step' && startsAway(1 - axis, numbers));
    const put = (/** @type {number} */ value) => all.push({ value: whole ? value : NaN, meant: stepped });
    if (of === 'axis') put(found[FOUND.FOUND_AXES + (2 * n + axis) * AXIS.length + AXIS.indexOf(own)]);
    else if (of === 'step') put(found[course + COURSE.DEVIATION + 1 - axis]);
    else
      for (const m of meant(MOTORS, measure.motor)) {
        const at = FOUND.FOUND_MOTORS + (2 * n + m) * OF_MOTOR;
        if (own === 'saturated') put(model ? found[course + COURSE.SHARE + m] : 0);
        else put(found[at + (own === 'peak' ? MOTOR.PEAK_VOLTAGE : MOTOR.EFFORT)]);
      }
  }
  return all;
}

/** Where an axis is at rest. @param {number} axis @param {Float64Array} numbers */
const base = (axis, numbers) => (axis === 0 ? numbers[AT.ANGLE] : 0);

/** @param {number} value @param {number} other */
const or = (value, other) => (Number.isNaN(value) ? other : value);

/** Whether an axis goes anywhere. @param {number} axis @param {Float64Array} numbers */
function moves(axis, numbers) {
  const at = base(axis, numbers);
  return or(numbers[AT.ASKED + axis], at) !== or(numbers[AT.BEGINNING + axis], at);
}

/** Whether an axis without a reference moves all the same. @param {number} axis @param {Float64Array} numbers */
function startsAway(axis, numbers) {
  const at = base(axis, numbers);
  return or(numbers[AT.BEGINNING + axis], at) !== at;
}

/** @param {string} own @param {Float64Array} found */
function ofSensitivity(own, found) {
  const of = (/** @type {number} */ at) => found[FOUND.FOUND_SENSITIVITY + at];
  const alpha = of(SENSITIVITY.DISK_MARGIN);
  if (own === 'gain_low') return (2 - alpha) / (2 + alpha);
  if (own === 'gain_high') return alpha < 2 ? (2 + alpha) / (2 - alpha) : NaN;
  if (own === 'phase') return 2 * Math.atan(alpha / 2);
  if (own === 'peak') return of(SENSITIVITY.SENSITIVITY_PEAK);
  if (own === 'disk_margin') return alpha;
  const value = of(own === 'peak_frequency' ? SENSITIVITY.PEAK_FREQUENCY : SENSITIVITY.DISK_FREQUENCY);
  return Math.abs(value) === Infinity ? NaN : value;
}

/**
 * Of several values the least good one.
 * @param {Pick<import('./measured.js').Measured, 'figure'|'unlimited'>} known @param {Own[]} all
 */
function worse({ figure, unlimited }, all) {
  const higher = figure.better === 'higher';
  const several = all.filter((own) => own.meant).length > 1;
  let worst = NaN;
  for (const { value: own, meant: there } of all) {
    if (!there) continue;
    const value = figure.signed && several ? Math.abs(own) : own;
    const lacks = Number.isNaN(value) || (unlimited && Math.abs(value) === Infinity);
    if (lacks && !unlimited) return NaN;
    const judged = lacks ? (higher ? Infinity : -Infinity) : value;
    worst = Number.isNaN(worst) ? judged : higher ? Math.min(worst, judged) : Math.max(worst, judged);
  }
  return worst;
}
