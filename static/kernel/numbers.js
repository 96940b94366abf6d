/**
 * From a design to the numbers that the kernel takes: what is left out comes from the preset, as the server has it
 * (heli2dof_core/request.py). Pure.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {6|8|14} Size
 */
import { ENCODERS, evaluationOf, FULL_RANK, OBSERVER_POLES, QUANTITIES, STANDARD, standardOf } from '../model/index.js';
import {
  AT,
  AT_ONCE,
  FAMILIES,
  FULL,
  LAGGED,
  MAY_LACK,
  MEASURED,
  PARAMETERS,
  PLAIN,
  WHOLE,
  WINDUPS,
  ZERO,
} from './layout.js';

/** Of each response's integration: a frame's work. Where that is not enough, the server goes on. */
const MOST_STEPS = 10_000;
/** Of a digital controller, for the same reason. */
const MOST_SAMPLES = 5000;
const AXES = /** @type {const} */ (['pitch', 'yaw']);
/** What the server does unless it is told otherwise. @type {Required<import('../contract.js').ScenarioChanges>} */
const SCENARIO = { ...standardOf('scenario'), rtol: STANDARD.rtol };
/** @type {Required<import('../contract.js').Initial>} */ const INITIAL = standardOf('scenario.initial');
/** @type {Required<import('../contract.js').DigitalController>} */ const DIGITAL = standardOf('scenario.digital');
/** @type {Required<import('../contract.js').InputDisturbance>} */ const UNDISTURBED =
  standardOf('scenario.disturbance');
/** @type {Required<import('../contract.js').ObserverChanges>} */ const WATCHED = standardOf('observer');
const WATCHING = OBSERVER_POLES.map((re) => ({ re, im: 0 }));

/**
 * Whether the kernel can say what the server would: what that might refuse is left to it.
 * @param {Design} design @param {Preset} preset
 */
export function serves(design, preset) {
  const { preset: _name, each_axis: _both, method, poles, rotor_poles, observer, ...others } = evaluationOf(design);
  const { scenario } = others;
  const kalman = scenario.measured === 'observer' && observer?.method === 'kalman';
  const noisy = Object.values(scenario.noise ?? {}).some(Boolean) || Boolean(scenario.digital?.noise);
  if (method !== FULL_RANK || kalman || noisy) return false;
  const { poles: watched, ...how } = observer ?? { poles: WATCHING };
  const whole = arePaired(poles) && arePaired(watched) && rotor_poles.length === 2 && rotor_poles.every(isPole);
  return whole && isSound(others, '', preset) && isSound(how, 'observer', preset) && fits(design, preset);
}

const { max: LARGEST = Infinity } = QUANTITIES.poles ?? {};

/** @param {unknown} v */
const isPole = (v) => typeof v === 'number' && Math.abs(v) <= LARGEST;

/** @param {readonly Complex[]} poles two pairs, each real or conjugate */
function arePaired(poles) {
  if (poles.length !== 4 || !poles.every(({ re, im }) => isPole(re) && isPole(im))) return false;
  return [0, 2].every((i) => {
    const [p, q] = [cleaned(poles[i]), cleaned(poles[i + 1])];
    return Math.abs(p.im + q.im) <= ZERO && (p.im === 0 || Math.abs(p.re - q.re) <= ZERO);
  });
}

/** @param {Complex} pole @returns {Complex} without what is as good as 0 */
const cleaned = ({ re, im }) => ({ re: Math.abs(re) < ZERO ? 0 : re, im: Math.abs(im) < ZERO ? 0 : im });

/**
 * Whether all that stands in a part of a request is known and in its range.
 * @param {unknown} value @param {string} path @param {Preset} preset
 * @returns {boolean}
 */
function isSound(value, path, preset) {
  if (value === undefined) return true; // as good as left out
  if (typeof value === 'object' && value !== null)
    return Object.entries(value).every(([name, own]) => isSound(own, path ? `${path}.${name}` : name, preset));
  const known = rangeOf(path, preset);
  if (value === null || !known) return value === null && MAY_LACK.has(path);
  if (known.words) return known.words.includes(String(value));
  if (known.min === undefined || known.max === undefined) return typeof value === 'boolean';
  if (WHOLE.has(path) && !Number.isInteger(value)) return false;
  return typeof value === 'number' && value >= known.min && value <= known.max;
}

/**
 * @param {string} path @param {Preset} preset
 * @returns {{min?: number, max?: number, words?: string[]}|undefined}
 */
function rangeOf(path, preset) {
  const [top, name] = path.split('.');
  const infos = { parameters: preset.parameter_info, limits: preset.limit_info }[top];
  if (!infos) return QUANTITIES[path];
  const info = Object.hasOwn(infos, name) ? infos[name] : undefined;
  return info && { min: info.minimum, max: info.maximum };
}

/** What two values say together. @param {Design} design @param {Preset} preset */
function fits(design, preset) {
  const { digital, duration } = design.scenario;
  const rotors = AXES.map((axis) => rotorOf(design, preset, axis));
  return (
    rotors.every(({ matched_at, dead_zone }) => !matched_at || matched_at > dead_zone) &&
    !(design.place_rotors && rotors.some(({ tau }) => tau === 0)) &&
    !(design.coupling === 'axis-decoupled' && Number.isFinite(design.shift)) &&
    !(digital && duration / { ...DIGITAL, ...digital }.sample_time > MOST_SAMPLES)
  );
}

