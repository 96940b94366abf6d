/**
 * Paints a map, on a canvas or, by what a canvas would be told, as SVG: bands of colour, lines with their values, what
 * is forbidden hatched.
 * @typedef {import('./layers.js').Layers} Layers
 * @typedef {import('./contours.js').Line} Line
 * @typedef {{x: number, y: number, width: number, height: number}} Box  pixels
 * @typedef {object} Look
 * @property {string[]} bands  colours by value, one more than levels
 * @property {string[]} lines  colours of the levels' lines
 * @property {string[]} inks  of their labels
 * @property {string} page  behind the picture
 * @property {string} danger  of what is unstable
 * @property {string} warn  of requirements that are missed
 * @property {string} muted  of what does not settle
 * @property {string} font  of labels: family
 * @property {number} type  of labels, px
 * @property {(level: number) => string} label
 */

/** Between hatching lines, px. */
const HATCH = 7;
/** Labels keep so far from what else there is, px. */
const CLEAR = 5;

/**
 * @param {CanvasRenderingContext2D} ctx
 * @param {Layers} layers
 * @param {Box} box  where its first and last nodes are
 * @param {Look} look
 * @param {{lines?: boolean, avoid?: [number, number][]}} [how]  avoid: where no label may stand
 */
export function paintMap(ctx, layers, box, look, { lines = true, avoid = [] } = {}) {
  const { grid, levels, bands } = layers;
  const [sx, sy] = [box.width / (grid.columns - 1), box.height / (grid.rows - 1)];
  /** @param {Line[]} all @param {boolean} closed */
  const trace = (all, closed) => {
    ctx.beginPath();
    for (const line of all) {
      ctx.moveTo(box.x + line[0] * sx, box.y + line[1] * sy);
      for (let i = 2; i < line.length; i += 2) ctx.lineTo(box.x + line[i] * sx, box.y + line[i + 1] * sy);
      if (closed) ctx.closePath();
    }
  };
  ctx.save();
  ctx.beginPath();
  ctx.rect(box.x, box.y, box.width, box.height);
  ctx.clip();
  ctx.fillStyle = look.bands[0];
  ctx.fillRect(box.x, box.y, box.width, box.height);
  for (const [k, { rings }] of bands.entries()) {
    if (!rings.length) continue;
    trace(rings, true);
    ctx.fillStyle = look.bands[k + 1];
    ctx.fill();
  }
  if (lines) {
    ctx.lineJoin = 'round';
    for (const [k, { lines: own }] of bands.entries()) {
      trace(own, false);
      ctx.strokeStyle = look.lines[k];
      ctx.lineWidth = isMain(k, levels) ? 1.3 : 0.7;
      ctx.stroke();
    }
  }
  const missed = { color: look.warn, veil: 0.28, turn: -1, gap: HATCH, width: 1.2 };
  const unsettled = { color: look.muted, veil: 0.85, turn: 1, gap: HATCH, width: 1 };
  const unstable = { color: look.danger, veil: 0.82, turn: 1, gap: HATCH, width: 1 };
  for (const [rings, how] of /** @type {const} */ ([
    [layers.missed, missed],
    [layers.unsettled, unsettled],
    [layers.unstable, unstable],
  ]))
    if (rings.length) hatch(ctx, () => trace(rings, true), box, look.page, how);
  if (lines) labels(ctx, layers, box, look, avoid);
  ctx.restore();
}

/** Lines that have labels: every other one where there are many. @param {number} k @param {number[]} levels */
const isMain = (k, levels) => levels.length < 6 || k % 2 === 0;

/**
 * @param {CanvasRenderingContext2D} ctx @param {() => void} trace @param {Box} box @param {string} page
 * @param {{color: string, veil: number, turn: number, gap: number, width: number}} how
 */
function hatch(ctx, trace, box, page, { color, veil, turn, gap, width }) {
  ctx.save();
  trace();
  ctx.globalAlpha = veil;
  ctx.fillStyle = page;
  ctx.fill();
  ctx.globalAlpha = 0.9;
  ctx.strokeStyle = color;
  ctx.lineWidth = 1.4;
  ctx.stroke();
  ctx.clip();
  ctx.globalAlpha = 0.42;
  ctx.lineWidth = width;
  ctx.beginPath();
  const reach = box.height;
  for (let x = box.x - reach; x < box.x + box.width + reach; x += gap * Math.SQRT2) {
    ctx.moveTo(x, turn > 0 ? box.y + reach : box.y);
    ctx.lineTo(x + reach, turn > 0 ? box.y : box.y + reach);
  }
  ctx.stroke();
  ctx.restore();
}

