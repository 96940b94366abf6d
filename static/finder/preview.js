/**
 * Shows a design that is only looked at: the whole page has it while the pointer is on it. The present design, undo,
 * the link, locks and what was asked of the server stay as they are; leaving brings the present one back at once, since
 * it was never gone.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Reply} Reply
 */
import { evaluationOf } from '../model/index.js';
import { evaluateDesign, Latest } from '../net/index.js';

export class Preview {
  /** The server's answers. @type {WeakMap<Design, Reply>} */ #known = new WeakMap();
  /** @type {Latest<Design>} */ #asks = new Latest((design) => void this.#ask(design));

  /**
   * @param {import('../model/store.js').Store} store
   * @param {(design: Design) => Reply|null|undefined} compute  the page's own numbers, where it has them
   * @param {{ask?: typeof evaluateDesign, reach?: import('./reach.js').Reach}} [of]
   */
  constructor(store, compute, { ask = evaluateDesign, reach } = {}) {
    this.store = store;
    this.compute = compute;
    this.ask = ask;
    this.reach = reach;
  }

  /** The design that is looked at. */
  get design() {
    return this.store.state.preview?.design ?? null;
  }

  /** @param {Design} design */
  show(design) {
    const { state } = this.store;
    if (state.preview?.design === design) return;
    if (state.design === design) return this.end();
    const known = this.#known.get(design);
    const reply = known ?? this.compute(design) ?? null;
    // words are the server's: of this design where it has answered for it, else of the one that it answered last
    this.#put({ design, reply, heard: known ? design : state.heard });
    if (!reply) this.#asks.put(design);
  }

  /** @param {import('../types.js').Previewed} preview */
  #put(preview) {
    if (!this.store.state.preview) this.reach?.begin();
    if (preview.reply) this.reach?.show(preview.design, preview.reply);
    this.store.set({ preview });
  }

  end() {
    if (!this.store.state.preview) return;
    this.reach?.back();
    this.store.set({ preview: null });
  }

  /** Makes a design the present one: one step of undo. @param {Design} design */
  take(design) {
    const { preview } = this.store.state;
    const reply = this.#known.get(design) ?? (preview?.design === design ? preview.reply : null);
    this.store.edit(() => design);
    this.store.commit();
    // what was seen stays in sight until the server has answered
    if (reply && this.store.state.design === design) this.store.set({ reply, answered: design, problem: null });
  }

  /** @param {Design} design */
  async #ask(design) {
    const reply = await this.ask(evaluationOf(design)).catch(() => null); // then the present design stays in sight
    if (reply) this.#known.set(design, reply);
    // an answer that comes late, when another is looked at or none, is kept for the next time
    const { preview } = this.store.state;
    if (reply && preview?.design === design && !preview.reply) this.#put({ design, reply, heard: design });
    this.#asks.done();
  }
}
