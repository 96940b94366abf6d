/**
 * What is asked of the server: what the requirements below the s-plane and the goals of a lab's step require, and which
 * handles are free to move. Pure.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../labs/shapes.js').Goal} Goal
 * @typedef {import('../contract.js').NearestAsked} NearestAsked
 * @typedef {NonNullable<NearestAsked['free']>[number]} Free
 * @typedef {{axis?: 'theta'|'psi'|'both', motor?: 'V_p'|'V_y'|'both', model?: 'linear'|'nonlinear',
 *   steps?: 'alone'|'together', max?: number, min?: number}} Limit
 * @typedef {Record<string, Limit[]>} Required
 */
import { bodyOf, FULL_RANK, hides, missesLag, missing, scenarioOf } from '../model/index.js';

/** Of a response these say more: of which. */
const OF_RESPONSES = ['axis', 'step', 'motor'];

/** What a step of a lab leaves of each lock, by a path that only it holds. @type {Record<string, Free>} */
const PARTS = { 'poles.0': 'pitch-pair', 'poles.2': 'yaw-pair', 'loops.pitch': 'pitch-pi', 'loops.yaw': 'yaw-pi' };

/**
 * What may move, as locks leave it.
 * @param {Pick<State, 'design'|'locks'|'task'>} state
 * @returns {Free[]}
 */
export function freeOf(state) {
  const { design, locks, task } = state;
  if (!design) return [];
  const keys = (task?.free ?? []).flatMap((lock) => lock.keys);
  const of = (/** @type {'poles'|'loops'} */ lock) =>
    !locks.includes(lock)
      ? [lock]
      : Object.entries(PARTS).flatMap(([key, part]) => (key.startsWith(lock) && keys.includes(key) ? [part] : []));
  const rotors = !design.place_rotors || !locks.includes('poles') || keys.includes('rotor_poles');
  // by other methods every design takes the server long: their loops alone
  const poles = design.method === FULL_RANK && rotors;
  return [...(poles ? of('poles') : []), ...(design.outer === 'pi' ? of('loops') : [])];
}

/**
 * Whether suggestions are kept back: of what a class is to find by itself.
 * @param {Pick<State, 'locks'|'task'>} state
 */
export const isKeptBack = (state) => ['remarks', 'suggestions', 'poles'].some((what) => hides(state, what));

/** The requirements of the s-plane's bar. @param {State['requirements']} r @returns {Required} */
const ofBar = ({ settling, overshoot, lag }) => ({
  ...(settling !== null && { settling_time: [{ axis: /** @type {const} */ ('both'), max: settling }] }),
  ...(overshoot !== null && { overshoot: [{ axis: /** @type {const} */ ('both'), max: overshoot }] }),
  ...(lag !== null && { lag_margin: [{ min: lag }] }),
});

/** A goal's limits, as the server takes them. @param {Goal} goal @returns {Limit} */
function limitOf({ of, axis, motor, model, steps, max, min }) {
  const responds = OF_RESPONSES.includes(of ?? '');
  const given = {
    axis: responds ? axis : null,
    motor: of === 'motor' || of === 'margins' ? motor : null,
    model: responds ? model : null,
    steps: responds ? steps : null,
    max,
    min,
  };
  return Object.fromEntries(Object.entries(given).filter(([, value]) => value !== null && value !== undefined));
}

/**
 * Goals that a design can be judged by: figures of merit of a loop that has to be stable.
 * @param {Goal[]} goals
 */
const judgeable = (goals) =>
  goals.filter(
    ({ kind, figure, unstable, of, steps, max, min }) =>
      kind === 'figure' &&
      figure !== undefined &&
      !unstable &&
      !(of === 'step' && steps === 'together') &&
      ((max ?? null) !== null || (min ?? null) !== null),
  );

/**
 * What is missed, and all that shall be kept; null where nothing is missed.
 * @param {Pick<State, 'reply'|'design'|'requirements'|'locks'|'task'>} state
 * @param {Goal[]} goals  of the lab's step
 * @param {(goal: Goal) => boolean} isMissed
 * @returns {Required|null}
 */
export function requiredOf(state, goals, isMissed) {
  const { reply, requirements } = state;
  if (!reply) return null;
  const barHidden = hides(state, 'requirements');
  const own = judgeable(goals);
  const bar = !barHidden && (missing(reply, requirements).length > 0 || missesLag(reply, requirements));
  if (!bar && !own.some(isMissed)) return null;
  const required = barHidden ? {} : ofBar(requirements);
  for (const goal of own) {
    const name = /** @type {string} */ (goal.figure);
    required[name] = [...(required[name] ?? []), limitOf(goal)];
  }
  return required;
}

/**
 * The request.
 * @param {Design} design @param {Required} require @param {Free[]} free
 */
export const requestOf = (design, require, free) => ({
  ...bodyOf(design),
  scenario: scenarioOf(design),
  nearest: { require, free },
});
