/**
 * What can be pointed at on a step's own curve: rise, peak, settling; and how far the other axis' step moves this one.
 * The figures are the server's, as in the table of figures; here is only where on the curve they are. Pure.
 * @typedef {import('../types.js').Reply} Reply
 * @typedef {import('../types.js').Step} Step
 * @typedef {import('../types.js').Series} Series
 * @typedef {import('../model/traces.js').Signal} Signal
 * @typedef {'rise'|'peak'|'settling'|'coupling'} Kind
 * @typedef {{kind: Kind, axis: 'theta'|'psi', t: number, value: number, brief: string, text: string}} Mark axis: whose
 *   step; s, degrees
 */
import { DEGREE, degrees, fixed, say, seconds } from '../text/index.js';
import { isVoltage } from '../model/index.js';

const HIGH = 0.9; // of the step, where the rise ends
const SEEN = 0.05; // %: less overshoot than this reads as none
const MOVES = 0.05; // °: less than this is not worth a mark

/** Between the samples. @param {Series} t @param {Series} values @param {number} time */
export function valueAt(t, values, time) {
  let i = 1;
  while (i < t.length - 1 && t[i] < time) i += 1;
  const share = t[i] === t[i - 1] ? 1 : Math.max(0, Math.min(1, (time - t[i - 1]) / (t[i] - t[i - 1])));
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

/**
 * When a share of the way is first reached.
 * @param {Series} t
 * @param {Series} values
 * @param {number} from
 * @param {number} to
 * @param {number} share
 * @returns {number|undefined}
 */
export function reaches(t, values, from, to, share) {
  const level = from + share * (to - from);
  const up = Math.sign(to - from);
  for (let i = 1; i < t.length; i++) {
    if (up * (values[i] - level) < 0) continue;
    const rest = values[i] - values[i - 1];
    return rest ? t[i - 1] + ((level - values[i - 1]) / rest) * (t[i] - t[i - 1]) : t[i];
  }
  return undefined;
}

/** @param {Step} step of this axis alone @param {'theta'|'psi'} axis @returns {Mark[]} */
function ownMarks(step, axis) {
  const { t } = step;
  const values = step[axis];
  const m = step.metrics[axis];
  if (!m) return [];
  const [from, to] = [values[0], step.reference[axis]];
  const end = m.rise_time === undefined ? undefined : reaches(t, values, from, to, HIGH);
  const at = (/** @type {number} */ time) => valueAt(t, values, time) * DEGREE;
  /** @type {Mark[]} */ const marks = [];
  if (end !== undefined && m.rise_time !== undefined) {
    marks.push({
      kind: 'rise',
      axis,
      t: end,
      value: at(end),
      brief: say`rise ${seconds(m.rise_time)}`,
      text: say`Rise time ${seconds(m.rise_time)}: 10 % at ${seconds(end - m.rise_time)}, 90 % at ${seconds(end)}`,
    });
  }
  if (m.overshoot !== undefined && m.overshoot >= SEEN && m.peak !== undefined && m.peak_time !== undefined) {
    marks.push({
      kind: 'peak',
      axis,
      t: m.peak_time,
      value: m.peak * DEGREE,
      brief: say`peak ${degrees(m.peak, 2)}`,
      text: say`Peak ${degrees(m.peak, 2)} at ${seconds(m.peak_time)}: overshoot ${fixed(m.overshoot, 1)} %`,
    });
  }
  if (m.settling_time !== undefined) {
    marks.push({
      kind: 'settling',
      axis,
      t: m.settling_time,
      value: at(m.settling_time),
      brief: say`settles ${seconds(m.settling_time)}`,
      text: say`Settling time ${seconds(m.settling_time)}: from here on within 2 % of the step`,
    });
  }
  return marks;
}

/**
 * How far one axis' step moves the other.
 * @param {Step} step
 * @param {'theta'|'psi'} stepped
 * @param {'theta'|'psi'} other
 * @returns {Mark[]}
 */
function couplingMark(step, stepped, other) {
  const values = step[other];
  let k = 0;
  for (let i = 1; i < values.length; i++) if (Math.abs(values[i] - values[0]) > Math.abs(values[k] - values[0])) k = i;
  const moved = (values[k] - values[0]) * DEGREE;
  if (!(Math.abs(moved) >= MOVES)) return [];
  // the server's, for the samples may miss it
  const figure = `${fixed(Math.abs((step.metrics.coupling_peak ?? 0) * DEGREE || moved), 2)}°`;
  const text =
    stepped === 'theta'
      ? say`The pitch step moves yaw by ${figure} at ${seconds(step.t[k])}`
      : say`The yaw step moves pitch by ${figure} at ${seconds(step.t[k])}`;
  return [
    { kind: 'coupling', axis: stepped, t: step.t[k], value: values[k] * DEGREE, brief: say`moves ${figure}`, text },
  ];
}

/**
 * The marks of a plot in the order of time; none where the loop is unstable, as then what is largest says only how long
 * one has looked.
 * @param {Reply|null} reply
 * @param {Signal} signal
 * @param {boolean} [alone] without what the other axis' step does here
 * @returns {Mark[]}
 */
export function marksOf(reply, signal, alone = false) {
  if (!reply?.stable || isVoltage(signal)) return [];
  const own = /** @type {'theta'|'psi'} */ (signal);
  const other = own === 'theta' ? 'psi' : 'theta';
  const [step, cross] = [reply.axis_steps?.[own]?.nonlinear, reply.axis_steps?.[other]?.nonlinear];
  return [...(step ? ownMarks(step, own) : []), ...(cross && !alone ? couplingMark(cross, other, own) : [])].sort(
    (a, b) => a.t - b.t,
  );
}
