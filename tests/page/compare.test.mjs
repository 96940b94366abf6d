// What counts as a difference between the page's numbers and the server's: more than rounding and float32 explain.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { differenceOf } from '../../static/kernel/compare.js';

const pole = (re, im = 0) => ({ re, im });
const course = Array.from({ length: 101 }, (_, i) => Math.sin(i / 10));
const step = () => ({
  t: course.map((_, i) => i / 100),
  theta: [...course],
  psi: course.map((v) => v / 7),
  V_p: course.map((v) => 20 * v),
  V_y: course.map((v) => -v),
  metrics: {
    theta: {
      rise_time: 0.31,
      overshoot: 1e-7,
      steady_state_error: -1e-9,
      peak: 0.2,
      settled: true,
      settling_time: 1.2,
    },
    V_p: { peak: 21.5, saturated: 0, effort: 3.1 },
  },
  stable: true,
  findings: [{ code: 'a', severity: 'info', message: 'of another design' }],
});
const reply = () => ({
  seq: 1,
  gains: {
    K: [
      [19, 2, 8, 1],
      [-3, 19, 0, 9],
    ],
    norm: 31.2,
    pole_error: 3e-14,
    pole_error_bound: 1e-12,
    eigenvector_condition: 45.1,
    closed_loop_poles: [pole(-3, 4), pole(-3, -4), pole(-5), pole(-6)],
    controllability_indices: [2, 2],
    findings: [],
  },
  rga: { rga: [[1.1, -0.1]], reason: 'because', niederlinski: 0.9, findings: [] },
  loop_poles: [pole(-1, 2), pole(-1, -2), pole(-8)],
  lag_margin: 0.0163,
  margins: { pitch: { gain_margin: 3.4, phase_margin: 0.9 } },
  sensitivity: { peak: 1.4, peak_frequency: 12.1 },
  step: { linear: step(), nonlinear: step() },
  axis_steps: { theta: { linear: step(), nonlinear: step() } },
  stable: true,
  findings: [],
});

/** As the wire gives long arrays. */
function wired(value) {
  if (Array.isArray(value) && value.length > 50) return Float32Array.from(value);
  if (Array.isArray(value) || typeof value !== 'object' || value === null) return value;
  return Object.fromEntries(Object.entries(value).map(([name, own]) => [name, wired(own)]));
}

/** The paths to each number, flag and text; of a course to some. */
function* leaves(value, path = []) {
  if (typeof value !== 'object' || value === null) yield path;
  else for (const name of Object.keys(value)) if (!(name > 3 && name % 33)) yield* leaves(value[name], [...path, name]);
}

const at = (value, path) => path.reduce((inner, name) => inner[name], value);
function changed(path, change) {
  const whole = reply();
  const inner = at(whole, path.slice(0, -1));
  inner[path.at(-1)] = change(inner[path.at(-1)]);
  return whole;
}

const WORDS = /findings|reason|seq|controllability|peak_frequency/;

test('what the wire rounds, other words and other numbers of messages are no difference', () => {
  const other = { ...reply(), seq: 9, findings: [{ code: 'b', severity: 'error', message: 'else' }] };
  other.rga.reason = 'something else';
  assert.equal(differenceOf(reply(), wired(other)), null);
});

test('each number that is another is told, with both values', () => {
  let told = 0;
  for (const path of leaves(reply())) {
    const name = path.join('.');
    const value = at(reply(), path);
    if (WORDS.test(name)) continue;
    const other = changed(path, (v) => (typeof v === 'number' ? v + 0.02 * Math.max(1, Math.abs(v)) : !v));
    const found = differenceOf(reply(), wired(other));
    assert.ok(found, name);
    assert.ok(path.join('.').startsWith(found.name), `${found.name} is told in place of ${name}`);
    if (typeof value === 'number' && !/poles/.test(name)) assert.notEqual(found.own, found.server, name);
    told += 1;
  }
  assert.ok(told > 60);
});

test('the last digits of each are no difference', () => {
  for (const path of leaves(reply())) {
    if (typeof at(reply(), path) !== 'number') continue;
    const other = changed(path, (v) => v * (1 + 2e-7));
    assert.equal(WORDS.test(path.join('.')) ? null : differenceOf(reply(), other), null, path.join('.'));
  }
});

test('what only one of both has is a difference, but for what exact numbers tell the server alone', () => {
  const without = reply();
  delete without.step.linear.metrics.theta.settling_time;
  assert.deepEqual(
    [differenceOf(without, reply()), differenceOf(reply(), without)].map((d) => [d.name, d.own, d.server]),
    [
      ['step.linear.metrics.theta.settling_time', '–', '1.2'],
      ['step.linear.metrics.theta.settling_time', '1.2', '–'],
    ],
  );
  const doubtful = reply();
  for (const name of ['pole_error', 'pole_error_bound']) delete doubtful.gains[name];
  doubtful.gains.closed_loop_poles[0].re -= 0.1;
  assert.equal(differenceOf(doubtful, reply()), null);
  doubtful.gains = { ...reply().gains, closed_loop_poles: doubtful.gains.closed_loop_poles };
  assert.equal(differenceOf(reply(), doubtful).name, 'gains.closed_loop_poles');
});

test('poles are compared whatever their order, and their number counts', () => {
  const turned = reply();
  turned.loop_poles.reverse();
  assert.equal(differenceOf(reply(), turned), null);
  turned.loop_poles.pop();
  assert.equal(differenceOf(reply(), turned).name, 'loop_poles');
});

test('a number that is none differs from every number', () => {
  assert.equal(
    differenceOf(
      changed(['gains', 'norm'], () => NaN),
      reply(),
    ).name,
    'gains.norm',
  );
  assert.equal(
    differenceOf(
      changed(['step', 'linear', 'theta', 5], () => NaN),
      reply(),
    ).name,
    'step.linear.theta',
  );
});

test('a rig that rounding drives apart is not compared, and an unsettled one only so far', () => {
  for (const [part, by, told] of [
    [{ stable: true }, 1e-3, true],
    [{ stable: false }, 1e-3, false],
    [{ settled: false }, 1e-3, false],
    [{ settled: false }, 0.1, true],
  ]) {
    const [own, server] = [reply(), reply()];
    for (const { step: both } of [own, server]) {
      both.nonlinear.stable = part.stable ?? true;
      both.nonlinear.metrics.theta.settled = part.settled ?? true;
    }
    server.step.nonlinear.V_p[7] *= 1 + by;
    assert.equal(differenceOf(own, server) !== null, told, JSON.stringify([part, by]));
    server.step.linear.V_p[7] *= 1.01;
    assert.notEqual(differenceOf(own, server), null);
  }
});

test('the condition of eigenvectors that merge has no digits', () => {
  const of = (v) => changed(['gains', 'eigenvector_condition'], () => v);
  const none = of(1);
  delete none.gains.eigenvector_condition;
  for (const [own, server, told] of [
    [of(2.1e9), of(1.6e9), false],
    [none, of(1.6e9), false],
    [none, of(45), true],
    [of(2.1e9), of(45), true],
    [of(46), of(45), true],
  ])
    assert.equal(differenceOf(own, server) !== null, told);
});
