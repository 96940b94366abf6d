/**
 * From the block that the kernel fills to a reply as the server gives it (app/contract/): what does not exist is left
 * out, long arrays are copied. What the kernel does not know, words above all, is of the server's last reply. Pure.
 * @typedef {import('../types.js').Reply} Reply
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {import('../types.js').Step} Step
 * @typedef {Record<string, Float64Array>} Block  arrays by name, see heli2dof_core/kernels/update_layout.py
 * @typedef {{reply: Reply, design: Design|null}} Said  the server's last reply
 * @typedef {'linear'|'nonlinear'} Model
 */
import { AT, AXIS, COURSE, ENDS, EXPERIMENT, FIGURES, MARGINS, MEASURED, MOTOR, OUTCOMES } from './layout.js';
import { PLAIN, ROTORS, RUNS, SENSITIVITY } from './layout.js';

const MODELS = /** @type {const} */ (['linear', 'nonlinear']);
const INPUTS = /** @type {const} */ (['V_p', 'V_y']);
const OUTPUTS = /** @type {const} */ (['theta', 'psi']);
/** What decides on a rig's model, and on an observer that is told for its own sake. */
const OF_THE_MODEL = /** @type {const} */ ([
  ...['preset', 'parameters', 'limits', 'theta0', 'rotors', 'friction', 'place_rotors', 'observer'],
]);

/** @param {ArrayLike<number>} flat @param {number} columns @returns {number[][]} */
const matrix = (flat, columns) =>
  Array.from({ length: flat.length / columns }, (_, i) =>
    Array.from({ length: columns }, (_, j) => flat[i * columns + j]),
  );

/** @param {Float64Array} flat @param {number} count @returns {Complex[]} */
const complexes = (flat, count) => Array.from({ length: count }, (_, i) => ({ re: flat[2 * i], im: flat[2 * i + 1] }));

/**
 * What exists.
 * @template {Record<string, unknown>} T
 * @param {T} values
 * @returns {T}
 */
const present = (values) =>
  /** @type {T} */ (
    Object.fromEntries(Object.entries(values).filter(([, v]) => v !== undefined && !Number.isNaN(v) && v !== Infinity))
  );

/** A row of a table with equal rows. @param {Float64Array} table @param {number} rows @param {number} at */
const row = (table, rows, at) => table.subarray((table.length / rows) * at, (table.length / rows) * (at + 1));

/** How many states the loop has. @param {Float64Array} numbers @param {Block} block */
function orderOf(numbers, { actuators }) {
  const lags = [actuators[0], actuators[1]].filter((tau) => tau > 0).length;
  const estimated = { states: 0, filtered: 4, observer: numbers[AT.ROTORS_PLACED] && lags ? 6 : 4 };
  const measured = /** @type {keyof typeof estimated} */ (MEASURED[numbers[AT.MEASURED]]);
  return 4 + (numbers[AT.PI_LOOPS] ? 2 : 0) + lags + estimated[measured];
}

/** A and B of the model that is placed, six states with the rotors. @param {Block} block @param {boolean} placed */
function modelOf({ A, B, actuators }, placed) {
  if (!placed) return { A: matrix(A, 4), B: matrix(B, 2) };
  const [tau, slope] = [actuators.subarray(0, 2), actuators.subarray(10, 12)];
  const lag = (/** @type {number} */ i, /** @type {number} */ j) => (i === j ? 1 / tau[i] : 0);
  return {
    A: [
      ...matrix(A, 4).map((own, i) => [...own, B[2 * i] * slope[0], B[2 * i + 1] * slope[1]]),
      ...[0, 1].map((i) => [0, 0, 0, 0, 0 - lag(i, 0), 0 - lag(i, 1)]),
    ],
    B: [...Array.from({ length: 4 }, () => [0, 0]), ...[0, 1].map((i) => [lag(i, 0), lag(i, 1)])],
  };
}

/**
 * What was there before, where it says the same: then nothing is drawn anew.
 * @template T
 * @param {T} now @param {T} before
 */
const unchanged = (now, before) => (JSON.stringify(now) === JSON.stringify(before) ? before : now);

/**
 * Relative gains, and what is said of them.
 * @param {number} gain λ₁₁ @param {Reply['rga']} said
 * @returns {Reply['rga']}
 */
