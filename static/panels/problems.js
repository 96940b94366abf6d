/** Puts what the server refuses at the field that it names. */
import { setAttr } from '../ui/index.js';

export class FieldProblems {
  /** @type {import('../types.js').Problem|null} */ #shown = null;
  /** @type {Element|null} */ #marked = null;

  /** @param {HTMLElement} root */
  constructor(root) {
    this.root = root;
  }

  /** @param {import('../types.js').State} state */
  render({ problem }) {
    if (problem === this.#shown) return;
    this.#shown = problem;
    this.#marked?.classList.remove('refused');
    this.#marked?.removeAttribute('aria-description');
    this.#marked = problem?.field ? this.#find(problem.field) : null;
    this.#marked?.classList.add('refused');
    if (this.#marked)
      setAttr(this.#marked, 'aria-description', [problem?.detail, problem?.hint].filter(Boolean).join(' '));
  }

  /** The field itself, or the one whose path begins or continues it ("poles.0", "poles"). @param {string} path */
  #find(path) {
    const fields = [...this.root.querySelectorAll('[data-field]')];
    return (
      fields.find((f) => path.startsWith(f.getAttribute('data-field') ?? '-')) ??
      fields.find((f) => f.getAttribute('data-field')?.startsWith(path)) ??
      null
    );
  }
}
