/**
 * Asks the server for what a card shows: only while the card is seen, shortly after the last change of the design, and
 * never during a drag.
 */
import { messageOf } from '../text/index.js';
import { ProblemError } from '../net/index.js';
import { h, setText } from './dom.js';

const DELAY_MS = 300;

/** Tells whether it is seen, whenever that changes. @param {Element} node @param {(seen: boolean) => void} tell */
export const whileSeen = (node, tell) =>
  new IntersectionObserver((entries) => tell(entries[entries.length - 1].isIntersecting)).observe(node);

/** @template B, A */
export class Lazy {
  #key = '';
  #visible = false;
  #failed = false;
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #timer;

  /**
   * @param {HTMLElement} root
   * @param {HTMLElement} content what an answer fills; hidden until there is one
   * @param {import('../model/store.js').Store} store
   * @param {{wait: string, body: (d: import('../types.js').Design) => B, ask: (body: B) => Promise<A>,
   *   show: (answer: A) => void}} how
   */
  constructor(root, content, store, how) {
    this.root = root;
    this.content = content;
    this.store = store;
    this.how = how;
    this.status = h('p', { class: 'status', role: 'status' }, how.wait);
    root.append(this.status);
    content.hidden = true;
    whileSeen(root, (seen) => {
      this.#visible = seen;
      this.render(store.state);
    });
  }

  /** @param {import('../types.js').State} state */
  render({ design, dragging, connection }) {
    if (!design || !this.#visible || dragging || (this.#failed && connection !== 'open')) return;
    const body = this.how.body(design);
    const key = JSON.stringify(body);
    if (key === this.#key) return;
    this.#key = key;
    this.root.setAttribute('aria-busy', 'true');
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#run(body, key), this.content.hidden ? 0 : DELAY_MS);
  }

  /** @param {B} body @param {string} key */
  async #run(body, key) {
    if (this.store.state.dragging) {
      this.#key = ''; // asked again when the hand lets go
      return;
    }
    /** @type {A|undefined} */ let answer;
    let refused = '';
    try {
      answer = await this.how.ask(body);
    } catch (error) {
      if (key !== this.#key) return;
      this.#failed = !(error instanceof ProblemError);
      if (this.#failed) this.#key = '';
      const hint = error instanceof ProblemError ? error.problem.hint : 'It is tried again with the next change.';
      refused = [`This could not be computed: ${messageOf(error)}`, hint].filter(Boolean).join(' ');
    }
    if (!refused && key !== this.#key) return;
    if (!refused) this.how.show(/** @type {A} */ (answer));
    this.content.hidden = Boolean(refused);
    this.status.hidden = !refused;
    this.status.classList.toggle('failure', Boolean(refused));
    setText(this.status, refused);
    this.root.removeAttribute('aria-busy');
  }
}
