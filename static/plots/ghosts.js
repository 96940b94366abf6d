/**
 * Responses of pinned designs under the plots' own, on a canvas of their own: a drag redraws the chart above it and
 * leaves this one alone. Each line carries its pin's letter, round on the pitch step's, square on the yaw step's.
 * @typedef {import('../types.js').Pin} Pin
 * @typedef {import('../model/traces.js').Signal} Signal
 */
import { colorOf, extent, letterOf, trace } from '../model/index.js';
import { h, pictureScale } from '../ui/index.js';

/**
 * @typedef {{pin: Pin, axis: 'theta'|'psi', t: import('../types.js').Series, values: import('../types.js').Series}}
 *   Ghost
 */
const AXES = /** @type {const} */ (['theta', 'psi']);
const BADGE = 6; // px, half its size

/** @param {Pin[]} pins @param {Signal} signal @returns {Ghost[]} */
export const ghostsOf = (pins, signal) =>
  pins.flatMap((pin) =>
    AXES.flatMap((axis) => {
      const step = pin.reply?.axis_steps?.[axis]?.nonlinear;
      const values = trace(step, signal, false);
      return step && values ? [{ pin, axis, t: step.t, values }] : [];
    }),
  );

export class PlotGhosts {
  /** @type {Ghost[]} */ ghosts = [];
  /** @type {[number, number]|undefined} */ extent;
  /** @type {Pin[]|null} */ #pins = null;
  #key = '';

  /** @param {import('../ui/picture_scale.js').Chart} chart @param {Signal} signal */
  constructor(chart, signal) {
    this.chart = chart;
    this.signal = signal;
    this.canvas = h('canvas', { class: 'ghosts', hidden: true, 'aria-hidden': 'true' });
    chart.root.querySelector('.u-wrap')?.append(this.canvas);
  }

  /** @param {Pin[]} pins @returns {boolean} whether they are others than before */
  take(pins) {
    if (pins === this.#pins) return false;
    this.#pins = pins;
    this.ghosts = ghostsOf(pins, this.signal);
    this.extent = extent(this.ghosts.map((g) => g.values));
    this.#key = '';
    this.canvas.hidden = this.ghosts.length === 0; // an empty one would be laid over the others in every frame
    return true;
  }

  /** Draws where scales, size or pins have changed since. @param {(name: string) => string} color */
  draw(color) {
    const { chart } = this;
    const { x, y } = chart.scales;
    const scale = pictureScale();
    const key =
      `${chart.width} ${chart.height} ${x.min} ${x.max} ${y.min} ${y.max} ${this.ghosts.length} ` +
      `${color('pin-0')} ${devicePixelRatio} ${scale.type} ${scale.line}`;
    if (key === this.#key) return;
    this.#key = key;
    const { left, top, width, height } = chart.bbox;
    const ratio = devicePixelRatio;
    const { canvas } = this;
    const [w, t] = [Math.round(width), Math.round(height)];
    if (canvas.width !== w || canvas.height !== t) Object.assign(canvas, { width: w, height: t });
    Object.assign(canvas.style, {
      left: `${left / ratio}px`,
      top: `${top / ratio}px`,
      width: `${width / ratio}px`,
      height: `${height / ratio}px`,
    });
    const ctx = canvas.getContext('2d');
    if (!ctx) return;
    ctx.clearRect(0, 0, w, t);
    if (!this.ghosts.length) return;
    drawGhosts(
      ctx,
      this.ghosts,
      (v) => chart.valToPos(v, 'x', true) - left,
      (v) => chart.valToPos(v, 'y', true) - top,
      { width: w, type: ratio * scale.type, line: ratio * scale.line, color },
    )();
  }
}

/**
 * @param {CanvasRenderingContext2D} ctx
 * @param {Ghost[]} ghosts
 * @param {(t: number) => number} px
 * @param {(v: number) => number} py
 * @param {{width: number, type: number, line: number, color: (name: string) => string}} how its size, and that of
 *   letters and lines, to a CSS pixel each
 * @returns {() => void} draws their letters, over what may come between
 */
export function drawGhosts(ctx, ghosts, px, py, { width, type, line, color }) {
  ctx.lineJoin = 'round';
  const badges = ghosts.map(({ pin, axis, t, values }, k) => {
    ctx.strokeStyle = color(colorOf(pin.index));
    ctx.globalAlpha = 0.85;
    ctx.lineWidth = (axis === 'theta' ? 1.6 : 1.1) * line;
    ctx.beginPath();
    for (let i = 0; i < t.length; i++) ctx.lineTo(px(t[i]), py(values[i]));
    ctx.stroke();
    // apart from one another, and early, where responses differ
    const aim = width * (0.06 + 0.4 * ((k * 0.381966 + 0.2) % 1));
    let i = 0;
    while (i < t.length - 1 && px(t[i]) < aim) i += 1;
    return {
      x: px(t[i]),
      y: py(values[i]),
      round: axis === 'theta',
      letter: letterOf(pin.index),
      ink: ctx.strokeStyle,
    };
  });
  ctx.globalAlpha = 1;
  return () => drawBadges(ctx, badges, type, color('panel'));
}

/**
 * @param {CanvasRenderingContext2D} ctx
 * @param {{x: number, y: number, round: boolean, letter: string, ink: string|CanvasGradient|CanvasPattern}[]} badges
 * @param {number} ratio
 * @param {string} paper
 */
function drawBadges(ctx, badges, ratio, paper) {
  Object.assign(ctx, {
    font: `700 ${9 * ratio}px system-ui, sans-serif`,
    textAlign: 'center',
    textBaseline: 'middle',
    lineWidth: 1.2 * ratio,
  });
  const r = BADGE * ratio;
  for (const { x, y, round, letter, ink } of badges) {
    ctx.beginPath();
    if (round) ctx.arc(x, y, r, 0, 2 * Math.PI);
    else ctx.rect(x - r, y - r, 2 * r, 2 * r);
    ctx.fillStyle = paper;
    ctx.fill();
    ctx.strokeStyle = ctx.fillStyle = ink;
    ctx.stroke();
    ctx.fillText(letter, x, y + 0.5 * ratio);
  }
}
