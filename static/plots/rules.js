/**
 * What is drawn across a plot besides its lines: limits with what lies beyond them, the reference, the band of
 * uncertain rigs. Shades lie under the lines; what is written lies over them on the paper's colour, so that it can be
 * read where lines pass.
 * @typedef {{value: number, label: string, danger: boolean}} Rule  in the plot's unit
 * @typedef {(name: string) => string} Color
 * @typedef {{left: number, right: number, inner: number, outer: number}} Region s, and in the plot's unit: the border,
 *   and how far it is drawn
 */
import { DEGREE, fixed, say, typographic } from '../text/index.js';
import { isVoltage } from '../model/index.js';
import { pictureScale } from '../ui/index.js';

/**
 * @typedef {import('../model/traces.js').Signal} Signal
 * @typedef {import('../types.js').Reply} Reply
 * @typedef {import('../ui/picture_scale.js').Chart} Chart
 */

/**
 * The step that is asked of this axis, degrees.
 * @param {Reply|null} reply
 * @param {Signal} signal
 * @returns {number|undefined}
 */
export function referenceOf(reply, signal) {
  const reference = reply?.step.nonlinear.reference;
  return isVoltage(signal) || !reference ? undefined : reference[/** @type {'theta'|'psi'} */ (signal)] * DEGREE;
}

/**
 * How far the motor goes, in volts, or pitch between its stops, in degrees.
 * @param {Reply|null} reply
 * @param {Signal} signal
 * @returns {number|undefined}
 */
export function limitOf(reply, signal) {
  const limits = reply?.limits;
  if (signal === 'theta') return limits?.theta === undefined ? undefined : limits.theta * DEGREE;
  return signal === 'psi' ? undefined : limits?.[signal];
}

/** The lines across a plot, with what they say. @param {Reply|null} reply @param {Signal} signal @returns {Rule[]} */
export function rulesOf(reply, signal) {
  const [limit, reference] = [limitOf(reply, signal), referenceOf(reply, signal)];
  const rules =
    limit === undefined
      ? []
      : [limit, -limit].map((value) => ({
          value,
          label: signal === 'theta' ? say`stop ${fixed(value, 1)}°` : say`limit ${typographic(String(value))} V`,
          danger: true,
        }));
  return reference
    ? [...rules, { value: reference, label: say`reference ${fixed(reference, 1)}°`, danger: false }]
    : rules;
}

const SETTLED = 0.02; // of the step
// of the step: how thick what is forbidden is drawn, as the other axis' step has its line in the same plot
const WALL = 0.25;

/**
 * Where this axis' own response may not be if it is to meet what is asked of the poles: past the overshoot, and off the
 * reference once it should have settled.
 * @param {Reply|null} reply
 * @param {Signal} signal
 * @param {import('../types.js').Requirements} asked
 * @returns {Region[]}
 */
export function regionsOf(reply, signal, { settling, overshoot }) {
  if (!reply || isVoltage(signal)) return [];
  const axis = /** @type {'theta'|'psi'} */ (signal);
  const step = reply.axis_steps?.[axis]?.nonlinear;
  if (!step) return [];
  const [from, to, end] = [step[axis][0] * DEGREE, step.reference[axis] * DEGREE, step.t[step.t.length - 1]];
  const size = to - from;
  if (Math.abs(size) < 1e-9) return [];
  const wall = (
    /** @type {number} */ left,
    /** @type {number} */ right,
    /** @type {number} */ inner,
    /** @type {number} */ away,
  ) => (right > left ? [{ left, right, inner: to + inner * size, outer: to + (inner + away * WALL) * size }] : []);
  const most = overshoot === null ? undefined : overshoot / 100;
  const late = settling ?? end;
  return [
    ...(most === undefined ? [] : wall(0, Math.min(late, end), most, 1)),
    ...(settling === null
      ? []
      : [...wall(late, end, Math.min(SETTLED, most ?? SETTLED), 1), ...wall(late, end, -SETTLED, -1)]),
  ];
}

/**
 * Hatched as in the s-plane, over the grid and under the lines.
 * @param {Chart} u
 * @param {Region[]} regions
 * @param {Color} color
 */
export function drawRegions(u, regions, color) {
  const { ctx, bbox } = u;
  const size = devicePixelRatio * pictureScale().line;
  const x = (/** @type {number} */ v) =>
    Math.max(bbox.left, Math.min(bbox.left + bbox.width, u.valToPos(v, 'x', true)));
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  for (const region of regions) {
    const [left, right, inner, outer] = [
      x(region.left),
      x(region.right),
      u.valToPos(region.inner, 'y', true),
      u.valToPos(region.outer, 'y', true),
    ];
    hatch(ctx, { left, right, inner, outer }, color('warn'), size);
  }
  ctx.restore();
}

/**
 * @param {CanvasRenderingContext2D} ctx
 * @param {Region} box pixels
 * @param {string} color
 * @param {number} size of a pixel
 */
export function hatch(ctx, { left, right, inner, outer }, color, size) {
  const [top, height] = [Math.min(inner, outer), Math.abs(outer - inner)];
  if (right - left < 1) return;
  ctx.save();
  ctx.setLineDash([]);
  Object.assign(ctx, { strokeStyle: color, lineWidth: 1.5 * size });
  ctx.beginPath();
  ctx.moveTo(left, inner);
  ctx.lineTo(right, inner);
  ctx.stroke();
  ctx.beginPath();
  ctx.rect(left, top, right - left, height);
  ctx.clip();
  ctx.globalAlpha = 0.32;
  ctx.beginPath();
  for (let x = left - height; x < right; x += 7 * size) {
    ctx.moveTo(x, top + height);
    ctx.lineTo(x + height, top);
  }
  ctx.stroke();
  ctx.restore();
}

