/**
 * What happens in a flight, each at a tick: what an event's values do to what acts (heli2dof_core/flight/events.py).
 * Pure.
 */
import { INPUT, WITHIN, WORDS } from '../kernel/index.js';

/** The word of an event that changes the design: it takes effect at the controller's next sample. */
export const DESIGN = 'design';

/** What acts where nobody does anything. */
export function nothingActs() {
  const u = new Float64Array(INPUT.FLIGHT_INPUTS);
  u.fill(1, INPUT.THRUST, INPUT.THRUST + 2);
  return u;
}

/** Refuses what is no event. @param {string} word @param {readonly number[]} values */
export function requireEvent(word, values) {
  const known = Object.hasOwn(WORDS, word) ? WORDS[word] : undefined;
  if (!known) throw new RangeError(`${word} is no word of a flight's log`);
  if (values.length !== known.length) throw new RangeError(`${word} takes ${known.length} values`);
  known.forEach(([name, unit, low, high], i) => {
    if (!(values[i] >= low && values[i] <= high))
      throw new RangeError(`${name} of ${word} is a number from ${low} to ${high} ${unit}, not ${values[i]}`);
  });
}

/** @typedef {(u: Float64Array, values: readonly number[], tick: number, step: number) => void} Act */

/** @param {number} at @returns {Act} */
const put = (at) => (u, values) => u.set(values, at);

/** @type {Record<string, Act>} */
const ACTS = {
  reference(u, values, tick) {
    u.set(values, INPUT.REFERENCE);
    u.fill(0, INPUT.TURN, INPUT.TURN + 2);
    u[INPUT.TURN_FROM] = tick;
  },
  turn(u, values, tick, step) {
    const since = (tick - u[INPUT.TURN_FROM]) * step;
    for (let i = 0; i < 2; i++) u[INPUT.REFERENCE + i] += since * u[INPUT.TURN + i];
    u.set(values, INPUT.TURN);
    u[INPUT.TURN_FROM] = tick;
  },
  hands: put(INPUT.MANUAL),
  sticks: put(INPUT.STICK),
  push: put(INPUT.PUSH),
  gust(u, [theta, psi, ticks], tick) {
    u.set([theta, psi], INPUT.GUST);
    u.set([tick, ticks], INPUT.GUST_FROM);
  },
  thrust: put(INPUT.THRUST),
  hung(u, [mass, arm]) {
    u.set([mass * arm * arm, mass * WITHIN.GRAVITY * arm], INPUT.HUNG);
  },
  stuck: put(INPUT.STUCK),
};

/**
 * A gust that blows lasts as long as it would have, though ticks are shorter from this one on by `ratio`.
 * @param {Float64Array} u @param {number} tick @param {number} ratio
 */
export function keepGust(u, tick, ratio) {
  const since = tick - u[INPUT.GUST_FROM];
  if (since > 0 && since < u[INPUT.GUST_TICKS])
    u.set([tick - since * ratio, u[INPUT.GUST_TICKS] * ratio], INPUT.GUST_FROM);
}

/**
 * Puts an event's values into what acts.
 * @param {Float64Array} u @param {string} word @param {readonly number[]} values @param {number} tick
 * @param {number} step  length of a tick, s
 */
export function act(u, word, values, tick, step) {
  ACTS[word](u, values, tick, step);
}
