import assert from 'node:assert/strict';
import { test } from 'node:test';
import { complex, fixed, forField, parseNumber, significant } from '../../static/format.js';
import { bounds, fit, niceStep, outgrown, ticks, toPixel, toPlane, zoom } from '../../static/splane_math.js';
import { indexAt, rangeOf, trace } from '../../static/traces.js';
import { decodeFrame, encodeFrame } from '../../static/wire.js';

const VIEW = { cx: -5, cy: 1, scale: 20, width: 400, height: 300 };

test('pixels and plane are inverse to each other, and zooming keeps the pixel', () => {
  const p = { re: -3.25, im: 2.5 };
  const [x, y] = toPixel(VIEW, p);
  assert.deepEqual(toPlane(VIEW, x, y), p);
  assert.deepEqual(toPixel(zoom(VIEW, 2.5, x, y), p).map((v) => Math.round(v * 1e9) / 1e9), [x, y]);
});

test('fitting shows every placed pole and the imaginary axis', () => {
  const poles = [{ re: -12, im: 0 }, { re: -10, im: 0 }, { re: -3, im: 9 }, { re: -3, im: -9 }];
  const view = fit(poles, [{ re: -500, im: 0 }], { width: 376, height: 300 });
  const b = bounds(view);
  for (const p of poles) assert.ok(p.re > b.left && Math.abs(p.im) < b.top);
  assert.ok(b.right > 0 && b.left > -60);
  assert.equal(outgrown(view, poles), false);
  assert.equal(outgrown(view, [{ re: -100, im: 0 }]), true);
  assert.equal(outgrown(view, poles.map((p) => ({ re: p.re / 50, im: p.im / 50 }))), true);
});

test('ticks are round', () => {
  assert.equal(niceStep(10, 5), 2);
  assert.deepEqual(ticks(-1, 1, 0.5), [-1, -0.5, 0, 0.5, 1].map((v) => v + 0));
});

test('linear voltages get the trim, angles become degrees', () => {
  const step = { t: [0, 1], theta: [0, Math.PI], psi: [0, 0], V_p: [1, 2], V_y: [0, 0], trim: { V_p: 12, V_y: -4 } };
  assert.deepEqual([...trace(step, 'V_p', true)], [13, 14]);
  assert.deepEqual([...trace(step, 'V_p', false)], [1, 2]);
  assert.ok(Math.abs(trace(step, 'theta', false)[1] - 180) < 1e-4);
});

test('ranges hold what is solid, do not jitter, and are not squeezed by a linear trace that runs away', () => {
  const first = rangeOf({ solid: [0, 10], dashed: undefined, include: [0] });
  assert.ok(first[0] <= 0 && first[1] >= 10);
  assert.deepEqual(rangeOf({ solid: [0, 9.8], dashed: undefined, include: [0], previous: first }), first);
  const away = rangeOf({ solid: [0, 10], dashed: [-1e9, 1e9], include: [0] });
  assert.ok(away[1] < 30);
});

test('the sample at a time', () => {
  const t = [0, 0.5, 1, 1.5];
  assert.deepEqual([-1, 0.6, 1.5, 9].map((time) => indexAt(t, time)), [0, 1, 3, 3]);
});

test('frames come out as they went in', () => {
  const message = { seq: 1, text: 'ψ', step: { t: Float32Array.of(0, 0.5), theta: Float32Array.of(1, -2) }, list: [1, 2] };
  const read = decodeFrame(encodeFrame(message));
  assert.deepEqual(read, message);
  assert.throws(() => decodeFrame(encodeFrame(message).slice(0, 20)), RangeError);
});

test('numbers read well', () => {
  assert.equal(fixed(-0.001), '0.00');
  assert.equal(fixed(-1.5, 1), '−1.5');
  assert.deepEqual([51.170053, -0.61941, 1234567, 0].map((v) => significant(v, 4)), ['51.17', '−0.619', '1.23e6', '0.000']);
  assert.equal(complex({ re: -3, im: -4 }), '−3.00 − 4.00j');
  assert.equal(forField(0.1 + 0.2), '0.3');
  assert.deepEqual(['−3,5', ' 4 ', '1e2'].map(parseNumber), [-3.5, 4, 100]);
  assert.ok(Number.isNaN(parseNumber('')));
});
