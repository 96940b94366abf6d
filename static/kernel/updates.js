/**
 * The kernel `update` of kernels.wasm, its arrays made once for each number of states. Pure.
 * @typedef {import('./module.js').Block} Values
 */
import { compiled, instantiated } from './module.js';
import { AT } from './layout.js';
import { block, scratch } from './shapes.js';
import { SIGNATURES } from './table.js';

/** Rejects where a browser has no WebAssembly, or may not have it. @param {Response|BufferSource} source of MODULE */
export const loadModule = async (source) => new Updates(await instantiated(await compiled(source)));

export class Updates {
  #numbers;
  #quiet;
  /** @type {Map<string, {run: () => unknown, filled: [string, Values][]}>} */ #ready = new Map();

  /** @param {import('./module.js').Kernels} kernels */
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
    const key = `${size} ${samples}`;
    const { run, filled } = this.#ready.get(key) ?? this.#made(key, size, samples);
    run();
    return Object.fromEntries(filled.map(([name, values]) => [name, values.floats]));
  }

  /** @param {string} key @param {number} size @param {number} samples */
  #made(key, size, samples) {
    const name = 'update';
    const arrays = (/** @type {typeof block} */ shapes) =>
      Object.entries(shapes(size, samples)).map(
        ([own, [kind, ...shape]]) => /** @type {[string, Values]} */ ([own, this.kernels.array(kind, ...shape)]),
      );
    const filled = arrays(block);
    const values = [...filled, ...arrays(scratch)].map(([, own]) => own); // in the order of the kernel's arguments
    const own = { numbers: this.#numbers, noise: this.#quiet, size: this.kernels.array('f64', size) };
    const [, , , ...names] = SIGNATURES[name].takes.map((taken) => taken.name);
    const run = this.kernels.bound(name, { ...own, ...Object.fromEntries(names.map((to, i) => [to, values[i]])) });
    const made = { run, filled };
    this.#ready.set(key, made);
    return made;
  }
}
