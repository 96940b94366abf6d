import assert from 'node:assert/strict';
import { test } from 'node:test';
import { clipped } from '../../static/machine/clipped.js';

const BOX = { width: 100, height: 50 };

test('what lies within stays as it is, and what lies outside is gone', () => {
  const line = [
    [10, 10],
    [20, 40],
    [90, 45],
  ];
  assert.deepEqual(clipped(line, BOX), [line]);
  const beyond = line.map(([x, y]) => [x - 1e6, y]);
  assert.deepEqual(clipped(beyond, BOX), []);
  assert.deepEqual(clipped([[5, -1]], BOX), []);
  const beside = [
    [-5, 10],
    [-5, 40],
  ];
  assert.deepEqual(clipped(beside, BOX), []);
});

test('a line from far away begins at the edge', () => {
  const line = [
    [-1e6, 20],
    [50, 20],
    [50, 1e6],
  ];
  const [[first, corner, last]] = clipped(line, BOX);
  assert.deepEqual(
    [first, corner, last].map((p) => p.map((v) => Number(v.toFixed(6)))),
    [
      [0, 20],
      [50, 20],
      [50, 50],
    ],
  );
});

test('one that leaves and comes back is two', () => {
  const line = [
    [50, 25],
    [50, 75],
    [80, 75],
    [80, 25],
  ];
  assert.deepEqual(clipped(line, BOX), [
    [
      [50, 25],
      [50, 50],
    ],
    [
      [80, 50],
      [80, 25],
    ],
  ]);
});

test('every point of a part is a point of the line, and within', () => {
  let seed = 1;
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  for (let k = 0; k < 300; k++) {
    const line = Array.from({ length: 8 }, () => [400 * random() - 150, 250 * random() - 100]);
    const off = ([x, y]) =>
      Math.min(
        ...line.slice(1).map(([x1, y1], i) => {
          const [x0, y0] = line[i];
          const size = (x1 - x0) ** 2 + (y1 - y0) ** 2;
          const t = Math.max(0, Math.min(1, ((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / size));
          return Math.hypot(x - x0 - t * (x1 - x0), y - y0 - t * (y1 - y0));
        }),
      );
    const parts = clipped(line, BOX);
    for (const [x, y] of parts.flat()) {
      assert.ok(off([x, y]) < 1e-9);
      assert.ok(x >= -1e-9 && x <= 100 + 1e-9 && y >= -1e-9 && y <= 50 + 1e-9);
    }
    // and nothing within is lost
    for (const [x, y] of line.filter(([x, y]) => x > 0 && x < 100 && y > 0 && y < 50))
      assert.ok(parts.flat().some(([u, v]) => Math.hypot(u - x, v - y) < 1e-9));
  }
});
