/**
 * Moves: the design that one leads to, what it moves in words, and where poles go. Pure.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Poles} Poles
 * @typedef {import('../contract.js').MoveReply} Move
 * @typedef {Move['handles'][number]} Handle
 * @typedef {{index: number, from: Complex, to: Complex}} Way  of a pole, by its handle in the s-plane
 */
import { complexIn, inField, say, t } from '../text/index.js';

/** @type {Record<Handle, string>} */
const NAMES = { 'pitch-pair': 'pitch poles', 'yaw-pair': 'yaw poles', 'pitch-pi': 'pitch PI', 'yaw-pi': 'yaw PI' };
const PAIRS = /** @type {const} */ ({ 'pitch-pair': 0, 'yaw-pair': 1 });
const LOOPS = /** @type {const} */ ({ 'pitch-pi': 'pitch', 'yaw-pi': 'yaw' });

/** @param {Handle} handle @returns {handle is 'pitch-pair'|'yaw-pair'} */
const isPair = (handle) => handle in PAIRS;

/**
 * The design where it leads; handles that stay keep their very numbers.
 * @param {Design} design @param {Move} move @returns {Design}
 */
export function moved(design, { handles, design: to }) {
  const poles = /** @type {Poles} */ ([...design.poles]);
  const loops = { ...design.loops };
  let rotors = design.rotor_poles;
  for (const handle of handles)
    if (isPair(handle)) {
      const pair = PAIRS[handle];
      for (const i of [2 * pair, 2 * pair + 1]) poles[i] = { ...to.poles[i] };
      const own = to.rotor_poles?.[pair];
      if (own !== undefined) rotors = pair ? [rotors[0], own] : [own, rotors[1]];
    } else {
      const axis = LOOPS[/** @type {'pitch-pi'|'yaw-pi'} */ (handle)];
      loops[axis] = { ...to.loops[axis] };
    }
  return { ...design, poles, loops, rotor_poles: rotors };
}

/**
 * Where each pole goes; of a pair each to the nearer place.
 * @param {Design} from @param {Design} to @returns {Way[]}
 */
export function waysOf(from, to) {
  /** @type {Way[]} */ const ways = [];
  for (const pair of [0, 2]) {
    const own = from.poles.slice(pair, pair + 2);
    const ends = to.poles.slice(pair, pair + 2);
    const far = (/** @type {Complex} */ a, /** @type {Complex} */ b) => Math.hypot(a.re - b.re, a.im - b.im);
    if (far(own[0], ends[1]) + far(own[1], ends[0]) < far(own[0], ends[0]) + far(own[1], ends[1])) ends.reverse();
    for (const [k, at] of own.entries())
      if (far(at, ends[k]) > 0) ways.push({ index: pair + k, from: at, to: ends[k] });
  }
  if (to.place_rotors)
    for (const k of [0, 1])
      if (from.rotor_poles[k] !== to.rotor_poles[k])
        ways.push({
          index: 4 + k,
          from: { re: from.rotor_poles[k], im: 0 },
          to: { re: to.rotor_poles[k], im: 0 },
        });
  return ways;
}

const short = (/** @type {number} */ v) => inField(Number(v.toPrecision(4)));

/** @param {readonly Complex[]} pair */
const pairText = ([p, q]) =>
  p.im
    ? complexIn({ re: p.re, im: Math.abs(p.im) }, { number: short, plus: '±', gap: ' ' })
    : `${short(p.re)}, ${short(q.re)}`;

/**
 * What moves where, a phrase per handle.
 * @param {Design} from @param {Move} move @returns {{handle: Handle, text: string}[]}
 */
export function wordsOf(from, move) {
  const to = moved(from, move);
  return move.handles.map((handle) => {
    if (isPair(handle)) {
      const first = 2 * PAIRS[handle];
      const rotor = to.place_rotors ? `, ${short(to.rotor_poles[PAIRS[handle]])}` : '';
      return { handle, text: say`${t(NAMES[handle])} to ${pairText(to.poles.slice(first, first + 2))}${rotor}` };
    }
    const axis = LOOPS[/** @type {'pitch-pi'|'yaw-pi'} */ (handle)];
    const [own, next] = [from.loops[axis], to.loops[axis]];
    const parts = [
      ...(own.kp !== next.kp ? [`kₚ ${short(next.kp)}`] : []),
      ...(own.ti !== next.ti ? [`Tᵢ ${short(next.ti)} s`] : []),
    ];
    return { handle, text: say`${t(NAMES[handle])} to ${parts.join(', ')}` };
  });
}

/**
 * What moves, in a word or two: of both axes alike, neither is named.
 * @param {Move} move @returns {string}
 */
export function whatMoves({ handles }) {
  const has = (/** @type {Handle} */ handle) => handles.includes(handle);
  const poles = has('pitch-pair') && has('yaw-pair');
  const loops = has('pitch-pi') && has('yaw-pi');
  const names = [
    ...(poles ? [t('poles')] : handles.filter(isPair).map((handle) => t(NAMES[handle]))),
    ...(loops ? [t('PI')] : handles.filter((handle) => !isPair(handle)).map((handle) => t(NAMES[handle]))),
  ];
  return names.join(' + ');
}

const brief = (/** @type {number} */ v) => inField(Number(v.toPrecision(3)));

/**
 * Of PI loops that a move changes, their new values, beside their names.
 * @param {Design} from @param {Design} to @returns {{axis: 'pitch'|'yaw', text: string}[]}
 */
export const numbersOf = (from, to) =>
  Object.values(LOOPS).flatMap((axis) => {
    const { kp, ti } = to.loops[axis];
    const same = from.loops[axis].kp === kp && from.loops[axis].ti === ti;
    return same ? [] : [{ axis, text: `→ ${brief(kp)}, ${brief(ti)}` }];
  });
