/**
 * The page's one state, and the only place that changes it. Knows no DOM and no network.
 *
 * `edit` changes the design (what the user chose), `editPlant` the plant of view Plant: each can be undone, in its own
 * view. `set` changes everything else. Views listen to `change` and read; whoever sends the design listens to `design`.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {import('../types.js').Pin} Pin
 * @typedef {import('../types.js').Choices} Choices
 * @typedef {{index?: number, plant: string, design?: import('../contract.js').SystemDesign|null}} PinnedPlant
 */
/**
 * @template T
 * @typedef {import('../types.js').Asked<T>} Asked
 */
import { scenarioBody } from './experiment.js';
import { History } from './history.js';
import { guarded } from './locks.js';
import { FULL_RANK } from './methods.js';
import { letterOf } from './pins.js';
import { MOST_PLANTS, samePlant } from './plant_pins.js';
import { fromWire } from './poles.js';
import { shownOf } from './preview.js';
import { OUTER, ROTORS, STRUCTURE } from './quantities.js';
import { NONE } from './requirements.js';
import { STANDARD_VIEW } from './views.js';

/** @returns {State} */
export const initialState = () => ({
  view: STANDARD_VIEW,
  presets: [],
  methods: [],
  design: null,
  reply: null,
  answered: null,
  heard: null,
  differences: 0,
  problem: null,
  preview: null,
  find: null,
  connection: 'connecting',
  motion: 'both',
  showLinear: true,
  showMarks: true,
  showLag: null,
  dragging: false,
  spread: 0,
  map: null,
  track: null,
  cloud: null,
  requirements: NONE,
  canUndo: false,
  canRedo: false,
  pins: [],
  locks: [],
  task: null,
  plant: null,
  plantPins: [],
  notice: null,
  fault: null,
  recorded: {
    preview: null,
    columns: null,
    driver: 'segments',
    busy: '',
    problem: null,
    overlay: null,
    overlaid: null,
    progress: null,
    found: null,
    foundFor: null,
  },
  beside: null,
});

/** The contract's fields of a design that are one value. @type {Set<string>} */
const PLAIN = new Set([...STRUCTURE, ...OUTER, ...ROTORS]);

/** Those that a preset or a design has. @param {Preset|Design} of @returns {Choices} */
const plainOf = (of) =>
  /** @type {Choices} */ (Object.fromEntries(Object.entries(of).filter(([name]) => PLAIN.has(name))));

/** What a preset proposes. @param {Preset} preset @param {Partial<Design>} [keep] @returns {Design} */
export function designOf(preset, keep = {}) {
  return {
    preset: preset.name,
    parameters: {},
    limits: {},
    rotors: {},
    friction: {},
    theta0: preset.operating_point?.theta ?? 0,
    poles: fromWire(preset.poles),
    rotor_poles: [preset.rotor_poles[0].re, preset.rotor_poles[1].re],
    method: FULL_RANK,
    ...plainOf(preset),
    loops: { pitch: { ...preset.loops.pitch }, yaw: { ...preset.loops.yaw } },
    scenario: {
      reference: { theta: preset.scenario?.reference?.theta ?? 0.2, psi: preset.scenario?.reference?.psi ?? 0.5 },
      duration: preset.scenario?.duration ?? 5,
    },
    ...keep,
  };
}

/** A design as the server's calls take it. @param {Design} design */
export function bodyOf(design) {
  return /** @satisfies {Asked<import('../contract.js').DesignRequest>} */ ({
    preset: design.preset,
    parameters: design.parameters,
    limits: design.limits,
    rotors: design.rotors,
    friction: design.friction,
    operating_point: { theta: design.theta0 },
    poles: design.poles,
    rotor_poles: design.rotor_poles,
    ...(design.observer && { observer: design.observer }),
    ...(design.weights && { weights: design.weights }),
    method: design.method,
    ...plainOf(design),
    loops: design.loops,
  });
}

/** The experiment, sampled for the screen. @param {Design} design */
export const scenarioOf = ({ scenario }) =>
  /** @satisfies {import('../contract.js').ScenarioChanges} */ ({ ...scenarioBody(scenario), samples: 501 });

/** All that the page shows of a design, asked of the server. @param {Design} design */
export const evaluationOf = (design) =>
  /** @satisfies {Asked<import('../contract.js').EvaluateRequest>} */ ({
    ...bodyOf(design),
    scenario: scenarioOf(design),
    each_axis: true,
  });

/** The message to the live socket. @param {Design} design @param {number} seq */
export const requestOf = (design, seq) =>
  /** @satisfies {Asked<import('../contract.js').LiveRequest>} */ ({ seq, ...evaluationOf(design) });

/** @param {Pick<State, 'presets'|'design'>} state @returns {Preset|undefined} */
export const presetOf = ({ presets, design }) => presets.find((p) => p.name === design?.preset);

/**
 * One view shows one axis at a time; who leaves it sees both again.
 * @param {State} before @param {Partial<State>} part @returns {Partial<State>}
 */
function motionIn(before, { view = before.view, motion }) {
  const wanted = motion ?? before.motion;
  if (view === 'explore') return { motion: wanted === 'both' ? 'theta' : wanted };
  return before.view === 'explore' ? { motion: motion ?? 'both' } : {};
}

export class Store extends EventTarget {
  /** @type {State} */ state = initialState();
  /** @type {History<Design>} */ #designs = new History();
  /** @type {History<string|null>} */ #plants = new History();
  /** @type {[state: State, as: State]|null} */ #shown = null;
  #pinned = 0;
  /** Counts the steps of undo: the edits of one gesture share a number. */
  step = 0;

