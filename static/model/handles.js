/**
 * The poles that are dragged in the s-plane, each by a handle of its own: 0 to 3 the placed ones; 4, 5 the rotors'
 * where they are placed, too; 6 to 9 the observer's where it is placed. Pure.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Poles} Poles
 */
import { drag, fromWire, LIMIT, nudge, pairOf, tidy } from './poles.js';
import { OBSERVER_POLES } from './quantities.js';

const ROTOR = 4;
const OBSERVER = 6;
/** All that there can be. */
export const HANDLES = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9];

/** @param {number} index @returns {'placed'|'rotor'|'observer'} */
export const kindOf = (index) => (index < ROTOR ? 'placed' : index < OBSERVER ? 'rotor' : 'observer');

/** @param {number} index @returns {0|1} 0 pitch, 1 yaw */
export const axisOf = (index) =>
  kindOf(index) === 'rotor' ? /** @type {0|1} */ (index - ROTOR) : pairOf(index % OBSERVER);

/** As it stands beside its mark. @param {number} index */
export const numeralOf = (index) => (index < OBSERVER ? String(index + 1) : `q${index - OBSERVER + 1}`);

/** Whether the states are estimated by an observer that is placed. @param {Design} design */
export const placesObserver = ({ scenario, observer }) =>
  scenario.measured === 'observer' && observer?.method !== 'kalman';

/** @param {Design} design @returns {Poles} q₁ to q₄ */
export const observerPoles = ({ observer }) => observer?.poles ?? fromWire(OBSERVER_POLES);

/** @param {Design} design @param {Poles} poles @returns {Design} */
export const withObserverPoles = (design, poles) => ({ ...design, observer: { ...design.observer, poles } });

/** @param {Design} design @param {0|1} rotor @param {number} re rad/s @returns {Design} */
export function withRotorPole(design, rotor, re) {
  const own = tidy(Math.max(-LIMIT, Math.min(LIMIT, re)));
  const [p, y] = design.rotor_poles;
  return { ...design, rotor_poles: rotor ? [p, own] : [own, y] };
}

/**
 * By handle, where there is one now.
 * @param {Design} design
 * @param {0|1|null} [alone] the one pair that is seen, if not all are
 * @returns {(Complex|undefined)[]}
 */
export function handlesOf(design, alone = null) {
  const { poles } = design;
  if (alone !== null) return poles.map((p, i) => (pairOf(i) === alone ? p : undefined));
  return [
    ...poles,
    ...(design.place_rotors ? fromWire(design.rotor_poles) : [undefined, undefined]),
    ...(placesObserver(design) ? observerPoles(design) : []),
  ];
}

/** The four poles among which a handle's stands. @param {Design} design @param {number} index */
export const fourOf = (design, index) => (index < ROTOR ? design.poles : observerPoles(design));

/** @param {Design} design @param {number} index @param {Poles} poles @returns {Design} */
const withFour = (design, index, poles) => (index < ROTOR ? { ...design, poles } : withObserverPoles(design, poles));

/**
 * One step of a drag of whichever pole; a rotor's slides along the real axis (see `drag`).
 * @param {Design} design
 * @param {number} index
 * @param {Complex} to
 * @param {{snap: number, meet: number, together: boolean}} how
 * @returns {{design: Design, together: boolean}}
 */
export function dragHandle(design, index, to, how) {
  if (kindOf(index) === 'rotor') return { design: withRotorPole(design, axisOf(index), to.re), together: false };
  const { poles, together } = drag(fourOf(design, index), index % OBSERVER, to, how);
  return { design: withFour(design, index, poles), together };
}

/**
 * One press of a key on whichever pole (see `nudge`).
 * @param {Design} design
 * @param {number} index
 * @param {Complex} by
 */
export function nudgeHandle(design, index, by) {
  if (kindOf(index) === 'rotor') return withRotorPole(design, axisOf(index), design.rotor_poles[axisOf(index)] + by.re);
  return withFour(design, index, nudge(fourOf(design, index), index % OBSERVER, by));
}
