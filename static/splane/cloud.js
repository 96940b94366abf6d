/** Poles of many rigs as dots behind the s-plane's own. */
import { toPixel } from './math.js';

const DOT = 2;
/** @type {unknown} */ let drawn = null;

/**
 * @param {HTMLCanvasElement} canvas
 * @param {import('./math.js').View} view
 * @param {number} unit CSS pixels to one of the view's
 * @param {import('../types.js').Cloud|null} cloud
 */
export function drawCloud(canvas, view, unit, cloud) {
  const key = cloud ? JSON.stringify(view) : '';
  if (canvas.dataset.view === key && drawn === cloud) return;
  canvas.dataset.view = key;
  drawn = cloud;
  canvas.hidden = !cloud;
  const ratio = devicePixelRatio * unit;
  const [width, height] = [Math.round(view.width * ratio), Math.round(view.height * ratio)];
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const ctx = canvas.getContext('2d');
  if (!ctx) return;
  ctx.clearRect(0, 0, width, height);
  if (!cloud) return;
  const style = getComputedStyle(canvas);
  const size = DOT * ratio;
  ctx.globalAlpha = cloud.loop_poles.length > 500 ? 0.25 : 0.5;
  for (const bad of [false, true]) {
    ctx.fillStyle = style.getPropertyValue(bad ? '--danger' : '--muted');
    for (const poles of cloud.loop_poles) {
      for (const p of poles) {
        if (p.re >= 0 !== bad) continue;
        const [x, y] = toPixel(view, p);
        ctx.fillRect(x * ratio - size / 2, y * ratio - size / 2, size, size);
      }
    }
  }
}
