/**
 * LQR by its weights, and a Kalman filter's poles: sliders where the poles stand as numbers, marks and the symmetric
 * root locus in the s-plane.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Complex} Complex
 */
import { placesPoles, presetOf } from '../model/index.js';
import { h, setAttr } from '../ui/index.js';
import { Locus } from './locus.js';
import { OwnMarks, sampleOf } from './marks.js';
import { WeightsPanel } from './panel.js';
import { isWeighted, locusBody } from './weights.js';

/** @type {readonly Complex[]} */ const NONE = [];

export class Optimal {
  /**
   * @param {import('../splane/splane.js').SPlane} plane
   * @param {HTMLElement} root where the poles stand as numbers
   * @param {import('../model/store.js').Store} store
   */
  constructor(plane, root, store) {
    this.store = store;
    this.root = root;
    this.panel = new WeightsPanel(root, store, () => this.render(store.state));
    this.locus = new Locus(plane, () => this.#draw(false));
    this.kalman = new OwnMarks(plane, 'kalman', 'Kalman filter');
    this.optimal = new OwnMarks(plane, 'optimal', 'LQR');
    const part = (/** @type {string} */ testid, /** @type {(Node|string)[]} */ ...inner) =>
      h('span', { 'data-testid': testid, hidden: true }, inner);
    this.keys = {
      optimal: part('key-optimal', sampleOf('optimal'), 'LQR’s poles'),
      locus: part('key-locus', 'line: root locus over ρ; ring: ρ = 1'),
      kalman: part('key-kalman', sampleOf('kalman'), 'Kalman filter’s poles'),
    };
    plane.svg.after(h('div', { class: 'cloud-words own-words' }, Object.values(this.keys)));
    const before = plane.over;
    plane.over = (fresh) => {
      before?.(fresh);
      this.#draw(fresh); // with the plane: a drag's poles are seen at once
    };
  }

  /** @param {boolean} fresh whether the view changed */
  #draw(fresh) {
    const state = this.store.shown;
    this.locus.draw(fresh);
    const [optimal, kalman] = [optimalPoles(state), kalmanPoles(state)];
    this.optimal.draw(optimal, fresh);
    this.kalman.draw(kalman, fresh);
    this.keys.optimal.hidden = !optimal.length;
    this.keys.locus.hidden = !this.locus.drawn;
    this.keys.kalman.hidden = !kalman.length;
  }

  /** @param {State} state */
  render(state) {
    const { design, problem, connection, preview } = state;
    const preset = presetOf(state);
    if (!design || !preset) return;
    const weighted = isWeighted(state);
    this.root.classList.toggle('weighted', weighted);
    this.panel.render(state, weighted);
    setAttr(this.locus.layer, 'visibility', preview ? 'hidden' : 'visible'); // it is the present design's
    if (connection !== 'lost' && !preview)
      this.locus.ask(weighted && !problem && this.panel.showsLocus ? locusBody(design, preset) : null);
    this.#draw(false);
  }
}

/** Of what is answered. @param {State} state */
const optimalPoles = (state) =>
  (!placesPoles(state) && state.answered?.method === state.design?.method && state.reply?.gains.optimal_poles) || NONE;

/** @param {State} state */
const kalmanPoles = ({ design, reply }) =>
  (design?.scenario.measured === 'observer' && design.observer?.method === 'kalman' && reply?.observer?.poles) || NONE;
