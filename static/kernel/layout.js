/**
 * What stands where in the numbers that the kernel `update` takes and in the block that it fills, and what a request
 * may be. Made of heli2dof_core/kernels/update_layout.py and the core's dataclasses by `python -m tests.page_kernel`;
 * not to be changed by hand.
 */

/** Offsets within the numbers. */
export const AT = {
  PARAMETERS: 0,
  ANGLE: 12,
  LIMITS: 13,
  POLES: 16,
  ROTOR_POLES: 24,
  ROTORS_PLACED: 26,
  FAMILY: 27,
  SHIFTED: 28,
  SHIFT: 29,
  PI_LOOPS: 30,
  PI_GAINS: 31,
  CROSSWISE: 35,
  DECOUPLED: 36,
  LAGS: 37,
  QUADRATIC: 39,
  DEAD_ZONES: 41,
  MATCHED: 43,
  FRICTION: 45,
  MEASURED: 49,
  OBSERVER_POLES: 50,
  OBSERVER_FAMILY: 58,
  ASKED: 59,
  BEGINNING: 61,
  DURATION: 65,
  SATURATION: 66,
  WINDUP_KIND: 67,
  TRACKING_TIME: 68,
  STOPS: 69,
  FEEDFORWARD: 70,
  RTOL: 71,
  DIGITAL: 72,
  SAMPLE_TIME: 73,
  LATE: 74,
  COUNTS: 75,
  RATES_FILTERED: 77,
  DISTURBED: 78,
  DISTURBANCE_VOLTS: 79,
  DISTURBED_FROM: 81,
  EACH_AXIS: 82,
  MOST_STEPS: 83,
  AIMS: 106,
  WITHOUT_MARGINS: 116,
  WITHOUT_LAG_MARGIN: 117,
  WITHOUT_LINEAR: 118,
  WITHOUT_RIG: 119,
  WITHOUT_SCENARIO: 120,
  WITHOUT_UNSTABLE: 121,
  NUMBERS: 122,
};

/** Parameters, in the numbers' order. */
export const PARAMETERS = ['K_pp', 'K_py', 'K_yp', 'K_yy', 'J_p', 'J_y', 'm', 'l', 'B_p', 'B_y', 'K_s', 'g'];

/** Coupling and leading axis of each family of structures, by its number. */
export const FAMILIES = ['triangular/pitch', 'triangular/yaw', 'input-diagonal/pitch', 'axis-decoupled/pitch'];

/** What is measured, by its number. */
export const MEASURED = ['states', 'filtered', 'observer'];

/** Kinds of anti-windup, by their numbers. */
export const WINDUPS = ['none', 'clamping', 'back-calculation'];

/** How an update ended. */
export const OUTCOMES = {
  DONE: 0,
  EXACT: 1,
  UNCONTROLLABLE: 2,
  NO_STRUCTURE: 3,
  NO_CURVE: 4,
  NO_SLOPE: 5,
  NO_EIGENVALUES: 6,
};

/** Columns of the figures. */
export const FIGURES = {
  DETERMINANT: 0,
  PLACED_STABLE: 1,
  NORM: 2,
  SPECTRAL_NORM: 3,
  CONDITION: 4,
  POLE_ERROR: 5,
  POLE_ERROR_BOUND: 6,
  DOUBTFUL: 7,
  RELATIVE_GAIN: 8,
  STABLE: 9,
  LAG_MARGIN: 10,
  CONNECTED: 11,
};

/** Columns of an experiment. */
export const EXPERIMENT = { REFERENCE: 0, START: 2, BOUND: 6, STOP: 8 };

/** Columns of an axis' metrics. */
export const AXIS = [
  'rise_time',
  'settling_time',
  'overshoot',
  'undershoot',
  'peak',
  'peak_time',
  'steady_state_error',
  'iae',
  'itae',
  'settled',
];

/** Columns of a motor's metrics. */
export const MOTOR = { PEAK_VOLTAGE: 0, EFFORT: 1 };

/** Columns of a course. */
export const COURSE = { DEVIATION: 0, SHARE: 2, HELD: 4, OUTCOME: 5, IMPACTS: 6, REACHED: 7 };

/** How a course ended. */
export const ENDS = { ENDED: 0, OUT_OF_STEPS: 1, OUT_OF_SWITCHES: 2, OUT_OF_BOUNDS: 3 };

/** Columns of a motor's margins. */
export const MARGINS = ['gain_margin', 'gain_reduction_margin', 'phase_margin', 'delay_margin'];

/** Columns of what both motors bear. */
export const SENSITIVITY = { SENSITIVITY_PEAK: 0, PEAK_FREQUENCY: 1, DISK_MARGIN: 2, DISK_FREQUENCY: 3 };

/** Columns of a design among many. */
export const FOUND = {
  FOUND_OUTCOME: 0,
  FOUND_RUNS: 1,
  SHARE_STABLE: 2,
  SHARE_WITHIN: 3,
  FOUND_FIGURES: 4,
  FOUND_SENSITIVITY: 16,
  FOUND_MARGINS: 20,
  FOUND_COURSES: 28,
  FOUND_MOTORS: 76,
  FOUND_AXES: 100,
  FOUND_K: 220,
  FOUND_INVERSE: 232,
  FOUND: 236,
};

/** Experiments in a block, filled or not. */
export const RUNS = 3;
/** States of the paper's rig, with rotors or friction, with an estimator. */
export const PLAIN = 6;
export const LAGGED = 8;
export const FULL = 14;
/** Where the rotors' speeds stand among the states. */
export const ROTORS = 6;
/** What rigs differ in: their parameters, and both rotors' time constants. */
export const FACTORS = 14;
/** Parts of poles below this are 0, rad/s. */
export const ZERO = 1e-9;
/** Rotors below this follow at once, s. */
export const AT_ONCE = 1e-6;

/** Of clouds: times of their responses, tolerance, least share of a parameter, percentiles of bands. */
export const RIGS = { TIMES: 101, RTOL: 1e-5, LEAST: 0.02, PERCENTILES: [5, 50, 95] };

/** Paths in a request whose values may be null. */
export const MAY_LACK = new Set([
  'limits.theta',
  'shift',
  'rotors.pitch.matched_at',
  'rotors.yaw.matched_at',
  'friction.pitch.static',
  'friction.yaw.static',
  'scenario.tracking_time',
  'scenario.reference.theta',
  'scenario.reference.psi',
  'scenario.initial.theta',
  'scenario.initial.psi',
]);

/** Those whose numbers are whole. */
export const WHOLE = new Set([
  'scenario.samples',
  'scenario.digital.seed',
  'scenario.digital.encoders.theta',
  'scenario.digital.encoders.psi',
]);
