// The view of the s-plane: pixels and plane agree, a fit shows what it should.
import assert from "node:assert/strict";
import { test } from "node:test";

import { bounds, fit, niceStep, outgrown, rayEnd, ticks, toPixel, toPlane, zoom } from "../../static/splane_math.js";

const SIZE = { width: 400, height: 380 };
const real = (...values) => values.map((re) => ({ re, im: 0 }));

test("a pixel and its point in the plane are one another's inverse", () => {
  const view = { cx: -4, cy: 1, scale: 17, ...SIZE };
  const [x, y] = toPixel(view, { re: -3.25, im: 2.5 });
  const p = toPlane(view, x, y);
  assert.ok(Math.abs(p.re + 3.25) < 1e-12 && Math.abs(p.im - 2.5) < 1e-12);
});

test("zooming keeps the point under the pointer", () => {
  const view = { cx: -4, cy: 0, scale: 17, ...SIZE };
  const before = toPlane(view, 120, 90);
  const after = toPlane(zoom(view, 2.5, 120, 90), 120, 90);
  assert.ok(Math.hypot(before.re - after.re, before.im - after.im) < 1e-12);
});

for (const [name, placed] of Object.entries({
  "the paper's poles": real(-12, -10, -9.25, -8.76),
  "complex pairs": [{ re: -3, im: 4 }, { re: -3, im: -4 }, { re: -5, im: 2 }, { re: -5, im: -2 }],
  "tall pairs": [{ re: -1, im: 30 }, { re: -1, im: -30 }, ...real(-2, -3)],
  "an unstable pole": real(4, -3, -2, -1),
  "poles at the origin": real(0, 0, 0, 0),
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

test("a view is outgrown by a pole out of sight and by poles in a corner", () => {
  const view = fit(real(-12, -10, -9, -8), [], SIZE);
  assert.equal(outgrown(view, real(-40, -10, -9, -8)), true);
  assert.equal(outgrown(view, real(-0.5, -0.4, -0.3, -0.2)), true);
});

test("grid steps are 1, 2 or 5 times a power of ten, and ticks lie on them", () => {
  for (const span of [0.013, 0.7, 3, 18, 45, 900]) {
    const step = niceStep(span, 8);
    const lead = Number(step.toExponential(6).split("e")[0]);
    assert.ok([1, 2, 5].includes(lead), `${span}: ${step}`);
  }
  assert.deepEqual(ticks(-0.31, 0.2, 0.1), [-0.3, -0.2, -0.1, 0, 0.1, 0.2]);
});

test("a ray of constant damping ends on the border, at its angle", () => {
  const view = fit(real(-12, -10, -9, -8), [], SIZE);
  const end = rayEnd(view, 0.6);
  assert.ok(end);
  const p = toPlane(view, ...end);
  assert.ok(Math.abs(-p.re / Math.hypot(p.re, p.im) - 0.6) < 1e-9);
  assert.ok(Math.abs(end[0]) < 1e-9 || Math.abs(end[1]) < 1e-9);
});

test('an unstable pole of the loop is brought into view, a fast stable one is not', () => {
  const placed = [{ re: -3, im: 0 }, { re: -2, im: 0 }, { re: -3, im: 0 }, { re: -2, im: 0 }];
  const seen = (view, p) => p.re > bounds(view).left && p.re < bounds(view).right && Math.abs(p.im) < bounds(view).top;
  assert.ok(seen(fit(placed, [{ re: 1.2, im: 9.7 }, { re: 1.2, im: -9.7 }], { width: 380, height: 440 }), { re: 1.2, im: 9.7 }));
  assert.ok(!seen(fit(placed, [{ re: -90, im: 0 }], { width: 380, height: 440 }), { re: -90, im: 0 }));
});
