/**
 * The kernel `update` of kernels.wasm, its arrays made once for each number of states. Pure.
 * @typedef {import('./module.js').Block} Values
 * @typedef {import('./module.js').Kernels} Kernels
 */
import { AT } from './layout.js';
import { block, scratch } from './shapes.js';
import { SIGNATURES } from './table.js';

export class Updates {
  #numbers;
  #quiet;
  /** @type {Map<string, {run: () => unknown, filled: [string, Values][], values: Record<string, Values>}>} */
  #ready = new Map();

  /** @param {Kernels} kernels */
  constructor(kernels) {
    this.kernels = kernels;
    this.#numbers = kernels.array('f64', AT.NUMBERS);
    this.#quiet = kernels.array('f64', 1, 2); // what noise adds to measured angles
  }

  /** What an update takes; to be asked for anew after one. */
  get numbers() {
    return this.#numbers.floats;
  }

  /**
   * Runs it.
   * @param {number} size states of the loop @param {number} samples of its responses
   * @returns {import('./reply.js').Block} the block, until the next update
   */
  update(size, samples) {
    const { run, filled } = this.#of(size, samples);
    run();
    return Object.fromEntries(filled.map(([name, values]) => [name, values.floats]));
  }

  /** All its arrays by the names of its arguments. @param {number} size @param {number} samples */
  values(size, samples) {
    return this.#of(size, samples).values;
  }

  /** @param {number} size @param {number} samples */
  #of(size, samples) {
    const key = `${size} ${samples}`;
    const made = this.#ready.get(key) ?? this.#made(size, samples);
    this.#ready.set(key, made);
    return made;
  }

  /** @param {number} size @param {number} samples */
  #made(size, samples) {
    const name = 'update';
    const filled = arrays(this.kernels, block(size, samples));
    const all = [...filled, ...arrays(this.kernels, scratch(size, samples))]; // in the order of the kernel's arguments
    const own = { numbers: this.#numbers, noise: this.#quiet, size: this.kernels.array('f64', size) };
    const [, , , ...names] = SIGNATURES[name].takes.map((taken) => taken.name);
    const values = { ...own, ...Object.fromEntries(names.map((to, i) => [to, all[i][1]])) };
    return { run: this.kernels.bound(name, values), filled, values };
  }
}

/** @param {Kernels} kernels @param {ReturnType<typeof block>} shapes */
export const arrays = (kernels, shapes) =>
  Object.entries(shapes).map(
    ([own, [kind, ...shape]]) => /** @type {[string, Values]} */ ([own, kernels.array(kind, ...shape)]),
  );
