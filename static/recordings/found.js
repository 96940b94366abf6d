/**
 * What an identification says: both fits, curves before and after, what is left, and whether that is white. Pure.
 * @typedef {import('../contract.js').IdentificationReply} IdentificationReply
 * @typedef {import('../types.js').Axis} Axis
 * @typedef {[number[], ...(number|null)[][]]} Curves
 */
import { DEGREE, fixed, inField, say, significant } from '../text/index.js';

const AXES = /** @type {const} */ ([
  ['theta', 'pitch'],
  ['psi', 'yaw'],
]);

/** @param {(number|null)[]} values rad */
const inDegrees = (values) => values.map((v) => (v === null ? null : v * DEGREE));

/** @param {IdentificationReply} found @param {Axis} axis @returns {Curves} t, measured, before, after, in degrees */
export const fittedCurves = ({ courses }, axis) => [
  courses.t,
  ...[courses.measured, courses.before, courses.after].map((own) => inDegrees(own[axis])),
];

/** @param {IdentificationReply} found @param {Axis} axis @returns {Curves} t and what is left, in degrees */
export const residualCurve = ({ courses }, axis) => [courses.t, inDegrees(courses.residuals[axis])];

/** @param {IdentificationReply} found @param {Axis} axis @returns {Curves} time lags, ms, from one sample on; shares */
export function correlationCurve({ whiteness, sample_time }, axis) {
  const { correlations } = whiteness[axis];
  return [correlations.map((_v, k) => 1e3 * (k + 1) * sample_time), correlations];
}

/**
 * Room for correlations, and for twice the band of white residuals.
 * @param {IdentificationReply} found
 * @param {Axis} axis
 * @returns {[number, number]}
 */
export function rangeOfCorrelation({ whiteness }, axis) {
  const { correlations, band } = whiteness[axis];
  const size = 1.15 * Math.max(2 * band, ...correlations.map(Math.abs));
  return [-size, size];
}

/**
 * Where what was held out lies, s; null where nothing was.
 * @param {IdentificationReply} found
 * @returns {[number, number]|null}
 */
export function heldOut({ parts }) {
  const part = parts.find((own) => own.held_out);
  return part ? [part.first, part.end] : null;
}

/**
 * Room for what was measured and found; what was wrong before is cut off.
 * @param {Curves} data
 * @returns {[number, number]}
 */
export function rangeOfFit([, measured, , after]) {
  const seen = [...measured, ...after].filter((v) => v !== null);
  const [low, high] = [Math.min(...seen), Math.max(...seen)];
  const room = Math.max(0.12 * (high - low), 0.5);
  return [low - room, high + room];
}

/**
 * The same room above and below zero.
 * @param {Curves} data
 * @returns {[number, number]}
 */
export function rangeOfRest([, values]) {
  const size = 1.1 * Math.max(1e-6, ...values.map((v) => Math.abs(v ?? 0)));
  return [-size, size];
}

/** @param {number|null|undefined} v % */
const share = (v) =>
  v === null || v === undefined
    ? '–'
    : v < -100
      ? 'below −100 %'
      : say`${fixed(v > 99.995 ? Math.min(v, 99.99) : v, 2)} %`;

/**
 * A row for each part and axis: fit, variance accounted for, residuals, of the rig as it was and as it was found.
 * @param {IdentificationReply} found
 * @returns {{id: string, part: string, axis: string, fit: [string, string], variance: [string, string],
 *   rms: [string, string]}[]}
 */
export const partRows = ({ parts }) =>
  parts.flatMap((part) =>
    AXES.map(([axis, name]) => {
      const pair = (/** @type {'fit'|'variance'|'rms'} */ key) => [part.before?.[key][axis], part.after[key][axis]];
      const rest = (/** @type {number|null|undefined} */ v) =>
        typeof v === 'number' ? `${significant(v * DEGREE, 3)}°` : '–';
      const when = `${fixed(part.first, 1)} … ${fixed(part.end, 1)} s`;
      return {
        id: `${part.held_out ? 'held' : 'fitted'}-${axis}`,
        part: part.held_out ? say`held out, ${when}` : say`fitted, ${when}`,
        axis: name,
        fit: /** @type {[string, string]} */ (pair('fit').map(share)),
        variance: /** @type {[string, string]} */ (pair('variance').map(share)),
        rms: /** @type {[string, string]} */ (pair('rms').map(rest)),
      };
    }),
  );

/** Whether residuals are white, in words. @param {IdentificationReply} found @param {Axis} axis */
export function whitenessWords({ whiteness }, axis) {
  const { white, probability, span } = whiteness[axis];
  const chance = significant(probability, 3);
  if (white) return say`White: white residuals would be correlated as much with a probability of ${chance}.`;
  const over = significant(1e3 * span, 2);
  return say`Not white: correlated over some ${over} ms. The model leaves something out, or the noise is correlated.`;
}

/**
 * As many decimals as two digits of the interval's half width need.
 * @param {number} v
 * @param {import('../contract.js').EstimateReply} e
 */
function as(v, { low, high }) {
  const half = (high - low) / 2;
  return fixed(v, half > 0 ? Math.max(0, Math.min(12, 1 - Math.floor(Math.log10(half)))) : 6);
}

/**
 * One row per parameter.
 * @param {IdentificationReply} found
 * @returns {{name: string, unit: string, before: string, value: string, width: string, noise: string,
 *   interval: string}[]}
 */
export const estimateRows = (found) =>
  found.estimates.map((e) => ({
    name: e.name,
    unit: e.unit,
    before: inField(e.before),
    value: as(e.value, e),
    width: `± ${as((e.high - e.low) / 2, e)}`,
    noise: `± ${significant(e.noise, 3)}`,
    interval: `${as(e.low, e)} … ${as(e.high, e)}`,
  }));
