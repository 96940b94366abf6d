/**
 * How hard hands and weather take hold of a rig: as hard as its motors can answer, so that what rocks the large rig
 * does not throw a light one over. Pure.
 * @typedef {{force: number, spring: number, theta: number, psi: number, mass: number, step: number}} Strength
 *   force: a hand's largest, N; spring: of a hand's pull, N/m; theta, psi: torques of the large gust, N·m; mass: the
 *   lightest that is hung on, kg; step: to which torques are rounded, N·m
 */

/** A hand's largest force, N, and how it grows with the way it pulls, 1/m: 6 N/m at 4 N. */
const HAND = 4;
const PULL = 1.5;
/** A hand has so much of what the weaker motor can do about its axis; a large gust's torque about either axis is such a
 * share of it; what hangs at the nose at most is such a share of what the pitch motor can lift. */
const SHARE = 0.75;
const GUST = 0.6;
const LIFT = 0.12;
const GRAVITY = 9.81;
/** The masses that can be hung on, as multiples of the lightest: 50 g to 300 g on the large rig. */
export const MASSES = [1, 2, 4, 6];
const LIGHTEST = 0.05;

/** The largest of 1, 2, 5, 10, 20, … (also below 1) that is not above `v` > 0. @param {number} v */
export function roundBelow(v) {
  const tens = 10 ** Math.floor(Math.log10(v) + 1e-9);
  const lead = v / tens;
  return Number(((lead >= 5 - 1e-9 ? 5 : lead >= 2 - 1e-9 ? 2 : 1) * tens).toPrecision(1));
}

/**
 * Rounded to whole steps, without the dust of a sum's binary digits, and without −0.
 * @param {number} v @param {number} step
 */
export const inSteps = (v, step) => Number((Math.round(v / step) * step).toPrecision(12)) || 0;

/**
 * @param {{K_pp: number, K_yy: number}} gains N·m/V
 * @param {{V_p: number, V_y: number}} limits V
 * @param {number} arm of the pitch rotor, m
 * @returns {Strength}
 */
export function strengthOf({ K_pp, K_yy }, { V_p, V_y }, arm) {
  const [pitch, yaw] = [Math.abs(K_pp) * V_p, Math.abs(K_yy) * V_y].map((v) => Math.max(v, 1e-4));
  const weaker = Math.min(pitch, yaw);
  const force = Math.min(HAND, (SHARE * weaker) / arm);
  const gust = Math.min(GUST * weaker, GUST * HAND * arm);
  return {
    force,
    spring: PULL * force,
    theta: gust,
    psi: gust,
    mass: Math.min(LIGHTEST, roundBelow((LIFT * pitch) / (GRAVITY * arm) / MASSES[MASSES.length - 1])),
    step: Math.min(1e-3, roundBelow((force * arm) / 500)),
  };
}
