/**
 * A pole's course through the s-plane: a line within the view, and an arrow on it.
 * @typedef {import('./clipped.js').Point} Point
 */
import { svg } from '../ui/index.js';
import { toPixel } from '../splane/index.js';
import { clipped } from './clipped.js';

const ARROW = 'M -4 -3.5 L 4 0 L -4 3.5';

/**
 * @param {import('../splane/math.js').View} view
 * @param {import('../types.js').Complex[]} path
 * @param {{line: string, arrow: string}} classes
 */
export function trackOf(view, path, { line, arrow }) {
  const parts = clipped(
    path.map((p) => toPixel(view, p)),
    view,
  );
  const d = parts.map((at) => `M ${at.map((p) => p.map((v) => v.toFixed(1)).join(' ')).join(' L ')}`).join(' ');
  return [svg('path', { class: line, d }), ...arrowOf(parts, arrow)];
}

/**
 * Where it goes, two thirds along what is drawn.
 * @param {Point[][]} parts @param {string} name its class
 */
function arrowOf(parts, name) {
  const steps = parts.flatMap((at) => at.slice(1).map(([x, y], i) => ({ x, y, dx: x - at[i][0], dy: y - at[i][1] })));
  const lengths = steps.map(({ dx, dy }) => Math.hypot(dx, dy));
  const whole = lengths.reduce((sum, l) => sum + l, 0);
  if (whole <= 18) return [];
  let i = 0;
  for (let gone = lengths[0]; i < steps.length - 1 && gone < 0.67 * whole; gone += lengths[++i]);
  const { x, y, dx, dy } = steps[i];
  const transform = `translate(${x} ${y}) rotate(${((Math.atan2(dy, dx) * 180) / Math.PI).toFixed(0)})`;
  return [svg('path', { class: name, d: ARROW, transform })];
}
