/**
 * The s-plane's section while one looks at other designs: it grows where their poles lie outside, and is as it was when
 * one leaves. What the user chose of it stays chosen.
 * @typedef {import('../types.js').Design} Design
 */
import { fit, outgrown } from '../splane/index.js';

export class Reach {
  /** Where one was when one began to look. @type {import('../splane/math.js').View|null} */ #left = null;

  /**
   * @param {Pick<import('../splane/splane.js').SPlane, 'view'>} plane
   * @param {import('../model/store.js').Store} store
   */
  constructor(plane, store) {
    this.plane = plane;
    this.store = store;
  }

  begin() {
    this.#left = this.plane.view;
  }

  /** @param {Design} design @param {import('../types.js').Reply} reply */
  show(design, reply) {
    const { view } = this.plane;
    const own = this.store.state.design?.poles ?? [];
    if (view.width && outgrown(view, design.poles))
      this.plane.view = fit([...own, ...design.poles], reply.loop_poles, view);
  }

  back() {
    if (this.#left?.width === this.plane.view.width) this.plane.view = this.#left;
  }
}
