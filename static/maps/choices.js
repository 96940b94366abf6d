/**
 * What maps can show, in words; and a choice as a link has it: `settling_time,psi,linear,yaw-pair`, of which all but
 * the first may be left out. Pure.
 * @typedef {import('./types.d.ts').Choice} Choice
 * @typedef {import('../kernel/found.js').Measure} Measure
 * @typedef {import('../types.js').Axis} Axis
 * @typedef {import('../model/figures.js').Figure} Figure
 * @typedef {object} Shown
 * @property {string} label
 * @property {boolean} stepped  whether it is of an axis' step
 * @property {boolean} model  whether it is of one of both models
 * @property {string} [hidden]  what a lab's step may keep back
 * @property {boolean} higher  whether more is better
 * @property {number[]} [levels]  of its colours, where they are always the same
 * @property {Figure|null} figure  how it is written; null: a share
 * @property {string} none  what it means that there is no value
 */
import { fixed, percent, say, t } from '../text/index.js';
import { AXIS, LOOP, MOTOR, SENSITIVITY, STEP, textOf } from '../model/index.js';

const OF_STEP = { stepped: true, model: true, higher: false, hidden: 'metrics' };
const OF_LOOP = { stepped: false, model: false, higher: true, hidden: 'margins' };

/** @type {Record<string, Shown>} */
export const CHOICES = {
  settling_time: { ...OF_STEP, label: 'settling time', figure: AXIS.settling, none: 'not settled' },
  overshoot: { ...OF_STEP, label: 'overshoot', figure: AXIS.overshoot, none: 'none' },
  undershoot: { ...OF_STEP, label: 'undershoot', figure: AXIS.undershoot, none: 'none' },
  V_peak: { ...OF_STEP, label: 'largest voltage', figure: MOTOR.peak, none: 'none' },
  saturated: { ...OF_STEP, label: 'saturated', figure: MOTOR.saturated, none: 'none' },
  coupling_peak: { ...OF_STEP, label: 'other axis moves', figure: STEP.coupling, none: 'none' },
  disk_margin: { ...OF_LOOP, label: 'disk margin', figure: SENSITIVITY.disk, none: 'none' },
  lag_margin: { ...OF_LOOP, label: 'lag margin', figure: LOOP.lag, none: 'none' },
  share_within_limits: {
    ...OF_LOOP,
    label: 'rigs that hold',
    figure: null,
    hidden: undefined,
    none: 'none',
    levels: [10, 20, 40, 60, 80, 90, 95, 100],
  },
};

const AXES = /** @type {const} */ (['theta', 'psi', 'both']);
const PAIRS = /** @type {Record<string, Choice['pair']>} */ ({ 'pitch-pair': 'pitch', 'yaw-pair': 'yaw' });

/** @param {string|null} text @returns {Choice|null} null where it is no map of this page */
export function choiceOf(text) {
  const [name, ...rest] = (text ?? '').split(',');
  if (!Object.hasOwn(CHOICES, name)) return null;
  /** @type {Choice} */ const choice = { name, axis: 'own', model: 'nonlinear', pair: 'hand' };
  for (const word of rest) {
    if (AXES.some((axis) => axis === word)) choice.axis = /** @type {Choice['axis']} */ (word);
    else if (word === 'linear') choice.model = word;
    else if (Object.hasOwn(PAIRS, word)) choice.pair = PAIRS[word];
    else return null;
  }
  return choice;
}

/** @param {Choice|null} choice @returns {string|null} */
export function linkOf(choice) {
  if (!choice) return null;
  const { name, axis, model, pair } = choice;
  const { stepped } = CHOICES[name];
  return [
    name,
    ...(stepped && axis !== 'own' ? [axis] : []),
    ...(stepped && model === 'linear' ? [model] : []),
    ...(pair !== 'hand' ? [`${pair}-pair`] : []),
  ].join();
}

/** @param {Choice} choice @param {Axis} own  that of what is moved @returns {Measure} */
export const measureOf = ({ name, axis, model }, own) =>
  CHOICES[name].stepped ? { name, axis: axis === 'own' ? own : axis, model } : { name };

/** @param {string} name @param {number} v  NaN: there is none @returns {string} */
export function valueText(name, v) {
  const { figure, none, higher } = CHOICES[name];
  if (v === (higher ? Infinity : -Infinity)) return t('unlimited');
  if (Number.isNaN(v)) return t(none);
  if (!figure) return percent(v);
  if (figure === MOTOR.saturated) return percent(v, v > 0 && v < 0.01 ? 1 : 0);
  return textOf(figure, v);
}

/**
 * From the least to the largest value of a field's stable places, as its unit is written.
 * @param {string} name @param {Pick<import('./types.d.ts').Field, 'values'|'stable'>} field
 */
export function rangeText(name, { values, stable }) {
  let [low, high] = [Infinity, -Infinity];
  for (const [i, v] of values.entries())
    if (stable[i] === 2 && Number.isFinite(v)) [low, high] = [Math.min(low, v), Math.max(high, v)];
  if (low > high) return '';
  const [from, to] = [valueText(name, low), valueText(name, high)];
  const unit = /\D*$/;
  if (from === to) return from;
  return unit.exec(from)?.[0] === unit.exec(to)?.[0] ? `${from.replace(unit, '')}–${to}` : `${from} – ${to}`;
}

/** A value in the unit of the legend. @param {string} name @param {number} v */
export const inUnit = (name, v) => {
  const { figure } = CHOICES[name];
  return v * (figure ? (figure.scale ?? 1) : 100);
};

/** Values of the legend that differ by less are written alike. @param {string} name */
export const finestOf = (name) => {
  const { figure } = CHOICES[name];
  return (figure?.least ?? 0) * (figure?.scale ?? 1);
};

/** @param {string} name */
export const unitOf = (name) => {
  const { figure } = CHOICES[name];
  if (!figure) return '%';
  return figure.notation === 'seconds' ? 's' : (figure.after ?? '').trim();
};

/** As few digits as tell neighbouring levels apart. @param {number} v @param {number[]} levels */
export function levelText(v, levels) {
  const step = Math.min(...levels.slice(1).map((own, i) => own - levels[i]), Math.abs(v) || 1);
  return fixed(v, Math.max(0, Math.min(4, -Math.floor(Math.log10(step) + 1e-9))));
}

/** @type {Record<string, string>} */
const STEPS = { theta: 'pitch step', psi: 'yaw step', both: 'the worse of both steps' };

/** What a map shows, as its legend says it. @param {Measure} measure @param {number} [spread] of the rigs */
export function titleOf({ name, axis, model }, spread) {
  const { label, figure } = CHOICES[name];
  const head = `${t(label).charAt(0).toUpperCase()}${t(label).slice(1)}`;
  if (!figure) return say`${head}: parameters ± ${fixed(100 * (spread ?? 0), 0)} %`;
  if (!axis) return head;
  return say`${head}, ${t(STEPS[axis])}, ${t(model === 'linear' ? 'linear' : 'nonlinear')} model`;
}
