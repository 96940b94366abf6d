/**
 * What the panel beside the rig asks for, as changes of the design and of playing. The names are those of
 * app/scene/panel.py. Pure.
 * @typedef {import('../types.js').Poles} Poles
 * @typedef {import('../types.js').Loops} Loops
 * @typedef {Record<string, number|boolean|string>} Edits
 * @typedef {ReturnType<typeof import('../model/store.js').evaluationOf>} Asked
 * @typedef {ReturnType<typeof shownOf>} Shown
 */
import { isComplex, LIMIT, setComplex, setMode, setReal } from '../model/index.js';

const PAIRS = /** @type {const} */ (['pitch', 'yaw']);
const COURSES = /** @type {const} */ (['t', 'theta', 'psi', 'V_p', 'V_y']);
const LEAST_IM = 1e-3;

/** @param {unknown} v @param {number} low @param {number} high @returns {number|null} */
const within = (v, low, high) =>
  typeof v === 'number' && Number.isFinite(v) ? Math.min(Math.max(v, low), high) : null;

/** @param {Poles} poles @param {0|1} pair @param {Edits} edits @returns {Poles} */
function pairEdited(poles, pair, edits) {
  const [name, index] = [PAIRS[pair], 2 * pair];
  let next = poles;
  const mode = edits[`${name}.complex`];
  if (typeof mode === 'boolean' && mode !== isComplex(next, pair)) next = setMode(next, pair, mode);
  if (isComplex(next, pair)) {
    const re = within(edits[`${name}.re`], -LIMIT, LIMIT);
    const im = within(edits[`${name}.im`], LEAST_IM, LIMIT); // 0 would make it a real pair under the hand
    const { re: wasRe, im: wasIm } = next[index];
    if (re !== null || im !== null)
      next = setComplex(next, index, { re: re ?? wasRe, im: im === null ? wasIm : Math.sign(wasIm) * im });
  } else {
    const [a, b] = ['first', 'second'].map((k) => within(edits[`${name}.${k}`], -LIMIT, LIMIT));
    if (a !== null) next = setReal(next, index, a);
    if (b !== null) next = setReal(next, index + 1, b);
  }
  return next;
}

/**
 * The design with what was set at the panel; itself where that changes nothing.
 * @template {{poles: Poles, loops: Loops}} T @param {T} design @param {Edits} edits @returns {T}
 */
export function edited(design, edits) {
  const poles = pairEdited(pairEdited(design.poles, 0, edits), 1, edits);
  let { loops } = design;
  for (const axis of PAIRS) {
    const kp = within(edits[`${axis}.kp`], 0, 1e5);
    const ti = within(edits[`${axis}.ti`], 1e-4, 1e5);
    if (kp !== null || ti !== null)
      loops = { ...loops, [axis]: { kp: kp ?? loops[axis].kp, ti: ti ?? loops[axis].ti } };
  }
  return poles === design.poles && loops === design.loops ? design : { ...design, poles, loops };
}

/**
 * What the edits do to playing.
 * @param {{play: () => void, pause: () => void, replay: () => void, setSpeed: (s: number) => void, setLoop: (l:
 *   boolean) => void}} player
 * @param {Edits} edits
 */
export function steer(player, edits) {
  const { speed, loop } = edits;
  if (typeof speed === 'number') player.setSpeed(speed);
  if (typeof loop === 'boolean') player.setLoop(loop);
  if (edits.play === 'Play') player.play();
  else if (edits.play === 'Pause') player.pause();
  else if (edits.play === 'Replay') player.replay();
}

/**
 * What the windows of a session show one another.
 * @param {Asked} request the evaluation that was asked for
 * @param {import('../types.js').Reply} reply
 * @param {import('../types.js').Step} motion
 * @param {{motion: import('../types.js').Motion, rig: string, after: number}} more after: number of the panel's last
 *   message that the request contains
 */
export function shownOf(request, reply, motion, more) {
  const series = /** @type {Record<(typeof COURSES)[number], Float32Array>} */ (
    Object.fromEntries(COURSES.map((name) => [name, Float32Array.from(motion[name])]))
  );
  return {
    design: request,
    K: reply.gains.K,
    limits: reply.limits,
    ...more,
    trajectory: { ...series, reference: motion.reference },
  };
}

/**
 * A trajectory from another window, if it is one.
 * @param {unknown} shown
 * @returns {import('./pose.js').Trajectory|null}
 */
export function trajectoryIn(shown) {
  const trajectory = /** @type {Partial<Shown>|null|undefined} */ (shown)?.trajectory;
  const series = COURSES.map((name) => trajectory?.[name]);
  const length = series[0]?.length ?? 0;
  return trajectory &&
    length > 1 &&
    series.every((s) => s instanceof Float32Array && s.length === length && s.every(Number.isFinite))
    ? trajectory
    : null;
}
