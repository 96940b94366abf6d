/**
 * What is painted of the strip chart: pieces of a lane's curves, and what lies behind them. In device pixels; where a
 * bin stands follows from its number alone, so that a piece joins what was painted before it.
 * @typedef {import('./scales.js').Span} Span
 * @typedef {import('./trace.js').Trace} Trace
 *
 * @typedef {object} Sheet  a picture on which a stretch of time is painted
 * @property {CanvasRenderingContext2D} ctx
 * @property {number} origin  bin whose right edge is its left one, less one
 * @property {number} perBin  px
 * @property {number} width  px
 * @property {number} ratio  device pixels to one of the page's, at its size of lines
 * @property {Inks} inks
 *
 * @typedef {Record<'pitch'|'yaw'|'danger'|'muted'|'grid'|'line'|'limit-fill', string>} Inks
 */
import { LANE } from './lanes.js';
import { BINS_PER_SECOND, CHANNELS, FLAG, KEPT } from './trace.js';

/** What is measured, and set points, beside the true course. */
const FAINT = 0.5;
/** Widths of lines: pitch's are the wider everywhere. */
const WIDTHS = [1.8, 1.2];
const [THIN, FULL] = [1, 3];
/** A set point is dashed by time: so many bins, as a power of two, are a dash, and as many a gap. */
const DASH = 3;

/** @param {Sheet} sheet @param {number} bin */
export const xOf = (sheet, bin) => (bin + 1 - sheet.origin) * sheet.perBin;

/**
 * A lane anew from a column on: what lies behind its curves on the whole sheet, and them.
 * @param {Sheet} sheet @param {Trace} trace
 * @param {{scales: import('./lanes.js').LaneScales, top: number, height: number}} place
 * @param {number} left  whole px: what is painted before it stays
 * @param {number} every  s, between two upright lines
 * @param {number} from  bin, of the curves: a little before that column @param {number} to  bin behind the last
 */
export function paintLane(sheet, trace, { scales, top, height }, left, every, from, to) {
  const { ctx, ratio, inks, width } = sheet;
  const { lane, spans } = scales;
  const margin = 2 * ratio;
  ctx.save();
  ctx.beginPath();
  ctx.rect(left, top - margin, width - left, height + 2 * margin);
  ctx.clip();
  ctx.clearRect(left, top - margin, width - left, height + 2 * margin);
  paintLines(sheet, top, height, scales.lines, left, every);
  ctx.lineJoin = 'round';
  if (lane === LANE.angles) paintBand(sheet, trace, FLAG.STOP, top, height, from, to);
  if (lane === LANE.volts) paintBand(sheet, trace, FLAG.FULL | FLAG.FULL_YAW, top, height, from, to);
  for (let axis = 1; axis >= 0; axis--) {
    const { low, high } = spans[axis];
    const scale = { top, high: high / lane.factor, per: (height * lane.factor) / (high - low) };
    const width = WIDTHS[axis] * ratio;
    ctx.strokeStyle = axis ? inks.yaw : inks.pitch;
    if (lane === LANE.volts) paintLimits(sheet, trace, axis, scale, from, to);
    if (lane.wish !== undefined) {
      ctx.lineWidth = THIN * ratio;
      trail(sheet, trace, lane.wish + axis, scale, from, to, DASHED);
    }
    if (lane.seen !== undefined) {
      ctx.globalAlpha = FAINT;
      ctx.lineWidth = THIN * ratio;
      trail(sheet, trace, lane.seen + axis, scale, from, to, 0);
      ctx.globalAlpha = 1;
    }
    ctx.lineWidth = width;
    trail(sheet, trace, lane.channel + axis, scale, from, to, 0);
    if (lane !== LANE.volts) continue;
    ctx.strokeStyle = inks.danger;
    ctx.lineWidth = FULL * ratio;
    trail(sheet, trace, lane.channel + axis, scale, from, to, axis ? FLAG.FULL_YAW : FLAG.FULL);
  }
  ctx.restore();
}

const DASHED = -1;

/**
 * The path of a channel through its bins' extremes: into each by the nearer one, out by the other.
 * @param {Sheet} sheet @param {Trace} trace @param {number} channel
 * @param {{top: number, high: number, per: number}} scale
 * @param {number} from @param {number} to
 * @param {number} only  0: all; DASHED; or a flag: where it is set
 */
