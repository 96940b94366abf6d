/**
 * The top line: which rig, where its numbers come from, what of them is changed, one step back or forth, pin and link,
 * and whether the server is there.
 */
import { say } from '../text/index.js';
import { designOf, lockNames, presetOf } from '../model/index.js';
import { button, h, setAttr, setText } from '../ui/index.js';
import { exportMenu } from './export_menu.js';
import { RigPanel } from './rig.js';
import { ShareButtons } from './share.js';

const STATUS = { connecting: 'connecting…', open: 'live', lost: 'connection lost' };

export class HeaderPanel {
  /**
   * @param {HTMLElement} root
   * @param {import('../model/store.js').Store} store
   * @param {import('../link/address.js').Address} address
   * @param {{tour: (from: HTMLElement) => void, projector: import('../ui/projector.js').Projector}} aids
   */
  constructor(root, store, address, { tour, projector }) {
    this.store = store;
    this.select = h('select', {
      'data-testid': 'preset',
      'aria-label': 'Rig and parameter set',
      onchange: () => this.#choose(),
    });
    this.source = h('span', { class: 'source', 'data-testid': 'source' });
    const tool = (
      /** @type {string} */ id,
      /** @type {string} */ text,
      /** @type {string} */ title,
      /** @type {() => void} */ act,
    ) => button({ 'data-testid': id, title, onclick: act }, text);
    this.undo = tool('undo', 'Undo', 'Undo (Ctrl+Z)', () => store.undo());
    this.redo = tool('redo', 'Redo', 'Redo (Ctrl+Shift+Z)', () => store.redo());
    this.reset = tool('reset', 'Reset', "Back to this preset's parameters, poles, loops and steps", () =>
      this.#reset(),
    );
    this.pin = tool('pin', 'Pin', 'Keep this design beside those that follow: its poles, responses and figures', () =>
      store.pin(),
    );
    this.rig = new RigPanel(store);
    this.tour = tool('tour-open', 'Tour', 'Five hints on what can be done here', () => tour(this.tour));
    this.projector = tool('projector', 'Aa', 'Projector: large type and thick lines', () =>
      this.projector.setAttribute('aria-pressed', String(projector.toggle())),
    );
    this.projector.setAttribute('aria-pressed', String(projector.on));
    setAttr(this.projector, 'aria-label', 'Projector mode');
    this.share = new ShareButtons(store, address);
    this.locked = h('span', { class: 'locked', hidden: true, 'data-testid': 'locked' });
    this.status = h(
      'span',
      { class: 'connection', role: 'status', 'data-testid': 'connection' },
      h('span', { class: 'dot', 'aria-hidden': 'true' }),
      (this.word = h('span')),
      (this.kept = h('span', { class: 'kept', hidden: true }, 'your changes are kept')),
    );
    root.append(
      h('div', { class: 'rig' }, this.select, this.rig.node, this.locked, this.source),
      h(
        'div',
        { class: 'buttons' },
        this.undo,
        this.redo,
        this.reset,
        this.pin,
        this.share.node,
        exportMenu(store, address),
        h('a', { class: 'button', href: '#compare', title: 'Methods side by side' }, 'Compare'),
        h('a', { class: 'button', href: '#formulas' }, 'Formulas'),
        h('a', { class: 'button', href: '#paper', title: 'The paper, step by step' }, 'Paper'),
        this.tour,
        this.projector,
      ),
      this.status,
    );
    document.addEventListener('keydown', (e) => this.#key(e));
  }

  #choose() {
    const preset = this.store.state.presets.find((p) => p.name === this.select.value);
    if (preset) this.store.edit(() => designOf(preset));
  }

  #reset() {
    const preset = this.store.preset;
    if (preset) this.store.edit(() => designOf(preset));
  }

  /** @param {KeyboardEvent} e */
  #key(e) {
    const field = e.target instanceof HTMLInputElement && e.target.type === 'text';
    if (!(e.ctrlKey || e.metaKey) || e.altKey || field) return;
    const key = e.key.toLowerCase();
    if (key !== 'z' && key !== 'y') return;
    e.preventDefault();
    if (key === 'y' || e.shiftKey) this.store.redo();
    else this.store.undo();
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    const { presets, design, connection, canUndo, canRedo, locks } = state;
    this.rig.render(state);
    if (this.select.querySelectorAll(':scope > option').length !== presets.length)
      this.select.prepend(...presets.map((p) => h('option', { value: p.name, title: p.source }, p.title)));
    if (design?.rig) this.select.value = `own:${design.rig}`;
    if (design && !(design.rig && this.select.value)) this.select.value = design.preset;
    const source = presetOf({ presets, design })?.source ?? '';
    setText(this.source, source);
    this.source.title = source;
    this.locked.hidden = !locks.length;
    setText(this.locked, locks.length ? say`locked: ${lockNames(locks)}` : '');
    setAttr(this.locked, 'title', 'Locked by the link that opened this page');
    this.undo.disabled = !canUndo;
    this.redo.disabled = !canRedo;
    this.status.className = `connection ${connection}`;
    setText(this.word, STATUS[connection]);
    this.kept.hidden = connection !== 'lost';
  }
}
