/**
 * The page's own numbers beside the server's of the same design: what differs by more than rounding and the wire's
 * float32 explain. Pure.
 * @typedef {import('../types.js').Reply} Reply
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {{name: string, own: string, server: string, by: number}} Difference  by: in tolerances
 */

const COURSE = 1e-5; // of the largest value: float32 has seven digits, the integration as many as its tolerance
const FIGURE = 1e-6;
/** Poles that meet move by the root of rounding, as does where something is flat at its top. */
const POLE = 1e-4;
/** @type {Record<string, number>} */
const LOOSER = { eigenvector_condition: 1e-2 };
/** How large those are whose value may be nearly 0: they are compared by that. @type {Record<string, number>} */
const USUAL = {
  ...{ overshoot: 100, undershoot: 100, steady_state_error: 1, coupling_peak: 1, iae: 1e-2, itae: 1e-2 },
  ...{ pole_error: 1, pole_error_bound: 1, saturated: 1, effort: 1e-3, rga: 1, niederlinski: 1, niederlinski_cross: 1 },
};
/**
 * Words and what is taken from the server anyway; and where something is largest: what is as large elsewhere (twice on
 * the same stop) is told apart by rounding alone.
 */
const SKIPPED = new Set([
  ...['findings', 'reason', 'method', 'seq', 'controllability_indices', 'pairing', 'states'],
  ...['peak_time', 'peak_frequency', 'disk_frequency'],
]);

/** @param {unknown} v @returns {v is ArrayLike<number>} */
const isSeries = (v) => (Array.isArray(v) && typeof v[0] === 'number') || v instanceof Float32Array;

/** @param {unknown} v @returns {v is Complex[]} */
const arePoles = (v) => Array.isArray(v) && typeof v[0]?.re === 'number';

/** @param {unknown} v @returns {v is number[][]} */
const isMatrix = (v) => Array.isArray(v) && isSeries(v[0]);

/** Eigenvectors that rounding tells apart or not: their condition has no digits. @param {unknown} condition */
const areMerging = (condition) => condition === undefined || Number(condition) > 1e4;

/** @param {number} v */
const words = (v) => String(Number(v.toPrecision(7)));

/** @param {ArrayLike<number>} values */
const largest = (values) => Array.from(values).reduce((most, v) => Math.max(most, Math.abs(v)), 0);

/**
 * The farthest of two series.
 * @param {string} name @param {ArrayLike<number>} own @param {ArrayLike<number>} server @param {number} share
 * @param {number} [size] of the values, where they may all be nearly 0
 * @returns {Difference|null}
 */
function farthest(name, own, server, share, size = 1e-9) {
  // so many values
  if (own.length !== server.length) return { name, own: `${own.length}`, server: `${server.length}`, by: Infinity };
  const tolerance = share * Math.max(largest(server), size);
  let [at, most] = [0, 0];
  for (let i = 0; i < own.length; i++) {
    const apart = Math.abs(own[i] - server[i]);
    if (!(apart <= most)) [at, most] = [i, Number.isNaN(apart) ? Infinity : apart];
  }
  return most <= tolerance ? null : { name, own: words(own[at]), server: words(server[at]), by: most / tolerance };
}

/**
 * Poles have no order.
 * @param {string} name @param {Complex[]} own @param {Complex[]} server
 * @returns {Difference|null}
 */
function farthestPole(name, own, server) {
  if (own.length !== server.length) return farthest(name, Array(own.length), Array(server.length), POLE);
  const left = [...own];
  const told = ({ re, im } = { re: NaN, im: NaN }) => `${words(re)}${im ? ` ± ${words(Math.abs(im))}j` : ''}`;
  const tolerance = POLE * Math.max(largest(server.map((p) => Math.hypot(p.re, p.im))), 1e-3);
  /** @type {Difference|null} */ let worst = null;
  for (const p of server) {
    const apart = left.map((q) => Math.hypot(p.re - q.re, p.im - q.im));
    const at = apart.reduce((best, v, i) => (v < apart[best] ? i : best), 0);
    const [q] = left.splice(at, 1);
    const by = apart[at] / tolerance;
    if (!(by <= Math.max(1, worst?.by ?? 0))) worst = { name, own: told(q), server: told(p), by };
  }
  return worst;
}

/**
 * @param {string} path @param {string} key @param {unknown} own @param {unknown} server
 * @returns {Difference[]}
 */
function compared(path, key, own, server) {
  const one = (/** @type {Difference|null} */ found) => (found ? [found] : []);
  if (own === server || SKIPPED.has(key)) return [];
  if (key === 'eigenvector_condition' && areMerging(own) && areMerging(server)) return [];
  if (typeof own === 'number' && typeof server === 'number')
    return one(farthest(path, [own], [server], LOOSER[key] ?? FIGURE, USUAL[key] ?? 1e-12));
  if (isMatrix(own) && isMatrix(server)) return one(farthest(path, own.flat(), server.flat(), FIGURE, USUAL[key]));
  if (isSeries(own) && isSeries(server)) return one(farthest(path, own, server, COURSE));
  if (arePoles(own) && arePoles(server)) return one(farthestPole(path, own, server));
  if (isObject(own) && isObject(server)) {
    const found = Object.keys({ ...own, ...server })
      .filter((name) => !(DOUBTFUL.has(name) && own[name] === undefined))
      .flatMap((name) => compared(path ? `${path}.${name}` : name, name, own[name], server[name]));
    const slack = key === 'nonlinear' ? Math.min(slackOf(own), slackOf(server)) : 1;
    return found.filter(({ by }) => by > slack && (slack < UNSETTLED || by < Infinity));
  }
  return [{ name: path, own: said(own), server: said(server), by: Infinity }];
}

/**
 * How much farther apart a response of the rig may be: as its integration's tolerance, within which an explicit method
 * trembles at rest; an unstable loop magnifies rounding without bound, and one that does not come to rest may do so for
 * as long as it is at its limits.
 * @param {Record<string, unknown>} step
 */
function slackOf({ stable, metrics }) {
  if (!stable) return Infinity;
  const axes = /** @type {{settled?: boolean}[]} */ (Object.values(metrics ?? {}));
  return axes.some(({ settled }) => settled === false) ? UNSETTLED : INTEGRATED;
}
const UNSETTLED = 1000;
const INTEGRATED = 10;

/** What the page leaves out where it takes exact numbers, or is told for its own sake. */
const DOUBTFUL = new Set(['pole_error', 'pole_error_bound', 'observer']);

/** @param {unknown} v @returns {v is Record<string, unknown>} */
const isObject = (v) => typeof v === 'object' && v !== null && !ArrayBuffer.isView(v) && !Array.isArray(v);

/** @param {unknown} v */
const said = (v) =>
  typeof v === 'number' ? words(v) : v === undefined ? '–' : typeof v === 'object' ? '…' : String(v);

/**
 * What differs most; null where nothing does.
 * @param {Reply} own @param {Reply} server
 * @returns {Difference|null}
 */
export function differenceOf(own, server) {
  const doubtful = own.gains.pole_error === undefined; // the server's poles are exact then
  const { closed_loop_poles: _rounded, ...gains } = own.gains;
  const { closed_loop_poles: _exact, ...others } = server.gains;
  const [mine, theirs] = doubtful
    ? [
        { ...own, gains },
        { ...server, gains: others },
      ]
    : [own, server];
  const found = compared('', '', mine, theirs);
  return found.reduce((/** @type {Difference|null} */ worst, d) => (worst && worst.by >= d.by ? worst : d), null);
}
