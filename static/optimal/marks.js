/**
 * Poles that nobody places: LQR's and a Kalman filter's, as marks of their own shape under the handles, with a tooltip.
 * @typedef {import('../types.js').Complex} Complex
 */
import { poleText, polesText, say, t } from '../text/index.js';
import { setAttr, svg } from '../ui/index.js';
import { toPixel } from '../splane/index.js';

const SHAPES = {
  optimal: 'M 9 0 L 4.5 7.8 L -4.5 7.8 L -9 0 L -4.5 -7.8 L 4.5 -7.8 Z', // a hexagon
  kalman: 'M 0 -9 L 2.6 -2.6 L 9 0 L 2.6 2.6 L 0 9 L -2.6 2.6 L -9 0 L -2.6 -2.6 Z', // a star of four points
};

/** @param {'optimal'|'kalman'} kind a sample of its marks */
export const sampleOf = (kind) =>
  svg(
    'svg',
    { class: `own-poles ${kind}`, 'aria-hidden': 'true', viewBox: '-10 -10 20 20' },
    svg('path', { d: SHAPES[kind] }),
  );

export class OwnMarks {
  /** @type {readonly Complex[]|null} */ #drawn = null;

  /** @param {import('../splane/splane.js').SPlane} plane @param {'optimal'|'kalman'} kind @param {string} name */
  constructor(plane, kind, name) {
    this.plane = plane;
    this.kind = kind;
    this.name = name;
    this.layer = svg('g', { class: `own-poles ${kind}`, 'data-testid': `${kind}-poles`, role: 'img' });
    plane.marks.seen.before(this.layer);
    this.draw([], true);
  }

  /** @param {readonly Complex[]} poles none where there are none @param {boolean} fresh whether the view changed */
  draw(poles, fresh) {
    if (!fresh && poles === this.#drawn) return;
    this.#drawn = poles;
    setAttr(this.layer, 'aria-label', say`${t(this.name)} poles: ${polesText(poles)} rad/s`);
    setAttr(this.layer, 'display', poles.length ? 'inline' : 'none');
    while (this.layer.childElementCount > poles.length) this.layer.lastElementChild?.remove();
    while (this.layer.childElementCount < poles.length)
      this.layer.append(svg('path', { d: SHAPES[this.kind] }, svg('title')));
    for (const [i, p] of poles.entries()) {
      const [x, y] = toPixel(this.plane.view, p);
      const node = this.layer.children[i];
      setAttr(node, 'transform', `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
      setAttr(node, 'class', p.re >= 0 ? 'bad' : '');
      const title = /** @type {Element} */ (node.firstElementChild);
      title.textContent = poleText(p, say`${t(this.name)} pole`);
    }
  }
}
