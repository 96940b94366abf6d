/**
 * What a designer asks of the response: to settle soon enough and not to overshoot by more. The verdict is on the rig's
 * steps. The s-plane's hatching is a guide: there a pair alone, as a second-order system, would miss it: settling to 2
 * % within 4/σ, overshoot e^(−πζ/√(1 − ζ²)). Pure.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {import('../types.js').Requirements} Requirements
 */
import { say, t } from '../text/index.js';
import { textOf } from './figure_texts.js';
import { AXIS } from './figures.js';
import { character } from './poles.js';

const SLACK = 1 + 1e-9; // a pole on the border itself is allowed

/** @type {Requirements} */
export const NONE = { settling: null, overshoot: null, lag: null };

/** What can be asked: s, %, s. @type {Record<keyof Requirements, {min: number, max: number, positive: boolean}>} */
export const RANGES = {
  settling: { min: 0, max: 1e3, positive: true },
  overshoot: { min: 0, max: 100, positive: false },
  lag: { min: 0, max: 10, positive: true },
};

/**
 * With one of them changed.
 * @param {Requirements} r
 * @param {string} name
 * @param {unknown} value
 * @returns {Requirements|null} null where that cannot be asked
 */
export function asking(r, name, value) {
  if (!Object.hasOwn(RANGES, name)) return null;
  const { min, max, positive } = RANGES[/** @type {keyof Requirements} */ (name)];
  if (value === null) return { ...r, [name]: null };
  return typeof value === 'number' && value >= min && value <= max && !(positive && value === 0)
    ? { ...r, [name]: value }
    : null;
}

/** Whether something is asked of the steps. @param {Requirements} r */
export const isAsked = (r) => r.settling !== null || r.overshoot !== null;

/**
 * Whether the loop bears less lag of the rotors than is asked; a stable one without a margin bears any.
 * @param {import('../types.js').Reply|null} reply
 * @param {Requirements} r
 */
export const missesLag = (reply, { lag }) =>
  lag !== null && reply !== null && !(reply.stable && (reply.lag_margin ?? Infinity) >= lag / SLACK);

/** The real part that no pole may exceed, rad/s. @param {Requirements} r @returns {number|undefined} */
export const fastestOf = ({ settling }) => (settling === null ? undefined : -4 / settling);

/** The damping ratio that no pole may fall short of. @param {Requirements} r @returns {number|undefined} */
export function leastDamping({ overshoot }) {
  if (overshoot === null) return undefined;
  if (overshoot <= 0) return 1;
  const log = Math.log(overshoot / 100);
  return -log / Math.hypot(Math.PI, log);
}

/**
 * What a pole alone would miss. One that grows never settles, and overshoots without end.
 * @param {Complex} p
 * @param {Requirements} r
 */
export function missed(p, { settling, overshoot }) {
  const it = character(p);
  return {
    settling: settling !== null && !((it.settling ?? Infinity) <= settling * SLACK),
    overshoot:
      overshoot !== null && !((it.settling === undefined ? Infinity : (it.overshoot ?? 0)) <= overshoot * SLACK),
  };
}

/**
 * Where a pole lies in the hatched plane, which is a guide; empty where it lies outside.
 * @param {Complex} p
 * @param {Requirements} r
 * @returns {string}
 */
export function guideWords(p, r) {
  const m = missed(p, r);
  return [m.settling && t('slower'), m.overshoot && t('less damped')].filter(Boolean).join(t(' and '));
}

/**
 * @typedef {import('../types.js').Axis} Axis
 * @typedef {{met: boolean, settling: boolean, overshoot: boolean, text: string}} Verdict of each requirement whether it
 *   is missed
 */
/** @type {Record<Axis, string>} */
const NAMES = { theta: 'pitch', psi: 'yaw' };
export const AXES = /** @type {Axis[]} */ (['theta', 'psi']);

/**
 * Whether a figure of the response misses what is asked; one that does not come about does.
 * @param {number|undefined} value
 * @param {number|null} asked
 */
export const misses = (value, asked) => asked !== null && !((value ?? Infinity) <= asked * SLACK);

/**
 * The one verdict on an axis: on the rig's own response, as the table shows it.
 * @param {import('../types.js').Reply|null} reply
 * @param {Axis} axis
 * @param {Requirements} r
 * @returns {Verdict|null} null where nothing is asked or the axis is not stepped
 */
export function verdictOf(reply, axis, r) {
  const own = reply?.axis_steps?.[axis]?.nonlinear.metrics?.[axis];
  if (!isAsked(r) || !own) return null;
  const [settling, overshoot] = [misses(own.settling_time, r.settling), misses(own.overshoot, r.overshoot)];
  const words = [
    settling &&
      (own.settling_time === undefined
        ? t('not settled')
        : say`settles in ${textOf(AXIS.settling, own.settling_time)}`),
    overshoot && say`overshoots by ${textOf(AXIS.overshoot, own.overshoot)}`,
  ];
  return {
    met: !settling && !overshoot,
    settling,
    overshoot,
    text: words.filter(Boolean).join(', ') || t('requirements met'),
  };
}

/**
 * The axes that miss what is asked, in words.
 * @param {import('../types.js').Reply|null} reply
 * @param {Requirements} r
 * @returns {string[]}
 */
export const missing = (reply, r) =>
  AXES.filter((axis) => verdictOf(reply, axis, r)?.met === false).map((axis) => t(NAMES[axis]));

/**
 * The forbidden regions as polygons in the plane, large enough for what is seen: right of −4/T, and outside the wedge
 * of least damping.
 * @param {{left: number, right: number, bottom: number, top: number}} seen @param {Requirements} r
 * @returns {{settling?: Complex[], overshoot?: Complex[]}}
 */
export function forbidden(seen, r) {
  /** @type {{settling?: Complex[], overshoot?: Complex[]}} */ const out = {};
  const edge = fastestOf(r);
  if (edge !== undefined && edge < seen.right) {
    const left = Math.max(edge, seen.left - 1);
    out.settling = [
      { re: left, im: seen.bottom },
      { re: left, im: seen.top },
      { re: seen.right, im: seen.top },
      { re: seen.right, im: seen.bottom },
    ];
  }
  const zeta = leastDamping(r);
  if (zeta !== undefined) {
    const far = 2 * Math.hypot(Math.max(-seen.left, seen.right), Math.max(seen.top, -seen.bottom));
    const end = { re: -zeta * far, im: Math.sqrt(1 - zeta * zeta) * far };
    const around = [
      { re: end.re, im: far },
      { re: far, im: far },
      { re: far, im: -far },
      { re: end.re, im: -far },
    ];
    out.overshoot = [{ re: 0, im: 0 }, end, ...around, { re: end.re, im: -end.im }];
  }
  return out;
}
