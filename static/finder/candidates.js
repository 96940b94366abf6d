/**
 * What was found, as designs of the page: what was free, over the design that the search began with, without what is
 * locked. One object for each, so that it is known again after undo. Pure.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').State} State
 * @typedef {import('./shapes.js').Found} Found
 */
import { evaluationOf, guarded } from '../model/index.js';
import { bodyFrom, designFrom, merged } from '../bodies/index.js';

/** What of a design the search left as it was, as JSON. @param {Design} design @param {string[]} free */
function restOf(design, free) {
  return JSON.stringify(Object.entries(evaluationOf(design)).filter(([name]) => !free.includes(name)));
}

export class Candidates {
  /** @type {(Design|undefined)[]} */ #designs;
  #base;
  #locks = '';
  /** @type {string[]} */ #free;

  /** @param {Found} found @param {Design} from the design that the search began with */
  constructor(found, from) {
    this.found = found;
    this.from = from;
    this.#base = from;
    this.#designs = Array(found.designs.length);
    this.#free = [...new Set(found.designs.flatMap(({ design }) => Object.keys(design)))];
  }

  /**
   * Follows the present design: of one with another rig or experiment, what was found is put over that.
   * @param {State} state
   * @returns {boolean} whether the figures are still those of the designs
   */
  follow({ design, locks, task }) {
    const key = [locks, task?.free.map(({ name }) => name)].join();
    const rest = design && restOf(design, this.#free);
    if (design && (key !== this.#locks || rest !== restOf(this.#base, this.#free))) {
      this.#base = rest === restOf(this.from, this.#free) ? this.from : design;
      this.#designs = Array(this.found.designs.length);
      this.#locks = key;
    }
    return rest === restOf(this.from, this.#free);
  }

  /** @param {number} i @param {Pick<State, 'presets'|'locks'|'task'>} state @returns {Design} */
  design(i, { presets, locks, task }) {
    const made = this.#designs[i];
    if (made) return made;
    const own = designFrom(merged(bodyFrom(this.#base), this.found.designs[i].design), presets);
    const found = Object.fromEntries(Object.entries(own).filter(([name]) => this.#free.includes(name)));
    return (this.#designs[i] = guarded(this.#base, { ...this.#base, ...found }, locks, task?.free));
  }

  /** Which of them it is. @param {Design|null} design @returns {number} −1: none */
  indexOf(design) {
    return design ? this.#designs.indexOf(design) : -1;
  }
}
