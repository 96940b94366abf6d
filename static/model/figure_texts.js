/** How the registry of figures (figures.js) says that its values are read. Pure. */
import { decibel, fixed, seconds, significant, typographic } from '../text/index.js';
import { STEP } from './figures.js';

/** @typedef {import('./figures.js').Figure} Figure */

/**
 * A value as it is written, with its unit where that does not stand at the row's head.
 * @param {Figure} figure
 * @param {number|undefined} v
 * @returns {string}
 */
export function textOf({ notation, digits, scale = 1, after = '' }, v) {
  if (v === undefined) return '–';
  if (notation === 'seconds') return seconds(v);
  if (notation === 'decibel') return decibel(v);
  if (notation === 'exponent') return v === 0 ? '0' : typographic(v.toExponential(digits));
  return `${(notation === 'significant' ? significant : fixed)(v * scale, digits)}${after}`;
}

/** Meaning and source, as a tooltip tells them. @param {Figure} figure */
export const tipOf = ({ meaning, source }) => `${meaning}${source ? ` (${source})` : ''}`;

/** 1 where less is better, −1 where more is. @param {Figure} figure @returns {1|-1} */
export const signOf = ({ better }) => (better === 'higher' ? -1 : 1);

/**
 * A figure of a reply's part, by its name in the registry.
 * @param {object|undefined} part
 * @param {string} name
 */
export const figureIn = (part, name) => /** @type {Record<string, number|undefined>} */ (part ?? {})[name];

/**
 * The value of a figure of an axis' step: the axis' own, or one that its step has.
 * @param {import('../types.js').Metrics|undefined} metrics
 * @param {import('../types.js').Axis} axis
 * @param {string} key  of RESPONSE
 * @param {Figure} figure
 * @returns {number|undefined}
 */
export const valueIn = (metrics, axis, key, { name }) => figureIn(key in STEP ? metrics : metrics?.[axis], name);