function relativeGains(gain, { reason, findings }) {
  if (Number.isNaN(gain)) return { findings };
  const cross = 1 - gain;
  const [p, y] = gain < 0.5 ? [INPUTS[1], INPUTS[0]] : INPUTS;
  return present({
    findings,
    rga: [
      [gain, cross],
      [cross, gain],
    ],
    pairing: [
      ['theta', p],
      ['psi', y],
    ],
    reason,
    niederlinski: gain ? 1 / gain : undefined,
    niederlinski_cross: cross ? 1 / cross : undefined,
  });
}

/** @param {Float64Array} values @returns {NonNullable<Reply['sensitivity']>} */
function sensitivityOf(values) {
  const disk = values[SENSITIVITY.DISK_MARGIN];
  return present({
    peak: values[SENSITIVITY.SENSITIVITY_PEAK],
    peak_frequency: values[SENSITIVITY.PEAK_FREQUENCY],
    disk_margin: disk,
    disk_frequency: values[SENSITIVITY.DISK_FREQUENCY],
    gain_low: (2 - disk) / (2 + disk),
    gain_high: disk < 2 ? (2 + disk) / (2 - disk) : undefined,
    phase: 2 * Math.atan(disk / 2),
  });
}

/**
 * An object of what is found for each name.
 * @template T
 * @param {readonly string[]} names @param {(at: number) => unknown} found
 */
const byName = (names, found) => /** @type {T} */ (Object.fromEntries(names.map((name, i) => [name, found(i)])));

/** @param {Float64Array} values a row of the kernel's, NaN where something did not happen */
const axisOf = (values) =>
  present({
    .../** @type {import('../types.js').AxisMetrics} */ (byName(AXIS, (i) => values[i])),
    settled: values[AXIS.indexOf('settled')] === 1,
  });

/**
 * One response's figures. Those of its steps are of the experiment without its disturbance.
 * @param {Block} block @param {number} run @param {number} model @param {boolean} disturbed
 * @returns {Step['metrics']}
 */
function metricsOf(block, run, model, disturbed) {
  const at = 2 * run + model;
  const course = row(block.courses, 2 * RUNS, at);
  const calm = disturbed && MODELS[model] === 'nonlinear';
  const axes = calm ? row(block.calm_axes, RUNS, run) : row(block.axes, 2 * RUNS, at);
  const steps = calm ? row(block.calm_courses, RUNS, run) : course;
  const motors = row(block.motors, 2 * RUNS, at);
  const x = row(block.experiments, RUNS, run);
  const stepped = [0, 1].filter((i) => x[EXPERIMENT.REFERENCE + i] !== x[EXPERIMENT.START + i]);
  const [p, y] = [0, 1].map((i) => ({
    peak: row(motors, 2, i)[MOTOR.PEAK_VOLTAGE],
    saturated: model ? course[COURSE.SHARE + i] : 0,
    effort: row(motors, 2, i)[MOTOR.EFFORT],
  }));
  return {
    ...byName(
      stepped.map((i) => OUTPUTS[i]),
      (k) => axisOf(row(axes, 2, stepped[k])),
    ),
    ...(stepped.length === 1 && { coupling_peak: steps[COURSE.DEVIATION + 1 - stepped[0]] }),
    V_p: p,
    V_y: y,
  };
}

/** @param {Block} block @param {number} size @param {number} samples @param {number} run @param {number} model */
function coursesOf(block, size, samples, run, model) {
  const kept = (/** @type {Float64Array} */ values, /** @type {number} */ at) =>
    new Float32Array(values.subarray(samples * at, samples * (at + 1)));
  const [states, from] = model ? [block.nonlinear, run * size] : [block.linear, run * (size + 1)];
  const [V_p, V_y] = [0, 1].map((i) => kept(block.voltages, 4 * run + 2 * model + i));
  const lags = [0, 1].map((i) => block.actuators[i] > 0);
  const [v_p, v_y] = [V_p, V_y].map((volts, i) => (lags[i] ? kept(states, from + ROTORS + i) : volts));
  const rotors = size > PLAIN && lags.some(Boolean) && { rotors: { v_p, v_y } };
  return { theta: kept(states, from), psi: kept(states, from + 1), V_p, V_y, ...rotors };
}

/**
 * All that the page shows of a design; null where the kernel has not found it.
 * @param {Block} block @param {Float64Array} numbers @param {Design} design
 * @param {{size: number, samples: number}} how @param {Said} said
 * @returns {Reply|null}
 */
