/** "Own rigs": in the menu of rigs, and beside the parameters where they are kept, renamed, saved and opened. */
import { messageOf, say, t } from '../text/index.js';
import { evaluationOf, presetOf } from '../model/index.js';
import { evaluateDesign, ProblemError } from '../net/index.js';
import { button, h, keepingFocus, saveFile, setText } from '../ui/index.js';
import { fileName, fileOf, freeName, LONGEST_NAME, readFile, rigOf, sameRig, tidyName, withRig } from './own_rigs.js';
import { shelf } from './shelf.js';

/** @typedef {import('../types.js').OwnRig} OwnRig */
const OWN = 'own:';
const LARGEST_FILE = 100_000; // bytes

export class OwnRigs {
  #key = '';

  /**
   * @param {HTMLElement} root
   * @param {import('../model/store.js').Store} store
   */
  constructor(root, store) {
    this.store = store;
    this.shelf = shelf();
    this.menu = /** @type {HTMLSelectElement|null} */ (document.querySelector('[data-testid=preset]'));
    this.group = h('optgroup', { label: 'Own rigs' });
    this.name = h('input', {
      class: 'number',
      type: 'text',
      maxlength: LONGEST_NAME,
      autocomplete: 'off',
      'aria-label': 'Name of the rig to keep',
      placeholder: t('name of this rig'),
      'data-testid': 'own-name',
    });
    this.file = h('input', {
      type: 'file',
      accept: '.json,application/json',
      class: 'sr',
      tabindex: -1,
      'aria-label': 'File of a rig',
      'data-testid': 'own-file',
      onchange: () => this.#open(),
    });
    this.list = h('ul', { class: 'own-list', 'data-testid': 'own-list' });
    this.told = h('span', { role: 'status', 'data-testid': 'own-told' });
    /** @type {() => void} */ this.back = () => {};
    this.undo = button({ hidden: true, 'data-testid': 'own-undo', onclick: () => this.#undo() }, 'Undo');
    this.refused = h('p', { class: 'experiment-warning', role: 'status', 'data-testid': 'own-refused' });
    const form = h(
      'form',
      {
        class: 'row',
        onsubmit: (/** @type {Event} */ e) => {
          e.preventDefault();
          this.#keep();
        },
      },
      this.name,
      h(
        'button',
        {
          type: 'submit',
          'data-testid': 'own-keep',
          title: 'Keep these parameters, limits, rotors, friction and operating point in this browser',
        },
        'Keep',
      ),
      button({ 'data-testid': 'own-open', onclick: () => this.file.click() }, 'Open a file…'),
      this.file,
    );
    this.node = h(
      'div',
      { class: 'own-rigs' },
      h('p', { class: 'caption' }, 'Kept in this browser; in the menu of rigs above'),
      form,
      this.list,
      h('p', { class: 'row own-told' }, this.told, this.undo),
      this.refused,
    );
    root.append(this.node);
    this.menu?.append(this.group);
    this.menu?.addEventListener('change', () => {
      const { value } = /** @type {HTMLSelectElement} */ (this.menu);
      if (value.startsWith(OWN)) this.#use(value.slice(OWN.length));
    });
    this.shelf.addEventListener('change', () => this.render(store.state));
  }

  /** @param {string} words @param {(() => void)|null} [back] what undoes it */
  #tell(words, back = null) {
    setText(this.told, words);
    this.undo.hidden = !back;
    this.back = back ?? (() => {});
  }

  #undo() {
    this.back();
    this.#tell('Undone.');
    this.name.focus();
  }

