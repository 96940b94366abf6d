/**
 * What a design and its experiment are made of, under their paths in the contract: units, ranges, words, and what
 * they are unless someone says otherwise. Made of the core's dataclasses by `python -m tests.page_quantities`; not to
 * be changed by hand.
 *
 * @typedef {object} Quantity
 * @property {string} [unit]  SI
 * @property {number} [min]
 * @property {number} [max]
 * @property {string[]} [words]  that it may be
 * @property {number|boolean|string} [standard]  without: the preset's, or none
 */

/** @type {Partial<Record<string, Quantity>>} */
export const QUANTITIES = {
  poles: { unit: 'rad/s', min: -100000, max: 100000 },
  'operating_point.theta': { unit: 'rad', min: -1.5, max: 1.5 },
  coupling: { words: ['triangular', 'input-diagonal', 'axis-decoupled'] },
  lead: { words: ['pitch', 'yaw'] },
  shift: { min: -1000000, max: 1000000 },
  outer: { words: ['pi', 'none'] },
  pairing: { words: ['diagonal', 'cross'] },
  decoupler: {},
  'loops.pitch.kp': { unit: 'V/rad', min: -1000000, max: 1000000 },
  'loops.pitch.ti': { unit: 's', min: 1e-6, max: 1000000 },
  'loops.yaw.kp': { unit: 'V/rad', min: -1000000, max: 1000000 },
  'loops.yaw.ti': { unit: 's', min: 1e-6, max: 1000000 },
  'rotors.pitch.tau': { unit: 's', min: 0, max: 10 },
  'rotors.pitch.curve': { words: ['linear', 'quadratic'] },
  'rotors.pitch.dead_zone': { unit: 'V', min: 0, max: 1000 },
  'rotors.pitch.matched_at': { unit: 'V', min: 0.001, max: 1000000 },
  'rotors.yaw.tau': { unit: 's', min: 0, max: 10 },
  'rotors.yaw.curve': { words: ['linear', 'quadratic'] },
  'rotors.yaw.dead_zone': { unit: 'V', min: 0, max: 1000 },
  'rotors.yaw.matched_at': { unit: 'V', min: 0.001, max: 1000000 },
  'friction.pitch.coulomb': { unit: 'N·m', min: 0, max: 1000 },
  'friction.pitch.static': { unit: 'N·m', min: 0, max: 1000 },
  'friction.yaw.coulomb': { unit: 'N·m', min: 0, max: 1000 },
  'friction.yaw.static': { unit: 'N·m', min: 0, max: 1000 },
  place_rotors: {},
  'observer.method': { words: ['full-rank', 'kalman'], standard: 'full-rank' },
  'observer.coupling': { words: ['triangular', 'input-diagonal', 'axis-decoupled'], standard: 'axis-decoupled' },
  'observer.lead': { words: ['pitch', 'yaw'], standard: 'pitch' },
  'observer.voltage_noise': { unit: 'V/√Hz', min: 1e-9, max: 1000000, standard: 1 },
  'observer.angle_noise': { unit: 'rad/√Hz', min: 1e-12, max: 1000, standard: 0.0001 },
  'weights.states.theta': { unit: '1/rad²', min: 0, max: 1000000000000 },
  'weights.states.psi': { unit: '1/rad²', min: 0, max: 1000000000000 },
  'weights.states.theta_dot': { unit: 's²/rad²', min: 0, max: 1000000000000 },
  'weights.states.psi_dot': { unit: 's²/rad²', min: 0, max: 1000000000000 },
  'weights.inputs.V_p': { unit: '1/V²', min: 1e-12, max: 1000000000000 },
  'weights.inputs.V_y': { unit: '1/V²', min: 1e-12, max: 1000000000000 },
  'weights.integrals.theta': { unit: '1/(rad·s)²', min: 1e-12, max: 1000000000000 },
  'weights.integrals.psi': { unit: '1/(rad·s)²', min: 1e-12, max: 1000000000000 },
  'scenario.duration': { unit: 's', min: 0.001, max: 600 },
  'scenario.samples': { min: 2, max: 20001 },
  'scenario.saturation': { standard: true },
  'scenario.anti_windup': { words: ['none', 'clamping', 'back-calculation'], standard: 'clamping' },
  'scenario.tracking_time': { unit: 's', min: 0.0001, max: 10000 },
  'scenario.travel_stops': { standard: true },
  'scenario.trim_feedforward': { standard: true },
  'scenario.rtol': { min: 1e-12, max: 0.01, standard: 1e-8 },
  'scenario.measured': { words: ['states', 'filtered', 'observer'], standard: 'states' },
  'scenario.reference.theta': { unit: 'rad', min: -100, max: 100 },
  'scenario.reference.psi': { unit: 'rad', min: -100, max: 100 },
  'scenario.initial.theta': { unit: 'rad', min: -100, max: 100 },
  'scenario.initial.psi': { unit: 'rad', min: -100, max: 100 },
  'scenario.initial.theta_dot': { unit: 'rad/s', min: -100, max: 100, standard: 0 },
  'scenario.initial.psi_dot': { unit: 'rad/s', min: -100, max: 100, standard: 0 },
  'scenario.noise.theta': { unit: 'rad', min: 0, max: 1, standard: 0 },
  'scenario.noise.psi': { unit: 'rad', min: 0, max: 1, standard: 0 },
  'scenario.digital.sample_time': { unit: 's', min: 0.0001, max: 1, standard: 0.002 },
  'scenario.digital.delay': { standard: false },
  'scenario.digital.rates': { words: ['filtered', 'true'], standard: 'filtered' },
  'scenario.digital.noise': { unit: 'rad', min: 0, max: 1, standard: 0 },
  'scenario.digital.seed': { min: 0, max: 4294967295, standard: 0 },
  'scenario.digital.encoders.theta': { unit: 'counts per revolution', min: 0, max: 10000000, standard: 4096 },
  'scenario.digital.encoders.psi': { unit: 'counts per revolution', min: 0, max: 10000000, standard: 8192 },
  'scenario.disturbance.V_p': { unit: 'V', min: -1000, max: 1000, standard: 0 },
  'scenario.disturbance.V_y': { unit: 'V', min: -1000, max: 1000, standard: 0 },
  'scenario.disturbance.time': { unit: 's', min: 0, max: 600, standard: 0 },
  'columns.unit': { words: ['rad', 'deg'], standard: 'rad' },
  'columns.sample_time': { unit: 's', min: 1e-5, max: 10 },
  'columns.time_unit': { words: ['s', 'ms', 'us', 'ns', 'min', 'h', 'd'] },
  'columns.voltage_unit': { words: ['V', 'mV'], standard: 'V' },
  'columns.decimate': { min: 1, max: 1000, standard: 1 },
};

/** Of an observer, unless someone says otherwise: q₁ to q₄, rad/s. */
export const OBSERVER_POLES = [-40, -42, -41, -43];

/** The structure of the closed loop: the names right in a request. */
export const STRUCTURE = /** @type {const} */ (['coupling', 'lead', 'shift']);

/** The outer loops' own: the names right in a request. */
export const OUTER = /** @type {const} */ (['outer', 'pairing', 'decoupler']);

/** Whether the rotors are placed, too: the names right in a request. */
export const ROTORS = /** @type {const} */ (['place_rotors']);
