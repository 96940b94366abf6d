/**
 * Arrows in the s-plane: where each pole would go, and a mark there that a click takes.
 * @typedef {import('../splane/math.js').View} View
 * @typedef {import('./moves.js').Way} Way
 */
import { axisOf } from '../model/index.js';
import { toPixel } from '../splane/index.js';
import { svg } from '../ui/index.js';

const HEAD = 'M -6 -4.5 L 4 0 L -6 4.5 Z';
/** px: the pole's own mark and that of its end */
const RING = 12;
const END = 7;
/** px: of an arrow beside the mark, where the way is shorter than that */
const LEAST = 14;

/**
 * @param {View} view @param {Way} way @param {() => void} take
 * @returns {SVGElement}
 */
export function arrowOf(view, { index, from, to }, take) {
  const [a, b] = [toPixel(view, from), toPixel(view, to)];
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length = Math.hypot(dx, dy);
  const [ux, uy] = length > 0 ? [dx / length, dy / length] : [0, -1];
  const along = (/** @type {number} */ r) => /** @type {const} */ ([a[0] + ux * r, a[1] + uy * r]);
  // a way within the pole's mark is pointed out beside it
  const near = length < RING + END + LEAST;
  const [start, tip] = [along(RING + 2), along(near ? RING + LEAST : length - END)];
  const turn = (Math.atan2(uy, ux) * 180) / Math.PI;
  const d = `M ${start.map((v) => v.toFixed(1)).join(' ')} L ${tip.map((v) => v.toFixed(1)).join(' ')}`;
  const end = svg('circle', {
    class: 'nearest-end',
    'data-testid': `nearest-end-${index}`,
    cx: b[0].toFixed(1),
    cy: b[1].toFixed(1),
    r: END,
  });
  end.addEventListener('pointerdown', (e) => e.stopPropagation()); // no pole is taken, nothing panned
  end.addEventListener('click', take);
  return svg(
    'g',
    { class: `nearest-way ${axisOf(index) ? 'yaw' : 'pitch'}` },
    svg('path', { class: 'nearest-line', d }),
    svg('path', {
      class: 'nearest-head',
      d: HEAD,
      transform: `translate(${tip.map((v) => v.toFixed(1)).join(' ')}) rotate(${turn.toFixed(1)})`,
    }),
    end,
  );
}
