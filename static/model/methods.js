/**
 * The ways from poles to a gain: full-rank's four structures and the other methods, each under one key. Pure.
 * @typedef {import('../types.js').Design} Design
 * @typedef {{method: string, coupling?: string, lead?: string}} Way
 */

export const FULL_RANK = 'full-rank';

/** @type {[string, string, string][]} key, name, explanation */
export const STRUCTURES = [
  [
    'full-rank/triangular/pitch',
    'triangular, pitch leads',
    'pitch has exactly its own pair and drives yaw: the paper’s',
  ],
  ['full-rank/triangular/yaw', 'triangular, yaw leads', 'yaw has exactly its own pair and drives pitch'],
  ['full-rank/input-diagonal', 'input-diagonal', 'standard Luenberger: diagonal in B₂⁻¹[θ, ψ]'],
  ['full-rank/axis-decoupled', 'axis-decoupled', 'pitch and yaw do not feel each other'],
];

/** @type {Record<string, string>} */
const NAMES = {
  'tits-yang': 'Tits–Yang',
  knv0: 'Kautsky–Nichols–Van Dooren',
  varga: 'Varga’s Schur method',
  ackermann: 'Ackermann’s formula',
  'bass-gura': 'Bass–Gura formula',
  lqr: 'LQR',
  'lqr-integral': 'LQR, integral action',
};

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
  return STRUCTURES.find(([own]) => own === key)?.[1] ?? NAMES[way.method] ?? way.title ?? way.method;
}

/**
 * Whether the poles in the s-plane are those that the method gives the loop.
 * @param {import('../types.js').State} state
 */
export function placesPoles({ design, methods }) {
  return methods.find((m) => m.name === design?.method)?.places_poles !== false;
}

/** Whether the method brings integral action, in place of the PI loops. @param {import('../types.js').State} state */
export function bringsIntegralAction({ design, methods }) {
  return methods.find((m) => m.name === design?.method)?.integrates === true;
}
