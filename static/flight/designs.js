/**
 * Designs as a flight takes them: from a body of the REST calls to a controller, by the page's kernel or, for methods
 * that it does not know, by the server's numbers. Live or from a log, it is the body from which all is made. Pure, but
 * for `ask`.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {import('../bodies/bodies.js').Body} Body
 * @typedef {import('../kernel/index.js').Flights} Flights
 * @typedef {import('../kernel/flights.js').Controller} Controller
 * @typedef {(body: Body) => Promise<Float64Array>} Ask  the server for a design's numbers
 *
 * @typedef {object} Aboard  a design in flight
 * @property {Body} body  as its log has it
 * @property {Controller} controller
 * @property {[number, number]} noises  standard deviations on θ and ψ, rad
 * @property {[number, number]} reference  of its experiment, θ and ψ, rad
 */
import { bodyFrom, designFrom } from '../bodies/index.js';
import { designOf } from '../model/index.js';
import { call } from '../net/index.js';

/** What a preset says anyway, each part as JSON. @type {WeakMap<Preset, Map<string, string>>} */
const proposed = new WeakMap();

/**
 * What a log keeps of a design: as JSON has it, and but for the experiment nothing that its preset says anyway.
 * @param {Design} design @param {Preset[]} [presets]  without: all of it
 * @returns {Body}
 */
export function bodyOfFlight(design, presets = []) {
  const preset = presets.find(({ name }) => name === design.preset);
  const usual = preset && (proposed.get(preset) ?? partsOf(designOf(preset)));
  if (preset && usual) proposed.set(preset, usual);
  const own = [...partsOf(design)].filter(([name, text]) => KEPT.has(name) || text !== usual?.get(name));
  return /** @type {Body} */ (Object.fromEntries(own.map(([name, text]) => [name, JSON.parse(text)])));
}

/** What stands in every log. */
const KEPT = new Set(['preset', 'scenario']);

/** The parts of its body, each as JSON. @param {Design} design @returns {Map<string, string>} */
function partsOf(design) {
  const body = bodyFrom(design);
  const poles = body.poles?.map((pole) => (typeof pole === 'number' || pole.im ? pole : pole.re));
  const all = Object.entries({ ...body, ...(poles && { poles }) });
  const texts = all.map(([name, own]) => /** @type {[string, string]} */ ([name, JSON.stringify(own ?? null)]));
  return new Map(texts.filter(([, text]) => text !== 'null' && text !== '{}'));
}

/** @param {Design} design @param {Body} body @param {Controller} controller @returns {Aboard} */
function aboard({ scenario }, body, controller) {
  const { noise, digital, reference } = scenario;
  const own = digital?.noise ?? 0;
  return {
    ...{ body, controller, reference: [reference.theta, reference.psi] },
    noises: [Math.hypot(noise?.theta ?? 0, own), Math.hypot(noise?.psi ?? 0, own)],
  };
}

export class Designs {
  /** @type {WeakMap<Body, Aboard>} */ #known = new WeakMap();

  /** @param {Flights} flights @param {() => Preset[]} presets @param {Ask} [ask] */
  constructor(flights, presets, ask = askServer) {
    this.flights = flights;
    this.presets = presets;
    this.ask = ask;
  }

  /** By the page's kernel at once; null: by the server. @param {Body} body @returns {Aboard|null} */
  here(body) {
    const known = this.#known.get(body);
    if (known) return known;
    const presets = this.presets();
    const preset = presets.find(({ name }) => name === body.preset);
    if (!preset || body.split) return null;
    try {
      const design = designFrom(body, presets);
      const controller = this.flights.controller(design, preset);
      return controller && this.#keep(aboard(design, body, controller));
    } catch (problem) {
      console.error(problem); // a body of somebody else's making: the server says what is wrong with it
      return null;
    }
  }

  /** By whichever can. @param {Body} body @returns {Promise<Aboard>} */
  async of(body) {
    const own = this.here(body);
    if (own) return own;
    const controller = this.flights.controllerOf(await this.ask(body));
    if (!controller) throw new Error('the eigenvalues of the loop were not found');
    return this.#keep(aboard(designFrom(body, this.presets()), body, controller));
  }

  /** @param {Aboard} own */
  #keep(own) {
    this.#known.set(own.body, own);
    return own;
  }
}

/** @type {Ask} */
async function askServer(body) {
  const { numbers } = /** @type {{numbers: string}} */ (await call('api/v1/flights/controller', body));
  const bytes = Uint8Array.from(atob(numbers), (letter) => letter.charCodeAt(0));
  return new Float64Array(bytes.buffer); // little-endian, as every browser's machine is
}
