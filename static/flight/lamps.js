/**
 * Lamps of a flight: what is so now that is seen in no curve at once. One that was lit for a tick glows on for a while,
 * so that a short saturation is seen; those who hear the page are told, but not of every flicker.
 * @typedef {'full_p'|'full_y'|'stop'|'hands'|'stuck'|'weak'|'hung'|'slow'} LampName
 * @typedef {'off'|'glow'|'on'} Glow  glow: no more, but not long ago
 */
import { INPUT, ROW } from '../kernel/index.js';
import { percent, say, t } from '../text/index.js';
import { h, setAttr, setText } from '../ui/index.js';
import { FLAG, flagsOf } from './trace.js';

/** How long a lamp glows on, ms. */
export const HOLD = 600;
/** How often one is told in words what is lit, ms. */
const TOLD = 2500;
/** Pace of the wall below which time is slow. */
const SLOW = 0.95;
const { FLIGHT_ROW } = ROW;

/** What each says, and what it means. @type {Readonly<Record<LampName, [words: string, title: string]>>} */
const LAMPS = {
  full_p: ['Pitch limit', 'The pitch motor’s voltage is at its limit'],
  full_y: ['Yaw limit', 'The yaw motor’s voltage is at its limit'],
  stop: ['Stop', 'Pitch rests on a stop, or has just hit one'],
  hands: ['Hands on', 'The sticks are the motors’ voltages; no controller flies'],
  stuck: ['Encoder', 'An encoder sticks: what is measured does not move'],
  weak: ['Rotor', 'A rotor has lost or gained thrust'],
  hung: ['Mass', 'A mass hangs on the rig'],
  slow: ['Slow', 'This machine does not keep up: time passes more slowly'],
};
const NAMES = /** @type {LampName[]} */ (Object.keys(LAMPS));

/** How lamps are lit, in time. Pure. */
export class LampStates {
  /** When each was lit last, ms. @type {Map<LampName, number>} */ #lit = new Map();
  /** @type {Set<LampName>} */ #now = new Set();
  #flags = 0; // of the rows since the last look
  #last = 0; // of the last row
  #impacts = 0;

  /** All are off. */
  clear() {
    this.#lit.clear();
    this.#now.clear();
    this.#flags = this.#last = this.#impacts = 0;
  }

  /** Ticks that were flown. @param {Float64Array} rows @param {number} count @param {ArrayLike<number>} limits  V */
  put(rows, count, limits) {
    for (let i = 0; i < count; i++) {
      this.#last = flagsOf(rows, i * FLIGHT_ROW, limits);
      this.#flags |= this.#last;
    }
  }

  /**
   * What is so now.
   * @param {number} now  ms
   * @param {{u?: ArrayLike<number>, impacts?: number, slow?: number, still?: boolean}} of  u: what acts; slow: share of
   *   the wall's pace; still: time stands still, and what glows glows on
   */
  look(now, { u, impacts = 0, slow = 1, still = false }) {
    const acts = (/** @type {number} */ at) => u !== undefined && (u[at] !== 0 || u[at + 1] !== 0);
    const weak = u !== undefined && (u[INPUT.THRUST] !== 1 || u[INPUT.THRUST + 1] !== 1);
    const hit = impacts > this.#impacts;
    this.#impacts = impacts;
    this.#light('full_p', now, this.#last & FLAG.FULL, this.#flags & FLAG.FULL, still);
    this.#light('full_y', now, this.#last & FLAG.FULL_YAW, this.#flags & FLAG.FULL_YAW, still);
    this.#light('stop', now, this.#last & FLAG.STOP, hit || this.#flags & FLAG.STOP, still);
    this.#switch('hands', u !== undefined && u[INPUT.MANUAL] !== 0);
    this.#switch('stuck', acts(INPUT.STUCK));
    this.#switch('weak', weak);
    this.#switch('hung', acts(INPUT.HUNG));
    this.#switch('slow', !still && slow < SLOW);
    this.#flags = 0;
  }

  /**
   * One that glows on.
   * @param {LampName} name @param {number} now  ms
   * @param {number} lit  whether it is so in the last row
   * @param {number|boolean} was  whether it was since the last look
   * @param {boolean} still
   */
  #light(name, now, lit, was, still) {
    this.#switch(name, lit !== 0);
    if (lit !== 0 || was || (still && this.#lit.has(name))) this.#lit.set(name, now);
    else if (now - (this.#lit.get(name) ?? -Infinity) >= HOLD) this.#lit.delete(name);
  }

  /** @param {LampName} name @param {boolean} on */
  #switch(name, on) {
    if (on) this.#now.add(name);
    else this.#now.delete(name);
  }

  /** @param {LampName} name @returns {Glow} */
  glow(name) {
    return this.#now.has(name) ? 'on' : this.#lit.has(name) ? 'glow' : 'off';
  }
}

export class Lamps {
  states = new LampStates();
  /** V_p and V_y at most, V. @type {[number, number]} */ limits = [Infinity, Infinity];
  #told = h('span', { class: 'sr', role: 'status' });
  #lastTold = -Infinity;
  #nodes = NAMES.map((name) => {
    const words = h('span', {}, LAMPS[name][0]);
    return { name, words, node: h('li', { class: 'lamp', 'data-lamp': name, title: LAMPS[name][1] }, words) };
  });
  node = h(
    'div',
    { class: 'lamps', 'data-testid': 'fly-lamps' },
    h('ul', { 'aria-label': 'Lamps' }, ...this.#nodes.map(({ node }) => node)),
    this.#told,
  );

  /** All are off. */
  clear() {
    this.states.clear();
  }

  /** Ticks that were flown. @param {Float64Array} rows @param {number} count */
  put(rows, count) {
    this.states.put(rows, count, this.limits);
  }

  /**
   * Once per animation frame.
   * @param {number} now  ms
   * @param {Pick<import('./flight.js').FlightState, 'mode'|'slow'>} state
   * @param {{u: ArrayLike<number>, impacts: number}|null} craft
   */
  render(now, { mode, slow }, craft) {
    const still = mode === 'frozen' || mode === 'ended';
    this.states.look(now, { u: craft?.u, impacts: craft?.impacts, slow, still });
    for (const { name, node, words } of this.#nodes) {
      setAttr(node, 'data-glow', this.states.glow(name));
      if (name === 'slow') setText(words, this.states.glow(name) === 'on' ? say`Slow ${percent(slow)}` : LAMPS.slow[0]);
    }
    if (now - this.#lastTold < TOLD) return;
    this.#lastTold = now;
    setText(this.#told, this.#words());
  }

  #words() {
    const lit = NAMES.filter((name) => this.states.glow(name) !== 'off');
    return lit.map((name) => `${t(LAMPS[name][1])}.`).join(' ');
  }
}
