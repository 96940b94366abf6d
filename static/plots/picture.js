/** A picture of lines for a report: title, axes with units, legend; on white, whatever the page's own colours. */
import { inField } from '../text/index.js';
import { niceStep, ticks } from '../model/index.js';
import { RECORDED } from '../charts/index.js';
import { drawGhosts } from './ghosts.js';
import { hatch, namePlaces } from './rules.js';

/**
 * @typedef {import('./export.js').Line} Line
 * @typedef {import('./rules.js').Rule} Rule
 * @typedef {import('./characteristics.js').Mark} Mark
 */
/**
 * @typedef {{range: [number, number], title: string, log?: boolean, steps?: number[]}} Axis steps: between its numbers,
 *   where not any round one will do
 */
/**
 * @typedef {{title: string, subtitle: string, x: Axis, y: Axis, lines: Line[], rules?: Rule[], regions?:
 *   import('./rules.js').Region[], pins?: import('../types.js').Pin[], marks?: (Mark & {to?: number})[]}} Picture to:
 *   where a line leads from the mark. pins: those of the lines, for their letters
 */

/**
 * @typedef {(words: string, left: number, top: number, align: CanvasTextAlign, font: string, color: string) => void}
 *   Write
 * @typedef {{color: string, width: number, dash: number[]}} Style
 * @typedef {(Line & {style?: undefined})|{t: ArrayLike<number>, values: ArrayLike<number>, style: Style}} Styled
 */

/** For a light page, as in style.css, sharing.css, recordings.css and compare.css. @type {Record<string, string>} */
const LIGHT = {
  panel: '#ffffff',
  ink: '#18222a',
  muted: '#4a5862',
  grid: '#e3e9ec',
  pitch: '#b94a2c',
  yaw: '#24689b',
  halo: '#dcdedf',
  danger: '#b3261e',
  warn: '#8a5a00',
  recorded: '#3f6b12',
  'limit-fill': '#fbeeed',
  'series-0': '#16726b',
  'series-1': '#7a4bb0',
  'pin-0': '#7a3fb0',
  'pin-1': '#11706a',
  'pin-2': '#8a5a00',
  'pin-3': '#ab2468',
  'pin-4': '#4a6a1c',
  'pin-5': '#4d5a6b',
};
const SCALE = 2; // dots per pixel
const [WIDTH, HEIGHT] = [800, 450];
const [LEFT, TOP, RIGHT, BOTTOM] = [64, 46, 20, 50];
const FONT = 'system-ui, sans-serif';
const AXIS = { theta: 'pitch', psi: 'yaw' };
/** Where a mark's words stand. @type {Record<Mark['kind'], [CanvasTextAlign, number, number]>} */
const BESIDE = {
  peak: ['center', 0, -14],
  coupling: ['center', 0, -14],
  rise: ['left', 9, 5],
  settling: ['left', 7, 15],
};

/** @param {Line} line @returns {Style} as on the page */
function styleOf({ kind, linear, index = 0, axis }) {
  if (kind === 'played') return { color: LIGHT.halo, width: 7, dash: [] };
  if (kind === 'pin') return { color: LIGHT[`pin-${index % 6}`], width: axis === 'theta' ? 1.6 : 1.1, dash: [] };
  const color = LIGHT[kind];
  if (kind === 'series-0' || kind === 'series-1') return { color, width: 2, dash: kind === 'series-0' ? [] : [7, 4] };
  if (kind === 'recorded') return { color, width: 1.6, dash: RECORDED };
  if (linear) return { color, width: 1.25, dash: kind === 'pitch' ? [7, 4] : [2, 3] };
  return { color, width: kind === 'pitch' ? 2.4 : 1.5, dash: [] };
}

/** Decades, or steps of a round number. @param {Axis} axis @param {number} about how many @returns {number[]} */
function ticksOf({ range: [low, high], log, steps }, about) {
  if (!log)
    return ticks(low, high, steps?.find((step) => (high - low) / step <= about + 1) ?? niceStep(high - low, about));
  const [first, last] = [Math.ceil(Math.log10(low) - 1e-9), Math.floor(Math.log10(high) + 1e-9)];
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => 10 ** (first + i));
}

/** Where a value lies along an axis, 0…1. @param {Axis} axis @param {number} v */
const share = ({ range: [low, high], log }, v) =>
  log ? Math.log(v / low) / Math.log(high / low) : (v - low) / (high - low);