  /** The state as it is drawn: perhaps with a design that is only previewed. */
  get shown() {
    if (this.#shown?.[0] !== this.state) this.#shown = [this.state, shownOf(this.state)];
    return this.#shown[1];
  }

  /** What a step back goes back in: a plant is seen in a view of its own. @param {Partial<State>} [part] */
  #history({ view = this.state.view } = {}) {
    return view === 'plant' ? this.#plants : this.#designs;
  }

  /** Changes what is not the design. @param {Partial<State>} part */
  set(part) {
    const { canUndo, canRedo } = this.#history(part);
    const elsewhere = part.view && part.view !== this.state.view && { preview: null };
    this.state = { ...this.state, ...part, ...elsewhere, ...motionIn(this.state, part), canUndo, canRedo };
    this.dispatchEvent(new Event('change'));
  }

  /**
   * Changes the design. Edits with the same gesture in a row are one step of undo.
   * @param {(d: Design) => Design} change
   * @param {{gesture?: string, stamp?: number}} [how] stamp: time of the input event
   */
  edit(change, { gesture, stamp } = {}) {
    const before = this.state.design;
    if (!before) return;
    const { locks, task } = this.state;
    const after = guarded(before, change(before), locks, task?.free);
    if (after === before) return;
    if (this.#designs.keep(before, gesture)) this.step += 1;
    this.#put(after, stamp);
  }

  /** Changes the plant, likewise. @param {string|null} plant @param {string} [gesture] */
  editPlant(plant, gesture) {
    const before = this.state.plant;
    if (plant === before || (plant !== null && before !== null && samePlant(plant, before))) return;
    if (this.#plants.keep(before, gesture)) this.step += 1;
    this.set({ plant });
  }

  /** Ends a gesture: the next edit is a new step of undo. */
  commit() {
    this.#plants.gesture = null;
    if (this.#designs.gesture === null) return;
    this.#designs.gesture = null;
    this.dispatchEvent(new Event('change')); // who waits for the hand to rest looks again
  }

  /** Whether a gesture goes on; a plant is told when the hand rests. */
  get busy() {
    return this.#designs.gesture !== null || this.state.dragging;
  }

  /** Starts afresh, without history. @param {Design} design */
  load(design) {
    this.#designs.clear();
    this.#plants.clear();
    this.step += 1;
    this.#put(design);
  }

  /** Takes a design as it is, whatever is locked; it can be undone. @param {Design} design */
  restore(design) {
    if (!this.state.design) return this.load(design);
    this.#designs.keep(this.state.design);
    this.step += 1;
    return this.#put(design);
  }

  undo() {
    this.#travel('undo');
  }

  redo() {
    this.#travel('redo');
  }

  /** @param {'undo'|'redo'} way */
  #travel(way) {
    const { design, plant, view, canUndo, canRedo } = this.state;
    if (!design || !(way === 'undo' ? canUndo : canRedo)) return;
    this.step += 1;
    if (view === 'plant') this.set({ plant: this.#plants[way](plant) });
    else this.#put(this.#designs[way](design));
  }

  /** @param {Design} design @param {number} [stamp] */
  #put(design, stamp) {
    const { canUndo, canRedo } = this.#history();
    this.state = { ...this.state, design, preview: null, canUndo, canRedo };
    this.dispatchEvent(new CustomEvent('design', { detail: { stamp } }));
    this.dispatchEvent(new Event('change'));
  }

  /** Keeps a design beside those that follow. @param {Design|null} [design] */
  pin(design = this.state.design) {
    const { reply, heard, pins } = this.state;
    if (!design) return;
    const index = [...pins.keys(), pins.length].find((i) => pins.every((p) => p.index !== i)) ?? pins.length;
    this.addPins([{ index, name: `Design ${letterOf(index)}`, design, reply: heard === design ? reply : null }]);
  }

  /** @param {Omit<Pin, 'id'>[]} pins */
  addPins(pins) {
    if (pins.length) this.set({ pins: [...this.state.pins, ...pins.map((pin) => ({ ...pin, id: ++this.#pinned }))] });
  }

  /** @param {number} id @param {Partial<Pin>} part */
  changePin(id, part) {
    this.set({ pins: this.state.pins.map((p) => (p.id === id ? { ...p, ...part } : p)) });
  }

  /** @param {number} id */
  unpin(id) {
    this.set({ pins: this.state.pins.filter((p) => p.id !== id) });
  }

  /** Makes a pinned design the present one. @param {number} id */
  usePin(id) {
    const pin = this.state.pins.find((p) => p.id === id);
    if (pin) this.edit(() => pin.design);
  }

  /** Keeps plants beside those that follow, as many as there is room for. @param {PinnedPlant[]} pins */
  addPlantPins(pins) {
    const { plantPins: kept } = this.state;
    const next = [...kept];
    for (const { index, plant, design = null } of pins) {
      const free = [...Array(MOST_PLANTS).keys()].filter((i) => next.every((pin) => pin.index !== i));
      if (!free.length || next.some((pin) => samePlant(pin.plant, plant))) continue;
      next.push({ index: free.includes(index ?? -1) ? Number(index) : free[0], id: ++this.#pinned, plant, design });
    }
    if (next.length > kept.length) this.set({ plantPins: next });
  }

  /** @param {number} id @param {Partial<import('../types.js').PlantPin>} part */
  changePlantPin(id, part) {
    this.set({ plantPins: this.state.plantPins.map((p) => (p.id === id ? { ...p, ...part } : p)) });
  }

  /** @param {number} id */
  unpinPlant(id) {
    this.set({ plantPins: this.state.plantPins.filter((p) => p.id !== id) });
  }

  /** @returns {Preset|undefined} */
  get preset() {
    return presetOf(this.state);
  }
}
