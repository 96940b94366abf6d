/**
 * The first minute's six steps: each asks for something and knows when it was done. The motor is driven to its limit
 * before PI comes, since with PI a step begins with k_p times its size, whatever the poles. Pure.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Design} Design
 * @typedef {{axis: 'theta'|'psi', motor: 'V_p'|'V_y', pair: 0|1}} Side  the pair that is seen, its angle and motor
 * @typedef {'pi'|'lag'|'first-aero'|'cross'} Switch
 */
import { fixed, inField, percent, say, t } from '../text/index.js';
import { designOf, isComplex, lagOf, presetOf } from '../model/index.js';

/** Of an Aero's rotors, measured, s. */
export const AERO_LAG = 0.16;
const FIRST_AERO = 'quanser-aero';

/** @param {0|1} pair @returns {Side} */
export const sideOf = (pair) =>
  pair ? { axis: 'psi', motor: 'V_y', pair: 1 } : { axis: 'theta', motor: 'V_p', pair: 0 };

/** How the rig follows the step of one axis. @param {State} state @param {Side} side */
export const metricsOf = ({ reply }, { axis }) => reply?.axis_steps?.[axis]?.nonlinear.metrics;

/**
 * The step's course as shares of the step, from where it begins to where it ends. It may end beside its reference,
 * which is what the inner loop alone leaves; that is for PI to mend, and judged apart here.
 * @param {State} state @param {Side} side
 */
function courseOf({ reply }, { axis }) {
  const step = reply?.axis_steps?.[axis]?.nonlinear;
  if (!step) return null;
  const y = step[axis];
  const [from, end, size] = [y[0], y[y.length - 1], step.reference[axis] - y[0]];
  return { t: step.t, beyond: Array.from(y, (v) => (v - end) / (size || end - from || 1)) };
}

/** When the rig comes to rest, s: after that it stays where it ends. @param {State} state @param {Side} side */
export function restOf(state, side) {
  const course = courseOf(state, side);
  return course ? course.t[course.beyond.findLastIndex((v) => Math.abs(v) > BAND) + 1] : NaN;
}

/** How far the rig swings past where it ends, as a share of the step. @param {State} state @param {Side} side */
export const swingOf = (state, side) => Math.max(0, ...(courseOf(state, side)?.beyond ?? []));

const BAND = 0.02;
const SWING = 0.03;

/** @param {number} v down to a number that reads well */
const nice = (v) => Number((Math.floor(v * 20) / 20).toFixed(2));

/**
 * @typedef {object} Step
 * @property {string} name
 * @property {string} title
 * @property {(goal: number, side: Side) => string} ask  what to do, one line
 * @property {string} see  what that shows, one line
 * @property {(state: State, side: Side) => number} [goal]  of the design that is there as the step begins; NaN while
 *   nothing is known of it
 * @property {(state: State, side: Side, goal: number) => boolean} done
 * @property {(state: State, side: Side) => string} [now]  how far it is, in words
 * @property {Switch[]} [switches]  what the step brings along
 * @property {true} [volts]  that it is seen in the voltage
 * @property {true} [lost]  that the loop may be unstable meanwhile, which nothing else counts as done
 * @property {0|1} [pair]  that is looked at
 */

const WHO = { theta: 'pitch', psi: 'yaw' };

/** For which share of the time the motor is at its limit. @param {State} state @param {Side} side */
const saturatedOf = (state, side) => metricsOf(state, side)?.[side.motor]?.saturated ?? 0;

/** @param {State} state */
const lagging = (state) =>
  state.design !== null &&
  /** @type {const} */ (['pitch', 'yaw']).every(
    (axis) => lagOf(/** @type {Design} */ (state.design), presetOf(state), axis) >= 0.9 * AERO_LAG,
  );

