/** What the motors' limits cost: the rig beside the linear model, which knows none. Pure. */
import { seconds } from './format.js';

/** @typedef {'theta'|'psi'} Axis */

const STEPS = /** @type {[Axis, string][]} */ ([['theta', 'the pitch step'], ['psi', 'the yaw step']]);
const OTHER = ['travel_stop', 'reference_beyond_stop', 'starts_on_stop', 'diverges', 'integration_stopped'];
/** Relative difference from which two figures are told apart. */
const NOTABLE = 0.05;

/** @param {number|undefined} a @param {number|undefined} b @param {number} [least] below this size nothing differs */
export const differs = (a, b, least = 0) => a !== b && (a === undefined || b === undefined || Math.abs(a - b) > Math.max(least, NOTABLE * Math.max(Math.abs(a), Math.abs(b))));

/** @param {any} metrics */
const atLimit = (metrics) => metrics.V_p?.saturated > 0 || metrics.V_y?.saturated > 0;

/**
 * The settling times of both models, where a motor saturates and they differ. Empty where something else, too, tells rig and model apart.
 * @param {import('./types.js').Reply|null} reply @param {import('./types.js').Scenario} [scenario] @returns {string}
 */
export function limitsCost(reply, scenario) {
  const stopped = reply?.findings?.some((f) => OTHER.includes(f.code));
  if (stopped || scenario?.digital || scenario?.disturbance || scenario?.trim_feedforward === false) return '';
  const parts = STEPS.flatMap(([axis, name]) => {
    const pair = reply?.axis_steps?.[axis];
    if (!pair || !atLimit(pair.nonlinear.metrics)) return [];
    const own = pair.nonlinear.metrics[axis]?.settling_time;
    const ideal = pair.linear.metrics[axis]?.settling_time;
    if (ideal === undefined || !differs(own, ideal)) return [];
    const end = Number(pair.nonlinear.t[pair.nonlinear.t.length - 1]);
    return [`${name} settles ${own === undefined ? `not within ${seconds(end)}` : `in ${seconds(own)}`} (linear: ${seconds(ideal)})`];
  });
  return parts.length ? `At the motors’ limits ${parts.join(', ')}.` : '';
}
