/**
 * A trace as a path with no more corners than the eye needs: a step response of 500 points is straight for most of its
 * length, and every corner costs at each frame of a drag. Pure but for Path2D.
 */
const TOLERANCE = 0.2; // device pixels that a point may lie above or below the line drawn past it

/**
 * The corners of a polyline through all points that keeps every one of them within the tolerance: from the last corner,
 * the next line's slope is bounded by each point that it passes; where no slope is left, the point before becomes a
 * corner.
 * @param {ArrayLike<number>} xs rising
 * @param {ArrayLike<number>} ys as many
 * @param {number} first
 * @param {number} last indices
 * @param {(i: number) => void} corner
 */
export function corners(xs, ys, first, last, corner, tolerance = TOLERANCE) {
  corner(first);
  let [anchor, low, high] = [first, -Infinity, Infinity];
  for (let i = first + 1; i <= last; i++) {
    let run = xs[i] - xs[anchor];
    const slope = (ys[i] - ys[anchor]) / run;
    if (slope < low || slope > high) {
      anchor = i - 1;
      corner(anchor);
      [low, high] = [-Infinity, Infinity];
      run = xs[i] - xs[anchor];
    }
    low = Math.max(low, (ys[i] - tolerance - ys[anchor]) / run);
    high = Math.min(high, (ys[i] + tolerance - ys[anchor]) / run);
  }
  if (last > first) corner(last);
}

/**
 * uPlot's builder of paths.
 * @param {import('../ui/picture_scale.js').Chart} u
 * @param {number} k of the series
 * @param {number} first
 * @param {number} last indices
 */
export function plainPath(u, k, first, last) {
  const t = u.data[0];
  const values = /** @type {ArrayLike<number>} */ (u.data[k]);
  if (values[first] === null) return null; // a trace is there as a whole or not at all
  const { left, top, width, height } = u.bbox;
  const { x, y } = /** @type {import('../ui/picture_scale.js').Ranges} */ (u.scales);
  const [perSecond, perUnit] = [width / (x.max - x.min), height / (y.max - y.min)];
  const [xs, ys] = [scratch(0, last + 1), scratch(1, last + 1)];
  for (let i = first; i <= last; i++) {
    xs[i] = left + (t[i] - x.min) * perSecond;
    ys[i] = top + (y.max - values[i]) * perUnit;
  }
  const stroke = new Path2D();
  corners(xs, ys, first, last, (i) => stroke.lineTo(xs[i], ys[i]));
  return { stroke, fill: null, clip: null, band: null, flags: 1 };
}

const kept = [new Float64Array(0), new Float64Array(0)];

/** @param {number} k @param {number} size @returns {Float64Array} */
function scratch(k, size) {
  if (kept[k].length < size) kept[k] = new Float64Array(2 * size);
  return kept[k];
}
