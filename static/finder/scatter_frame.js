/**
 * What lies under the points of the scatter: axes, limits that were set, and where one began.
 * @typedef {import('./shapes.js').Drawn} Drawn
 * @typedef {import('./scatter_math.js').Range} Range
 */
import { inField, t } from '../text/index.js';
import { svg } from '../ui/index.js';
import { limitsOn, shortTitle, ticksOf } from './scatter_math.js';

/** What the axes' words take of the drawing, px. */
export const EDGE = { left: 46, right: 14, top: 26, bottom: 40 };

/**
 * @param {{found: Drawn, x: number, y: number, ranges: {x: Range, y: Range}, here: {x: number, y: number}|null,
 *   at: {px: (v: number) => number, py: (v: number) => number}, size: {width: number, height: number}}} drawing
 *   x, y: the figures; here: where one began; at: from figures to pixels
 * @returns {SVGElement[]}
 */
export function frameOf({ found, x, y, ranges, here, at: { px, py }, size: { width, height } }) {
  const line = (/** @type {string} */ kind, /** @type {number[]} */ [x1, y1, x2, y2]) =>
    svg('line', { class: kind, x1: x1.toFixed(1), y1: y1.toFixed(1), x2: x2.toFixed(1), y2: y2.toFixed(1) });
  const text = (/** @type {Record<string, unknown>} */ how, /** @type {string} */ words) => {
    const node = svg('text', how);
    node.textContent = words;
    return node;
  };
  const [right, bottom] = [width - EDGE.right, height - EDGE.bottom];
  const inside = (/** @type {number} */ v, /** @type {Range} */ [low, high]) => v > low && v < high;
  return [
    ...ticksOf(ranges.x, Math.max(2, (right - EDGE.left) / 80)).flatMap((v) => [
      line('find-grid', [px(v), EDGE.top, px(v), bottom]),
      text({ x: px(v).toFixed(1), y: bottom + 15, 'text-anchor': 'middle' }, inField(v)),
    ]),
    ...ticksOf(ranges.y, Math.max(2, (bottom - EDGE.top) / 46)).flatMap((v) => [
      line('find-grid', [EDGE.left, py(v), right, py(v)]),
      text({ x: EDGE.left - 6, y: (py(v) + 4).toFixed(1), 'text-anchor': 'end' }, inField(v)),
    ]),
    text({ class: 'find-axis', x: right, y: height - 6, 'text-anchor': 'end' }, shortTitle(found.figures[x])),
    text({ class: 'find-axis', x: 8, y: 15 }, shortTitle(found.figures[y])),
    ...limitsOn(found, x)
      .filter(({ at }) => inside(at, ranges.x))
      .flatMap(({ at, limit }) => [
        line('find-limit-line', [px(at), EDGE.top, px(at), bottom]),
        text({ class: 'find-limit-text', x: (px(at) - 4).toFixed(1), y: bottom - 6, 'text-anchor': 'end' }, limit),
      ]),
    ...limitsOn(found, y)
      .filter(({ at }) => inside(at, ranges.y))
      .flatMap(({ at, limit }) => [
        line('find-limit-line', [EDGE.left, py(at), right, py(at)]),
        text({ class: 'find-limit-text', x: right - 4, y: (py(at) - 4).toFixed(1), 'text-anchor': 'end' }, limit),
      ]),
    ...(here
      ? [
          svg('path', {
            class: 'find-present',
            d: `M${px(here.x) - 6} ${py(here.y)}h12M${px(here.x)} ${py(here.y) - 6}v12`,
          }),
          text(
            {
              class: 'find-present-text',
              ...(px(here.x) > 0.6 * width
                ? { x: (px(here.x) - 9).toFixed(1), 'text-anchor': 'end' }
                : { x: (px(here.x) + 9).toFixed(1) }),
              y: (py(here.y) - 5).toFixed(1),
            },
            t('where you began'),
          ),
        ]
      : []),
  ];
}
