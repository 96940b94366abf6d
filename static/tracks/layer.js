/**
 * A track in the s-plane: courses, where they begin and end, zeros, crossings, and the poles at the value in question.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {import('./moving.js').Curves} Curves
 */
import { significant } from '../text/index.js';
import { setAttr, svg } from '../ui/index.js';
import { toPixel } from '../splane/index.js';
import { trackOf } from '../machine/index.js';
import { coursesOf, crossingsOf, stretches } from './courses.js';

const CROSS = 'M -4 -4 L 4 4 M -4 4 L 4 -4';
const SQUARE = 'M -3.5 -3.5 H 3.5 V 3.5 H -3.5 Z';
/** Poles farther out than so many times the view are not worth a mark. */
const FAR = 2;

export class Layer {
  /** @type {Complex[][]} */ courses = [];
  /** @type {Curves|null} */ #track = null;

  /** @param {import('../splane/splane.js').SPlane} plane */
  constructor(plane) {
    this.plane = plane;
    this.lines = svg('g');
    this.here = svg('g', { class: 'track-here' });
    this.node = svg('g', { class: 'track', 'data-testid': 'track', 'aria-hidden': 'true' }, this.lines, this.here);
    plane.svg.prepend(this.node);
  }

  /** @param {Curves|null} track */
  show(track) {
    this.#track = track;
    this.courses = track ? coursesOf(track) : [];
    this.draw();
  }

  /** It is of another design than the present one. @param {boolean} stale */
  fade(stale) {
    setAttr(this.node, 'data-stale', String(stale));
  }

  /** In the plane's view. */
  draw() {
    const track = this.#track;
    this.lines.replaceChildren(...(track ? this.#drawn(track) : []));
  }

  /** @param {Curves} track */
  #drawn(track) {
    const { view } = this.plane;
    const last = track.values.length - 1;
    const lines = this.courses.flatMap((course) =>
      stretches(course, track.starts).flatMap(({ points, stable }) => {
        const bad = stable ? '' : ' bad';
        return trackOf(view, points, { line: `track-line${bad}`, arrow: `track-arrow${bad}` });
      }),
    );
    const ends = this.courses.flatMap((course) => [
      this.#mark(course[0], 'track-start', CROSS),
      this.#mark(course[last], 'track-end', SQUARE),
    ]);
    const zeros = track.zeros.map((z) => this.#ring(z, 'track-zero', 5));
    const crossings = crossingsOf(track).flatMap(({ pole, value }) => {
      const ring = this.#ring(pole, 'track-crossing', 4.5);
      if (!ring) return [];
      const [x, y] = toPixel(view, pole);
      return [ring, svg('text', { class: 'track-value', x: x + 8, y: y - 6, translate: 'no' }, significant(value, 3))];
    });
    return [...lines, ...ends, ...zeros, ...crossings].filter((node) => node !== null);
  }

  /** The poles at one of the values. @param {number|null} index */
  point(index) {
    const poles = index === null ? [] : this.courses.map((course) => course[index]);
    const nodes = poles.map((p) => this.#ring(p, 'track-point', 4)).filter((node) => node !== null);
    this.here.replaceChildren(...nodes);
  }

  /** @param {Complex|undefined} p */
  #seen(p) {
    if (!p || !Number.isFinite(p.re) || !Number.isFinite(p.im)) return null;
    const { view } = this.plane;
    const [x, y] = toPixel(view, p);
    return Math.abs(x) > FAR * view.width || Math.abs(y) > FAR * view.height ? null : [x, y];
  }

  /** @param {Complex|undefined} p @param {string} name @param {number} r */
  #ring(p, name, r) {
    const at = this.#seen(p);
    return at && svg('circle', { class: name, 'data-testid': name, cx: at[0], cy: at[1], r });
  }

  /** @param {Complex|undefined} p @param {string} name @param {string} d */
  #mark(p, name, d) {
    const at = this.#seen(p);
    return at && svg('path', { class: name, d, transform: `translate(${at[0].toFixed(1)} ${at[1].toFixed(1)})` });
  }
}
