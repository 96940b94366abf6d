/**
 * Where labs stand: beside the instrument in a wide window, else a sheet from below that is drawn up and down by its
 * handle: with a pointer, by its button, by the arrow keys.
 */
import { button, h, setAttr } from '../ui/index.js';

/** How high, as CSS has it (labs.css). */
const HEIGHTS = /** @type {const} */ (['low', 'half', 'full']);
const SHARES = [0.14, 0.42, 0.88];
const WORDS = { low: 'Show the lab', half: 'Enlarge the lab', full: 'Make the lab small' };

export class Sheet {
  /** @type {number|null} where the pointer took hold of it */ #from = null;
  #moved = false;

  /** @param {HTMLElement} body */
  constructor(body) {
    this.page = document.documentElement;
    this.handle = button(
      {
        class: 'lab-handle',
        'data-testid': 'lab-handle',
        'aria-controls': 'lab',
        onclick: () => {
          if (!this.#moved) this.#set(HEIGHTS[(this.#at + 1) % HEIGHTS.length]);
          this.#moved = false;
        },
        onkeydown: (/** @type {KeyboardEvent} */ e) => {
          const step = { ArrowUp: 1, ArrowDown: -1 }[e.key];
          if (step) e.preventDefault();
          if (step) this.#set(HEIGHTS[Math.max(0, Math.min(2, this.#at + step))]);
        },
        onpointerdown: (/** @type {PointerEvent} */ e) => {
          this.#from = e.clientY;
          this.handle.setPointerCapture(e.pointerId);
        },
        onpointermove: (/** @type {PointerEvent} */ e) => this.#drag(e.clientY),
        onpointerup: () => this.#drop(),
        onpointercancel: () => this.#drop(),
      },
      h('span', { class: 'lab-grip', 'aria-hidden': 'true' }),
    );
    this.node = h('aside', { id: 'lab', class: 'lab-dock', 'aria-label': 'Lab', hidden: true }, this.handle, body);
  }

  get #at() {
    return HEIGHTS.findIndex((height) => height === this.page.dataset.sheet);
  }

  /** @param {typeof HEIGHTS[number]} height */
  #set(height) {
    this.page.dataset.sheet = height;
    this.node.style.removeProperty('height');
    setAttr(this.handle, 'aria-label', WORDS[height]);
    setAttr(this.handle, 'aria-expanded', String(height !== 'low'));
  }

  /** @param {number} y */
  #drag(y) {
    if (this.#from === null) return;
    if (Math.abs(y - this.#from) > 4) this.#moved = true;
    if (this.#moved) this.node.style.height = `${Math.max(64, Math.min(innerHeight * 0.92, innerHeight - y + 12))}px`;
  }

  #drop() {
    const share = this.node.offsetHeight / innerHeight;
    if (this.#from !== null && this.#moved) {
      const nearest = SHARES.map((own) => Math.abs(own - share));
      this.#set(HEIGHTS[nearest.indexOf(Math.min(...nearest))]);
    }
    this.#from = null;
  }

  show() {
    this.node.hidden = false;
    this.page.classList.add('with-lab');
    if (this.#at < 0) this.#set('half');
  }

  /** In sight, where it was small. */
  rise() {
    this.show();
    if (this.#at === 0) this.#set('half');
  }

  hide() {
    this.node.hidden = true;
    this.page.classList.remove('with-lab');
    delete this.page.dataset.sheet;
  }
}
