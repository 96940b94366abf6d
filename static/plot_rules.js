/**
 * What is drawn across a plot besides its lines: limits with what lies beyond them, the reference, the band of uncertain rigs. Shades lie under the lines; what
 * is written lies over them on the paper's colour, so that it can be read where lines pass.
 * @typedef {{value: number, label: string, danger: boolean}} Rule  in the plot's unit
 * @typedef {(name: string) => string} Color
 */
import { DEGREE, fixed } from './format.js';
import { pictureScale } from './picture_scale.js';
import { isVoltage } from './traces.js';
import { say } from './words.js';

/** @typedef {import('./traces.js').Signal} Signal @typedef {import('./types.js').Reply} Reply */

/** The step that is asked of this axis, degrees. @param {Reply|null} reply @param {Signal} signal @returns {number|undefined} */
export function referenceOf(reply, signal) {
  const reference = reply?.step.nonlinear.reference;
  return isVoltage(signal) || !reference ? undefined : reference[/** @type {'theta'|'psi'} */ (signal)] * DEGREE;
}

/** How far the motor goes, in volts, or pitch between its stops, in degrees. @param {Reply|null} reply @param {Signal} signal @returns {number|undefined} */
export function limitOf(reply, signal) {
  const limits = reply?.limits;
  if (signal === 'theta') return limits?.theta === undefined ? undefined : limits.theta * DEGREE;
  return signal === 'psi' ? undefined : limits?.[signal];
}

const minus = (/** @type {number} */ v) => `${v < 0 ? '\u2212' : ''}${Math.abs(v)}`;

/** The lines across a plot, with what they say. @param {Reply|null} reply @param {Signal} signal @returns {Rule[]} */
export function rulesOf(reply, signal) {
  const [limit, reference] = [limitOf(reply, signal), referenceOf(reply, signal)];
  const rules = limit === undefined ? [] : [limit, -limit].map((value) => ({ value, label: signal === 'theta' ? say`stop ${fixed(value, 1)}°` : say`limit ${minus(value)} V`, danger: true }));
  return reference ? [...rules, { value: reference, label: say`reference ${fixed(reference, 1)}°`, danger: false }] : rules;
}

/** @param {any} u @param {Rule} rule @returns {boolean} */
const seen = (u, { value }) => value <= u.scales.y.max && value >= u.scales.y.min;

/** @param {any} u @param {Rule} rule */
const heightOf = (u, { value }) => Math.round(u.valToPos(value, 'y', true));

/** Limits and what lies beyond them, before the lines are drawn. @param {any} u @param {Rule[]} rules @param {Color} color */
export function drawShades(u, rules, color) {
  const { ctx, bbox } = u;
  ctx.save();
  for (const rule of rules.filter((r) => r.danger && seen(u, r))) {
    const y = heightOf(u, rule);
    ctx.fillStyle = color('limit-fill');
    if (rule.value > 0) ctx.fillRect(bbox.left, bbox.top, bbox.width, y - bbox.top);
    else ctx.fillRect(bbox.left, y, bbox.width, bbox.top + bbox.height - y);
    drawRule(u, y, color('danger'), []);
  }
  ctx.restore();
}

/** The reference, and what the limits and it are called, after the lines are drawn. @param {any} u @param {Rule[]} rules @param {Color} color */
export function drawLabels(u, rules, color) {
  u.ctx.save();
  for (const rule of rules.filter((r) => seen(u, r))) {
    const y = heightOf(u, rule);
    if (!rule.danger) drawRule(u, y, color('ink'), [1, 5]);
    drawLabel(u, y, rule.label, rule.value > 0 ? 1 : -1, color(rule.danger ? 'danger' : 'ink'), color('panel'));
  }
  u.ctx.restore();
}

/** A horizontal line. @param {any} u @param {number} y @param {string} stroke @param {number[]} dash */
export function drawRule({ ctx, bbox }, y, stroke, dash) {
  const size = devicePixelRatio * pictureScale().line;
  Object.assign(ctx, { strokeStyle: stroke, lineWidth: 1.25 * size, lineCap: 'round' });
  ctx.setLineDash(dash.map((d) => d * size));
  ctx.beginPath();
  ctx.moveTo(bbox.left, y);
  ctx.lineTo(bbox.left + bbox.width, y);
  ctx.stroke();
}

/** What a line is called, at its right end, on paper. @param {any} u @param {number} y @param {string} label @param {1|-1} side 1: below it @param {string} ink @param {string} paper */
export function drawLabel({ ctx, bbox }, y, label, side, ink, paper) {
  const size = devicePixelRatio * pictureScale().type;
  const [x, foot] = [bbox.left + bbox.width - 4 * size, y + side * 3 * size];
  Object.assign(ctx, { font: `${10 * size}px system-ui, sans-serif`, textAlign: 'right', textBaseline: side > 0 ? 'top' : 'bottom' });
  const width = ctx.measureText(label).width;
  ctx.globalAlpha = 0.82;
  ctx.fillStyle = paper;
  ctx.fillRect(x - width - 2 * size, foot - (side > 0 ? size : 11 * size), width + 4 * size, 12 * size);
  ctx.globalAlpha = 1;
  ctx.fillStyle = ink;
  ctx.fillText(label, x, foot);
}

/** Between the 5th and the 95th percentile of the cloud's responses. @param {any} u @param {Signal} signal @param {import('./types.js').Cloud|null} cloud @param {Color} color */
export function drawBand(u, signal, cloud, color) {
  if (!cloud || isVoltage(signal)) return;
  const { t, envelopes } = cloud;
  const [low, , high] = envelopes[/** @type {'theta'|'psi'} */ (signal)];
  const { ctx, bbox } = u;
  const at = (/** @type {number[]} */ band, /** @type {number} */ i) => /** @type {const} */ ([u.valToPos(t[i], 'x', true), u.valToPos(band[i] * DEGREE, 'y', true)]);
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.beginPath();
  for (let i = 0; i < t.length; i++) ctx.lineTo(...at(high, i));
  for (let i = t.length - 1; i >= 0; i--) ctx.lineTo(...at(low, i));
  ctx.closePath();
  ctx.globalAlpha = 0.22;
  ctx.fillStyle = color(signal === 'theta' ? 'pitch' : 'yaw');
  ctx.fill();
  ctx.restore();
}
