/**
 * What a step of a lab can leave free, by the names that labs use: what links lock, and parts of it. Pure.
 * @typedef {import('../types.js').Lock} Lock
 */
import { LOCKS } from '../model/index.js';

/** @param {string} path in a request */
const field = (path) => `[data-field^="${path}"]`;
const handle = (/** @type {number} */ index) => `.pole[data-index="${index}"]`;
/** @param {string} name @param {string} controls @param {string[]} keys @returns {Lock} */
const part = (name, controls, ...keys) => ({ name, keys, controls });

/** What of a lock can be freed alone. @type {Record<string, Lock>} */
export const PARTS = {
  'pitch-poles': part('pitch poles', `${handle(0)}, ${handle(1)}, #poles .pitch input`, 'poles.0', 'poles.1'),
  'yaw-poles': part('yaw poles', `${handle(2)}, ${handle(3)}, #poles .yaw input`, 'poles.2', 'poles.3'),
  'rotor-poles': part('rotor poles', '.pole.rotor, #poles .rotor-poles input:not([type=checkbox])', 'rotor_poles'),
  structure: part('structure', field('method'), 'coupling', 'lead'),
  'place-rotors': part('placing the rotors', field('place_rotors'), 'place_rotors'),
  outer: part('PI on or off', '#loops [data-testid^=outer-]', 'outer'),
  pairing: part('pairing', '[data-field=pairing], [data-testid=pair-advised]', 'pairing'),
  decoupler: part('decoupler', field('decoupler'), 'decoupler'),
  'pitch-pi': part('pitch PI', '#loops .pi.pitch input', 'loops.pitch'),
  'yaw-pi': part('yaw PI', '#loops .pi.yaw input', 'loops.yaw'),
  'observer-poles': part('observer poles', '.pole.observer, .observer-placed input', 'observer.poles'),
  'steps-size': part('step sizes', field('scenario.reference'), 'scenario.reference'),
  duration: part('duration', field('scenario.duration'), 'scenario.duration'),
  digital: part(
    'digital controller',
    [
      field('scenario.digital'),
      ...['digital', 'delay', 'filtered'].map((id) => `[data-testid=experiment-${id}]`),
    ].join(),
    'scenario.digital',
  ),
  'sample-time': part('sample time', field('scenario.digital.sample_time'), 'scenario.digital.sample_time'),
  encoders: part('encoders', field('scenario.digital.encoders'), 'scenario.digital.encoders'),
  parameters: part('parameters', `#rig ${field('parameters')}`, 'parameters'),
  measured: part('what is measured', field('scenario.measured'), 'scenario.measured'),
  noise: part('noise', field('scenario.noise'), 'scenario.noise'),
  'anti-windup': part(
    'anti-windup',
    `[data-testid^=experiment-windup], ${field('scenario.tracking_time')}`,
    ...['scenario.anti_windup', 'scenario.tracking_time'],
  ),
  disturbance: part(
    'disturbance',
    `${field('scenario.disturbance')}, [data-testid=experiment-disturbance]`,
    'scenario.disturbance',
  ),
};

/** Free in every step, as they are no part of a design. */
const YARDSTICKS = ['remarks'];

/**
 * What is locked and what is left free of it where a step frees these.
 * @param {string[]} unlocked
 * @returns {{locks: string[], free: Lock[]}}
 */
export const locksOf = (unlocked) => ({
  locks: Object.keys(LOCKS).filter((name) => !YARDSTICKS.includes(name) && !unlocked.includes(name)),
  free: unlocked.flatMap((name) => PARTS[name] ?? []),
});

/** The free parts, each by what it is called and what changes it. @param {string[]} unlocked @returns {Lock[]} */
export const freeParts = (unlocked) => unlocked.flatMap((name) => LOCKS[name] ?? PARTS[name] ?? []);