/**
 * The lines' values, along them where they run straight, and none over another or over a pole.
 * @param {CanvasRenderingContext2D} ctx @param {Layers} layers @param {Box} box @param {Look} look
 * @param {[number, number][]} avoid
 */
function labels(ctx, { grid, levels, bands, unstable, unsettled }, box, look, avoid) {
  ctx.font = `600 ${look.type}px ${look.font}`;
  ctx.textAlign = 'center';
  ctx.textBaseline = 'middle';
  const [sx, sy] = [box.width / (grid.columns - 1), box.height / (grid.rows - 1)];
  /** @type {[number, number, number][]} */ const taken = avoid.map(([x, y]) => [x, y, 14]);
  const isHidden = (/** @type {number} */ x, /** @type {number} */ y) =>
    isWithin(unstable, x, y) || isWithin(unsettled, x, y);
  for (const [k, { lines }] of bands.entries()) {
    if (!isMain(k, levels)) continue;
    const text = look.label(levels[k]);
    const width = ctx.measureText(text).width + 6;
    for (const line of lines.toSorted((a, b) => b.length - a.length).slice(0, 4)) {
      const at = straight(line, sx, sy, width, (x, y) => {
        const inside = [x - width / 2 > 2, x + width / 2 < box.width - 2, y > look.type, y < box.height - look.type];
        const free = taken.every(([u, v, r]) => Math.hypot(box.x + x - u, box.y + y - v) > r + width / 2 + CLEAR);
        return inside.every(Boolean) && free && !isHidden(x / sx, y / sy);
      });
      if (!at) continue;
      const [x, y, angle] = at;
      taken.push([box.x + x, box.y + y, width / 2]);
      ctx.save();
      ctx.translate(box.x + x, box.y + y);
      ctx.rotate(angle);
      ctx.fillStyle = look.bands[k];
      ctx.fillRect(-width / 2, -look.type * 0.55, width, look.type * 1.1);
      ctx.fillStyle = look.inks[k];
      ctx.fillText(text, 0, 0);
      ctx.restore();
    }
  }
}

/**
 * Where along a line a label of that width has room: the straightest of those places that are free.
 * @param {Line} line @param {number} sx @param {number} sy @param {number} width
 * @param {(x: number, y: number) => boolean} isFree
 * @returns {[x: number, y: number, angle: number]|null}
 */
function straight(line, sx, sy, width, isFree) {
  const n = line.length / 2;
  const along = new Float64Array(n);
  for (let i = 1; i < n; i++)
    along[i] =
      along[i - 1] + Math.hypot((line[2 * i] - line[2 * i - 2]) * sx, (line[2 * i + 1] - line[2 * i - 1]) * sy);
  const length = along[n - 1];
  if (length < 2 * width) return null;
  const point = (/** @type {number} */ s) => {
    let i = Math.max(
      1,
      along.findIndex((v) => v >= s),
    );
    if (i < 1) i = n - 1;
    const share = (s - along[i - 1]) / (along[i] - along[i - 1] || 1);
    const of = (/** @type {number} */ k) => line[2 * i - 2 + k] + share * (line[2 * i + k] - line[2 * i - 2 + k]);
    return [of(0) * sx, of(1) * sy];
  };
  /** @type {[number, number, number]|null} */ let best = null;
  let most = 0.93;
  for (let s = width / 2 + 2; s < length - width / 2; s += Math.max(6, length / 60)) {
    const [[ax, ay], [x, y], [bx, by]] = [s - width / 2, s, s + width / 2].map(point);
    const bent = Math.hypot(x - (ax + bx) / 2, y - (ay + by) / 2) / width;
    const score = Math.hypot(bx - ax, by - ay) / width - 2 * bent - 0.02 * Math.abs(2 * (s / length) - 1);
    if (score <= most || !isFree(x, y)) continue;
    most = score;
    let angle = Math.atan2(by - ay, bx - ax);
    if (angle > Math.PI / 2) angle -= Math.PI;
    if (angle <= -Math.PI / 2) angle += Math.PI;
    best = [x, y, angle];
  }
  return best;
}

/** @param {Line[]} rings @param {number} x @param {number} y */
function isWithin(rings, x, y) {
  let inside = false;
  for (const ring of rings)
    for (let i = 0, j = ring.length - 2; i < ring.length; j = i, i += 2)
      if (ring[i + 1] > y !== ring[j + 1] > y) {
        const at = ring[i] + ((y - ring[i + 1]) / (ring[j + 1] - ring[i + 1])) * (ring[j] - ring[i]);
        if (x < at) inside = !inside;
      }
  return inside;
}
