/** Shows what a link has locked: its controls are disabled and say why. The store is what keeps the values. */
import { LOCKS } from '../model/index.js';

const WHY = 'Locked by the link that opened this page';

export class LockedControls {
  /** @type {Element[]} */ #marked = [];
  #key = '';

  /** @param {HTMLElement} root */
  constructor(root) {
    this.root = root;
  }

  /**
   * Gives back what other locks held; before the panels, which disable what their own state forbids.
   * @param {import('../types.js').State} state
   * @returns {boolean} whether the locks are others
   */
  release({ locks }) {
    const key = locks.join();
    if (key === this.#key) return false;
    this.#key = key;
    for (const control of this.#marked) this.#free(control);
    this.#marked = [];
    this.root.dataset.locked = key.replaceAll(',', ' ');
    return true;
  }

  /** After the panels, which enable what their own state allows. @param {import('../types.js').State} state */
  render({ locks }) {
    for (const name of locks.filter((lock) => LOCKS[lock].controls)) {
      for (const control of this.root.querySelectorAll(LOCKS[name].controls))
        if (!(/** @type {HTMLInputElement} */ (control).disabled) || !control.hasAttribute('data-locked'))
          this.#lock(/** @type {HTMLInputElement} */ (control));
    }
  }

  /** @param {HTMLInputElement} control */
  #lock(control) {
    control.disabled = true;
    if (control.hasAttribute('data-locked')) return;
    control.dataset.locked = control.title;
    control.title = WHY;
    control.setAttribute('aria-disabled', 'true');
    control.setAttribute('aria-description', WHY);
    this.#marked.push(control);
  }

  /** @param {Element} control */
  #free(control) {
    const input = /** @type {HTMLInputElement} */ (control);
    input.disabled = false;
    input.title = input.dataset.locked ?? '';
    delete input.dataset.locked;
    for (const name of ['aria-description', 'aria-disabled']) input.removeAttribute(name);
  }
}
