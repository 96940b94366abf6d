/** What lies beyond the s-plane's view. Pure. */
import { toPixel } from '../splane/index.js';

/**
 * Where a pole is marked: at its place, or, where that is out of sight, at the edge towards it.
 * @param {import('../splane/math.js').View} v
 * @param {import('../types.js').Complex} pole
 * @param {number} margin pixels from the edge
 * @returns {{x: number, y: number, turn: number|null}} turn: degrees from the left, clockwise; null: it is in sight
 */
export function inSight(v, pole, margin) {
  const [px, py] = toPixel(v, pole);
  if (px >= 0 && px <= v.width && py >= 0 && py <= v.height) return { x: px, y: py, turn: null };
  const x = Math.max(margin, Math.min(v.width - margin, px));
  const y = Math.max(margin, Math.min(v.height - margin, py));
  return { x, y, turn: (Math.atan2(y - py, x - px) * 180) / Math.PI };
}
