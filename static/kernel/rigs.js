/**
 * Clouds of uncertain rigs, computed in a worker: the page itself only says what it wants, and is told.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {import('../types.js').Cloud} Cloud
 * @typedef {{module: WebAssembly.Module} & Partial<Record<'id'|'task', undefined>> |
 *   {id: number, task: import('./many.js').Task, module?: undefined}} Asked
 * @typedef {{ready?: true, id?: number, cloud?: Cloud|null, problem?: string}} Told
 */
import { lagOf } from '../model/index.js';
import { AT, PARAMETERS } from './layout.js';
import { fill, serves, sizeOf } from './numbers.js';

/** In the order of the kernel's factors. */
const UNCERTAIN = [...PARAMETERS, 'tau_p', 'tau_y'];

/**
 * Half widths in the kernel's order: of every parameter but g, and of each rotor that lags.
 * @param {Design} design @param {Preset} preset @param {number} spread  relative
 */
export const spreadsOf = (design, preset, spread) =>
  UNCERTAIN.map((name) => {
    if (name === 'tau_p' || name === 'tau_y')
      return lagOf(design, preset, name === 'tau_p' ? 'pitch' : 'yaw') > 0 ? spread : 0;
    return name !== 'g' && name in preset.parameters ? spread : 0;
  });

/**
 * @param {WebAssembly.Module} module
 * @param {() => Worker} [open]
 * @returns {Promise<Rigs>} rejects where there can be no such worker
 */
export async function loadRigs(
  module,
  open = () => new Worker(new URL('./rigs_worker.js', import.meta.url), { type: 'module' }),
) {
  const worker = open();
  await new Promise((ready, refused) => {
    const fail = (/** @type {string} */ why) => {
      worker.terminate();
      refused(new Error(why));
    };
    worker.onmessage = ({ data: { problem } }) => (problem ? fail(problem) : ready(null));
    worker.onerror = (event) => {
      event.preventDefault(); // told by who asked
      fail(event.message || 'the worker could not be loaded');
    };
    worker.postMessage(/** @type {Asked} */ ({ module }));
  });
  return new Rigs(worker);
}

export class Rigs {
  #id = 0;
  /** Once the worker has failed, it is not asked again. */ #broken = false;
  /** Who asked last. @type {((cloud: Cloud|null) => void)|null} */ #then = null;

  /** @param {Worker} worker which is ready */
  constructor(worker) {
    this.worker = worker;
    worker.onmessage = ({ data }) => this.#hear(data);
    worker.onerror = (event) => {
      event.preventDefault();
      this.#fail(event.message);
    };
  }

  /** @param {Design} design @param {Preset} preset */
  serves(design, preset) {
    return !this.#broken && serves(design, preset);
  }

  /**
   * Asks for a cloud: whoever asked before is told of the newest only what is already under way.
   * @param {Design} design  one that is served @param {Preset} preset
   * @param {Record<string, number>} spreads  half widths, by names of parameters and tau_p, tau_y
   * @param {number} rigs
   * @param {(cloud: Cloud|null) => void} then  told of a few rigs' responses, then of all; null: the kernel cannot
   * @param {Float64Array} [drawn]  by which the rigs differ, where that is not to be drawn: of each the factors of its
   *   parameters and of tau_p, tau_y
   */
  ask(design, preset, spreads, rigs, then, drawn) {
    const numbers = new Float64Array(AT.NUMBERS);
    fill(numbers, design, preset);
    const size = sizeOf(design, preset);
    const task = { numbers, size, spreads: UNCERTAIN.map((name) => spreads[name] ?? 0), rigs, drawn };
    this.#then = then;
    this.worker.postMessage(/** @type {Asked} */ ({ id: ++this.#id, task }), [numbers.buffer]);
  }

  /** Nobody waits any more. */
  forget() {
    this.#then = null;
  }

  /** @param {Told} told */
  #hear({ id, cloud = null, problem }) {
    if (problem) this.#fail(problem);
    // an older design's dots are nearer to the hand than none, but that it has none says nothing
    else if (cloud || id === this.#id) this.#then?.(cloud);
  }

  /** @param {string} message */
  #fail(message) {
    console.warn(message);
    this.#broken = true;
    this.worker.terminate();
    this.#then?.(null);
  }
}
