/** Numbers in words and figures, one way everywhere. Pure. */

const MINUS = '\u2212';
export const DEGREE = 180 / Math.PI;

/** The true minus for the programs'. @param {string} text */
export const typographic = (text) => text.replaceAll('-', MINUS);

/** Fixed decimals with a true minus; never "−0.00". @param {number|undefined} v @param {number} [decimals] */
export function fixed(v, decimals = 2) {
  if (v === undefined || !Number.isFinite(v)) return '–';
  const text = v.toFixed(decimals);
  return typographic(Number(text) === 0 ? text.replace('-', '') : text);
}

/**
 * About `digits` significant digits without an exponent unless it is needed.
 * @param {number|undefined} v
 * @param {number} [digits]
 */
export function significant(v, digits = 4) {
  if (v === undefined || !Number.isFinite(v)) return '–';
  const size = Math.abs(v);
  if (size !== 0 && (size >= 1e6 || size < 1e-4))
    return typographic(v.toExponential(Math.max(0, digits - 2)).replace('e+', 'e'));
  const leading = size === 0 ? 0 : Math.floor(Math.log10(Number(size.toPrecision(digits)))); // of what is shown
  // so that a small figure is not rounded to a zero
  const whole = leading >= 0 ? leading + 1 : leading === -1 ? 1 : leading + 2;
  return fixed(v, Math.max(0, digits - whole));
}

/**
 * A figure in few characters: from 10 on with one decimal, from 100 on with none, from 10⁴ on as a power of ten.
 * @param {string} text with one number in it
 */
export const brief = (text) =>
  text.replace(/(?<![\d.])(?:\d{3,}(?:\.\d+)?|\d\d\.\d\d+)/, (v) =>
    Number(v) >= 9999.5
      ? Number(v).toExponential(0).replace('e+', 'e')
      : Number(v) < 99.95
        ? Number(v).toFixed(1)
        : String(Math.round(Number(v))),
  );

/** No trailing zeros, plain minus, as programs write it. @param {number} v */
export const forField = (v) => String(Number(v.toPrecision(7)));
/** The same with the true minus that is used everywhere on the page. @param {number} v */
export const inField = (v) => typographic(forField(v));

/**
 * Accepts a comma for the point and the typographic minus, as people paste them.
 * @param {string} text
 * @returns {number} NaN if it is no number
 */
export function parseNumber(text) {
  const plain = text.trim().replaceAll(MINUS, '-').replace(',', '.');
  return plain === '' ? NaN : Number(plain);
}

const SIZE = '([\\d.]+(?:e[+-]?\\d+)?)?';
const COMPLEX = new RegExp(
  `^([+-]?[\\d.]+(?:e[+-]?\\d+)?)?(?:([+-]|±|\\+-)\\*?)?(?:${SIZE}\\*?[ij]|[ij]\\*?${SIZE})$`,
  'i',
);

/**
 * One of a conjugate pair as people write it: -3+2j, −3 ± 2i, -3-2*j, 2j.
 * @param {string} text
 * @returns {import('../types.js').Complex|null} null where it is none; the imaginary part as written, ± as +
 */
export function parseComplex(text) {
  const plain = text.replaceAll(MINUS, '-').replaceAll(',', '.').replace(/\s+/g, '');
  const parts = COMPLEX.exec(plain);
  if (!parts || (parts[1] !== undefined && parts[2] === undefined)) return imaginary(plain);
  const re = parts[1] === undefined ? 0 : Number(parts[1]);
  const size = parts[3] ?? parts[4];
  const im = (parts[2] === '-' ? -1 : 1) * (size === undefined ? 1 : Number(size));
  return Number.isFinite(re) && Number.isFinite(im) ? { re, im } : null;
}

/** @param {string} plain @returns {import('../types.js').Complex|null} */
function imaginary(plain) {
  const [, size] = /^([+-]?[\d.]+(?:e[+-]?\d+)?)\*?[ij]$/i.exec(plain) ?? [];
  return size !== undefined && Number.isFinite(Number(size)) ? { re: 0, im: Number(size) } : null;
}

/**
 * A complex number in any notation.
 * @param {import('../types.js').Complex} p
 * @param {{number: (v: number) => string, plus?: string, minus?: string, gap?: string, unit?: string}} notation
 */
export function complexIn({ re, im }, { number, plus = '+', minus = MINUS, gap = ' ', unit = 'j' }) {
  if (im === 0) return number(re);
  return `${number(re)}${gap}${im < 0 ? minus : plus}${gap}${number(Math.abs(im))}${unit}`;
}

/** @param {import('../types.js').Complex} p @param {number} [decimals] */
export const complex = (p, decimals = 2) => complexIn(p, { number: (v) => fixed(v, decimals) });

/** One that stands for its conjugate too. @param {import('../types.js').Complex} p @param {number} [decimals] */
export const conjugates = (p, decimals = 2) =>
  complexIn(p, { number: (v) => fixed(v, decimals), plus: '±', minus: '±' });

/**
 * A conjugate pair is written once.
 * @param {readonly import('../types.js').Complex[]} poles
 * @param {number} [decimals]
 */
export const polesText = (poles, decimals = 2) =>
  poles
    .filter((p) => p.im >= 0)
    .map((p) => conjugates(p, decimals))
    .join(', ');

/** What a pole says to those who hear it. @param {import('../types.js').Complex} p @param {string} name */
export const poleText = (p, name) => `${name}: ${complex(p, 1)} rad/s`;

/** @param {number|undefined} share 0…1 */
export const percent = (share, decimals = 0) => (share === undefined ? '–' : `${fixed(100 * share, decimals)} %`);

/** A share that is not none, and never reads as none. @param {number} part 0…1 */
export const share = (part) => (part < 0.0005 ? '< 0.1 %' : percent(part, part < 0.01 ? 1 : 0));

/** @param {number|undefined} ratio */
export const decibel = (ratio) =>
  ratio === undefined || !(ratio > 0) ? '–' : `${fixed(20 * Math.log10(ratio), 1)} dB`;

/** @param {number|undefined} rad */
export const degrees = (rad, decimals = 1) => (rad === undefined ? '–' : `${fixed(rad * DEGREE, decimals)}°`);

/** @param {number|undefined} s */
export const seconds = (s) =>
  s === undefined ? '–' : s < 0.1 ? `${fixed(1000 * s, s < 0.01 ? 1 : 0)} ms` : `${fixed(s, 2)} s`;

/** Relative difference from which two figures are told apart. */
const NOTABLE = 0.05;

/** @param {number|undefined} a @param {number|undefined} b @param {number} [least] below this size nothing differs */
export const differs = (a, b, least = 0) =>
  a !== b &&
  (a === undefined ||
    b === undefined ||
    Math.abs(a - b) > Math.max(least, NOTABLE * Math.max(Math.abs(a), Math.abs(b))));
