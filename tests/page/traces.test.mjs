// From a reply to the plots: units, one voltage scale, ranges that hold still.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { extent, indexAt, rangeOf, trace, tracesOf } from '../../static/model/traces.js';

const step = (value) => ({
  t: [0, 1, 2],
  theta: [0, value, value],
  psi: [0, 0, 0],
  V_p: [value, 0, 0],
  V_y: [0, 0, 0],
  reference: { theta: value, psi: 0 },
  trim: { V_p: 12.5, V_y: -3.8 },
  metrics: {},
  stable: true,
});
const pair = (value) => ({ linear: step(value), nonlinear: step(value) });

test('angles are drawn in degrees', () => {
  assert.ok(Math.abs(trace(step(Math.PI / 6), 'theta', false)[1] - 30) < 1e-5);
});

test('linear voltages get the trim, nonlinear ones have it already', () => {
  assert.equal(trace(step(2), 'V_p', true)[0], 14.5);
  assert.equal(trace(step(2), 'V_p', false)[0], 2);
  assert.equal(trace(undefined, 'V_p', false), undefined);
});

test('the halo follows the motion that is played; an axis without a step has no trace', () => {
  const reply = { step: pair(0.3), axis_steps: { theta: pair(0.1) } };
  assert.ok(tracesOf(reply, 'both', true).plots.theta[0][1] > 17);
  assert.ok(tracesOf(reply, 'theta', true).plots.theta[0][1] < 6);
  const { plots } = tracesOf(reply, 'both', false);
  assert.deepEqual(
    plots.theta.map((v) => v !== undefined),
    [true, false, false, false, true, false, false],
  );
});

test('the speeds of rotors that take time are traces of their motor’s plot', () => {
  const step = pair(0.1);
  const speeds = { v_p: Float32Array.of(0, 1), v_y: Float32Array.of(0, 2) };
  const reply = { step, axis_steps: { theta: { ...step, nonlinear: { ...step.nonlinear, rotors: speeds } } } };
  const { plots } = tracesOf(reply, 'both', true);
  assert.deepEqual([plots.V_p[6], plots.V_y[6]], [speeds.v_p, speeds.v_y]);
  assert.deepEqual([plots.theta[6], plots.V_p[5]], [undefined, undefined]);
});

test('a range holds all solid traces and is not moved by a small change', () => {
  const first = rangeOf({ solid: [-1, 10], dashed: undefined, include: [0] });
  assert.ok(first[0] <= -1 && first[1] >= 10);
  assert.equal(rangeOf({ solid: [-1, 10.1], dashed: undefined, include: [0], previous: first }), first);
  assert.ok(rangeOf({ solid: [-1, 30], dashed: undefined, include: [0], previous: first })[1] >= 30);
  assert.ok(rangeOf({ solid: [0, 1], dashed: undefined, include: [0], previous: first })[1] < 5);
});

test('a linear trace that runs away does not squeeze the others', () => {
  const [low, high] = rangeOf({ solid: [0, 10], dashed: [-1e8, 1e8], include: [0] });
  assert.ok(low > -15 && high < 25);
});

test("a voltage's limit comes into sight when the motor nears it", () => {
  assert.ok(rangeOf({ solid: [0, 5], dashed: undefined, include: [0], limit: 24 })[1] < 10);
  assert.ok(rangeOf({ solid: [0, 20], dashed: undefined, include: [0], limit: 24 })[1] > 24);
  assert.ok(rangeOf({ solid: [-14, 2], dashed: undefined, include: [0], limit: 15 })[0] < -15);
});

test('extents skip what is missing', () => {
  assert.deepEqual(extent([undefined, [3, -1], [7]]), [-1, 7]);
  assert.equal(extent([undefined]), undefined);
});

test('a time finds its sample, also beyond the ends', () => {
  const t = [0, 0.5, 1, 1.5, 2];
  assert.deepEqual(
    [-1, 0.6, 5].map((time) => indexAt(t, time)),
    [0, 1, 4],
  );
});
