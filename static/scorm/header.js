/** The top line: which lab, that it is practice, and one step back or forth. */
import { button, h } from '../ui/index.js';

export class Header {
  /**
   * @param {HTMLElement} root @param {import('../model/store.js').Store} store
   * @param {import('./content.js').Content} content
   */
  constructor(root, store, { lab }) {
    this.undo = button({ 'data-testid': 'undo', title: 'Undo (Ctrl+Z)', onclick: () => store.undo() }, 'Undo');
    this.redo = button({ 'data-testid': 'redo', title: 'Redo (Ctrl+Shift+Z)', onclick: () => store.redo() }, 'Redo');
    root.append(
      h('strong', { class: 'lab-title', translate: 'no' }, lab.title),
      h(
        'span',
        {
          class: 'practice',
          title: 'The page marks itself, and holds the answers: it is practice and no proof of who did what.',
        },
        'Practice: this page marks itself',
      ),
      h('span', {}, this.undo, this.redo),
    );
    document.addEventListener('keydown', (e) => {
      const field = e.target instanceof HTMLTextAreaElement || e.target instanceof HTMLInputElement;
      if (!(e.ctrlKey || e.metaKey) || e.altKey || field) return;
      const key = e.key.toLowerCase();
      if (key !== 'z' && key !== 'y') return;
      e.preventDefault();
      if (key === 'y' || e.shiftKey) store.redo();
      else store.undo();
    });
  }

  /** @param {import('../types.js').State} state */
  render({ canUndo, canRedo }) {
    this.undo.disabled = !canUndo;
    this.redo.disabled = !canRedo;
  }
}
