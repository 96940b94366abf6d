/**
 * Geometry of the s-plane: which part of it is seen, and what its grid looks like. Pure.
 * A view is the rectangle of the plane in sight, with one scale for both axes (angles are damping ratios, so they must
 * be true).
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {{cx: number, cy: number, scale: number, width: number, height: number}} View centre, pixels per rad/s,
 *   pixels
 */
import { niceStep } from '../model/index.js';

/** @param {View} v @param {Complex} p @returns {[number, number]} pixels */
export const toPixel = (v, p) => [v.width / 2 + (p.re - v.cx) * v.scale, v.height / 2 - (p.im - v.cy) * v.scale];

/** @param {View} v @param {number} x @param {number} y @returns {Complex} */
export const toPlane = (v, x, y) => ({
  re: v.cx + (x - v.width / 2) / v.scale,
  im: v.cy - (y - v.height / 2) / v.scale,
});

/** @param {View} v */
export function bounds(v) {
  const w = v.width / 2 / v.scale;
  const h = v.height / 2 / v.scale;
  return { left: v.cx - w, right: v.cx + w, bottom: v.cy - h, top: v.cy + h };
}

/**
 * Zooms about a pixel, which keeps its place in the plane.
 * @param {View} v
 * @param {number} factor
 * @param {number} x
 * @param {number} y
 * @returns {View}
 */
export function zoom(v, factor, x, y) {
  const scale = Math.max(0.002, Math.min(5000, v.scale * factor));
  const p = toPlane(v, x, y);
  return { ...v, scale, cx: p.re - (x - v.width / 2) / scale, cy: p.im + (y - v.height / 2) / scale };
}

const RING = 11; // px: half a pole's mark

/**
 * The pole that a press takes: the topmost of the marks that it falls on; beside all marks, the nearest within reach.
 * @param {View} v
 * @param {readonly (Complex|undefined)[]} poles
 * @param {readonly number[]} order from the lowest to the topmost mark
 * @param {{x: number, y: number}} at @param {number} reach pixels
 * @returns {number|null}
 */
export function pick(v, poles, order, at, reach) {
  const away = order.map(() => Infinity);
  for (const [i, p] of poles.entries()) {
    if (!p) continue;
    const [x, y] = toPixel(v, p);
    away[i] = Math.hypot(x - at.x, y - at.y);
  }
  const onTop = order.findLast((i) => away[i] <= RING);
  if (onTop !== undefined) return onTop;
  const nearest = order.reduceRight((best, i) => (away[i] < away[best] ? i : best), order[order.length - 1]);
  return away[nearest] <= reach ? nearest : null;
}

/**
 * Two fingers: what lay between them stays between them, as far apart as they are now.
 * @param {View} v when they touched down
 * @param {[{x: number, y: number}, {x: number, y: number}]} from
 * @param {[{x: number, y: number}, {x: number, y: number}]} to
 * @returns {View}
 */
export function pinch(v, [a, b], [c, d]) {
  const apart = (/** @type {{x: number, y: number}} */ p, /** @type {{x: number, y: number}} */ q) =>
    Math.max(10, Math.hypot(p.x - q.x, p.y - q.y));
  const zoomed = zoom(v, apart(c, d) / apart(a, b), (a.x + b.x) / 2, (a.y + b.y) / 2);
  return {
    ...zoomed,
    cx: zoomed.cx - (c.x + d.x - a.x - b.x) / 2 / zoomed.scale,
    cy: zoomed.cy + (c.y + d.y - a.y - b.y) / 2 / zoomed.scale,
  };
}

/**
 * The view that shows the poles with room to drag, the imaginary axis, and a little of the right half plane. Of the
 * loop's poles only those count that are not far beyond the placed ones, as one fast pole must not make the rest tiny;
 * an unstable one must be seen.
 * @param {readonly Complex[]} placed @param {readonly Complex[]} others @param {{width: number, height: number}} size
 * @returns {View}
 */
export function fit(placed, others, { width, height }) {
  const reach = 1.6 * Math.max(1, ...placed.map((p) => Math.hypot(p.re, p.im)));
  const seen = [...placed, ...others.filter((p) => Math.hypot(p.re, p.im) <= (p.re >= 0 ? 8 : 1) * reach)];
  let left = Math.min(0, ...seen.map((p) => p.re));
  let right = Math.max(0, ...seen.map((p) => p.re));
  const up = Math.max(...seen.map((p) => Math.abs(p.im)));
  const span = Math.max(right - left, 0.5);
  left -= 0.18 * span;
  right += right > 0 ? 0.18 * span : 0.22 * span;
  const scale = Math.min(width / (right - left), height / (2 * Math.max(up * 1.2, 0.3 * span)));
  return { cx: (left + right) / 2, cy: 0, scale, width, height };
}

/** Without those that are far faster than the rest. @param {readonly Complex[]} poles @param {number} times */
export function slower(poles, times) {
  const sizes = poles.map((p) => Math.hypot(p.re, p.im));
  const second = sizes.toSorted((a, b) => a - b)[1] ?? Infinity;
  return poles.filter((_p, i) => sizes[i] <= times * Math.max(second, 0.1));
}

/**
 * Whether the poles need another view: one is out of sight, or all are huddled in a corner.
 * @param {View} v
 * @param {readonly Complex[]} placed
 */
export function outgrown(v, placed) {
  const b = bounds(v);
  const margin = 0.03 * (b.right - b.left);
  const out = placed.some((p) => p.re < b.left + margin || p.re > b.right - margin || Math.abs(p.im) > b.top - margin);
  const reach = Math.max(...placed.map((p) => Math.hypot(p.re, p.im)));
  return out || reach < 0.25 * (b.right - b.left);
}

export const DAMPING = [0.2, 0.4, 0.6, 0.8, 0.9];

/**
 * Where the ray of damping ratio ζ (upper left) leaves the view, or nothing.
 * @param {View} v
 * @param {number} zeta
 * @returns {[number, number]|undefined}
 */
export function rayEnd(v, zeta) {
  const b = bounds(v);
  const dir = { re: -zeta, im: Math.sqrt(1 - zeta * zeta) };
  if (b.left >= 0 || b.top <= 0) return undefined;
  const r = Math.min(b.left / dir.re, b.top / dir.im);
  return toPixel(v, { re: r * dir.re, im: r * dir.im });
}

/** Keyboard step: a round number near a fiftieth of what is seen. @param {View} v */
export const keyStep = (v) => niceStep(v.width / v.scale, 80);
