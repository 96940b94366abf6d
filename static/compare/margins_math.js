/**
 * Where on a loop's frequency response its margins are measured. The margins themselves are the server's, exact; here
 * they are found again on the samples, so that they can be drawn. Pure.
 * @typedef {{gain: number[], phase: number[]}} Loop  phase in rad, without jumps
 * @typedef {{gain_margin?: number, phase_margin?: number}} Margins
 * @typedef {{at: number, from: number, to: number}} Place  rad/s; dB or degrees: of the curve, and of the border
 */
import { DEGREE } from '../text/index.js';

/** Further from the exact margin than this it is another crossing: °, dB. */
const [PHASE_NEAR, GAIN_NEAR] = [3, 1];

/** @param {number[]} gain factors */
export const decibels = (gain) => gain.map((v) => 20 * Math.log10(v));

/** The multiple of a whole turn next to −180°. @param {number} phase degrees */
const critical = (phase) => 360 * Math.round((phase + 180) / 360) - 180;

/**
 * Where values cross a level, as places between two samples.
 * @param {number[]} values
 * @param {number} level
 * @returns {{i: number, share: number}[]}
 */
export function crossings(values, level) {
  const out = [];
  for (let i = 1; i < values.length; i++) {
    const [a, b] = [values[i - 1] - level, values[i] - level];
    if (a !== b && a * b <= 0 && b !== 0) out.push({ i, share: a / (a - b) });
  }
  return out;
}

/** @param {number[]} values @param {{i: number, share: number}} where */
const between = (values, { i, share }) => values[i - 1] + share * (values[i] - values[i - 1]);

/**
 * @param {Place[]} places
 * @param {(p: Place) => number} off how far from the exact margin
 * @param {number} near
 * @returns {Place|undefined}
 */
const nearest = (places, off, near) => places.filter((p) => off(p) <= near).sort((a, b) => off(a) - off(b))[0];

/**
 * @param {number[]} frequencies rad/s @param {Loop} loop @param {Margins|undefined} margins
 * @returns {{phase?: Place, gain?: Place}} what there is, and within the frequencies
 */
export function marginPlaces(frequencies, loop, margins) {
  const [dB, degrees, decades] = [
    decibels(loop.gain),
    loop.phase.map((v) => v * DEGREE),
    frequencies.map((w) => Math.log(w)),
  ];
  const { phase_margin: pm, gain_margin: gm } = margins ?? {};
  /** @type {{phase?: Place, gain?: Place}} */ const out = {};
  if (pm !== undefined) {
    const places = crossings(dB, 0).map((c) => ({
      at: Math.exp(between(decades, c)),
      from: between(degrees, c),
      to: critical(between(degrees, c)),
    }));
    out.phase = nearest(places, (p) => Math.abs(Math.abs(p.from - p.to) - pm * DEGREE), PHASE_NEAR);
  }
  if (gm !== undefined) {
    const turns = [...new Set(degrees.map(critical))];
    const places = turns
      .flatMap((level) => crossings(degrees, level))
      .map((c) => ({ at: Math.exp(between(decades, c)), from: between(dB, c), to: 0 }));
    out.gain = nearest(places, (p) => Math.abs(-p.from - 20 * Math.log10(gm)), GAIN_NEAR);
  }
  return out;
}
