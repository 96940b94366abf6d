/**
 * One scale for all that is mapped of a figure: one colour is one value, in the plane and in the fields of the loops.
 * The plane's map leads; without one the fields have theirs together. Knows no DOM.
 * @typedef {import('./types.d.ts').Field} Field
 * @typedef {import('./types.d.ts').Asked} Asked
 */
import { CHOICES, finestOf, inUnit } from './choices.js';
import { levelsOf } from './levels.js';

/**
 * Levels of a field's own beside those of the scale: beyond it lines and their numbers still tell values apart, where
 * colours no longer do.
 * @param {number[]} scale @param {number[]} own
 */
export const beyond = (scale, own) =>
  scale.length
    ? [...own.filter((v) => v < scale[0]), ...scale, ...own.filter((v) => v > scale[scale.length - 1])]
    : own;

/** What is known of stable places, in the unit that is shown. @param {Field} field @param {string} name */
export const known = ({ values, stable }, name) =>
  Array.from(values, (v) => inUnit(name, v)).filter((v, i) => stable[i] === 2 && Number.isFinite(v));

/** Levels of these values alone. @param {number[]} values @param {string} name */
export const levelsIn = (values, name) =>
  CHOICES[name].levels ?? levelsOf(values, CHOICES[name].higher, finestOf(name));

export class Scale {
  /** Of what. */ name = '';
  /** @type {number[]} */ levels = [];
  /** @type {{name: string, levels: number[]}|null} */ #lead = null;
  /** @type {Map<string, {field: Field, asked: Asked}>} */ #fields = new Map();

  /** @param {() => boolean} busy  whether a hand moves something @param {() => void} changed */
  constructor(busy, changed) {
    this.busy = busy;
    this.changed = changed;
  }

  /** Whether the plane's map has it. */
  get isLed() {
    return this.#lead !== null;
  }

  /** The fields that it is of, where no plane leads. */
  get fields() {
    return [...this.#fields.values()];
  }

  /** The plane's. @param {string|null} name null: it has no map @param {number[]} levels */
  lead(name, levels) {
    this.#lead = name === null ? null : { name, levels };
    this.#update();
  }

  /** A field's. @param {string} key @param {Field|null} field @param {Asked|null} asked */
  put(key, field, asked) {
    if (field && asked) this.#fields.set(key, { field, asked });
    else this.#fields.delete(key);
    this.#update();
  }

  /** @param {string} name @returns {number[]} none where it is of another figure */
  of(name) {
    return name === this.name ? this.levels : [];
  }

  #update() {
    const name = this.#lead?.name ?? this.fields.at(-1)?.asked.measure.name ?? '';
    const led = this.#lead?.levels;
    // while something moves colours keep their meaning, so that one sees the valley move
    if (!led && name === this.name && this.levels.length && this.busy()) return;
    const values = led
      ? []
      : this.fields.flatMap(({ field, asked }) => (asked.measure.name === name ? known(field, name) : []));
    const levels = led ?? (name ? levelsIn(values, name) : []);
    if (name === this.name && String(levels) === String(this.levels)) return;
    this.name = name;
    this.levels = levels;
    this.changed();
  }
}
