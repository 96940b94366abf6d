/**
 * From what hands ask for to what a flight is told: rates of its set points, or voltages. Pure.
 * @typedef {import('./keys.js').Demand} Demand
 */
import { inSteps } from './strength.js';

/** How fast set points move at a stick's end, rad/s. */
export const RATES = { theta: 0.6, psi: 1.2 };
/** To what is rounded: rad/s, V. */
export const FINEST = { rate: 1e-4, volts: 1e-3 };
/** Pitch's set point goes no further than this to either side, also where nothing stops the rig, rad. */
const FURTHEST = Math.PI / 2;

/** @param {number} v */
const bounded = (v) => Math.min(Math.max(v, -1), 1);

/** What all ask for together. @param {Demand[]} demands @returns {Demand} */
export const together = (demands) => ({
  pitch: bounded(demands.reduce((sum, { pitch }) => sum + pitch, 0)),
  yaw: bounded(demands.reduce((sum, { yaw }) => sum + yaw, 0)),
});

/**
 * How fast the set points move, rad/s; pitch's rests at the end of its travel.
 * @param {Demand} demand @param {number} theta where pitch's set point is, rad @param {number} travel rad
 * @returns {[number, number]}
 */
export function ratesOf({ pitch, yaw }, theta, travel) {
  const end = Math.min(travel, FURTHEST);
  const stopped = (pitch > 0 && theta >= end) || (pitch < 0 && theta <= -end);
  return [stopped ? 0 : inSteps(pitch * RATES.theta, FINEST.rate), inSteps(yaw * RATES.psi, FINEST.rate)];
}

/**
 * The motors' voltages, V: `rest` in the middle, their limits at the ends.
 * @param {Demand} demand @param {readonly number[]} rest @param {readonly number[]} limits
 * @returns {[number, number]}
 */
export function voltsOf({ pitch, yaw }, rest, limits) {
  const of = (/** @type {number} */ out, /** @type {number} */ i) => {
    const middle = bounded(rest[i] / limits[i]) * limits[i];
    return inSteps(middle + Math.abs(out) * (Math.sign(out) * limits[i] - middle), FINEST.volts);
  };
  return [of(pitch, 0), of(yaw, 1)];
}

/**
 * The turn of a set point, or the one that is closest to where the rig is now: whoever has spun it by hand need not see
 * it spun back.
 * @param {number} reference rad @param {number} now rad
 */
export const nearestTurn = (reference, now) => reference + 2 * Math.PI * Math.round((now - reference) / (2 * Math.PI));
