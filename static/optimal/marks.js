/**
 * Poles that nobody places: LQR's and a Kalman filter's, as marks of their own shape under the handles, with a tooltip.
 * @typedef {import('../types.js').Complex} Complex
 */
import { inField, poleText, polesText, say, t } from '../text/index.js';
import { setAttr, setText, svg } from '../ui/index.js';
import { inSight } from './edge.js';

const SHAPES = {
  optimal: 'M 9 0 L 4.5 7.8 L -4.5 7.8 L -9 0 L -4.5 -7.8 L 4.5 -7.8 Z', // a hexagon
  kalman: 'M 0 -9 L 2.6 -2.6 L 9 0 L 2.6 2.6 L 0 9 L -2.6 2.6 L -9 0 L -2.6 -2.6 Z', // a star of four points
};

/** For a pole out of sight: points to it. */
const FAR = 'M -8 0 L 4 -7 L 4 7 Z';
const MARGIN = 11;

/** @param {'optimal'|'kalman'} kind a sample of its marks */
export const sampleOf = (kind) =>
  svg(
    'svg',
    { class: `own-poles ${kind}`, 'aria-hidden': 'true', viewBox: '-10 -10 20 20' },
    svg('path', { d: SHAPES[kind] }),
  );

const short = (/** @type {number} */ v) => inField(Number(v.toPrecision(3)));

/** @param {Complex} p */
const placeText = ({ re, im }) => (im ? `${short(re)} ± ${short(im)}j` : short(re));

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
      this.layer.append(svg('g', {}, svg('title'), svg('path'), svg('text')));
    for (const [i, p] of poles.entries()) {
      const { x, y, turn } = inSight(this.plane.view, p, MARGIN);
      const node = this.layer.children[i];
      const [title, mark, far] = node.children;
      setAttr(node, 'transform', `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
      setAttr(node, 'class', p.re >= 0 ? 'bad' : '');
      setAttr(mark, 'd', turn === null ? SHAPES[this.kind] : FAR);
      setAttr(mark, 'transform', `rotate(${turn?.toFixed(0) ?? 0})`);
      title.textContent = poleText(p, say`${t(this.name)} pole`);
      // What it is, once for a pair, beside the arrow and within the plane.
      setText(far, turn === null || p.im < 0 ? '' : placeText(p));
      setAttr(far, 'y', y < 24 ? 20 : -9);
      const right = 2 * x > this.plane.view.width;
      setAttr(far, 'x', right ? -10 : 10);
      setAttr(far, 'text-anchor', right ? 'end' : 'start');
    }
  }
}
