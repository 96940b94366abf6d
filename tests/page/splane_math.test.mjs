// The view of the s-plane: pixels and plane agree, a fit shows what it should.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { niceStep, ticks } from '../../static/model/ticks.js';
import { bounds, fit, outgrown, pick, pinch, rayEnd, toPixel, toPlane, zoom } from '../../static/splane/math.js';

const SIZE = { width: 400, height: 380 };
const real = (...values) => values.map((re) => ({ re, im: 0 }));

test("a pixel and its point in the plane are one another's inverse", () => {
  const view = { cx: -4, cy: 1, scale: 17, ...SIZE };
  const [x, y] = toPixel(view, { re: -3.25, im: 2.5 });
  const p = toPlane(view, x, y);
  assert.ok(Math.abs(p.re + 3.25) < 1e-12 && Math.abs(p.im - 2.5) < 1e-12);
});

test('zooming keeps the point under the pointer', () => {
  const view = { cx: -4, cy: 0, scale: 17, ...SIZE };
  const before = toPlane(view, 120, 90);
  const after = toPlane(zoom(view, 2.5, 120, 90), 120, 90);
  assert.ok(Math.hypot(before.re - after.re, before.im - after.im) < 1e-12);
});

for (const [name, placed] of Object.entries({
  "the paper's poles": real(-12, -10, -9.25, -8.76),
  'complex pairs': [
    { re: -3, im: 4 },
    { re: -3, im: -4 },
    { re: -5, im: 2 },
    { re: -5, im: -2 },
  ],
  'tall pairs': [{ re: -1, im: 30 }, { re: -1, im: -30 }, ...real(-2, -3)],
  'an unstable pole': real(4, -3, -2, -1),
  'poles at the origin': real(0, 0, 0, 0),
})) {
  test(`a fit shows ${name}, the imaginary axis and some of the right half plane`, () => {
    const view = fit(placed, real(-500), SIZE);
    const b = bounds(view);
    for (const p of [...placed, { re: 0, im: 0 }]) {
      assert.ok(b.left < p.re && p.re < b.right && b.bottom < p.im && p.im < b.top, JSON.stringify({ b, p }));
    }
    assert.ok(b.right > 0.04 * (b.right - b.left));
    if (placed.some((p) => p.re !== 0)) assert.equal(outgrown(view, placed), false);
  });
}

test('a view is outgrown by a pole out of sight and by poles in a corner', () => {
  const view = fit(real(-12, -10, -9, -8), [], SIZE);
  assert.equal(outgrown(view, real(-40, -10, -9, -8)), true);
  assert.equal(outgrown(view, real(-0.5, -0.4, -0.3, -0.2)), true);
});

test('grid steps are 1, 2 or 5 times a power of ten, and ticks lie on them', () => {
  for (const span of [0.013, 0.7, 3, 18, 45, 900]) {
    const step = niceStep(span, 8);
    const lead = Number(step.toExponential(6).split('e')[0]);
    assert.ok([1, 2, 5].includes(lead), `${span}: ${step}`);
  }
  assert.deepEqual(ticks(-0.31, 0.2, 0.1), [-0.3, -0.2, -0.1, 0, 0.1, 0.2]);
});

test('a ray of constant damping ends on the border, at its angle', () => {
  const view = fit(real(-12, -10, -9, -8), [], SIZE);
  const end = rayEnd(view, 0.6);
  assert.ok(end);
  const p = toPlane(view, ...end);
  assert.ok(Math.abs(-p.re / Math.hypot(p.re, p.im) - 0.6) < 1e-9);
  assert.ok(Math.abs(end[0]) < 1e-9 || Math.abs(end[1]) < 1e-9);
});

test('an unstable pole of the loop is brought into view, a fast stable one is not', () => {
  const placed = [
    { re: -3, im: 0 },
    { re: -2, im: 0 },
    { re: -3, im: 0 },
    { re: -2, im: 0 },
  ];
  const seen = (view, p) => p.re > bounds(view).left && p.re < bounds(view).right && Math.abs(p.im) < bounds(view).top;
  assert.ok(
    seen(
      fit(
        placed,
        [
          { re: 1.2, im: 9.7 },
          { re: 1.2, im: -9.7 },
        ],
        { width: 380, height: 440 },
      ),
      { re: 1.2, im: 9.7 },
    ),
  );
  assert.ok(!seen(fit(placed, [{ re: -90, im: 0 }], { width: 380, height: 440 }), { re: -90, im: 0 }));
});

test('a press takes the topmost mark under it, and beside all marks the nearest within reach', () => {
  const view = { cx: -5, cy: 0, scale: 20, ...SIZE };
  const poles = real(-12, -10, -9.25, -9);
  const at = (re, dy = 0) => ({ x: toPixel(view, { re, im: 0 })[0], y: SIZE.height / 2 + dy });
  const order = [3, 2, 1, 0];
  assert.equal(pick(view, poles, order, at(-9.1), 28), 2);
  assert.equal(pick(view, poles, [2, 1, 0, 3], at(-9.1), 28), 3);
  assert.equal(pick(view, poles, [2, 1, 0, 3], at(-9.25), 28), 3); // also right on the one below
  assert.equal(pick(view, poles, order, at(-9, 20), 28), 3);
  assert.equal(pick(view, poles, order, at(-12, 40), 28), null);
  const same = real(-9, -9, -9, -9);
  for (const top of [0, 1, 2, 3])
    assert.equal(pick(view, same, [...order.filter((i) => i !== top), top], at(-9, 20), 28), top);
});

test('two fingers keep what was between them between them', () => {
  const view = { cx: -5, cy: 1, scale: 20, ...SIZE };
  const [a, b, c, d] = [
    { x: 100, y: 100 },
    { x: 200, y: 140 },
    { x: 60, y: 150 },
    { x: 260, y: 230 },
  ];
  const after = pinch(view, [a, b], [c, d]);
  assert.ok(Math.abs(after.scale / view.scale - 2) < 1e-9);
  const [before, now] = [toPlane(view, 150, 120), toPlane(after, 160, 190)];
  assert.ok(Math.hypot(before.re - now.re, before.im - now.im) < 1e-9);
  assert.deepEqual(pinch(view, [a, b], [a, b]), view);
});