/**
 * @param {Design} design @param {Preset} preset @param {'pitch'|'yaw'} axis
 * @returns {import('../contract.js').Rotor}
 */
function rotorOf(design, preset, axis) {
  const own = /** @type {import('../contract.js').Rotor} */ ({ ...preset.rotors[axis], ...design.rotors[axis] });
  return { ...own, tau: own.tau < AT_ONCE ? 0 : own.tau };
}

/** Torques against the motion, and those that hold an axis at rest. @param {Design} design @param {Preset} preset */
function frictionOf(design, preset) {
  const both = AXES.map(
    (axis) => /** @type {import('../contract.js').Friction} */ ({ ...preset.friction[axis], ...design.friction[axis] }),
  );
  return [...both.map((own) => own.coulomb), ...both.map((own) => own.static ?? 0)];
}

/** How many states its loop has for the kernel. @param {Design} design @param {Preset} preset @returns {Size} */
export function sizeOf(design, preset) {
  if ((design.scenario.measured ?? SCENARIO.measured) !== MEASURED[0]) return FULL;
  const plain = AXES.every((axis) => {
    const { tau, curve } = rotorOf(design, preset, axis);
    return tau === 0 && curve === 'linear';
  });
  return plain && !frictionOf(design, preset).some(Boolean) ? PLAIN : LAGGED;
}

/** @param {readonly Complex[]} poles */
const parts = (poles) => poles.map(cleaned).flatMap(({ re, im }) => [re, im]);

/** @param {string} coupling @param {string} lead */
const familyOf = (coupling, lead) => FAMILIES.indexOf(`${coupling}/${coupling === 'triangular' ? lead : 'pitch'}`);

/**
 * Writes a design into the kernel's numbers.
 * @param {Float64Array} numbers @param {Design} design @param {Preset} preset
 */
export function fill(numbers, design, preset) {
  const put = (/** @type {number} */ at, /** @type {(number|boolean|null|undefined)[]} */ ...values) =>
    values.forEach((v, i) => (numbers[at + i] = Number(v)));
  const { scenario, loops, shift } = design;
  const limits = { ...preset.limits, ...design.limits };
  const rotors = AXES.map((axis) => rotorOf(design, preset, axis));
  const watched = { ...WATCHED, poles: WATCHING, ...design.observer };
  const how = { ...SCENARIO, ...scenario };
  const start = { ...INITIAL, ...scenario.initial };
  const { digital, disturbance } = scenario;
  const sampled = { ...DIGITAL, ...digital };
  const counts = digital && !digital.encoders ? preset.encoders : { ...ENCODERS, ...digital?.encoders };
  const pushed = { ...UNDISTURBED, ...disturbance };
  numbers.fill(0);
  put(AT.PARAMETERS, ...PARAMETERS.map((name) => design.parameters[name] ?? preset.parameters[name]));
  put(AT.ANGLE, design.theta0);
  put(AT.LIMITS, limits.V_p, limits.V_y, limits.theta ?? Infinity);
  put(AT.POLES, ...parts(design.poles));
  put(AT.ROTOR_POLES, ...design.rotor_poles);
  put(AT.ROTORS_PLACED, design.place_rotors);
  put(AT.FAMILY, familyOf(design.coupling, design.lead), Number.isFinite(shift), shift ?? 0);
  put(AT.PI_LOOPS, design.outer === 'pi', loops.pitch.kp, loops.pitch.ti, loops.yaw.kp, loops.yaw.ti);
  put(AT.CROSSWISE, design.pairing === 'cross', design.decoupler);
  put(AT.LAGS, ...rotors.map((own) => own.tau));
  put(AT.QUADRATIC, ...rotors.map((own) => own.curve === 'quadratic'));
  put(AT.DEAD_ZONES, ...rotors.map((own) => own.dead_zone));
  put(AT.MATCHED, ...rotors.map((own) => own.matched_at ?? 0));
  put(AT.FRICTION, ...frictionOf(design, preset));
  put(AT.MEASURED, MEASURED.indexOf(how.measured));
  put(AT.OBSERVER_POLES, ...parts(watched.poles));
  put(AT.OBSERVER_FAMILY, familyOf(watched.coupling, watched.lead));
  put(AT.ASKED, scenario.reference.theta ?? NaN, scenario.reference.psi ?? NaN);
  put(AT.BEGINNING, start.theta ?? NaN, start.psi ?? NaN, start.theta_dot, start.psi_dot);
  put(AT.DURATION, scenario.duration, how.saturation, WINDUPS.indexOf(how.anti_windup), how.tracking_time ?? 0);
  put(AT.STOPS, how.travel_stops, how.trim_feedforward, how.rtol);
  put(AT.DIGITAL, Boolean(digital), sampled.sample_time, sampled.delay);
  put(AT.COUNTS, counts.theta, counts.psi, sampled.rates === 'filtered');
  put(AT.DISTURBED, Boolean(disturbance), pushed.V_p, pushed.V_y, disturbance ? pushed.time : Infinity);
  put(AT.EACH_AXIS, true, MOST_STEPS);
  put(AT.AIMS, true);
}
