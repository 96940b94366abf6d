/**
 * What stands where in a flight's arrays, the words of its log and their ranges. Made of heli2dof_core/flight and
 * heli2dof_core/kernels/flight_layout.py by `python -m tests.page_kernel`; not to be changed by hand.
 */

/** What acts from outside. */
export const INPUT = {
  MANUAL: 0,
  STICK: 1,
  REFERENCE: 3,
  TURN: 5,
  TURN_FROM: 7,
  PUSH: 8,
  GUST: 10,
  GUST_FROM: 12,
  GUST_TICKS: 13,
  THRUST: 14,
  HUNG: 16,
  STUCK: 18,
  NOISE: 20,
  SEED: 22,
  FLIGHT_INPUTS: 23,
};

/** A controller's settings, behind its sample time. */
export const CONTROLLER = {
  TIME: 0,
  BY_REFERENCE: 14,
  BASE: 18,
  ZERO_ANGLE: 20,
  TRIM: 21,
  MEASURED_AS: 23,
  ORDER: 24,
  TICKS: 25,
  FLIGHT_CONTROLLER: 26,
};

/** Of a loop's constants. */
export const CONSTANT = { LIMIT: 25, TRAVEL: 33 };

/** Of a rig's modes. */
export const MODE = { REST: 4 };

/** What a flight remembers beside its state. */
export const MEMORY = {
  FILTERS: 0,
  HAS: 4,
  COMPUTED: 6,
  SEEN: 8,
  READ: 18,
  PHASE: 20,
  TICK: 21,
  ENDED_AS: 22,
  WISHED: 23,
  HITS: 25,
  PUSHED: 26,
  FLIGHT_MEMORY: 28,
};

/** A row of its course. */
export const ROW = {
  STATE: 0,
  SENSED: 4,
  VOLTAGE: 8,
  UNLIMITED: 10,
  SPEED: 12,
  WISH: 14,
  OUTSIDE: 16,
  ON_STOP: 18,
  FLIGHT_ROW: 19,
};

/** What a change of controller tells. */
export const TAKEN_OVER = { JUMP: 0, JUMP_WITHOUT: 2, BUMPLESS: 4, TOLD: 5 };

/** Sizes of the arrays. */
export const FLOWN = {
  STATES: 14,
  CONSTANTS: 174,
  MODES: 12,
  OBSERVER_ROWS: 6,
  OBSERVER_COLUMNS: 11,
  WORK_ROWS: 24,
  WORK_COLUMNS: 16,
};

/** Tolerances within a tick, most steps; a continuous design's sample time, s; most samples; m/s². */
export const WITHIN = { RTOL: 1e-8, ATOL: 1e-9, MOST_STEPS: 2000, SAMPLED: 0.002, MOST_SAMPLES: 100000, GRAVITY: 9.81 };

/** Of a log. */
export const LOG = {
  FORMAT: 1,
  MOST_TICKS: 6000000,
  LONGEST: 660,
  MOST_EVENTS: 100000,
  MOST_DESIGNS: 5000,
  CHECK_EVERY: 500,
  AGREED: 1e-9,
};

/**
 * The words of a log: what each carries, its unit, and its range.
 * @type {Record<string, [name: string, unit: string, low: number, high: number][]>}
 */
export const WORDS = {
  reference: [
    ['theta', 'rad', -100, 100],
    ['psi', 'rad', -10000, 10000],
  ],
  turn: [
    ['theta_dot', 'rad/s', -20, 20],
    ['psi_dot', 'rad/s', -20, 20],
  ],
  hands: [['on', '', 0, 1]],
  sticks: [
    ['V_p', 'V', -1000, 1000],
    ['V_y', 'V', -1000, 1000],
  ],
  push: [
    ['theta', 'N·m', -100, 100],
    ['psi', 'N·m', -100, 100],
  ],
  gust: [
    ['theta', 'N·m', -100, 100],
    ['psi', 'N·m', -100, 100],
    ['ticks', '', 1, 1000000],
  ],
  thrust: [
    ['pitch', '', 0, 2],
    ['yaw', '', 0, 2],
  ],
  hung: [
    ['mass', 'kg', 0, 10],
    ['arm', 'm', -1, 1],
  ],
  stuck: [
    ['theta', '', 0, 1],
    ['psi', '', 0, 1],
  ],
};
