/**
 * What the scatter shows of what was found: scales, the nearest point, what a brush keeps. Pure.
 * @typedef {import('./shapes.js').Drawn} Drawn
 * @typedef {import('./shapes.js').Seen} Seen
 * @typedef {import('./shapes.js').SoFar} SoFar
 * @typedef {import('./shapes.js').Outcome} Outcome
 * @typedef {[low: number, high: number]} Range
 * @typedef {{index: number, x: number, y: number}} Point
 */
import { niceStep, ticks } from '../model/index.js';
import { MEASURED_FIGURES } from '../kernel/index.js';
import { isSame, shownValue, titleOf, unitOf } from './settings.js';

/** An axis' words: its title and the unit in which its numbers are. @param {Seen} figure */
export function axisTitle({ measure, title }) {
  const unit = unitOf(measure);
  return `${title || titleOf(measure)}${unit ? `, ${unit}` : ''}`;
}

/** The same in short, for a drawing. @param {Seen} figure */
export const shortTitle = (figure) => axisTitle({ ...figure, title: figure.title.split(',')[0] });

/** A design's figure in the unit in which it is read. @param {Drawn} found @param {Outcome} of @param {number} k */
export const readOf = (found, of, k) => readAs(found.figures[k], of.figures[k]?.value);

/** A value in the unit in which it is read. @param {Seen} figure @param {number|undefined} value */
export function readAs({ measure }, value) {
  if (value === undefined) return undefined;
  const v = MEASURED_FIGURES.get(measure)?.figure.signed ? Math.abs(value) : value;
  const shown = shownValue(measure, v);
  return Number.isFinite(shown) ? shown : undefined;
}

/** The two figures that tell most at first: the first of those that differ. @param {Drawn} found */
export function firstAxes(found) {
  const varied = found.figures
    .map((_, k) => k)
    .filter((k) => new Set(found.designs.map((d) => d.figures[k]?.text)).size > 1);
  const [x = 0, y = found.figures.length > 1 ? (x === 0 ? 1 : 0) : 0] = varied;
  return { x, y };
}

/** Those designs that have both figures. @param {Drawn} found @param {number} x @param {number} y @returns {Point[]} */
export const pointsOf = (found, x, y) =>
  found.designs.flatMap((design, index) => {
    const [a, b] = [readOf(found, design, x), readOf(found, design, y)];
    return a === undefined || b === undefined ? [] : [{ index, x: a, y: b }];
  });

/**
 * Where the front of a search that goes on lies in two of the figures.
 * @param {Drawn} found @param {number} x @param {number} y @param {SoFar} soFar
 * @returns {{x: number, y: number}[]|null} null where the search makes not both of them better
 */
export function soFarOn({ figures }, x, y, soFar) {
  const [a, b] = [x, y].map((k) => soFar.figures.findIndex((own) => isSame(own, figures[k])));
  if (a < 0 || b < 0 || a === b) return null;
  return soFar.points.flatMap((row) => {
    const [u, v] = [readAs(figures[x], row[a]), readAs(figures[y], row[b])];
    return u === undefined || v === undefined ? [] : [{ x: u, y: v }];
  });
}

/** What is drawn of a search before it has found anything: its figures. @param {SoFar} soFar @returns {Drawn} */
export const begun = ({ figures }) => ({ figures, designs: [], requirements: [] });

/** A little more than the values need. @param {number[]} values @returns {Range} */
export function rangeOf(values) {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  if (!Number.isFinite(low)) return [0, 1];
  const room = 0.08 * (high - low) || 0.1 * Math.abs(high) || 1;
  return [low >= 0 ? Math.max(0, low - room) : low - room, high + room];
}

/** @param {Range} range @param {number} count */
export const ticksOf = ([low, high], count) => ticks(low, high, niceStep(high - low, count));

/**
 * The nearest in pixels.
 * @param {Point[]} pixels where they are drawn
 * @param {number} x @param {number} y @param {number} [within]
 * @returns {number} its design's index; −1: none is near
 */
export function nearest(pixels, x, y, within = 28) {
  let [index, least] = [-1, within];
  for (const p of pixels) {
    const apart = Math.hypot(p.x - x, p.y - y);
    if (apart <= least) [index, least] = [p.index, apart];
  }
  return index;
}

/**
 * Designs within all brushed ranges.
 * @param {Drawn} found
 * @param {Map<number, Range>} brushes by figure, in the units that are read
 * @returns {Set<number>} their indices
 */
export const brushed = (found, brushes) =>
  new Set(
    [...found.designs.keys()].filter((i) =>
      [...brushes].every(([k, [low, high]]) => {
        const v = readOf(found, found.designs[i], k);
        return v !== undefined && v >= low && v <= high;
      }),
    ),
  );

/**
 * The next of those that are kept, along x.
 * @param {Point[]} points @param {Set<number>} kept @param {number} active @param {number} by
 */
export function stepped(points, kept, active, by) {
  const order = points.filter((p) => kept.has(p.index)).sort((a, b) => a.x - b.x || a.y - b.y);
  if (!order.length) return -1;
  const at = order.findIndex((p) => p.index === active);
  const from = at >= 0 ? at : by > 0 ? -1 : order.length;
  return order[Math.max(0, Math.min(order.length - 1, from + by))].index;
}

/** Limits of a figure, in the units that are read. @param {Drawn} found @param {number} k */
export const limitsOn = (found, k) =>
  found.requirements
    .filter(({ figure }) => figure === k)
    .flatMap(({ max, min, limit }) => [
      ...(max === undefined ? [] : [{ at: shownValue(found.figures[k].measure, max), most: true, limit }]),
      ...(min === undefined ? [] : [{ at: shownValue(found.figures[k].measure, min), most: false, limit }]),
    ]);
