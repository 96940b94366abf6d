/**
 * Where rigs of one's own are kept: in the browser, the same in all of its tabs. What it refuses to keep lives as long
 * as the page.
 * @typedef {import('../types.js').OwnRig} OwnRig
 */
import { t } from '../text/index.js';
import { keptText, readKept, withOne } from './own_rigs.js';

const KEY = 'heli2dof.rigs';

/** @returns {Storage|null} */
function own() {
  try {
    return globalThis.localStorage ?? null;
  } catch {
    return null; // storage is switched off
  }
}

export class Shelf extends EventTarget {
  /** @type {OwnRig[]} */ rigs = [];
  /** What the browser refuses, in words; empty where it does not. */
  refused = '';
  /** The text that was read or written last; undefined: none yet. @type {string|null|undefined} */ #text;

  /** @param {Storage|null} [storage] @param {EventTarget} [window] that tells of other tabs' changes */
  constructor(storage = own(), window = globalThis.window) {
    super();
    this.storage = storage;
    this.#read();
    window?.addEventListener('storage', (e) => {
      const { key } = /** @type {StorageEvent} */ (e);
      if (key === KEY || key === null) this.#read();
    });
  }

  /** What another tab may have changed. */
  #read() {
    let text;
    try {
      text = this.storage ? this.storage.getItem(KEY) : undefined;
    } catch {
      text = undefined;
    }
    if (text === undefined || text === this.#text) return;
    const read = readKept(text);
    this.refused = read
      ? ''
      : t('What this browser kept of your rigs cannot be read. It stays as it is until you keep a rig.');
    this.#text = text;
    if (read) this.rigs = read;
    this.dispatchEvent(new Event('change'));
  }

  /**
   * Changes what is kept, as it is now: another tab may have changed it since.
   * @param {(rigs: OwnRig[]) => OwnRig[]} change
   */
  #change(change) {
    if (!this.refused) this.#read();
    this.rigs = change(this.rigs);
    const text = keptText(this.rigs);
    try {
      if (!this.storage) throw new Error('storage is switched off');
      this.storage.setItem(KEY, text);
      this.#text = text;
      this.refused = '';
    } catch {
      this.refused = t(
        'This browser does not keep it: its storage is full or switched off. The rig is here until you leave; save ' +
          'it as a file.',
      );
    }
    this.dispatchEvent(new Event('change'));
  }

  /** @param {string} name */
  named(name) {
    return this.rigs.find((rig) => rig.name === name);
  }

  /** Keeps a rig, in the place of one of that name. @param {OwnRig} rig @returns {OwnRig|undefined} that one */
  keep(rig) {
    const before = this.named(rig.name);
    this.#change((rigs) => withOne(rigs, rig));
    return before;
  }

  /** @param {string} name @returns {OwnRig|undefined} what was removed */
  remove(name) {
    const before = this.named(name);
    if (before) this.#change((rigs) => rigs.filter((rig) => rig.name !== name));
    return before;
  }

  /** @param {string} name @param {string} after @returns {boolean} false where another one has that name */
  rename(name, after) {
    if (name === after) return true;
    if (!after || this.named(after)) return false;
    this.#change((rigs) => rigs.map((rig) => (rig.name === name ? { ...rig, name: after } : rig)));
    return true;
  }
}

/** @type {Shelf|undefined} */ let one;

/** The page's own. */
export const shelf = () => (one ??= new Shelf());
