/**
 * Computes what pinned designs come to, and keeps them over a reload of the tab, with pinned plants. Pins stand in the
 * tab's storage in the words of a link, so that an older page's are read as an older link is.
 * @typedef {import('../types.js').State} State
 */
import { evaluationOf } from '../model/index.js';
import { evaluateDesign, ProblemError } from '../net/index.js';
import { linkOf, readLink } from './permalink.js';

const KEY = 'heli2dof-pins';

/** @param {{name: string, design: unknown}} pin */
const identity = ({ name, design }) => JSON.stringify([name, design]);

export class PinKeeper {
  /** @type {State['pins']} */ #seen = [];
  /** @type {State['plantPins']} */ #plants = [];
  #opened = false;
  #busy = false;
  #failed = false;

  /** @param {import('../model/store.js').Store} store @param {{ask?: typeof evaluateDesign, storage?: Storage}} [of] */
  constructor(store, { ask = evaluateDesign, storage = globalThis.sessionStorage } = {}) {
    this.store = store;
    this.ask = ask;
    this.storage = storage;
  }

  /** Brings back the tab's own pins, beside those of the link. */
  open() {
    const { presets, methods, pins } = this.store.state;
    const { pins: kept = [], plantPins = [] } = readLink(this.storage.getItem(KEY) ?? '', { presets, methods });
    const there = new Set(pins.map(identity));
    const letters = new Set(pins.map((p) => p.index));
    const free = () => {
      let i = 0;
      while (letters.has(i)) i += 1;
      return i;
    };
    this.store.addPins(
      kept
        .filter((pin) => !there.has(identity(pin)))
        .map((pin) => {
          const index = letters.has(pin.index) ? free() : pin.index;
          letters.add(index);
          return { ...pin, index, reply: null };
        }),
    );
    this.store.addPlantPins(plantPins);
    this.#opened = true;
  }

  /** @param {State} state */
  render(state) {
    if (!this.#opened) return;
    if (state.connection !== 'open') this.#failed = false; // asked again when it is back
    if (state.pins !== this.#seen || state.plantPins !== this.#plants) {
      this.#seen = state.pins;
      this.#plants = state.plantPins;
      this.#keep(state);
    }
    if (!this.#busy && !this.#failed && !state.dragging && state.connection === 'open') this.#compute();
  }

  /** @param {State} state */
  #keep(state) {
    try {
      if (state.pins.length || state.plantPins.length)
        this.storage.setItem(KEY, linkOf(state, { presets: state.presets, methods: state.methods }, null, Infinity));
      else this.storage.removeItem(KEY);
    } catch {
      // A full or forbidden storage: the pins live as long as the page.
    }
  }

  async #compute() {
    const pin = this.store.state.pins.find((p) => !p.reply && !p.refused);
    if (!pin) return;
    this.#busy = true;
    /** @type {Partial<import('../types.js').Pin>|null} */ let part = null;
    try {
      part = { reply: await this.ask(evaluationOf(pin.design)) };
    } catch (error) {
      if (error instanceof ProblemError) part = { refused: error.message };
      else this.#failed = true;
    }
    this.#busy = false;
    if (part) this.store.changePin(pin.id, part);
  }
}
