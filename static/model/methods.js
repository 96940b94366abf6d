/**
 * The ways from poles to a gain: full-rank's four structures and the other methods, each under one key. Pure.
 * @typedef {import('../types.js').Design} Design
 * @typedef {{method: string, coupling?: string, lead?: string}} Way
 */
import { METHODS, STRUCTURES } from './method_names.js';

export const FULL_RANK = 'full-rank';

/** Yaw can lead only where the coupling is triangular. @param {Way} way @returns {string} */
export function keyOf({ method, coupling, lead }) {
  if (method !== FULL_RANK) return method;
  return coupling === 'triangular' ? `${method}/${coupling}/${lead ?? 'pitch'}` : `${method}/${coupling}`;
}

/** What a key changes in a design. @param {string} key @returns {Partial<Design>} */
export function partOf(key) {
  const [method, coupling, lead] = key.split('/');
  return coupling
    ? {
        method,
        coupling: /** @type {Design['coupling']} */ (coupling),
        lead: /** @type {Design['lead']} */ (lead ?? 'pitch'),
      }
    : { method };
}

/** @param {Way & {title?: string}} way @returns {string} */
export function nameOf(way) {
  const key = keyOf(way);
  return STRUCTURES.find(([own]) => own === key)?.[1] ?? METHODS[way.method] ?? way.title ?? way.method;
}

/**
 * Whether the poles in the s-plane are those that the method gives the loop.
 * @param {Pick<import('../types.js').State, 'design'|'methods'>} state
 */
export function placesPoles({ design, methods }) {
  return methods.find((m) => m.name === design?.method)?.places_poles !== false;
}

/** Whether the method brings integral action, in place of the PI loops. @param {import('../types.js').State} state */
export function bringsIntegralAction({ design, methods }) {
  return methods.find((m) => m.name === design?.method)?.integrates === true;
}
