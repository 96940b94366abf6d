/**
 * From a reply to what the plots draw: degrees, absolute volts, ranges that do not jitter. Pure.
 * @typedef {import('../types.js').Reply} Reply
 * @typedef {import('../types.js').Step} Step
 * @typedef {import('../types.js').Motion} Motion
 * @typedef {'theta'|'psi'|'V_p'|'V_y'} Signal
 */
import { DEGREE } from '../text/index.js';
import { niceStep } from './ticks.js';

/** @type {Signal[]} */
export const SIGNALS = ['theta', 'psi', 'V_p', 'V_y'];

/** The traces of each plot, in drawing order. The played motion lies under the rest as a halo. */
export const TRACES = ['played', 'theta-linear', 'psi-linear', 'psi', 'theta', 'psi-rotor', 'theta-rotor'];

/** @param {Signal} signal */
export const isVoltage = (signal) => signal === 'V_p' || signal === 'V_y';

/**
 * The speed of the motor's rotor, as the voltage that would hold it; of a rotor that takes time.
 * @param {Step|undefined} step
 * @param {Signal} signal
 */
const rotorTrace = (step, signal) =>
  signal === 'V_p' ? step?.rotors?.v_p : signal === 'V_y' ? step?.rotors?.v_y : undefined;

/** @param {Reply} reply @param {Motion} motion @returns {import('../types.js').StepPair|undefined} */
export const motionOf = (reply, motion) => (motion === 'both' ? reply.step : (reply.axis_steps?.[motion] ?? undefined));

/** @param {import('../types.js').Series} values @param {number} factor @param {number} offset */
function scaled(values, factor, offset) {
  const out = new Float32Array(values.length);
  for (let i = 0; i < out.length; i++) out[i] = values[i] * factor + offset;
  return out;
}

/**
 * One trace in the plots' units. Linear voltages are deviations from trim; with the trim added, both models share one
 * absolute scale.
 * @param {(Pick<Step, Signal> & Partial<Pick<Step, 'trim'>>)|undefined} step
 * @param {Signal} signal
 * @param {boolean} linear
 */
export function trace(step, signal, linear) {
  if (!step) return undefined;
  if (!isVoltage(signal)) return scaled(step[signal], DEGREE, 0);
  return linear ? scaled(step[signal], 1, step.trim?.[signal] ?? 0) : step[signal];
}

/**
 * @param {Reply} reply @param {Motion} motion @param {boolean} showLinear
 * @param {0|1|null} [alone] 0: the rig's pitch step and nothing else, 1: its yaw step
 * @returns {{t: import('../types.js').Series, plots: Record<Signal, (import('../types.js').Series|undefined)[]>}}
 */
export function tracesOf(reply, motion, showLinear, alone = null) {
  const all = reply.axis_steps ?? {};
  const steps = alone === null ? all : alone ? { psi: all.psi } : { theta: all.theta };
  const linear = showLinear && alone === null;
  const played = motionOf(reply, motion)?.nonlinear;
  const of = (/** @type {Signal} */ s) => [
    trace(played, s, false),
    linear ? trace(steps.theta?.linear, s, true) : undefined,
    linear ? trace(steps.psi?.linear, s, true) : undefined,
    trace(steps.psi?.nonlinear, s, false),
    trace(steps.theta?.nonlinear, s, false),
    rotorTrace(steps.psi?.nonlinear, s),
    rotorTrace(steps.theta?.nonlinear, s),
  ];
  const plots = /** @type {Record<Signal, ReturnType<typeof of>>} */ (
    Object.fromEntries(SIGNALS.map((s) => [s, of(s)]))
  );
  return { t: reply.step.nonlinear.t, plots };
}

/** @param {(import('../types.js').Series|undefined)[]} list @returns {[number, number]|undefined} */
export function extent(list) {
  let low = Infinity;
  let high = -Infinity;
  for (const values of list) {
    if (!values) continue;
    for (let i = 0; i < values.length; i++) {
      const v = values[i];
      if (v < low) low = v;
      if (v > high) high = v;
    }
  }
  return low <= high ? [low, high] : undefined;
}

/**
 * The vertical range of a plot. It grows at once and shrinks only when much too large, so that a drag does not make the
 * axes dance. A linear trace that runs away may not squeeze what the rig really does.
 * @param {{solid: [number, number]|undefined, dashed: [number, number]|undefined, include: number[], limit?: number,
 *   previous?: [number, number]}} what
 * @returns {[number, number]}
 */
export function rangeOf({ solid, dashed, include, limit, previous }) {
  let [low, high] = extent([include, solid ?? [], []]) ?? [0, 1];
  if (dashed) {
    const room = 0.6 * Math.max(high - low, 1e-6);
    low = Math.min(low, Math.max(dashed[0], low - room));
    high = Math.max(high, Math.min(dashed[1], high + room));
  }
  if (limit !== undefined) {
    if (high > 0.55 * limit) high = Math.max(high, limit);
    if (low < -0.55 * limit) low = Math.min(low, -limit);
  }
  const pad = 0.07 * Math.max(high - low, 1e-3);
  const step = niceStep(high - low + 2 * pad, 8);
  const wanted = /** @type {[number, number]} */ ([
    Math.floor((low - pad) / step) * step,
    Math.ceil((high + pad) / step) * step,
  ]);
  if (!previous) return wanted;
  const holds = previous[0] <= low - pad / 4 && previous[1] >= high + pad / 4;
  const tooLarge = wanted[1] - wanted[0] < 0.6 * (previous[1] - previous[0]);
  return holds && !tooLarge ? previous : wanted;
}

/**
 * Index of the sample at a time; samples are evenly spaced.
 * @param {import('../types.js').Series} t
 * @param {number} time
 */
export function indexAt(t, time) {
  const last = t.length - 1;
  if (last < 1) return 0;
  return Math.max(0, Math.min(last, Math.round(((time - t[0]) / (t[last] - t[0])) * last)));
}
