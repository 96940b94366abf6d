/** A plot as a picture for a report: title, axes with units, legend; on white, whatever the page's own colours. */
import { drawGhosts } from './plot_ghosts.js';
import { TITLES, unitOf } from './plot_export.js';
import { niceStep, ticks } from './splane_math.js';
import { isVoltage } from './traces.js';

/** @typedef {import('./plot_export.js').Line} Line @typedef {import('./traces.js').Signal} Signal */
/** style.css's and sharing.css's own for a light page. @type {Record<string, string>} */
const LIGHT = { panel: '#ffffff', ink: '#18222a', muted: '#4a5862', grid: '#e3e9ec', pitch: '#b94a2c', yaw: '#24689b', halo: '#dcdedf', danger: '#b3261e', 'limit-fill': '#fbeeed',
  'pin-0': '#7a3fb0', 'pin-1': '#11706a', 'pin-2': '#8a5a00', 'pin-3': '#ab2468', 'pin-4': '#4a6a1c', 'pin-5': '#4d5a6b' };
const SCALE = 2; // dots per pixel
const [WIDTH, HEIGHT] = [800, 450];
const LEFT = 64;
const [TOP, RIGHT, BOTTOM] = [46, 20, 50];
const FONT = 'system-ui, sans-serif';

/** @param {Line} line @returns {{color: string, width: number, dash: number[]}} as on the page */
function styleOf({ kind, linear, index = 0, axis }) {
  if (kind === 'played') return { color: LIGHT.halo, width: 7, dash: [] };
  if (kind === 'pin') return { color: LIGHT[`pin-${index % 6}`], width: axis === 'theta' ? 1.6 : 1.1, dash: [] };
  const color = LIGHT[kind];
  if (linear) return { color, width: 1.25, dash: kind === 'pitch' ? [7, 4] : [2, 3] };
  return { color, width: kind === 'pitch' ? 2.4 : 1.5, dash: [] };
}

const minus = (/** @type {number} */ v) => String(Number(v.toPrecision(6))).replace('-', '\u2212');

/**
 * @param {Signal} signal @param {Line[]} lines @param {any[]} pins their pins, for the letters
 * @param {{x: [number, number], y: [number, number], subtitle: string, rules: {value: number, label: string, danger: boolean}[]}} how  ranges in s and in the plot's unit
 * @returns {HTMLCanvasElement}
 */