/** @type {Step[]} */
export const STEPS = [
  {
    name: 'swing',
    title: 'Make it swing',
    ask: (_goal, { axis }) =>
      say`Drag one pole of ${t(WHO[axis])} onto the other, then up: they part. Go on until it swings past its end.`,
    see: 'On the real axis poles creep. Off it they swing: the steeper the ray they are on, the more.',
    now: (state, side) => say`swings past its end by ${percent(swingOf(state, side), 1)}`,
    done: (state, side) => isComplex(state.design?.poles ?? [], side.pair) && swingOf(state, side) >= SWING,
  },
  {
    name: 'settle',
    title: 'Be quick',
    ask: (goal, { axis }) => say`Drag the pair until ${t(WHO[axis])} is at rest within ${inField(goal)} s.`,
    see: 'Left is fast: a pole at −σ dies away like exp(−σt), which leaves 2 % after about 4/σ seconds.',
    goal: (state, side) => Math.max(0.2, nice(0.6 * restOf(state, side))),
    now: (state, side) => say`at rest after ${fixed(restOf(state, side), 2)} s`,
    done: (state, side, goal) => restOf(state, side) <= goal,
  },
  {
    name: 'saturate',
    title: 'Run out of volts',
    ask: (goal) =>
      goal > 0
        ? say`The motor is at its limit already. Drag on to the left until it is for ${percent(goal, 1)} of the time.`
        : t('Drag the pair to the left until the motor’s voltage reaches its limit.'),
    goal: (state, side) => Math.ceil(300 * saturatedOf(state, side)) / 200,
    see: 'Fast poles need a large K, and the motor cuts what is beyond the red line: from there on poles do little.',
    now: (state, side) => say`at the limit for ${percent(saturatedOf(state, side), 1)} of the time`,
    done: (state, side, goal) => saturatedOf(state, side) > 0 && saturatedOf(state, side) >= goal,
    volts: true,
  },
  {
    name: 'pi',
    title: 'Add PI, and see the poles move',
    ask: () => t('Switch the PI loops on, then touch a pole.'),
    see: 'PI removes the error that stays. But your poles move: a dotted line leads from each to where it is now.',
    done: ({ design }) => design?.outer === 'pi',
    switches: ['pi'],
  },
  {
    name: 'lag',
    title: 'Let the rotors lag',
    ask: () =>
      say`Give both rotors a real rig’s lag, ${inField(AERO_LAG)} s; then move the pair until the loop is stable.`,
    see: 'Placement knew of no lag. Dashes show where it takes poles: near the axis they ring, beyond it all is lost.',
    now: (state) => (lagging(state) ? t(state.reply?.stable ? 'stable' : 'unstable') : ''),
    done: (state) => lagging(state) && state.reply?.stable === true,
    lost: true,
    switches: ['lag'],
  },
  {
    name: 'cross',
    title: 'Pair crosswise',
    ask: () => t('Change to another rig, the first Quanser Aero, look at yaw, and lead each error to the other motor.'),
    see: 'Its relative gain λ₁₁ is 0.30, nearer 0 than 1: each motor moves the other angle more. Yaw calms down.',
    now: (state, side) => say`swings past its end by ${percent(swingOf(state, side), 0)}`,
    done: ({ design, reply }) => design?.pairing === 'cross' && (reply?.rga?.rga?.[0][0] ?? 1) < 0.5,
    switches: ['first-aero', 'cross'],
    pair: 1,
  },
];

/**
 * Switches in words, whether they are on, and the design with them turned.
 * @type {Record<Switch, {text: string, on: (state: State) => boolean, turned: (d: Design, on: boolean, state: State) =>
 *   Design}>}
 */
export const SWITCHES = {
  pi: {
    text: 'PI loops',
    on: ({ design }) => design?.outer === 'pi',
    turned: (d, on) => ({ ...d, outer: on ? 'pi' : 'none', ...(!on && { pairing: 'diagonal' }) }),
  },
  lag: {
    text: 'rotors lag',
    on: lagging,
    turned: (d, on) => ({
      ...d,
      rotors: {
        pitch: { ...d.rotors.pitch, tau: on ? AERO_LAG : 0 },
        yaw: { ...d.rotors.yaw, tau: on ? AERO_LAG : 0 },
      },
    }),
  },
  'first-aero': {
    text: 'first Aero',
    on: ({ design }) => design?.preset === FIRST_AERO,
    turned: (d, on, { presets }) => {
      const preset = on ? presets.find((p) => p.name === FIRST_AERO) : presets[0];
      return preset ? designOf(preset, { outer: 'pi' }) : d;
    },
  },
  cross: {
    text: 'crosswise',
    on: ({ design }) => design?.pairing === 'cross',
    turned: (d, on) => ({ ...d, pairing: on ? 'cross' : 'diagonal', ...(on && { outer: 'pi' }) }),
  },
};