function trail(sheet, trace, channel, { top, high, per }, from, to, only) {
  const { ctx, perBin } = sheet;
  const { low: lows, high: highs, flags } = trace;
  let drawn = false; // something of it
  let down = false; // the pen
  let last = NaN; // where it came out of the bin before
  let x = xOf(sheet, from - 1);
  for (let bin = from - 1; bin < to; bin++, x += perBin) {
    const slot = bin & (KEPT - 1);
    const [a, b] = [lows[slot * CHANNELS + channel], highs[slot * CHANNELS + channel]];
    if (bin < trace.first || !(a <= b)) {
      down = false;
      continue;
    }
    const [lower, upper] = [top + (high - a) * per, top + (high - b) * per];
    const wide = lower - upper > 0.5;
    // a jump of a set point is drawn in a gap of its dashes as well
    const seen = only === 0 || (only > 0 ? (flags[slot] & only) !== 0 : wide || ((bin >> DASH) & 1) === 0);
    if (!seen) {
      down = false;
      last = (lower + upper) / 2;
      continue;
    }
    if (!drawn) ctx.beginPath();
    drawn = true;
    const up = Math.abs(last - upper) > Math.abs(last - lower); // in by the lower end
    if (!down) ctx.moveTo(x - (bin >= from ? perBin : 0), up ? lower : upper);
    ctx.lineTo(x, up ? lower : upper);
    last = up ? upper : lower;
    if (wide) ctx.lineTo(x, last);
    down = true;
  }
  if (drawn) ctx.stroke();
}

/**
 * The lines behind the curves.
 * @param {Sheet} sheet @param {number} top @param {number} height
 * @param {readonly number[]} lines  shares of the height from below @param {number} left @param {number} every  s
 */
function paintLines({ ctx, origin, perBin, width, ratio, inks }, top, height, lines, left, every) {
  const hair = Math.max(Math.round(ratio), 1);
  ctx.fillStyle = inks.grid;
  const step = every * BINS_PER_SECOND;
  for (let bin = Math.ceil(origin / step) * step; (bin - origin) * perBin < width; bin += step)
    ctx.fillRect(Math.round((bin - origin) * perBin), top, hair, height);
  for (const share of lines) {
    ctx.fillStyle = share === 0.5 ? inks.line : inks.grid;
    ctx.fillRect(left, Math.round(top + height * (1 - share)), width - left, hair);
  }
}

/**
 * Stretches in which something was so, over the lane's height.
 * @param {Sheet} sheet @param {Trace} trace @param {number} flag @param {number} top @param {number} height
 * @param {number} from @param {number} to
 */
function paintBand(sheet, trace, flag, top, height, from, to) {
  const { ctx, inks } = sheet;
  ctx.fillStyle = inks['limit-fill'];
  for (let bin = Math.max(from, trace.first); bin < to;) {
    let end = bin;
    while (end < to && trace.flags[end & (KEPT - 1)] & flag) end += 1;
    if (end > bin) {
      const [left, right] = [Math.round(xOf(sheet, bin - 1)), Math.round(xOf(sheet, end - 1))];
      ctx.fillRect(left, top, right - left, height);
    }
    bin = end + 1;
  }
}

/**
 * The limits of a motor as they were then.
 * @param {Sheet} sheet @param {Trace} trace @param {number} axis
 * @param {{top: number, high: number, per: number}} scale @param {number} from @param {number} to
 */
function paintLimits(sheet, trace, axis, { top, high, per }, from, to) {
  const { ctx, ratio, inks } = sheet;
  ctx.fillStyle = inks.danger;
  ctx.globalAlpha = FAINT;
  for (let bin = Math.max(from, trace.first); bin < to;) {
    const limit = trace.limits[2 * (bin & (KEPT - 1)) + axis];
    let end = bin + 1;
    while (end < to && trace.limits[2 * (end & (KEPT - 1)) + axis] === limit) end += 1;
    const [left, right] = [Math.round(xOf(sheet, bin - 1)), Math.round(xOf(sheet, end - 1))];
    for (let side = -1; side <= 1 && limit < Infinity; side += 2)
      ctx.fillRect(left, Math.round(top + (high - side * limit) * per), right - left, Math.max(Math.round(ratio), 1));
    bin = end;
  }
  ctx.globalAlpha = 1;
}

/**
 * Times below the lanes, every so many seconds.
 * @param {Sheet} sheet @param {number} top @param {number} height @param {number} every  s @param {string} font
 */
export function paintTimes({ ctx, origin, perBin, width, inks }, top, height, every, font) {
  ctx.clearRect(0, top, width, height);
  [ctx.font, ctx.fillStyle, ctx.textAlign, ctx.textBaseline] = [font, inks.muted, 'center', 'middle'];
  const step = every * BINS_PER_SECOND;
  const aside = 60 / perBin; // of those that stand on the next sheet something reaches onto this one
  for (let bin = Math.max(Math.ceil((origin - aside) / step) * step, 0); ; bin += step) {
    const x = (bin - origin) * perBin;
    if (x > width + 60) break;
    ctx.fillText(`${bin / BINS_PER_SECOND} s`, x, top + height / 2);
  }
}
