/**
 * The uncertain rigs of goals on a cloud, computed when something is handed in: the core's own, which are in the
 * package. Pure, but for the worker.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {import('../types.js').Cloud} Cloud
 * @typedef {import('../kernel/index.js').Rigs} Rigs
 */
import { cloudScenario } from '../model/index.js';

/** Of a rig: its parameters, both rotors' time constants. */
const FACTORS = 14;

/** Numbers as they stand in the package. @param {string} text  base64 of their bytes, the lowest first */
export function numbersIn(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  return Float64Array.from({ length: bytes.length / 8 }, (_, i) => view.getFloat64(8 * i, true));
}

export class GoalClouds {
  /** @type {Promise<Pick<Rigs, 'serves'|'ask'>>|null} */ #rigs = null;
  /** One at a time: a worker leaves what it was asked before. @type {Promise<unknown>} */ #last = Promise.resolve();

  /** @param {Preset[]} presets @param {() => Promise<Pick<Rigs, 'serves'|'ask'>>} load  a worker of its own */
  constructor(presets, load) {
    this.presets = presets;
    this.load = load;
  }

  /**
   * @param {Design} design
   * @param {Float64Array} drawn  by which the rigs differ
   * @returns {Promise<Cloud|null>} null where it cannot be computed here
   */
  of(design, drawn) {
    const found = this.#last.then(() => this.#find(design, drawn));
    this.#last = found.catch(() => null);
    return found.catch(() => null);
  }

  /** @param {Design} design @param {Float64Array} drawn */
  async #find(design, drawn) {
    this.#rigs ??= this.load();
    const rigs = await this.#rigs;
    const preset = this.presets.find(({ name }) => name === design.preset);
    const calm = { ...design, scenario: cloudScenario(design.scenario) };
    if (!preset || !rigs.serves(calm, preset)) return null;
    const count = drawn.length / FACTORS;
    return new Promise((/** @type {(cloud: Cloud|null) => void} */ found) => {
      const told = (/** @type {Cloud|null} */ cloud) => {
        if (!cloud || cloud.judged === count) found(cloud); // else only the first few are
      };
      rigs.ask(calm, preset, {}, count, told, drawn);
    });
  }
}