export function replyOf(block, numbers, design, { size, samples }, said) {
  const [outcome, runs] = block.outcome;
  if (outcome !== OUTCOMES.DONE) return null;
  const figures = block.figures;
  for (let at = 0; at < 2 * runs; at++)
    if (row(block.courses, 2 * RUNS, at)[COURSE.OUTCOME] === ENDS.OUT_OF_STEPS) return null;
  const placed = Boolean(numbers[AT.ROTORS_PLACED]);
  const stable = figures[FIGURES.STABLE] === 1;
  const measured = MEASURED[numbers[AT.MEASURED]];
  const observer = measured === 'observer' && {
    observer: { L: matrix(block.L, 2), poles: complexes(block.estimator_poles, 4) },
  };
  const lag = present({ lag_margin: figures[FIGURES.LAG_MARGIN] });
  const trim = { V_p: block.trim[0], V_y: block.trim[1] };
  const common = { ...lag, loop_poles: complexes(block.poles, orderOf(numbers, block)), stable, trim, ...observer };
  const t = new Float32Array(block.t);
  const words = said.reply;
  const disturbed = Boolean(numbers[AT.DISTURBED]);
  const pair = (/** @type {number} */ run, /** @type {Reply['step']|undefined} */ told) => {
    const [theta, psi] = row(block.experiments, RUNS, run);
    const stepOf = (/** @type {number} */ model) => ({
      ...common,
      t,
      ...coursesOf(block, size, samples, run, model),
      reference: { theta, psi },
      metrics: metricsOf(block, run, model, disturbed),
      findings: told?.[MODELS[model]].findings ?? [],
    });
    return { linear: stepOf(0), nonlinear: stepOf(1) };
  };
  const alone = OUTPUTS.filter((_, i) => !Number.isNaN(numbers[AT.ASKED + i])).slice(0, runs - 1);
  const { A, B } = modelOf(block, placed);
  const sure = !figures[FIGURES.DOUBTFUL];
  const same = OF_THE_MODEL.every((key) => design[key] === said.design?.[key]);
  return {
    ...common,
    gains: {
      ...present({
        pole_error: sure ? figures[FIGURES.POLE_ERROR] : undefined,
        pole_error_bound: sure ? figures[FIGURES.POLE_ERROR_BOUND] : undefined,
        eigenvector_condition: figures[FIGURES.CONDITION],
        rotor_poles: placed
          ? complexes(Float64Array.of(numbers[AT.ROTOR_POLES], 0, numbers[AT.ROTOR_POLES + 1], 0), 2)
          : undefined,
        observer: !design.observer ? undefined : observer ? observer.observer : same ? words.gains.observer : undefined,
      }),
      norm: figures[FIGURES.NORM],
      spectral_norm: figures[FIGURES.SPECTRAL_NORM],
      ...lag,
      method: design.method,
      K: matrix(block.K, 6).map((own) => own.slice(0, placed ? 6 : 4)),
      A,
      B,
      poles: complexes(numbers.subarray(AT.POLES, AT.POLES + 8), 4),
      closed_loop_poles: complexes(block.closed, placed ? 6 : 4),
      controllability_indices: words.gains.controllability_indices,
      findings: words.gains.findings,
    },
    open_loop_poles: unchanged(complexes(block.open, 4), words.open_loop_poles),
    rga: relativeGains(figures[FIGURES.RELATIVE_GAIN], words.rga),
    step: pair(0, words.step),
    axis_steps: byName(alone, (i) => pair(i + 1, words.axis_steps[alone[i]])),
    margins: stable
      ? byName(['pitch', 'yaw'], (i) => present(byName(MARGINS, (j) => row(block.margins, 2, i)[j])))
      : {},
    ...(stable && { sensitivity: sensitivityOf(block.sensitivity) }),
    limits: present({
      V_p: numbers[AT.LIMITS],
      V_y: numbers[AT.LIMITS + 1],
      theta: numbers[AT.LIMITS + 2],
    }),
    findings: words.findings,
    ...(words.seq !== undefined && { seq: words.seq }),
  };
}

/**
 * The same numbers, with the words of another reply.
 * @param {Reply} own @param {Reply} said
 * @returns {Reply}
 */
export const withWords = (own, said) => ({
  ...own,
  findings: said.findings,
  rga: present({ ...own.rga, reason: said.rga.reason, findings: said.rga.findings }),
  ...(said.seq !== undefined && { seq: said.seq }),
});
