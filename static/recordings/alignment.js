/**
 * A recording beside the design: which stretch of it, from when on, and by how much its angles are shifted. Pure.
 * @typedef {import('../contract.js').OverlayReply} OverlayReply
 * @typedef {import('../types.js').Beside} Beside
 * @typedef {{t: number, axis: 'theta'|'psi', size: number}} RecordedStep s and rad
 */
import { DEGREE, fixed, say } from '../text/index.js';

const LEAST_STEP = 0.5 / DEGREE;
const NAMES = { theta: 'pitch', psi: 'yaw' };

/**
 * The steps of the recorded references, in their order.
 * @param {Pick<OverlayReply, 't'|'references'>} overlay
 * @returns {RecordedStep[]}
 */
export function stepsOf({ t, references }) {
  if (!references) return [];
  /** @type {RecordedStep[]} */ const found = [];
  for (let i = 1; i < t.length; i++)
    for (const axis of /** @type {const} */ (['theta', 'psi'])) {
      const size = (references[axis][i] ?? 0) - (references[axis][i - 1] ?? 0);
      if (Math.abs(size) > LEAST_STEP) found.push({ t: t[i], axis, size });
    }
  return found;
}

/** @param {RecordedStep} step */
export const stepWords = ({ t, axis, size }) =>
  say`${fixed(t, 2)} s: ${NAMES[axis]} ${size < 0 ? '' : '+'}${fixed(size * DEGREE, 1)}°`;

/**
 * What is shown of it: `duration` s from `from` s on. Shifted, its references (or, where there are none, its angles)
 * are there what the design's are before its step.
 * @param {OverlayReply} overlay
 * @param {{from: number, duration: number, shifted: boolean, theta0: number}} how
 * @returns {Omit<Beside, 'ghost'|'plotted'>|null} null where nothing is left
 */
export function alignedTrace({ t, measured, references, voltages }, { from, duration, shifted, theta0 }) {
  const first = t.findIndex((v) => v >= from - 1e-9);
  const after = t.findIndex((v) => v > from + duration + 1e-9);
  if (first < 0) return null;
  const rows = Array.from({ length: (after < 0 ? t.length : after) - first }, (_, k) => first + k);
  if (rows.length < 2) return null;
  const before = Math.max(0, first - 1);
  const at = (/** @type {'theta'|'psi'} */ axis) => references?.[axis][before] ?? measured[axis][first] ?? 0;
  const shift = shifted ? { theta: theta0 - at('theta'), psi: -at('psi') } : { theta: 0, psi: 0 };
  const moved = (/** @type {'theta'|'psi'} */ axis) =>
    Float64Array.from(rows, (i) => (measured[axis][i] ?? NaN) + shift[axis]);
  const held = (/** @type {'V_p'|'V_y'} */ motor) => Float64Array.from(rows, (i) => voltages[motor][i]);
  return {
    t: Float64Array.from(rows, (i) => t[i] - t[first]),
    theta: moved('theta'),
    psi: moved('psi'),
    V_p: held('V_p'),
    V_y: held('V_y'),
    from: t[first],
    shift,
  };
}

/** How it is aligned. @param {Pick<Beside, 'from'|'shift'>} beside */
export function alignmentWords({ from, shift }) {
  const by = (/** @type {number} */ v) => `${v < 0 ? '' : '+'}${fixed(v * DEGREE, 2)}°`;
  const start = say`The recording’s ${fixed(from, 2)} s are the plots’ 0 s.`;
  if (shift.theta === 0 && shift.psi === 0) return say`${start} Its angles are as measured.`;
  const moved = say`Pitch is shifted by ${by(shift.theta)}, yaw by ${by(shift.psi)}`;
  return say`${start} ${moved}, so that it begins where the design does.`;
}