  /** The present rig, under the name in the field. */
  #keep() {
    const { design } = this.store.state;
    const preset = presetOf(this.store.state);
    const name = tidyName(this.name.value) || design?.rig || '';
    if (!design || !preset) return;
    if (!name) {
      this.#tell('Give the rig a name first.');
      this.name.focus();
      return;
    }
    const rig = rigOf(design, preset, name);
    const before = this.shelf.keep(rig);
    this.store.edit((d) => ({ ...d, rig: name }));
    this.name.value = '';
    if (before && !sameRig(before, rig))
      this.#tell(say`${name} is kept in place of the one of that name.`, () => this.shelf.keep(before));
    else this.#tell(say`${name} is kept.`);
  }

  /** The present design follows its rig's name. @param {string} before @param {string} after */
  #called(before, after) {
    if (this.store.state.design?.rig === before) this.store.edit((d) => ({ ...d, rig: after }));
  }

  /** @param {string} name */
  #use(name) {
    const { presets, design } = this.store.state;
    const rig = this.shelf.named(name);
    const preset = rig && presets.find((p) => p.name === rig.preset);
    if (!rig || !preset) {
      if (rig) this.#tell(say`This server knows no rig “${rig.preset}”, from which ${name} stems.`);
      if (this.menu && design) this.menu.value = design.preset;
      return;
    }
    this.store.edit(() => withRig(rig, preset));
  }

  async #open() {
    const file = this.file.files?.[0];
    this.file.value = '';
    if (!file) return;
    if (file.size > LARGEST_FILE) return void this.#tell(say`${file.name} is too large to be a rig.`);
    const read = readFile(await file.text());
    if (read.refused !== undefined) return void this.#tell(`${file.name}: ${read.refused}`);
    const { presets } = this.store.state;
    const preset = presets.find((p) => p.name === read.rig.preset);
    if (!preset) return void this.#tell(say`${file.name}: preset: this server knows no rig “${read.rig.preset}”.`);
    this.#tell(say`Checking ${file.name}…`);
    try {
      await evaluateDesign(
        /** @type {ReturnType<typeof evaluationOf>} */ ({ ...evaluationOf(withRig(read.rig, preset)), ...read.body }),
      );
    } catch (error) {
      const {
        field = '',
        detail = '',
        hint = '',
      } = error instanceof ProblemError ? error.problem : { detail: messageOf(error) };
      return void this.#tell([field && `${field}: `, detail, hint && ` ${hint}`].join(''));
    }
    const name = freeName(this.shelf.rigs, read.rig.name);
    this.shelf.keep({ ...read.rig, name });
    this.#use(name);
    this.#tell(say`${name} is opened and kept.`);
  }

  /** @param {import('../types.js').State} state */
  render({ design, presets }) {
    const preset = presetOf({ presets, design });
    if (!design || !preset) return;
    const kept = design.rig === undefined ? undefined : this.shelf.named(design.rig);
    const changed = kept && !sameRig(kept, rigOf(design, preset, kept.name));
    const key = JSON.stringify([this.shelf.rigs.map((rig) => rig.name), design.rig, changed]);
    setText(this.refused, this.shelf.refused);
    if (key === this.#key) return;
    this.#key = key;
    const names = this.shelf.rigs.map((rig) => rig.name);
    const options = design.rig !== undefined && !kept ? [...names, design.rig] : names;
    this.group.hidden = !options.length;
    this.group.replaceChildren(
      ...options.map((name) => {
        const own = name === design.rig;
        const text = own && !kept ? say`${name} (not kept)` : own && changed ? say`${name} (changed)` : name;
        return h('option', { value: OWN + name, translate: 'no' }, text);
      }),
    );
    if (this.menu) this.menu.value = design.rig === undefined ? design.preset : OWN + design.rig;
    keepingFocus(this.list, () =>
      this.list.replaceChildren(...this.shelf.rigs.map((rig) => this.#row(rig, design.rig === rig.name))),
    );
  }

  /** @param {OwnRig} rig @param {boolean} present */
  #row(rig, present) {
    const { name } = rig;
    const tool = (
      /** @type {string} */ id,
      /** @type {string} */ text,
      /** @type {string} */ title,
      /** @type {() => void} */ act,
    ) => button({ 'data-testid': `own-${id}-${name}`, 'aria-label': title, title, onclick: act }, text);
    const field = h('input', {
      class: 'number',
      type: 'text',
      value: name,
      maxlength: LONGEST_NAME,
      autocomplete: 'off',
      'aria-label': say`Name of ${name}`,
      'data-testid': `own-rename-${name}`,
      onchange: () => {
        const after = tidyName(field.value);
        if (!this.shelf.rename(name, after)) {
          this.#tell(after ? say`Another rig is called ${after}.` : t('A rig needs a name.'));
          field.value = name;
          return;
        }
        this.#called(name, after);
        this.#tell(say`${name} is now ${after}.`, () => this.shelf.rename(after, name) && this.#called(after, name));
      },
    });
    return h(
      'li',
      { class: present ? 'present' : '' },
      field,
      tool('use', 'Use', say`Use ${name}`, () => this.#use(name)),
      tool('save', 'Save', say`Save ${name} as a file`, () => {
        saveFile(fileName(rig), new Blob([fileOf(rig)], { type: 'application/json' }));
        this.#tell(say`${fileName(rig)} is saved.`);
      }),
      tool('remove', 'Remove', say`Remove ${name}`, () => {
        const before = this.shelf.remove(name);
        if (before) this.#tell(say`${name} is removed.`, () => this.shelf.keep(before));
      }),
    );
  }
}
