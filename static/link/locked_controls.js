/** Shows what a link or lab has locked: its controls are disabled and say why. The store is what keeps the values. */
import { LOCKS } from '../model/index.js';

export class LockedControls {
  /** @type {Element[]} */ #marked = [];
  #key = '';
  #why = '';

  /** @param {HTMLElement} root */
  constructor(root) {
    this.root = root;
  }

  /**
   * Gives back what other locks held; before the panels, which disable what their own state forbids.
   * @param {import('../types.js').State} state
   * @returns {boolean} whether the locks are others
   */
  release({ locks, task }) {
    const key = [locks, task?.free.map(({ name }) => name)].join();
    this.#why = task ? 'Fixed in this step' : 'Locked by the link that opened this page';
    if (key === this.#key) return false;
    this.#key = key;
    for (const control of this.#marked) this.#free(control);
    this.#marked = [];
    this.root.dataset.locked = task ? '' : locks.join(' ');
    return true;
  }

  /** After the panels, which enable what their own state allows. @param {import('../types.js').State} state */
  render({ locks, task }) {
    for (const name of locks.filter((lock) => LOCKS[lock].controls)) {
      for (const control of this.root.querySelectorAll(LOCKS[name].controls))
        if (
          (!(/** @type {HTMLInputElement} */ (control).disabled) || !control.hasAttribute('data-locked')) &&
          !task?.free.some((lock) => control.matches(lock.controls))
        )
          this.#lock(/** @type {HTMLInputElement} */ (control));
    }
  }

  /** @param {HTMLInputElement} control */
  #lock(control) {
    control.disabled = true;
    if (control.hasAttribute('data-locked')) return;
    control.dataset.locked = control.title;
    control.title = this.#why;
    control.setAttribute('aria-disabled', 'true');
    control.setAttribute('aria-description', this.#why);
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
