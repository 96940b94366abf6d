/**
 * The cloud of uncertain rigs in the s-plane: their poles as dots behind the plane's own, and in words how many of them
 * are stable. Its bands over time are the plots' own.
 * @typedef {import('../types.js').State} State
 */
import { h, setText } from '../ui/index.js';
import { drawCloud } from './dots.js';
import { CloudFeed, cloudWords } from './feed.js';

export class Clouds {
  /** @type {import('../types.js').Cloud|null} */ #cloud = null;

  /** @param {import('../splane/splane.js').SPlane} plane @param {import('../model/store.js').Store} store */
  constructor(plane, store) {
    this.plane = plane;
    this.feed = new CloudFeed(store);
    this.canvas = h('canvas', { class: 'cloud', hidden: true, 'aria-hidden': 'true' });
    this.words = h('div', { class: 'cloud-words', 'data-testid': 'cloud-words', role: 'status' });
    plane.backdrop.after(this.canvas);
    plane.readout.node.after(this.words);
    plane.under = () => this.#draw();
  }

  /** From now on the page computes what it can. @param {import('../kernel/index.js').Rigs} rigs */
  take(rigs) {
    this.feed.take(rigs);
  }

  /** @param {State} state */
  render(state) {
    this.feed.render(state); // first: others compute meanwhile
    const { design, spread, cloud, preview } = state;
    this.#cloud = spread && !preview ? cloud : null; // it is of the present design
    this.#draw();
    setText(this.words, cloudWords(this.#cloud, design?.scenario));
  }

  #draw() {
    drawCloud(this.canvas, this.plane.view, this.plane.unit, this.#cloud);
  }
}
