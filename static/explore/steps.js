/**
 * The first minute's six steps: each begins with a design of its own, asks for something, and knows when it was done:
 * by the figure that is shown, as it is rounded. The motor is driven to its limit before PI comes, since with PI a step
 * begins with k_p times its size, whatever the poles. Pure.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {{axis: 'theta'|'psi', motor: 'V_p'|'V_y', pair: 0|1}} Side  the pair that is seen, its angle and motor
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {'pi'|'lag'|'first-aero'|'cross'} Switch
 */
import { degrees, fixed, percent, say, t } from '../text/index.js';
import { designOf, isComplex, lagOf, presetOf, setComplex } from '../model/index.js';

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
/** What is asked for: shares, and seconds. */
const [SWING, QUICK, SATURATED, CALM] = [0.05, 0.5, 0.01, 2];

/** Whether a share is as large as asked, as it is shown: in percent, with one decimal. */
const shows = (/** @type {number} */ share, /** @type {number} */ asked) =>
  Math.round(1000 * share) >= Math.round(1000 * asked);
/** Whether a time is as short as asked, as it is shown: with two decimals. */
const within = (/** @type {number} */ time, /** @type {number} */ asked) => Math.round(100 * time) <= 100 * asked;

/**
 * A rig with its inner loop alone and one pair, of the axis that is seen or of both, elsewhere.
 * @param {Preset} preset @param {Complex|null} at null: as the rig proposes @param {Side} [side]
 * @returns {Design}
 */
function innerLoop(preset, at, side) {
  const design = designOf(preset, { outer: 'none' });
  for (const pair of at ? /** @type {const} */ ([0, 1]) : [])
    if (at && (!side || side.pair === pair)) design.poles = setComplex(design.poles, 2 * pair, at);
  return design;
}

/**
 * @typedef {object} Step
 * @property {string} name
 * @property {string} title
 * @property {(side: Side) => string} ask  what to do, one line
 * @property {string} see  what that shows, one line
 * @property {(preset: Preset, side: Side) => Design} begin  the design with which it begins, of the first rig
 * @property {(state: State, side: Side, moved: boolean) => boolean} done  `moved`: whether poles have been, since
 * @property {(state: State, side: Side) => string} [now]  how far it is, in words
 * @property {Switch[]} [switches]  what the step brings along
 * @property {true} [volts]  that it is seen in the voltage
 * @property {true} [lost]  that the loop may be unstable meanwhile, which nothing else counts as done
 * @property {0|1} [pair]  that is looked at
 */

const WHO = { theta: 'pitch', psi: 'yaw' };
/** @param {Side} side */
const who = ({ axis }) => t(WHO[axis]);

/** How far from its reference the step ends, rad. @param {State} state @param {Side} side */
function errorOf({ reply }, { axis }) {
  const step = reply?.axis_steps?.[axis]?.nonlinear;
  return step ? Math.abs(step[axis][step[axis].length - 1] - step.reference[axis]) : NaN;
}

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
    ask: (side) =>
      say`Drag one pole of ${who(side)} onto the other, then up: they part. Go on to ${percent(SWING)} of overshoot.`,
    see: 'On the real axis poles creep. Off it they swing: the steeper the ray they are on, the more they overshoot.',
    begin: (preset) => innerLoop(preset, null),
    now: (state, side) => say`overshoots by ${percent(swingOf(state, side), 1)}`,
    done: (state, side) => isComplex(state.design?.poles ?? [], side.pair) && shows(swingOf(state, side), SWING),
  },
  {
    name: 'settle',
    title: 'Be quick',
    ask: (side) => say`Drag the pair until ${who(side)} is at rest within ${fixed(QUICK, 2)} s.`,
    see: 'Left is fast: a pole at −σ dies away like exp(−σt), 2 % are left after about 4/σ s, of a close pair 6/σ.',
    begin: (preset) => innerLoop(preset, { re: -3, im: 3 }),
    now: (state, side) => say`at rest after ${fixed(restOf(state, side), 2)} s`,
    done: (state, side) => within(restOf(state, side), QUICK),
  },
  {
    name: 'saturate',
    title: 'Run out of volts',
    ask: () =>
      say`Drag the pair to the left until the motor is at its limit, for ${percent(SATURATED, 1)} of the time.`,
    begin: (preset) => innerLoop(preset, { re: -5, im: 3 }),
    see: 'Fast poles need a large K, and the motor cuts what is beyond the red line: from there on poles do little.',
    now: (state, side) => say`at the limit for ${percent(saturatedOf(state, side), 1)} of the time`,
    done: (state, side) => shows(saturatedOf(state, side), SATURATED),
    volts: true,
  },
  {
    name: 'pi',
    title: 'Add PI, and see the poles move',
    ask: () => t('Switch the PI loops on, then drag a pole.'),
    see: 'PI removes the error that stays. But your poles move: as you drag, dotted lines lead to where they are now.',
    begin: (preset) => innerLoop(preset, null),
    now: (state, side) => say`ends ${degrees(errorOf(state, side), 2)} beside its reference`,
    done: ({ design }, _side, moved) => design?.outer === 'pi' && moved,
    switches: ['pi'],
  },
  {
    name: 'lag',
    title: 'Let the rotors lag',
    ask: (side) =>
      say`Give the rotors an Aero’s lag, ${AERO_LAG} s; then bring ${who(side)} to rest within ${fixed(CALM, 2)} s.`,
    see: 'Placement knew of no lag: dashes show where poles go. Late rotors bear no fast poles: go right, and down.',
    begin: (preset, side) => innerLoop(preset, { re: -20, im: 20 }, side),
    now: (state, side) =>
      !lagging(state)
        ? ''
        : state.reply?.stable
          ? say`at rest after ${fixed(restOf(state, side), 2)} s`
          : t('unstable'),
    done: (state, side) => lagging(state) && state.reply?.stable === true && within(restOf(state, side), CALM),
    lost: true,
    switches: ['lag'],
    pair: 0,
  },
  {
    name: 'cross',
    title: 'Pair crosswise',
    ask: () => t('Change to another rig, the first Quanser Aero, look at yaw, and lead each error to the other motor.'),
    see: 'There each motor moves the other angle more (relative gain λ₁₁ 0.30, nearer 0 than 1). Yaw calms down.',
    begin: (preset) => designOf(preset, { outer: 'pi' }),
    now: (state, side) => say`overshoots by ${percent(swingOf(state, side), 1)}`,
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
