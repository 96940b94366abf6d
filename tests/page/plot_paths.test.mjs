import assert from 'node:assert/strict';
import { test } from 'node:test';
import { corners, plainPath } from '../../static/plots/paths.js';

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
    for (let i = a; i <= b; i++)
      worst = Math.max(worst, Math.abs(ys[i] - (ys[a] + ((ys[b] - ys[a]) * (xs[i] - xs[a])) / (xs[b] - xs[a]))));
  }
  return worst;
}

const xs = Array.from({ length: 501 }, (_, i) => i * 0.8);
/** A second-order step response in pixels. */
const response = (zeta, omega) =>
  xs.map((_, i) => {
    const t = i / 100;
    const damped = omega * Math.sqrt(1 - zeta * zeta);
    return (
      120 *
      (1 -
        Math.exp(-zeta * omega * t) *
          (Math.cos(damped * t) + (zeta / Math.sqrt(1 - zeta * zeta)) * Math.sin(damped * t)))
    );
  });

test('a straight line has two corners', () => {
  assert.deepEqual(
    cornersOf(
      xs,
      xs.map((x) => 3 - 0.5 * x),
    ),
    [0, 500],
  );
  assert.deepEqual(cornersOf([1, 2], [5, 9]), [0, 1]);
  assert.deepEqual(cornersOf([1], [5]), [0]);
});

test('no point lies off the line by more than the tolerance, and few corners are left', () => {
  for (const [zeta, omega] of [
    [0.1, 3],
    [0.4, 8],
    [0.7, 12],
    [0.99, 40],
    [0.02, 30],
  ]) {
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
  const noise = () => (seed = (seed * 16807) % 2147483647) / 2147483647 - 0.5;
  const ys = xs.map(() => 3 * noise());
  const kept = cornersOf(xs, ys);
  assert.ok(farthest(xs, ys, kept) <= TOLERANCE + 1e-9);
});

test('a path runs through the data as the axes place them, as far as a fifth of a pixel', () => {
  globalThis.Path2D = class {
    points = [];
    lineTo(x, y) {
      this.points.push([x, y]);
    }
  };
  const data = [
    xs.map((x) => x / 80),
    xs.map((_, i) => Math.sin(i / 40)),
    xs.map(() => null),
    xs.map((_, i) => Math.exp(-i / 60)),
  ];
  const u = {
    data,
    bbox: { left: 30, top: 12, width: 700, height: 240 },
    scales: { x: { min: 1, max: 4 }, y: { min: -2, max: 3 } },
  };
  for (const k of [1, 3]) {
    const { points } = plainPath(u, k, 100, 400).stroke;
    const [ends, values] = [
      [points[0], points[points.length - 1]],
      [100, 400],
    ];
    values.forEach((i, end) => {
      assert.ok(Math.abs((ends[end][0] - 30) / 700 - (data[0][i] - 1) / 3) < 1e-12, 'its share of the width');
      assert.ok(Math.abs((252 - ends[end][1]) / 240 - (data[k][i] + 2) / 5) < 1e-12, 'its share of the height');
    });
    for (let i = 100, at = 0; i <= 400; i++) {
      const [x, y] = [30 + (700 * (data[0][i] - 1)) / 3, 252 - (240 * (data[k][i] + 2)) / 5];
      while (points[at + 1][0] < x - 1e-9) at++;
      const [[x0, y0], [x1, y1]] = [points[at], points[at + 1]];
      assert.ok(Math.abs(y0 + ((y1 - y0) * (x - x0)) / (x1 - x0) - y) <= TOLERANCE + 1e-9);
    }
  }
  assert.equal(plainPath(u, 2, 100, 400), null); // a trace that is not there
  delete globalThis.Path2D;
});
