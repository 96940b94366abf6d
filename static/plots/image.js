/** A plot over time as a picture: what is seen, with its words. */
import { TITLES } from './export.js';
import { say, t } from '../text/index.js';
import { isVoltage } from '../model/index.js';

/** @typedef {import('./export.js').Line} Line @typedef {import('../model/traces.js').Signal} Signal */
/**
 * @typedef {{x: [number, number], y: [number, number], rules: import('./rules.js').Rule[], regions?:
 *   import('./rules.js').Region[], marks?: import('./characteristics.js').Mark[]}} Seen ranges in s and in the plot's
 *   unit
 */

/**
 * @param {Signal} signal
 * @param {Line[]} lines
 * @param {import('../types.js').Pin[]} pins their pins, for the letters
 * @param {Seen & {subtitle: string}} how
 * @returns {import('./picture.js').Picture}
 */
export function pictureOf(signal, lines, pins, { x, y, subtitle, rules, regions, marks }) {
  const symbol = TITLES[signal].split(' ').pop();
  return {
    title: t(TITLES[signal]),
    subtitle,
    lines,
    pins,
    rules,
    regions,
    marks,
    x: { range: x, title: t('Time in s') },
    y: { range: y, title: isVoltage(signal) ? `${symbol} in V` : say`${symbol} in degrees` },
  };
}
