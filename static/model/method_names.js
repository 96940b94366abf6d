/**
 * Names of structures and methods, made of heli2dof_core/couplings.py and heli2dof_core/placement by
 * `python -m tests.page_methods`; not to be changed by hand.
 */

export const COUPLINGS = ['triangular', 'input-diagonal', 'axis-decoupled'];
export const LEADS = ['pitch', 'yaw'];

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
export const METHODS = {
  'full-rank': 'Full-rank',
  'tits-yang': 'Tits–Yang',
  knv0: 'Kautsky–Nichols–Van Dooren',
  varga: 'Varga’s Schur method',
  ackermann: 'Ackermann’s formula',
  'bass-gura': 'Bass–Gura formula',
  lqr: 'LQR',
  'lqr-integral': 'LQR, integral action',
};
