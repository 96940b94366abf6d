/**
 * The top line: which rig, where its numbers come from, what of them is changed, one step back or forth, pin and link,
 * and whether the server is there.
 */
import { say } from '../text/index.js';
import { changedWords, designOf, isOfRig, lockNames, presetOf } from '../model/index.js';
import { button, h, icon, setAttr, setText, svg } from '../ui/index.js';
import { ShareButtons } from './share.js';
import { viewLinks } from './views.js';

const STATUS = { connecting: 'connecting…', open: 'live', lost: 'connection lost' };

/** In place of the menu of exports, which is not of the first view, and as wide. */
const exportsToCome = () =>
  button(
    { disabled: true, 'aria-label': 'Export this design as a file' },
    h('span', { class: 'export' }, icon('save'), h('span', { class: 'word' }, 'Export')),
  );

export class HeaderPanel {
  /**
   * @param {HTMLElement} root
   * @param {import('../model/store.js').Store} store
   * @param {import('../link/address.js').Address} address
   */
  constructor(root, store, address) {
    this.store = store;
    this.select = h('select', {
      'data-testid': 'preset',
      'aria-label': 'Rig and parameter set',
      onchange: () => this.#choose(),
    });
    this.source = h('span', { class: 'source', 'data-testid': 'source' });
    const tool = (
      /** @type {string} */ id,
      /** @type {Node|string} */ text,
      /** @type {string} */ title,
      /** @type {() => void} */ act,
    ) => button({ 'data-testid': id, title, onclick: act }, text);
    const turn = (/** @type {string} */ id, /** @type {string} */ name) => {
      const drawing = svg('svg', { class: 'icon-tool turn', viewBox: '0 0 12 12', 'aria-hidden': 'true' });
      drawing.append(svg('path', { d: 'M 4.5 1.5 L 1.5 4.5 L 4.5 7.5 M 1.5 4.5 H 7.5 A 2.9 2.9 0 0 1 7.5 10.5 H 4' }));
      return h('span', { class: id }, drawing, h('span', { class: 'sr' }, name));
    };
    this.undo = tool('undo', turn('undo', 'Undo'), 'Undo (Ctrl+Z)', () => store.undo());
    this.redo = tool('redo', turn('redo', 'Redo'), 'Redo (Ctrl+Shift+Z)', () => store.redo());
    this.reset = tool('reset', 'Reset', "Back to this preset's parameters, poles, loops and steps", () =>
      this.#reset(),
    );
    this.pin = tool('pin', 'Pin', 'Keep this design beside those that follow: its poles, responses and figures', () =>
      store.pin(),
    );
    this.rig = h('a', {
      class: 'rig-link',
      href: '#rig',
      'data-testid': 'rig',
      title: 'The rig’s parameters and limits',
    });
    this.help = button(
      {
        'data-testid': 'help',
        'aria-label': 'Help',
        'aria-pressed': 'false',
        title: 'Help (?): what is tapped or takes the focus explains itself',
        onclick: () => this.#explain(),
      },
      '?',
    );
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
      ...viewLinks(),
      h('div', { class: 'rig' }, this.select, this.rig, this.locked, this.source),
      h(
        'div',
        { class: 'buttons' },
        h('span', {}, this.undo, this.redo),
        h('span', { 'data-views': 'explore design compare rig derivation' }, this.reset),
        h('span', { 'data-views': 'design compare rig derivation' }, this.pin),
        h('span', { 'data-views': 'design compare rig plant derivation' }, this.share.node),
        h('span', { 'data-views': 'design compare rig derivation', id: 'exports' }, exportsToCome()),
        this.help,
      ),
      this.status,
    );
    document.addEventListener('keydown', (e) => this.#key(e));
  }

  #choose() {
    const preset = this.store.state.presets.find((p) => p.name === this.select.value);
    if (preset) this.store.edit(() => this.#fresh(preset));
  }

  #reset() {
    const preset = this.store.preset;
    if (preset) this.store.edit(() => this.#fresh(preset));
  }

  /** As a rig comes: where one explores, without PI loops. @param {import('../types.js').Preset} preset */
  #fresh(preset) {
    return designOf(preset, this.store.state.view === 'explore' ? { outer: 'none' } : undefined);
  }

  async #explain() {
    this.#turn ??= import('./help.js').then(({ help }) => help(this.help));
    (await this.#turn)();
  }

  /** @type {Promise<() => void>|undefined} */ #turn;

  /** @param {KeyboardEvent} e */
  #key(e) {
    const { target } = e;
    const field =
      target instanceof HTMLTextAreaElement || (target instanceof HTMLInputElement && target.type === 'text');
    if (e.key === '?' && !field && !e.ctrlKey && !e.metaKey) this.#explain();
    if (!(e.ctrlKey || e.metaKey) || e.altKey || field) return;
    const key = e.key.toLowerCase();
    if (key !== 'z' && key !== 'y') return;
    e.preventDefault();
    if (key === 'y' || e.shiftKey) this.store.redo();
    else this.store.undo();
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    const { presets, design, connection, canUndo, canRedo, locks, task, problem } = state;
    const changed = design ? changedWords(design) : '';
    setText(this.rig, changed || 'Parameters');
    this.rig.hidden = !changed && !isOfRig(problem?.field); // else the view's own link is enough
    this.rig.classList.toggle('changed', Boolean(changed));
    this.rig.classList.toggle('refused', isOfRig(problem?.field));
    if (this.select.querySelectorAll(':scope > option').length !== presets.length)
      this.select.prepend(...presets.map((p) => h('option', { value: p.name, title: p.source }, p.title)));
    if (design?.rig) this.select.value = `own:${design.rig}`;
    if (design && !(design.rig && this.select.value)) this.select.value = design.preset;
    const source = presetOf({ presets, design })?.source ?? '';
    setText(this.source, source);
    this.source.title = source;
    this.locked.hidden = !locks.length || task !== null;
    setText(this.locked, locks.length ? say`locked: ${lockNames(locks)}` : '');
    setAttr(this.locked, 'title', 'Locked by the link that opened this page');
    this.undo.disabled = !canUndo;
    this.redo.disabled = !canRedo;
    this.status.className = `connection ${connection}`;
    setText(this.word, STATUS[connection]);
    this.kept.hidden = connection !== 'lost';
  }
}
