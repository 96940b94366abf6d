/**
 * Every figure of merit under one name, as requests and requirements have it (heli2dof_core/measured.py): what it
 * belongs to, and how it is written. Pure.
 * @typedef {import('../model/figures.js').Figure} Figure
 * @typedef {'axis'|'step'|'motor'|'margins'|'sensitivity'|'loop'|'design'} Of
 * @typedef {{of: Of, own: string, figure: Figure, unlimited: boolean}} Measured  own: its name in replies; unlimited:
 *   no value says that it has no limit
 */
import { AXIS, DESIGN, LOOP, MARGINS, MOTOR, SENSITIVITY, STEP } from '../model/index.js';

/** @type {Record<Of, Record<string, Figure>>} */
const TABLES = {
  axis: AXIS,
  step: STEP,
  motor: MOTOR,
  margins: MARGINS,
  sensitivity: SENSITIVITY,
  loop: LOOP,
  design: DESIGN,
};
/** Where the registry's own names are unclear by themselves. @type {Record<string, string>} */
const NAMES = {
  'motor.peak': 'V_peak',
  'sensitivity.peak': 'sensitivity_peak',
  'sensitivity.peak_frequency': 'sensitivity_peak_frequency',
  'sensitivity.gain_low': 'disk_gain_low',
  'sensitivity.gain_high': 'disk_gain_high',
  'sensitivity.phase': 'disk_phase',
  'design.relative_gain': 'lambda_11',
};
const UNLIMITED = [...Object.values(MARGINS), LOOP.lag, SENSITIVITY.gain_high];

/** @type {ReadonlyMap<string, Measured>} */
export const MEASURED_FIGURES = new Map(
  Object.entries(TABLES).flatMap(([of, figures]) =>
    Object.values(figures)
      .filter((figure) => figure !== AXIS.settled)
      .map((figure) => [
        NAMES[`${of}.${figure.name}`] ?? figure.name,
        { of: /** @type {Of} */ (of), own: figure.name, figure, unlimited: UNLIMITED.includes(figure) },
      ]),
  ),
);

/** Shares of uncertain rigs, beside these. */
export const SHARES = ['share_stable', 'share_within_limits'];
