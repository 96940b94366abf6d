/**
 * What questions ask of the student's own design, read from its numbers, as heli2dof_core/labs/quantities.py reads them
 * of a report. Pure.
 * @typedef {import('../types.js').Reply} Reply
 * @typedef {NonNullable<import('./questions.js').RightNumber['own']>} Asked
 */

/** The whole loop's poles that it has, from the right. @param {Reply} reply */
const polesOf = ({ loop_poles }) => [...loop_poles].sort((a, b) => b.re - a.re || Math.abs(a.im) - Math.abs(b.im));

/** @param {number[][]|undefined} matrix @param {number[]} indices */
const entry = (matrix, [i, j]) => matrix?.[i - 1]?.[j - 1];

/** What stands at a dotted path of a design's body. @param {unknown} body @param {string} path @returns {unknown} */
const at = (body, path) =>
  path
    .split('.')
    .reduce(
      (inner, key) => /** @type {Record<string, unknown>|undefined} */ (inner)?.[key],
      /** @type {unknown} */ (body),
    );

/** @param {Record<string, unknown>} body @param {string} axis */
const gainOf = (body, axis) => Number(at(body, `loops.${axis}.kp`));

/** A step whose first voltage meets the motor's limit, rad. @param {Design} own @param {'V_p'|'V_y'} motor */
function largestStep({ reply, body }, motor) {
  const kp = gainOf(body, motor === 'V_p' ? 'pitch' : 'yaw');
  return kp > 0 ? (Number(reply.limits[motor]) - reply.trim[motor]) / kp : undefined;
}

const GAINS = { smallest: 1e-3, largest: 1e4, growth: 1.2, close: 1e-6 };

/** The largest kp of a PI loop with which the whole loop is stable, V/rad. @param {Design} own @param {string} axis */
function largestGain({ body, stable }, axis) {
  const loops = /** @type {Record<string, object>} */ (body.loops);
  const holds = (/** @type {number} */ kp) => stable({ ...body, loops: { ...loops, [axis]: { ...loops[axis], kp } } });
  let low = GAINS.smallest;
  if (!holds(low)) return undefined;
  let high = low * GAINS.growth;
  for (; holds(high); high = low * GAINS.growth) {
    low = high;
    if (low > GAINS.largest) return undefined;
  }
  while (high / low > 1 + GAINS.close) {
    const middle = Math.sqrt(low * high);
    if (holds(middle)) low = middle;
    else high = middle;
  }
  return low;
}

/** @typedef {import('./questions.js').Own & {reply: Reply}} Design  one that exists */
/** @type {Record<string, (own: Design, indices: number[]) => number|undefined>} by name, without indices */
const READERS = {
  K: ({ reply }, of) => entry(reply.gains.K, of),
  A: ({ reply }, of) => entry(reply.gains.A, of),
  B: ({ reply }, of) => entry(reply.gains.B, of),
  L: ({ reply }, of) => entry(reply.observer?.L, of),
  rga: ({ reply }, of) => entry(reply.rga.rga, of),
  niederlinski: ({ reply }) => reply.rga.niederlinski,
  niederlinski_cross: ({ reply }) => reply.rga.niederlinski_cross,
  slowest_pole: ({ reply }) => polesOf(reply)[0]?.re,
  fastest_pole: ({ reply }) => polesOf(reply).at(-1)?.re,
  loop_pole_re: ({ reply }, [i]) => polesOf(reply)[i - 1]?.re,
  loop_pole_im: ({ reply }, [i]) => {
    const pole = polesOf(reply)[i - 1];
    return pole && Math.abs(pole.im);
  },
  order: ({ reply }) => reply.loop_poles.length,
  damping: ({ reply }) => {
    const found = reply.loop_poles.filter(({ re, im }) => re || im).map(({ re, im }) => -re / Math.hypot(re, im));
    return found.length ? Math.min(...found) : undefined;
  },
  trim_V_p: ({ reply }) => reply.trim.V_p,
  trim_V_y: ({ reply }) => reply.trim.V_y,
  largest_step_theta: (own) => largestStep(own, 'V_p'),
  largest_step_psi: (own) => largestStep(own, 'V_y'),
  largest_kp_pitch: (own) => largestGain(own, 'pitch'),
  largest_kp_yaw: (own) => largestGain(own, 'yaw'),
};

/** Names that this page can read: app/scorm/answers.py packs no others. */
export const READABLE = Object.keys(READERS);

/**
 * @param {Asked} asked
 * @param {import('./questions.js').Own} own  the student's own design
 * @returns {number|null} in the question's unit; null where it does not exist
 */
export function quantityOf({ name, indices, figure, scale }, own) {
  const { reply, body } = own;
  if (!reply || (figure && !reply.stable)) return null;
  const value = figure
    ? own.figure(figure, reply)
    : READERS[name]
      ? READERS[name]({ ...own, reply }, indices)
      : at(body, name);
  if (typeof value !== 'number' || !Number.isFinite(value)) return null;
  if (scale === 'dB') return value > 0 ? 20 * Math.log10(value) : null;
  return value * scale;
}
