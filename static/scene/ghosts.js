// Designs that fly beside the rig as ghosts: the linear model and pinned designs. Pure.
import { change, sampleTrajectory, show, turn } from './pose.js';
import { colorOf, COLORS, letterOf, motionOf } from '../model/index.js';

/**
 * One ghost: its node under /ghosts, as app/scene/rig.py makes them, what is written at it and what it flies. Its
 * voltages are not drawn.
 * @typedef {{slot: string, label: string, color: import("./pose.js").Color,
 *   trajectory: Pick<import("./pose.js").Trajectory, "t" | "theta" | "psi">}} Flight
 */

export const SLOTS = ['linear', 'recorded', ...Array.from({ length: COLORS }, (_, k) => String(k))];

/**
 * @param {string} text "#rrggbb", as the style sheets name colours
 * @returns {import("./pose.js").Color}
 */
export function rgb(text) {
  const value = /^#[0-9a-f]{6}$/i.test(text) ? Number.parseInt(text.slice(1), 16) : 0x808080;
  return [value >> 16, (value >> 8) & 255, value & 255];
}

/**
 * Returns who flies beside the rig: the linear model, the first pins that have a reply, a recording.
 * @param {Pick<import("../types.js").State, "reply" | "motion" | "pins" | "beside">} state
 * @param {{linear: boolean, pins: boolean}} wanted
 * @param {(name: string) => string} color a style sheet's colour, "#rrggbb"
 * @returns {Flight[]}
 */
export function flightsOf({ reply, motion, pins, beside }, wanted, color) {
  const flights = [];
  const linear = reply && wanted.linear ? motionOf(reply, motion)?.linear : undefined;
  if (linear) flights.push({ slot: 'linear', label: 'linear', color: rgb(color('ink')), trajectory: linear });
  const ready = wanted.pins ? pins.filter((pin) => pin.reply).slice(0, COLORS) : [];
  ready.forEach((pin, k) => {
    const trajectory = pin.reply && motionOf(pin.reply, motion)?.nonlinear;
    if (trajectory)
      flights.push({ slot: String(k), label: letterOf(pin.index), color: rgb(color(colorOf(pin.index))), trajectory });
  });
  if (beside?.ghost)
    flights.push({ slot: 'recorded', label: 'recorded', color: rgb(color('recorded')), trajectory: beside });
  return flights;
}

/**
 * Returns viser's messages that put the ghosts where they are at a time in seconds, each held at the end of its own
 * response, and hide the others.
 * @param {Flight[]} flights @param {number} time
 */
export const ghostMessages = (flights, time) =>
  ghostsAt(flights.map((own) => ({ ...own, ...sampleTrajectory({ ...own.trajectory, V_p: [], V_y: [] }, time) })));

/**
 * The same of ghosts that somebody else flies.
 * @typedef {Omit<Flight, 'trajectory'> & {theta: number, psi: number}} Ghost
 * @param {Ghost[]} ghosts
 * @returns {import("./pose.js").SceneMessage[]}
 */
export function ghostsAt(ghosts) {
  return SLOTS.flatMap((slot) => {
    const node = `/ghosts/${slot}`;
    const ghost = ghosts.find((own) => own.slot === slot);
    if (ghost === undefined) return [show(node, false)];
    const { theta, psi, color, label } = ghost;
    return [
      show(node, true),
      turn(`${node}/yoke`, 'z', -psi),
      turn(`${node}/yoke/body`, 'y', -theta),
      change(`${node}/yoke/shape`, { color }),
      change(`${node}/yoke/body/shape`, { color }),
      change(`${node}/yoke/body/label`, { text: label }),
    ];
  });
}
