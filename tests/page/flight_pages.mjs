// A flight's parts for tests: a rig, its design in the air, and a page on which it flies.
import { readFileSync } from 'node:fs';
import { bodyOfFlight, Designs } from '../../static/flight/designs.js';
import { Flight } from '../../static/flight/index.js';
import { compiled, Flights, instantiated, MODULE } from '../../static/kernel/index.js';
import { designOf, Store } from '../../static/model/index.js';
import { PRESETS } from './presets.mjs';

const parameters = {
  ...{ K_pp: 0.204, K_py: 0.0068, K_yp: 0.0219, K_yy: 0.072, J_p: 0.0384, J_y: 0.0432 },
  ...{ m: 1.3872, l: 0.186, B_p: 0.8, B_y: 0.318, K_s: 0.0, g: 9.81 },
};
const known = { parameter_info: {}, limit_info: {}, encoders: { theta: 4096, psi: 8192 } };
export const PRESET = { ...known, ...PRESETS[0], parameters };
export const flights = new Flights(await instantiated(await compiled(readFileSync(MODULE))));
export const designs = new Designs(flights, () => [PRESET], unasked);

async function unasked() {
  throw new Error('Nobody is there.');
}

/** A design in the air. */
export const aboard = (part = {}) => designs.here(bodyOfFlight({ ...designOf(PRESET), ...part }, [PRESET]));
export const slowly = (design) => ({ ...design, poles: design.poles.map(({ re, im }) => ({ re: re / 2, im })) });
export const sampled = (sample_time) => ({ scenario: { ...designOf(PRESET).scenario, digital: { sample_time } } });

/** A flight on a page of its own, with a wall's clock in hand. */
export function page({ ask = unasked, now = () => 0 } = {}) {
  const store = new Store();
  store.set({ presets: [PRESET, { ...known, ...PRESETS[1] }] });
  store.load(designOf(PRESET));
  const flight = new Flight(store, flights, { ask, now });
  const heard = [];
  for (const type of ['start', 'change', 'takeover', 'did', 'cut', 'end'])
    flight.addEventListener(type, ({ detail }) => heard.push([type, detail]));
  const told = (type) => heard.filter(([own]) => own === type).map(([, detail]) => detail);
  let wall = 5000;
  const frames = (seconds, rate = 60) => {
    for (let n = 0; n < seconds * rate; n++) flight.frame((wall += 1000 / rate));
  };
  frames.late = (ms) => flight.frame((wall += ms));
  return { store, flight, told, frames };
}
