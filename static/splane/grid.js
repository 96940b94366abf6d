/**
 * What lies behind the poles: axes, circles of constant ωₙ, rays of constant ζ, and the unstable half. Redrawn only
 * when the view changes.
 */
import { fixed } from '../text/index.js';
import { niceStep, ticks } from '../model/index.js';
import { svg } from '../ui/index.js';
import { bounds, DAMPING, rayEnd, toPixel } from './math.js';

const WN_DIRECTION = [Math.cos(0.87), Math.sin(0.87)];

const LABEL = 36; // px: how wide a damping ratio is

/** @param {number} step */
const decimalsOf = (step) => Math.max(0, -Math.floor(Math.log10(step) + 1e-9));

/**
 * @param {SVGGElement} layer
 * @param {import('./math.js').View} view
 * @param {string} [pattern] of the unstable half, by its name
 */
export function drawGrid(layer, view, pattern = 'hatch') {
  const b = bounds(view);
  const [x0, y0] = toPixel(view, { re: 0, im: 0 });
  const step = niceStep(Math.max(b.right - b.left, b.top - b.bottom), 8);
  const decimals = decimalsOf(step);
  const nodes = [];

  if (x0 < view.width) {
    const left = Math.max(0, x0);
    nodes.push(
      svg('rect', { class: 'unstable-half', x: left, y: 0, width: view.width - left, height: view.height }),
      svg('rect', {
        class: 'unstable-hatch',
        x: left,
        y: 0,
        width: view.width - left,
        height: view.height,
        fill: `url(#${pattern})`,
      }),
    );
    if (view.width - left > 14) {
      const x = Math.max(left, view.width - 21); // far from the axis, where poles may be
      nodes.push(svg('text', { class: 'unstable-label', x, y: 10, transform: `rotate(90 ${x} 10)` }, 'unstable'));
    }
  }

  const farthest = Math.max(...[b.left, b.right].flatMap((re) => [b.bottom, b.top].map((im) => Math.hypot(re, im))));
  for (const r of ticks(step, farthest, step)) {
    nodes.push(
      svg('path', {
        class: 'grid',
        d: `M ${x0} ${y0 - r * view.scale} A ${r * view.scale} ${r * view.scale} 0 0 0 ${x0} ${y0 + r * view.scale}`,
      }),
    );
  }
  const labelled = step * (step * view.scale < 44 ? 2 : 1);
  for (const r of ticks(labelled, farthest, labelled)) {
    // Below the real axis, where no ray has its label, and away from the ticks of the imaginary one.
    const [x, y] = toPixel(view, { re: -r * WN_DIRECTION[0], im: -r * WN_DIRECTION[1] });
    if (x > 22 && x0 - x > 30 && y > 30 && y < view.height - 24)
      nodes.push(
        svg(
          'text',
          { class: 'wn-label', x, y: y + 3, 'text-anchor': 'middle' },
          'ω',
          svg('tspan', { class: 'sub', dy: 3 }, 'n'),
          svg('tspan', { dy: -3 }, ` ${fixed(r, decimals)}`),
        ),
      );
  }
  let [free, low] = [x0, 0]; // where the next damping ratio has room: left of it, below it
  for (const zeta of DAMPING) {
    const end = rayEnd(view, zeta);
    if (!end) continue;
    const [x, y] = end;
    nodes.push(svg('path', { class: 'grid', d: `M ${x} ${y} L ${x0} ${y0} L ${x} ${2 * y0 - y}` }));
    const atTop = y < 1;
    if (atTop ? x + 4 + LABEL > free : y < low) continue;
    if (atTop) free = x;
    else low = y + 18;
    nodes.push(
      svg('text', { class: 'zeta-label', x: atTop ? x + 4 : 5, y: atTop ? 12 : y + 13 }, `ζ ${fixed(zeta, 1)}`),
    );
  }

  nodes.push(svg('line', { class: 'axis', x1: 0, x2: view.width, y1: y0, y2: y0 }));
  nodes.push(svg('line', { class: 'axis imaginary', x1: x0, x2: x0, y1: 0, y2: view.height }));
  const baseline = view.height - 7; // along the edge: at the axis the poles would cover them
  for (const re of ticks(b.left, b.right, step)) {
    const [x] = toPixel(view, { re, im: 0 });
    if (x < 14 || x > view.width - 14) continue;
    nodes.push(
      svg(
        'text',
        { class: 'tick', x, y: baseline, 'text-anchor': 'middle' },
        Math.abs(re) < step / 2 ? '0' : fixed(re, decimals),
      ),
    );
  }
  const column = Math.max(4, Math.min(view.width - 4, x0 - 5));
  for (const im of ticks(b.bottom, b.top, step)) {
    const [, y] = toPixel(view, { re: 0, im });
    if (y < 22 || y > view.height - 24 || im === 0) continue;
    nodes.push(svg('text', { class: 'tick', x: column, y: y + 4, 'text-anchor': 'end' }, `${fixed(im, decimals)}j`));
  }
  layer.replaceChildren(...nodes);
}