/** Those within the plot's range. @param {Chart} u @param {Rule[]} rules */
export function rulesSeen(u, rules) {
  const { y } = /** @type {import('../ui/picture_scale.js').Ranges} */ (u.scales);
  return rules.filter(({ value }) => value <= y.max && value >= y.min);
}

/**
 * Where lines' names stand, so that none lies over another: towards zero from its own line, else beyond, else farther
 * away. Pure.
 * @param {readonly {value: number, y: number}[]} lines y: downwards
 * @param {{gap: number, high: number, top: number, bottom: number}} room gap: from a line to the middle of its name
 * @returns {number[]} of their middles
 */
export function namePlaces(lines, { gap, high, top, bottom }) {
  /** @type {number[]} */ const taken = [];
  for (const { value, y } of lines) {
    const side = value > 0 ? 1 : -1;
    const all = [0, 1, 2, 3].flatMap((k) => [y + side * (gap + k * high), y - side * (gap + k * high)]);
    const free = all.filter((at) => at - high / 2 >= top && at + high / 2 <= bottom);
    taken.push(free.find((at) => taken.every((own) => Math.abs(own - at) >= high)) ?? all[0]);
  }
  return taken;
}

/** @param {Chart} u @param {Rule} rule */
const heightOf = (u, { value }) => Math.round(u.valToPos(value, 'y', true));

/**
 * Limits and what lies beyond them, over the grid and under the lines.
 * @param {Chart} u
 * @param {Rule[]} rules
 * @param {Color} color
 */
export function drawShades(u, rules, color) {
  const { ctx, bbox } = u;
  ctx.save();
  for (const rule of rulesSeen(u, rules).filter((r) => r.danger)) {
    const y = heightOf(u, rule);
    ctx.fillStyle = color('limit-fill');
    if (rule.value > 0) ctx.fillRect(bbox.left, bbox.top, bbox.width, y - bbox.top);
    else ctx.fillRect(bbox.left, y, bbox.width, bbox.top + bbox.height - y);
    drawRule(u, y, color('danger'), []);
  }
  ctx.restore();
}

/** The reference, after the lines are drawn. @param {Chart} u @param {Rule[]} rules @param {Color} color */
export function drawReference(u, rules, color) {
  u.ctx.save();
  for (const rule of rulesSeen(u, rules)) if (!rule.danger) drawRule(u, heightOf(u, rule), color('ink'), [1, 5]);
  u.ctx.restore();
}

/**
 * All with what they are called, after the lines are drawn.
 * @param {Chart} u
 * @param {Rule[]} rules
 * @param {Color} color
 * @param {1|-1} side of the line that its name stands on, 1: below it
 */
export function drawNamedRules(u, rules, color, side) {
  u.ctx.save();
  for (const rule of rulesSeen(u, rules)) {
    const [y, stroke] = [heightOf(u, rule), color(rule.danger ? 'danger' : 'ink')];
    drawRule(u, y, stroke, rule.danger ? [] : [1, 5]);
    drawLabel(u, y, rule.label, side, stroke, color('panel'));
  }
  u.ctx.restore();
}

/** A horizontal line. @param {Chart} u @param {number} y @param {string} stroke @param {number[]} dash */
function drawRule({ ctx, bbox }, y, stroke, dash) {
  const size = devicePixelRatio * pictureScale().line;
  Object.assign(ctx, { strokeStyle: stroke, lineWidth: 1.25 * size, lineCap: 'round' });
  ctx.setLineDash(dash.map((d) => d * size));
  ctx.beginPath();
  ctx.moveTo(bbox.left, y);
  ctx.lineTo(bbox.left + bbox.width, y);
  ctx.stroke();
}

/**
 * What a line is called, at its right end, on paper.
 * @param {Chart} u
 * @param {number} y
 * @param {string} label
 * @param {1|-1} side 1: below it
 * @param {string} ink
 * @param {string} paper
 */
function drawLabel({ ctx, bbox }, y, label, side, ink, paper) {
  const size = devicePixelRatio * pictureScale().type;
  const [x, foot] = [bbox.left + bbox.width - 4 * size, y + side * 3 * size];
  Object.assign(ctx, {
    font: `${10 * size}px system-ui, sans-serif`,
    textAlign: 'right',
    textBaseline: side > 0 ? 'top' : 'bottom',
  });
  const width = ctx.measureText(label).width;
  ctx.globalAlpha = 0.82;
  ctx.fillStyle = paper;
  ctx.fillRect(x - width - 2 * size, foot - (side > 0 ? size : 11 * size), width + 4 * size, 12 * size);
  ctx.globalAlpha = 1;
  ctx.fillStyle = ink;
  ctx.fillText(label, x, foot);
}

/**
 * Between the 5th and the 95th percentile of the cloud's responses.
 * @param {Chart} u
 * @param {Signal} signal
 * @param {import('../types.js').Cloud|null} cloud
 * @param {Color} color
 */
export function drawBand(u, signal, cloud, color) {
  if (!cloud || isVoltage(signal)) return;
  const { t, envelopes } = cloud;
  if (!t.length) return;
  const [low, , high] = envelopes[/** @type {'theta'|'psi'} */ (signal)];
  const { ctx, bbox } = u;
  const at = (/** @type {ArrayLike<number>} */ band, /** @type {number} */ i) =>
    /** @type {const} */ ([u.valToPos(t[i], 'x', true), u.valToPos(band[i] * DEGREE, 'y', true)]);
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