/** Width and height, px. @param {Picture} picture @returns {[number, number]} */
export const sizeOf = ({ lines }) => [WIDTH, HEIGHT + 20 * Math.ceil(lines.length / 3)];

/** @param {Picture} picture @returns {HTMLCanvasElement} */
export function drawPicture(picture) {
  const canvas = document.createElement('canvas');
  const [width, height] = sizeOf(picture);
  Object.assign(canvas, { width: width * SCALE, height: height * SCALE });
  const ctx = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  ctx.scale(SCALE, SCALE);
  paint(ctx, picture);
  return canvas;
}

/** @param {CanvasRenderingContext2D} ctx or what writes down what it is asked @param {Picture} picture */
export function paint(ctx, picture) {
  const { title, subtitle, x, y, lines, rules = [], regions = [], pins = [], marks = [] } = picture;
  const [, height] = sizeOf(picture);
  ctx.fillStyle = LIGHT.panel;
  ctx.fillRect(0, 0, WIDTH, height);
  const box = { left: LEFT, top: TOP, right: WIDTH - RIGHT, bottom: HEIGHT - BOTTOM };
  const px = (/** @type {number} */ v) => box.left + share(x, v) * (box.right - box.left);
  const py = (/** @type {number} */ v) => box.bottom - share(y, v) * (box.bottom - box.top);
  /** @type {Write} */
  const text = (words, left, top, align, font, color) => {
    Object.assign(ctx, { textAlign: align, textBaseline: 'middle', font: `${font} ${FONT}`, fillStyle: color });
    ctx.fillText(words, left, top);
  };
  /** On paper, so that it can be read over lines. @type {Write} */
  const label = (words, left, top, align, font, color) => {
    ctx.font = `${font} ${FONT}`;
    const width = ctx.measureText(words).width + 4;
    ctx.globalAlpha = 0.82;
    ctx.fillStyle = LIGHT.panel;
    ctx.fillRect(
      left - 2 - (align === 'right' ? width - 4 : align === 'center' ? width / 2 - 2 : 0),
      top - 7,
      width,
      14,
    );
    ctx.globalAlpha = 1;
    text(words, left, top, align, font, color);
  };
  text(title, box.left, 16, 'left', '600 15px', LIGHT.ink);
  text(subtitle, box.left, 34, 'left', '11px', LIGHT.muted);
  drawAxes(ctx, box, { x, y, px, py, text });
  text(x.title, (box.left + box.right) / 2, HEIGHT - 14, 'center', '12px', LIGHT.ink);
  ctx.save();
  ctx.translate(16, (box.top + box.bottom) / 2);
  ctx.rotate(-Math.PI / 2);
  text(y.title, 0, 0, 'center', '12px', LIGHT.ink);
  ctx.restore();

  ctx.save();
  ctx.beginPath();
  ctx.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
  ctx.clip();
  for (const r of regions)
    hatch(ctx, { left: px(r.left), right: px(r.right), inner: py(r.inner), outer: py(r.outer) }, LIGHT.warn, 1);
  for (const line of lines.filter((l) => l.kind === 'played')) stroke(ctx, line, px, py);
  const ghosts = lines
    .filter((l) => l.kind === 'pin')
    .map((l) => ({
      pin: /** @type {import('../types.js').Pin} */ (pins.find((p) => p.index === l.index)),
      axis: /** @type {'theta'|'psi'} */ (l.axis),
      t: l.t,
      values: l.values,
    }))
    .filter((g) => g.pin);
  ctx.save();
  ctx.translate(box.left, 0);
  const badges = drawGhosts(ctx, ghosts, (v) => px(v) - box.left, py, {
    width: box.right - box.left,
    type: 1,
    line: 1,
    color: (name) => LIGHT[name],
  });
  ctx.restore();
  for (const line of lines.filter((l) => l.kind !== 'pin' && l.kind !== 'played').reverse()) stroke(ctx, line, px, py);
  for (const mark of marks) {
    if (mark.to !== undefined)
      stroke(
        ctx,
        {
          t: [mark.t, mark.t],
          values: [mark.value, mark.to],
          style: { color: LIGHT[AXIS[mark.axis]], width: 1.5, dash: [] },
        },
        px,
        py,
      );
    drawMark(ctx, mark, px(mark.t), py(mark.value), label);
  }
  ctx.translate(box.left, 0);
  badges();
  ctx.restore();
  const seen = rules.filter(({ value }) => value >= y.range[0] && value <= y.range[1]);
  const middles = namePlaces(
    seen.map(({ value }) => ({ value: y.log ? -1 : value, y: py(value) })),
    { gap: 9, high: 14, top: box.top, bottom: box.bottom },
  );
  for (const [i, { value, label: words, danger }] of seen.entries()) {
    stroke(
      ctx,
      {
        t: x.range,
        values: [value, value],
        style: { color: danger ? LIGHT.danger : LIGHT.ink, width: 1.2, dash: danger ? [] : [1, 4] },
      },
      px,
      py,
    );
    label(words, box.right - 4, middles[i], 'right', '11px', danger ? LIGHT.danger : LIGHT.ink);
  }
  lines.forEach((line, i) => {
    const [left, top] = [box.left + (i % 3) * ((box.right - box.left) / 3), HEIGHT + 4 + 20 * Math.floor(i / 3)];
    const { color, width, dash } = styleOf(line);
    Object.assign(ctx, { strokeStyle: color, lineWidth: width });
    ctx.setLineDash(dash);
    ctx.beginPath();
    ctx.moveTo(left, top);
    ctx.lineTo(left + 26, top);
    ctx.stroke();
    text(line.name, left + 33, top, 'left', '12px', LIGHT.ink);
  });
}

