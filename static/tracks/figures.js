/**
 * The figures that are told along a track, as far as a lab's step does not keep them back. Pure.
 * @typedef {import('../kernel/found.js').Measure} Measure
 * @typedef {import('../contract.js').FigureTrack} FigureTrack
 * @typedef {import('../model/figures.js').Figure} Figure
 * @typedef {object} Told
 * @property {string} head  what is said before the values of both axes
 * @property {string} label
 * @property {Measure} measure
 * @property {Figure} figure
 * @property {string} none  what it means that there is no value
 * @property {'metrics'|'margins'} hidden  what a lab's step may keep back
 */
import { t } from '../text/index.js';
import { AXIS, hides, LOOP, MOTOR, SENSITIVITY, textOf } from '../model/index.js';

const OF_STEP = /** @type {const} */ ({ hidden: 'metrics', none: '–' });
const OF_LOOP = /** @type {const} */ ({ hidden: 'margins', none: '–' });
const SETTLING = { ...OF_STEP, head: 'settling time', figure: AXIS.settling, none: 'not settled' };
const OVERSHOOT = { ...OF_STEP, head: 'overshoot', figure: AXIS.overshoot };
const PEAK = { ...OF_STEP, head: 'largest voltage', figure: MOTOR.peak };

/** @type {readonly Told[]} */
export const FIGURES = [
  { ...SETTLING, label: 'settling time, pitch', measure: { name: 'settling_time', axis: 'theta' } },
  { ...SETTLING, label: 'settling time, yaw', measure: { name: 'settling_time', axis: 'psi' } },
  { ...OVERSHOOT, label: 'overshoot, pitch', measure: { name: 'overshoot', axis: 'theta' } },
  { ...OVERSHOOT, label: 'overshoot, yaw', measure: { name: 'overshoot', axis: 'psi' } },
  { ...OF_LOOP, head: 'disk margin', label: 'disk margin', figure: SENSITIVITY.disk, measure: { name: 'disk_margin' } },
  { ...OF_LOOP, head: 'lag margin', label: 'lag margin', figure: LOOP.lag, measure: { name: 'lag_margin' } },
  { ...PEAK, label: 'largest voltage, pitch motor', measure: { name: 'V_peak', motor: 'V_p' } },
  { ...PEAK, label: 'largest voltage, yaw motor', measure: { name: 'V_peak', motor: 'V_y' } },
];

/** Those that may be told. @param {import('../types.js').State} state */
export const told = (state) => FIGURES.filter(({ hidden }) => !hides(state, hidden));

/** The one of these that a reply's figure is of. @param {FigureTrack} of */
export const toldBy = ({ measure, axis, motor }) =>
  FIGURES.find(
    ({ measure: own }) =>
      own.name === measure && (!own.axis || own.axis === axis) && (!own.motor || own.motor === motor),
  );

/** A value as it is written, in words where there is none. @param {FigureTrack} of @param {number} index */
export function valueText(of, index) {
  const own = toldBy(of);
  if (of.unlimited?.[index]) return t('unlimited');
  if (!own || !of.valid[index]) return t(own?.none ?? '–');
  return textOf(own.figure, of.values[index]);
}
