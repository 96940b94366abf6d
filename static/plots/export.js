/**
 * What a plot shows, as lines with names, and as comma-separated values. Pure.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Series} Series
 * @typedef {import('../model/traces.js').Signal} Signal
 * @typedef {'pitch'|'yaw'|'played'|'pin'|'recorded'|'series-0'|'series-1'} Kind
 * @typedef {{name: string, kind: Kind, linear?: boolean, index?: number, axis?: 'theta'|'psi', t: Series, values:
 *   Series}} Line
 */
import { t as word } from '../text/index.js';
import { isVoltage, letterOf, trace, tracesOf } from '../model/index.js';
import { ghostsOf } from './ghosts.js';

export const NAMES = { theta: 'theta', psi: 'psi', V_p: 'V_p', V_y: 'V_y' };
export const TITLES = {
  theta: 'Pitch angle θ',
  psi: 'Yaw angle ψ',
  V_p: 'Pitch motor voltage V_p',
  V_y: 'Yaw motor voltage V_y',
};
const STEPS = { theta: 'pitch step', psi: 'yaw step', both: 'both steps' };

/** @param {Signal} signal */
export const unitOf = (signal) => (isVoltage(signal) ? 'V' : 'deg');

/**
 * Every line of a plot in the order of the legend, which is that of drawing from the top down.
 * @param {State} state
 * @param {Signal} signal
 * @returns {Line[]}
 */
export function linesOf({ reply, motion, showLinear, pins, beside }, signal) {
  if (!reply) return [];
  const { t, plots } = tracesOf(reply, motion, showLinear);
  const [played, linearPitch, linearYaw, yaw, pitch, rotorYaw, rotorPitch] = plots[signal];
  const line = (
    /** @type {string} */ name,
    /** @type {Kind} */ kind,
    /** @type {Series|undefined} */ values,
    linear = false,
    own = t,
  ) => (values ? [{ name: word(name), kind, linear, t: own, values }] : []);
  const ghosts = ghostsOf(pins, signal).map(
    ({ pin, axis, t: own, values }) =>
      /** @type {Line} */ ({
        name: `${letterOf(pin.index)} ${pin.name}, ${word(STEPS[axis])}`,
        kind: 'pin',
        index: pin.index,
        axis,
        t: own,
        values,
      }),
  );
  return [
    ...line(STEPS.theta, 'pitch', pitch),
    ...line(STEPS.psi, 'yaw', yaw),
    ...line('pitch step, linear', 'pitch', linearPitch, true),
    ...line('yaw step, linear', 'yaw', linearYaw, true),
    ...line('rotor’s speed, pitch step', 'pitch', rotorPitch, true),
    ...line('rotor’s speed, yaw step', 'yaw', rotorYaw, true),
    ...ghosts,
    ...(beside?.plotted ? line('recorded', 'recorded', trace(beside, signal, false), false, beside.t) : []),
    ...(motion === 'both' ? line(STEPS.both, 'played', played) : []),
  ];
}

/** Single precision has no more digits than this. @param {number|undefined} v */
const digits = (v) => (v === undefined || !Number.isFinite(v) ? '' : String(Number(v.toPrecision(8))));

/** @param {string} text */
const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

/** @param {Series} a @param {Series} b */
const alike = (a, b) => a === b || (a.length === b.length && Math.abs(a[a.length - 1] - b[b.length - 1]) < 1e-6);

/**
 * RFC 4180 with units in the header; lines over another time get a column of that time before them.
 * @param {Signal} signal
 * @param {Line[]} lines
 */
export const csvOf = (signal, lines) =>
  tableOf(lines, 't [s]', (name) => `${NAMES[signal]}, ${name} [${unitOf(signal)}]`);

/**
 * The same for lines over anything.
 * @param {Line[]} lines
 * @param {string} over the header of what they are over
 * @param {(name: string) => string} header
 */
export function tableOf(lines, over, header) {
  /** @type {{name: string, values: Series}[]} */ const columns = [];
  /** @type {Series|null} */ let t = null;
  for (const line of lines) {
    if (!t || !alike(t, line.t)) columns.push({ name: over, values: line.t });
    t = line.t;
    columns.push({ name: header(line.name), values: line.values });
  }
  const rows = Math.max(0, ...columns.map((c) => c.values.length));
  const body = Array.from({ length: rows }, (_, i) => columns.map((c) => digits(c.values[i])).join(','));
  return `${[columns.map((c) => quoted(c.name)).join(','), ...body].join('\r\n')}\r\n`;
}
