/**
 * The experiment's options: what they are unless someone says otherwise, how they change, and what differs in words.
 * Pure.
 *
 * Besides its steps and its duration a scenario holds only what differs from this, in the contract's names and units:
 * what is absent is standard.
 * @typedef {import('../types.js').Scenario} Scenario
 * @typedef {import('../types.js').Digital} Digital
 * @typedef {import('../types.js').Disturbance} Disturbance
 * @typedef {import('../types.js').Encoders} Encoders
 */
import { DEGREE, fixed, significant } from '../text/index.js';
import { standardOf } from './rig.js';

/**
 * What the server does unless it is told otherwise.
 * @type {Required<Pick<Scenario, 'saturation'|'anti_windup'|'travel_stops'|'trim_feedforward'|'rtol'>>}
 */
const SERVERS = standardOf('scenario');
export const STANDARD = { ...SERVERS, rtol: 1e-5 }; // as exact as a screen

/** The rig's own controller. @type {Required<Omit<Digital, 'encoders'>>} */
export const DIGITAL = standardOf('scenario.digital');

/** Of a rig that says nothing of its own. @type {Encoders} */
export const ENCODERS = standardOf('scenario.digital.encoders');

/** What a disturbance is in what it does not say. @type {Required<Disturbance>} */
const UNDISTURBED = standardOf('scenario.disturbance');

/** What the server's cloud of uncertain rigs does not know. */
const NOT_IN_CLOUD = ['digital', 'disturbance'];

/**
 * Without what is absent or standard.
 * @template {object} T
 * @param {T} values
 * @param {Record<string, unknown>} standard
 * @returns {T}
 */
const differing = (values, standard) =>
  /** @type {T} */ (
    Object.fromEntries(
      Object.entries(values).filter(([name, v]) => v !== undefined && v !== null && v !== standard[name]),
    )
  );

/** @param {Scenario} scenario @returns {Scenario} the same steps, nothing else */
export const standard = ({ reference, duration }) => ({ reference, duration });

/** @param {Scenario} scenario */
export const isStandard = (scenario) =>
  Object.keys(scenario).every((name) => name === 'reference' || name === 'duration');

/**
 * A tracking time belongs to back-calculation and goes with it.
 * @param {Scenario} scenario
 * @param {Partial<Scenario>} part undefined: standard
 * @returns {Scenario}
 */
export function withOption(scenario, part) {
  const after = differing({ ...scenario, ...part }, STANDARD);
  return after.anti_windup === 'back-calculation' ? after : differing({ ...after, tracking_time: undefined }, {});
}

/**
 * @param {Scenario} scenario
 * @param {Partial<Digital>|null} part of the digital controller; null: continuous
 * @returns {Scenario}
 */
export const withDigital = (scenario, part) =>
  withOption(scenario, { digital: part ? differing({ ...scenario.digital, ...part }, DIGITAL) : undefined });

/** @param {Scenario} scenario @param {'theta'|'psi'} axis @param {number|undefined} rad @returns {Scenario} */
export function withNoise(scenario, axis, rad) {
  const noise = differing({ ...scenario.noise, [axis]: rad || undefined }, {});
  return withOption(scenario, { noise: Object.keys(noise).length ? noise : undefined });
}

/** @param {Scenario} scenario @param {Partial<Disturbance>|null} part null: undisturbed @returns {Scenario} */
export const withDisturbance = (scenario, part) =>
  withOption(scenario, {
    disturbance: part
      ? { V_p: 1, V_y: 0, time: Number((scenario.duration / 2).toPrecision(3)), ...scenario.disturbance, ...part }
      : undefined,
  });

/**
 * @param {Scenario} scenario
 * @param {'theta'|'psi'} axis
 * @param {number|undefined} angle rad; undefined: at rest
 * @returns {Scenario}
 */
export function withStart(scenario, axis, angle) {
  const initial = differing({ ...scenario.initial, [axis]: angle }, {});
  return withOption(scenario, { initial: Object.keys(initial).length ? initial : undefined });
}