export function drawPlot(signal, lines, pins, { x, y, subtitle, rules }) {
  const legend = Math.ceil(lines.length / 3);
  const canvas = document.createElement('canvas');
  const height = HEIGHT + 20 * legend;
  Object.assign(canvas, { width: WIDTH * SCALE, height: height * SCALE });
  const ctx = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  ctx.scale(SCALE, SCALE);
  ctx.fillStyle = LIGHT.panel;
  ctx.fillRect(0, 0, WIDTH, height);
  const box = { left: LEFT, top: TOP, right: WIDTH - RIGHT, bottom: HEIGHT - BOTTOM };
  const px = (/** @type {number} */ t) => box.left + ((t - x[0]) / (x[1] - x[0])) * (box.right - box.left);
  const py = (/** @type {number} */ v) => box.bottom - ((v - y[0]) / (y[1] - y[0])) * (box.bottom - box.top);
  const text = (/** @type {string} */ words, /** @type {number} */ left, /** @type {number} */ top, /** @type {CanvasTextAlign} */ align, /** @type {string} */ font, /** @type {string} */ color) => {
    Object.assign(ctx, { textAlign: align, textBaseline: 'middle', font: `${font} ${FONT}`, fillStyle: color });
    ctx.fillText(words, left, top);
  };
  text(TITLES[signal], box.left, 16, 'left', '600 15px', LIGHT.ink);
  text(subtitle, box.left, 34, 'left', '11px', LIGHT.muted);
  axes(ctx, box, { x, y, px, py, text });
  text('Time in s', (box.left + box.right) / 2, HEIGHT - 14, 'center', '12px', LIGHT.ink);
  ctx.save();
  ctx.translate(16, (box.top + box.bottom) / 2);
  ctx.rotate(-Math.PI / 2);
  text(`${TITLES[signal].split(' ').pop()} in ${isVoltage(signal) ? 'V' : 'degrees'}`, 0, 0, 'center', '12px', LIGHT.ink);
  ctx.restore();

  ctx.save();
  ctx.beginPath();
  ctx.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
  ctx.clip();
  for (const line of lines.filter((l) => l.kind === 'played')) stroke(ctx, line, px, py);
  const ghosts = lines.filter((l) => l.kind === 'pin').map((l) => ({ pin: pins.find((p) => p.index === l.index), axis: /** @type {'theta'|'psi'} */ (l.axis), t: l.t, values: l.values })).filter((g) => g.pin);
  ctx.save();
  ctx.translate(box.left, 0);
  const badges = drawGhosts(ctx, ghosts, (t) => px(t) - box.left, py, { width: box.right - box.left, type: 1, line: 1, color: (name) => LIGHT[name] });
  ctx.restore();
  for (const line of lines.filter((l) => l.kind !== 'pin' && l.kind !== 'played').reverse()) stroke(ctx, line, px, py);
  ctx.translate(box.left, 0);
  badges();
  ctx.restore();
  for (const { value, label, danger } of rules) {
    if (value < y[0] || value > y[1]) continue;
    stroke(ctx, { t: x, values: [value, value], style: { color: danger ? LIGHT.danger : LIGHT.ink, width: 1.2, dash: danger ? [] : [1, 4] } }, px, py);
    text(label, box.right - 4, py(value) + (value > 0 ? 9 : -9), 'right', '11px', danger ? LIGHT.danger : LIGHT.ink);
  }
  lines.forEach((line, i) => {
    const [left, top] = [box.left + (i % 3) * ((box.right - box.left) / 3), HEIGHT + 4 + 20 * Math.floor(i / 3)];
    stroke(ctx, { t: [0, 1], values: [0, 0], style: styleOf(line) }, (t) => left + 26 * t, () => top);
    text(line.name, left + 33, top, 'left', '12px', LIGHT.ink);
  });
  return canvas;
}

/** @param {CanvasRenderingContext2D} ctx @param {{left: number, top: number, right: number, bottom: number}} box @param {any} to */
function axes(ctx, box, { x, y, px, py, text }) {
  ctx.lineWidth = 1;
  ctx.strokeStyle = LIGHT.grid;
  ctx.beginPath();
  for (const t of ticks(x[0], x[1], niceStep(x[1] - x[0], 8))) {
    ctx.moveTo(px(t), box.top);
    ctx.lineTo(px(t), box.bottom);
    text(minus(t), px(t), box.bottom + 12, 'center', '11px', LIGHT.muted);
  }
  for (const v of ticks(y[0], y[1], niceStep(y[1] - y[0], 6))) {
    ctx.moveTo(box.left, py(v));
    ctx.lineTo(box.right, py(v));
    text(minus(v), box.left - 7, py(v), 'right', '11px', LIGHT.muted);
  }
  ctx.stroke();
}

/** @param {CanvasRenderingContext2D} ctx @param {any} line @param {(t: number) => number} px @param {(v: number) => number} py */
function stroke(ctx, line, px, py) {
  const { color, width, dash } = line.style ?? styleOf(line);
  ctx.save();
  Object.assign(ctx, { strokeStyle: color, lineWidth: width, lineJoin: 'round' });
  ctx.setLineDash(dash);
  ctx.beginPath();
  for (let i = 0; i < line.t.length; i++) ctx.lineTo(px(line.t[i]), py(line.values[i]));
  ctx.stroke();
  ctx.restore();
}

/** @param {Signal} signal */
export const fileName = (signal) => `heli2dof-${signal}-${unitOf(signal)}`;
