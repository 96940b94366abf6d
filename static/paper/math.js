/**
 * What the paper's section computes for itself: anchors, counts, figures, one worked example. Pure.
 *
 * @typedef {Partial<import('../contract.js').Evidence>} Form
 * @typedef {import('../contract.js').Equation} Equation
 * @typedef {import('../contract.js').PrintedNumber} PrintedNumber
 * @typedef {import('../contract.js').Erratum} Erratum
 * @typedef {import('../contract.js').Outcome} Consequence
 * @typedef {import('../contract.js').Figure} Curves
 * @typedef {import('../contract.js').Paper} Paper
 * @typedef {import('../types.js').Complex} Complex
 */
import { polesText as plainPoles, typographic } from '../text/index.js';

const FIRM = '\u00a0'; // a space at which no line breaks

/** "Eqs. 21, 22" → "eq-21-22", "Fig. 1" → "fig-1", "trim" → "eq-trim". @param {string} number */
export function anchorOf(number) {
  const slug = number.toLowerCase().replace(/[^a-z0-9]+/g, '-');
  if (/^eqs?-/.test(slug)) return slug.replace(/^eqs?-/, 'eq-');
  return /^(fig|table)-/.test(slug) ? slug : `eq-${slug}`;
}

/** As short as a table of contents wants it. @param {string} number */
export const shortOf = (number) => number.replace(/^Eqs?\. /, '').replace(', ', '–');

/**
 * @template T
 * @param {T[]} items
 * @param {(item: T) => string} key
 * @returns {[string, T[]][]} in the order of first appearance
 */
export function groupBy(items, key) {
  /** @type {Map<string, T[]>} */ const groups = new Map();
  for (const item of items) groups.set(key(item), [...(groups.get(key(item)) ?? []), item]);
  return [...groups];
}

/** @param {Paper} paper */
export function countsOf({ numbers, errata, equations }) {
  const having = (/** @type {string} */ verdict) => numbers.filter((n) => n.verdict === verdict).length;
  const [reproduced, differs, given] = ['reproduced', 'differs', 'given'].map(having);
  return {
    reproduced,
    differs,
    given,
    derivable: reproduced + differs,
    numbers: numbers.length,
    errata: errata.filter((e) => e.standing === 'confirmed').length,
    unclear: errata.filter((e) => e.standing !== 'confirmed').length,
    proofs: errata.filter((e) => e.proof.holds).length,
    status: Object.fromEntries(groupBy(equations, (e) => e.status).map(([status, list]) => [status, list.length])),
  };
}

/** @param {Pick<PrintedNumber, 'digits'|'digits_printed'>} n */
export const digitsText = ({ digits, digits_printed }) =>
  digits === undefined ? '–' : `${digits} of ${digits_printed}`;

/** ASCII minus before a digit → minus. @param {string} text */
export const minus = (text) => text.replace(/(^|[\s(=,])-(?=\d)/g, '$1\u2212');

/**
 * A number with that many digits at most and no trailing zeros; what rounding has left of an integer is that integer.
 * @param {number|undefined|null} v @param {number} [digits]
 */
export function figure(v, digits = 5) {
  if (v === undefined || v === null || !Number.isFinite(v)) return '–';
  const near = Math.round(v);
  if (Math.abs(v - near) < 1e-12 * Math.max(1, Math.abs(v))) return typographic(String(near || 0));
  const rounded = Number(v.toPrecision(digits));
  const size = Math.abs(rounded);
  const text = size >= 1e6 || size < 1e-4 ? rounded.toExponential().replace('e+', 'e') : String(rounded);
  return typographic(text);
}

/**
 * What rounding has left of zeros, taken away.
 * @param {number[][]|undefined|null} matrix
 * @returns {number[][]|undefined}
 */
export function clean(matrix) {
  if (!matrix) return undefined;
  const floor = 1e-13 * Math.max(...matrix.flat().map(Math.abs));
  return matrix.map((row) => row.map((v) => (Math.abs(v) <= floor ? 0 : v)));
}

/** A conjugate pair is written once, with ±. @param {Complex[]} poles @param {number} [decimals] */
export const polesText = (poles, decimals = 3) => plainPoles(poles, decimals).replace(/(?<!,) /g, FIRM);

/** @param {Complex} p */
export const dampingRatio = (p) => -p.re / Math.hypot(p.re, p.im);

/**
 * @typedef {{name: string, symbols: string, figures: string, value: number, unit: string, digits?: number}} Step one
 *   line of a worked example
 */
const f = (/** @type {number} */ v) => figure(v, 7);

/** Eq. 8 with the components' values. @param {Record<string, number>} c @returns {Step[]} */
export function thrustSteps(c) {
  const arm = (/** @type {'p'|'y'} */ a) => ({
    name: `K_${a}${a}`,
    symbols: `K_f,${a} r_${a}`,
    figures: `${f(c[`K_f${a}`])} N/V × ${f(c[`r_${a}`])} m`,
    value: c[`K_f${a}`] * c[`r_${a}`],
    unit: 'N·m/V',
  });
  const drag = (/** @type {string} */ name, /** @type {'p'|'y'} */ a) => ({
    name,
    symbols: `K_t,${a} / R_m,${a}`,
    figures: `${f(c[`K_t${a}`])} N·m/A / ${f(c[`R_${a}`])} Ω`,
    value: c[`K_t${a}`] / c[`R_${a}`],
    unit: 'N·m/V',
  });
  return [arm('p'), arm('y'), drag('K_py', 'y'), drag('K_yp', 'p')];
}

/** Eq. 1 with the components' values. @param {Record<string, number>} c @returns {Step[]} */
export function centreSteps({ m_p, m_y, m_shield, r_p, r_y }) {
  const [above, below] = [(m_p + m_shield) * r_p + (m_y + m_shield) * r_y, m_p + m_y + 2 * m_shield];
  return [
    {
      name: 'numerator',
      symbols: '(m_m,p + m_shield) r_p + (m_m,y + m_shield) r_y',
      figures: `${f(m_p + m_shield)} kg × ${f(r_p)} m + ${f(m_y + m_shield)} kg × ${f(r_y)} m`,
      value: above,
      unit: 'kg·m',
      digits: 6,
    },
    {
      name: 'denominator',
      symbols: 'm_m,p + m_m,y + 2 m_shield',
      figures: `${f(m_p)} kg + ${f(m_y)} kg + 2 × ${f(m_shield)} kg`,
      value: below,
      unit: 'kg',
    },
    { name: 'l', symbols: 'numerator / denominator', figures: '', value: above / below, unit: 'm' },
  ];
}