/**
 * @param {Scenario} scenario
 * @param {'theta'|'psi'} axis
 * @param {number|undefined} counts undefined: the rig's
 * @param {Encoders} rig
 * @returns {Scenario}
 */
export function withEncoder(scenario, axis, counts, rig) {
  const encoders = { ...rig, ...scenario.digital?.encoders, [axis]: counts ?? rig[axis] };
  return withDigital(scenario, {
    encoders: encoders.theta === rig.theta && encoders.psi === rig.psi ? undefined : encoders,
  });
}

/** As the server takes it. @param {Scenario} scenario */
export const scenarioBody = (scenario) => ({ ...scenario, rtol: scenario.rtol ?? STANDARD.rtol });

/** What the cloud is asked for: all that it knows. @param {Scenario} scenario */
export const cloudScenario = (scenario) =>
  /** @type {Scenario} */ (
    Object.fromEntries(Object.entries(scenario).filter(([name]) => !NOT_IN_CLOUD.includes(name) && name !== 'rtol'))
  );

/** What the cloud leaves out of it, in words. @param {Scenario|undefined} scenario */
export function cloudCaveat(scenario) {
  return [scenario?.digital ? 'not digital' : '', scenario?.disturbance ? 'not disturbed' : '']
    .filter(Boolean)
    .join(', ');
}

/** Milliseconds without trailing zeros, seconds from one on. @param {number} s */
const time = (s) => (s < 1 ? `${significantShort(1000 * s)} ms` : `${significantShort(s)} s`);

/** @param {number} v */
const significantShort = (v) =>
  significant(Number(v.toPrecision(3)), 3)
    .replace(/(\.\d*?)0+$/, '$1')
    .replace(/\.$/, '');

/** @param {Scenario} scenario @returns {string[]} */
function digitalWords({ digital }) {
  if (!digital) return [];
  const { sample_time, delay, rates, noise, encoders } = { ...DIGITAL, ...digital };
  const details = [
    time(sample_time),
    delay && 'one sample late',
    rates === 'true' && 'true rates',
    encoders && (encoders.theta || encoders.psi ? 'other encoders' : 'exact angles'),
    noise > 0 && `noise ${significantShort(noise * DEGREE)}°`,
  ];
  return [`digital rig, ${details.filter(Boolean).join(', ')}`];
}

/** @param {Scenario} scenario @returns {string[]} */
function disturbanceWords({ disturbance }) {
  if (!disturbance) return [];
  const { V_p, V_y, time: at } = { ...UNDISTURBED, ...disturbance };
  const volts = [V_p && `${significantShort(V_p)} V (pitch)`, V_y && `${significantShort(V_y)} V (yaw)`]
    .filter(Boolean)
    .join(', ');
  return [`disturbance ${volts || '0 V'} at ${significantShort(at)} s`];
}

/**
 * What differs from the standard experiment, in the order in which it matters.
 * @param {Scenario} scenario
 * @returns {string[]}
 */
export function experimentWords(scenario) {
  const { saturation, anti_windup, travel_stops, trim_feedforward, measured } = { ...STANDARD, ...scenario };
  const { initial = {}, tracking_time, rtol } = scenario;
  const from = [
    initial.theta !== undefined && `θ ${fixed(initial.theta * DEGREE, 1)}°`,
    initial.psi !== undefined && `ψ ${fixed(initial.psi * DEGREE, 1)}°`,
  ].filter(Boolean);
  const windup =
    anti_windup === 'none'
      ? 'no anti-windup'
      : `back-calculation${tracking_time === undefined ? '' : `, ${time(tracking_time)}`}`;
  return [
    ...digitalWords(scenario),
    measured === 'filtered' && 'filtered rates',
    measured === 'observer' && 'an observer',
    scenario.noise && 'noisy angles',
    ...disturbanceWords(scenario),
    !saturation && 'no voltage limits',
    saturation && anti_windup !== 'clamping' && windup,
    !travel_stops && 'no stops',
    !trim_feedforward && 'no trim',
    from.length > 0 && `starts at ${from.join(', ')}`,
    rtol !== undefined && `tolerance ${rtol.toExponential(0).replace('-', '−')}`,
  ].filter((part) => typeof part === 'string');
}
