/**
 * The page's one state, and the only place that changes it. Knows no DOM and no network.
 *
 * `edit` changes the design (what the user chose) and can be undone; `set` changes everything else. Views listen to
 * `change` and read; whoever sends the design listens to `design`.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {import('../types.js').Pin} Pin
 * @typedef {import('../types.js').Choices} Choices
 */
/**
 * @template T
 * @typedef {import('../types.js').Asked<T>} Asked
 */
import { scenarioBody } from './experiment.js';
import { guarded } from './locks.js';
import { FULL_RANK } from './methods.js';
import { letterOf } from './pins.js';
import { fromWire } from './poles.js';
import { OUTER, ROTORS, STRUCTURE } from './quantities.js';
import { NONE } from './requirements.js';
import { STANDARD_VIEW } from './views.js';

const DEPTH = 200;

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
  connection: 'connecting',
  motion: 'both',
  showLinear: true,
  showMarks: true,
  showLag: null,
  dragging: false,
  spread: 0,
  cloud: null,
  requirements: NONE,
  canUndo: false,
  canRedo: false,
  pins: [],
  locks: [],
  plant: null,
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
  /** @type {Design[]} */ #past = [];
  /** @type {Design[]} */ #future = [];
  /** @type {string|null} */ #gesture = null;
  #pinned = 0;
  /** Counts the steps of undo: the edits of one gesture share a number. */
  step = 0;

  /** Changes what is not the design. @param {Partial<State>} part */
  set(part) {
    this.state = { ...this.state, ...part, ...motionIn(this.state, part) };
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
    const after = guarded(before, change(before), this.state.locks);
    if (after === before) return;
    if (!gesture || gesture !== this.#gesture) {
      this.step += 1;
      this.#past.push(before);
      if (this.#past.length > DEPTH) this.#past.shift();
    }
    this.#gesture = gesture ?? null;
    this.#future = [];
    this.#put(after, stamp);
  }

  /** Ends a gesture: the next edit is a new step of undo. */
  commit() {
    if (this.#gesture === null) return;
    this.#gesture = null;
    this.dispatchEvent(new Event('change')); // who waits for the hand to rest looks again
  }

  /** Whether a gesture goes on. */
  get busy() {
    return this.#gesture !== null || this.state.dragging;
  }

  /** Starts afresh, without history. @param {Design} design */
  load(design) {
    this.#past = [];
    this.#future = [];
    this.#gesture = null;
    this.step += 1;
    this.#put(design);
  }

  /** Takes a design as it is, whatever is locked; it can be undone. @param {Design} design */
  restore(design) {
    if (!this.state.design) return this.load(design);
    this.#past.push(this.state.design);
    this.#future = [];
    this.#gesture = null;
    this.step += 1;
    return this.#put(design);
  }

  undo() {
    this.#travel(this.#past, this.#future);
  }

  redo() {
    this.#travel(this.#future, this.#past);
  }

  /** @param {Design[]} from @param {Design[]} to */
  #travel(from, to) {
    const design = from.pop();
    if (!design || !this.state.design) return;
    to.push(this.state.design);
    this.#gesture = null;
    this.step += 1;
    this.#put(design);
  }

  /** @param {Design} design @param {number} [stamp] */
  #put(design, stamp) {
    this.state = { ...this.state, design, canUndo: this.#past.length > 0, canRedo: this.#future.length > 0 };
    this.dispatchEvent(new CustomEvent('design', { detail: { stamp } }));
    this.dispatchEvent(new Event('change'));
  }

  /** Keeps the present design beside those that follow. */
  pin() {
    const { design, reply, heard, pins } = this.state;
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

  /** @returns {Preset|undefined} */
  get preset() {
    return presetOf(this.state);
  }
}
