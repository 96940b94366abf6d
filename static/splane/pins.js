/**
 * Pinned designs in the s-plane: small crosses with their letters under the poles that are dragged. Drawn anew only
 * when pins or view change.
 */
import { colorOf, letterOf } from '../model/index.js';
import { drawingUnit, pictureScale, svg } from '../ui/index.js';
import { toPixel } from './math.js';

const CROSS = 'M -3.5 -3.5 L 3.5 3.5 M -3.5 3.5 L 3.5 -3.5';
const NEAR = 14; // px, at the usual size of type: poles of one pin that share a letter
/** @type {WeakMap<SVGElement, {layer: SVGGElement, pins: unknown, view: unknown}>} */
const drawn = new WeakMap();

/** @param {SVGSVGElement} root @param {import('./math.js').View} view @param {import('../types.js').Pin[]} pins */
export function drawPins(root, view, pins) {
  let own = drawn.get(root);
  if (!own) {
    own = { layer: svg('g', { class: 'pin-poles', 'data-testid': 'pin-poles' }), pins: null, view: null };
    root.prepend(own.layer);
    drawn.set(root, own);
  }
  if (own.pins === pins && own.view === view) return;
  Object.assign(own, { pins, view });
  const near = (NEAR * pictureScale().type) / drawingUnit();
  own.layer.replaceChildren(
    ...pins.map((pin) => {
      /** @type {[number, number][]} */ const named = [];
      return svg(
        'g',
        { class: colorOf(pin.index), role: 'img', 'aria-label': `poles of ${letterOf(pin.index)}, ${pin.name}` },
        pin.design.poles.flatMap((p) => {
          const [x, y] = toPixel(view, p);
          const mark = svg('path', { d: CROSS, transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})` });
          if (named.some(([a, b]) => Math.hypot(a - x, b - y) < near)) return [mark];
          named.push([x, y]);
          return [
            mark,
            svg('text', { x: (x - 3).toFixed(1), y: (y + (p.im < 0 ? 24 : -15)).toFixed(1) }, letterOf(pin.index)),
          ];
        }),
      );
    }),
  );
}
