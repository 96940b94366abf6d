/**
 * The symmetric root locus, drawn as a track: where the optimal poles go as ρ, the factor on R, falls; a ring where it
 * is 1. One request is under way at a time, and the newest waits.
 * @typedef {import('../contract.js').RootLocus} RootLocus
 * @typedef {ReturnType<typeof import('./weights.js').locusBody>} Body
 */
import { rootLocus } from '../net/index.js';
import { setAttr, svg } from '../ui/index.js';
import { toPixel } from '../splane/index.js';
import { trackOf } from '../machine/index.js';

export class Locus {
  /** @type {RootLocus|null} */ #locus = null;
  /** @type {RootLocus|null} */ #drawn = null;
  /** What is to be shown, as JSON; empty: nothing. */ #key = '';
  #shown = '';
  #busy = false;

  /** @param {import('../splane/splane.js').SPlane} plane @param {() => void} changed it is to be drawn anew */
  constructor(plane, changed) {
    this.plane = plane;
    this.changed = changed;
    this.layer = svg('g', { class: 'locus', 'data-testid': 'locus', 'aria-hidden': 'true' });
    plane.svg.prepend(this.layer);
  }

  /** Whether it is drawn. */
  get drawn() {
    return this.#locus !== null;
  }

  /** @param {Body|null} body none where there is no locus to show */
  ask(body) {
    this.#key = body ? JSON.stringify(body) : '';
    if (!body) this.#put(null, '');
    else if (!this.#busy && this.#key !== this.#shown) this.#fetch(body, this.#key);
  }

  /** @param {Body} body @param {string} key */
  async #fetch(body, key) {
    this.#busy = true;
    const locus = await rootLocus(body).catch(() => null); // what is wrong is told where the design is asked for
    this.#busy = false;
    if (this.#key) this.#put(locus, key);
    if (this.#key && this.#key !== key) this.#fetch(JSON.parse(this.#key), this.#key);
  }

  /** @param {RootLocus|null} locus @param {string} key */
  #put(locus, key) {
    this.#shown = key;
    if (locus === this.#locus) return;
    this.#locus = locus;
    this.changed();
  }

  /** @param {boolean} fresh whether the view changed */
  draw(fresh) {
    const locus = this.#locus;
    if (!fresh && locus === this.#drawn) return;
    this.#drawn = locus;
    const { view } = this.plane;
    const middle = locus ? locus.rho.indexOf(1) : -1;
    setAttr(this.layer, 'data-shown', String(locus !== null));
    this.layer.replaceChildren(
      ...(locus?.poles ?? []).flatMap((path) => {
        const [cx, cy] = toPixel(view, path[middle]);
        return [
          ...trackOf(view, path, { line: 'locus-path', arrow: 'locus-arrow' }),
          svg('circle', { class: 'locus-one', cx: cx.toFixed(1), cy: cy.toFixed(1), r: 3.5 }),
        ];
      }),
    );
  }
}
