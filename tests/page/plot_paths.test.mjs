import assert from 'node:assert/strict';
import { test } from 'node:test';
import { corners } from '../../static/plot_paths.js';

const TOLERANCE = 0.2;

/** @param {number[]} xs @param {number[]} ys @returns {number[]} indices of the corners */
function cornersOf(xs, ys) {
  /** @type {number[]} */ const found = [];
  corners(xs, ys, 0, xs.length - 1, (i) => found.push(i), TOLERANCE);
  return found;
}

/** How far the points lie from the line through the corners, measured upright. */
function farthest(xs, ys, kept) {
  let worst = 0;
  for (let k = 1; k < kept.length; k++) {
    const [a, b] = [kept[k - 1], kept[k]];
    for (let i = a; i <= b; i++) worst = Math.max(worst, Math.abs(ys[i] - (ys[a] + ((ys[b] - ys[a]) * (xs[i] - xs[a])) / (xs[b] - xs[a]))));
  }
  return worst;
}

const xs = Array.from({ length: 501 }, (_, i) => i * 0.8);
/** A second-order step response in pixels. */
const response = (zeta, omega) => xs.map((_, i) => {
  const t = i / 100;
  const damped = omega * Math.sqrt(1 - zeta * zeta);
  return 120 * (1 - Math.exp(-zeta * omega * t) * (Math.cos(damped * t) + (zeta / Math.sqrt(1 - zeta * zeta)) * Math.sin(damped * t)));
});

test('a straight line has two corners', () => {
  assert.deepEqual(cornersOf(xs, xs.map((x) => 3 - 0.5 * x)), [0, 500]);
  assert.deepEqual(cornersOf([1, 2], [5, 9]), [0, 1]);
  assert.deepEqual(cornersOf([1], [5]), [0]);
});

test('no point lies off the line by more than the tolerance, and few corners are left', () => {
  for (const [zeta, omega] of [[0.1, 3], [0.4, 8], [0.7, 12], [0.99, 40], [0.02, 30]]) {
    const ys = response(zeta, omega);
    const kept = cornersOf(xs, ys);
    assert.ok(farthest(xs, ys, kept) <= TOLERANCE + 1e-9, `${zeta} ${omega}`);
    if (zeta > 0.3) assert.ok(kept.length < 160, `${kept.length} corners`);
  }
});

test('jumps, spikes and plateaus keep their corners', () => {
  const ys = xs.map((_, i) => (i < 100 ? 0 : i === 300 ? -40 : 50));
  const kept = cornersOf(xs, ys);
  assert.deepEqual(kept, [0, 99, 100, 299, 300, 301, 500]);
});

test('noise keeps what is above the tolerance', () => {
  let seed = 1;
  const noise = () => ((seed = (seed * 16807) % 2147483647) / 2147483647 - 0.5);
  const ys = xs.map(() => 3 * noise());
  const kept = cornersOf(xs, ys);
  assert.ok(farthest(xs, ys, kept) <= TOLERANCE + 1e-9);
});