/**
 * Round on a pitch step's curve, square on a yaw step's, with its figure beside it.
 * @param {CanvasRenderingContext2D} ctx
 * @param {Mark} mark
 * @param {number} x
 * @param {number} y
 * @param {Write} text
 */
function drawMark(ctx, { kind, axis, brief }, x, y, text) {
  const color = LIGHT[AXIS[axis]];
  ctx.setLineDash([]);
  for (const [size, fill] of /** @type {const} */ ([
    [5, color],
    [4, LIGHT.panel],
    [2.6, color],
  ])) {
    ctx.beginPath();
    if (axis === 'theta') ctx.arc(x, y, size, 0, 2 * Math.PI);
    else ctx.rect(x - size, y - size, 2 * size, 2 * size);
    ctx.fillStyle = fill;
    ctx.fill();
  }
  const [align, dx, dy] = BESIDE[kind];
  text(brief, x + dx, y + dy, align, '11px', color);
}

/**
 * @param {CanvasRenderingContext2D} ctx
 * @param {{left: number, top: number, right: number, bottom: number}} box
 * @param {{x: Axis, y: Axis, px: (v: number) => number, py: (v: number) => number, text: Write}} to
 */
function drawAxes(ctx, box, { x, y, px, py, text }) {
  const words = (/** @type {number} */ v) => inField(v);
  ctx.lineWidth = 1;
  ctx.strokeStyle = LIGHT.grid;
  ctx.beginPath();
  for (const v of ticksOf(x, 8)) {
    ctx.moveTo(px(v), box.top);
    ctx.lineTo(px(v), box.bottom);
    text(words(v), px(v), box.bottom + 12, 'center', '11px', LIGHT.muted);
  }
  for (const v of ticksOf(y, 6)) {
    ctx.moveTo(box.left, py(v));
    ctx.lineTo(box.right, py(v));
    text(words(v), box.left - 7, py(v), 'right', '11px', LIGHT.muted);
  }
  ctx.stroke();
}

/**
 * Gaps where there is no value.
 * @param {CanvasRenderingContext2D} ctx
 * @param {Styled} line
 * @param {(t: number) => number} px
 * @param {(v: number) => number} py
 */
function stroke(ctx, line, px, py) {
  const { color, width, dash } = line.style ?? styleOf(line);
  ctx.save();
  Object.assign(ctx, { strokeStyle: color, lineWidth: width, lineJoin: 'round' });
  ctx.setLineDash(dash);
  ctx.beginPath();
  for (let i = 0, broken = true; i < line.t.length; i++) {
    const y = line.values[i] === null ? NaN : py(line.values[i]);
    if (!Number.isFinite(y)) broken = true;
    else if (broken) {
      ctx.moveTo(px(line.t[i]), y);
      broken = false;
    } else ctx.lineTo(px(line.t[i]), y);
  }
  ctx.stroke();
  ctx.restore();
}
