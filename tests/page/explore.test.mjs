// The first minute: each of its steps knows when it was done, and not before.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { restOf, sideOf, STEPS, SWITCHES, swingOf } from '../../static/explore/steps.js';
import { designOf, initialState } from '../../static/model/store.js';
import { PRESETS } from './presets.mjs';

const step = (name) => STEPS.find((s) => s.name === name);
/** A state whose pitch step has these figures. */
const state = ({ design = {}, theta = {}, V_p = {}, rga } = {}) => ({
  ...initialState(),
  presets: PRESETS,
  design: { ...designOf(PRESETS[0]), outer: 'none', ...design },
  reply: { axis_steps: { theta: { nonlinear: { metrics: { theta, V_p } } } }, rga: { rga: [[rga ?? 1]] } },
});
const pitch = sideOf(0);
const swinging = [
  { re: -5, im: 6 },
  { re: -5, im: -6 },
  { re: -9, im: 0 },
  { re: -8, im: 0 },
];

test('there are six, each of two lines', () => {
  assert.deepEqual(
    STEPS.map((s) => s.name),
    ['swing', 'settle', 'saturate', 'pi', 'lag', 'cross'],
  );
  for (const { ask, see } of STEPS) {
    assert.match(ask(pitch), /^[A-Z].*\.$/);
    assert.ok(see.length <= 120, see);
  }
});

/** A state whose step goes along `course`, a share of the step by time, of a reference of 0.2 rad. */
function going(course, design = {}) {
  const t = Float64Array.from({ length: 501 }, (_, i) => i / 100);
  const of = state({ design });
  of.reply.axis_steps.theta.nonlinear = { t, theta: t.map((v) => 0.2 * course(v)), reference: { theta: 0.2, psi: 0 } };
  return of;
}
const creeping = (rate, end) => (t) => end * (1 - Math.exp(-rate * t));
/** Of a pair with damping ratio zeta: overshoots by exp(-pi zeta / sqrt(1 - zeta²)). */
const ringing = (zeta, end) => (t) => {
  const d = Math.sqrt(1 - zeta * zeta);
  return end * (1 - Math.exp(-8 * zeta * t) * (Math.cos(8 * d * t) + (zeta / d) * Math.sin(8 * d * t)));
};

test('swinging is past where the response ends, of a pair off the axis', () => {
  const { done } = step('swing');
  for (const end of [1, 1.04, 0.9]) {
    assert.equal(done(going(creeping(4, end), { poles: swinging }), pitch), false);
    assert.equal(done(going(ringing(0.8, end), { poles: swinging }), pitch), false); // 1.5 %
    assert.equal(done(going(ringing(0.6, end), { poles: swinging }), pitch), true); // 9.5 %
    assert.ok(Math.abs(swingOf(going(ringing(0.5, end)), pitch) - end * Math.exp(-Math.PI / Math.sqrt(3))) < 2e-3);
  }
  assert.equal(done(going(ringing(0.4, 1)), pitch), false, 'real poles do not swing');
  assert.equal(swingOf(state(), sideOf(1)), 0, 'nothing is known of yaw');
});

test('being quick is judged where the rig ends, beside its reference, too, and as it is shown', () => {
  const { done, now } = step('settle');
  for (const end of [1, 1.04]) {
    const slow = going(creeping(2, end));
    assert.ok(Math.abs(restOf(slow, pitch) - Math.log(end / 0.02) / 2) <= 0.011); // a sample
    assert.equal(done(slow, pitch), false);
    assert.equal(done(going(creeping(9, end)), pitch), true);
  }
  for (const rate of [6, 7, 7.5, 7.7, 7.9, 8, 8.2, 9]) {
    const it = going(creeping(rate, 1));
    const shown = Number(/[\d.]+/.exec(now(it, pitch))[0]);
    assert.equal(done(it, pitch), shown <= 0.5, `${shown} s`);
  }
  assert.equal(done(state(), sideOf(1)), false, 'nothing is known of yaw');
});

test('each step begins with a design of its own, in which it is not done', () => {
  for (const pair of [0, 1])
    for (const { name, begin } of STEPS) {
      const side = sideOf(pair);
      const design = begin(PRESETS[0], side);
      assert.equal(design.preset, PRESETS[0].name, name);
      assert.equal(design.outer, name === 'cross' ? 'pi' : 'none', name);
      assert.ok(
        design.poles.every(({ re }) => re < 0),
        name,
      );
      assert.ok(!SWITCHES.lag.on({ ...state(), design }), name);
    }
  const [fast, other] = [0, 1].map((pair) => step('lag').begin(PRESETS[0], sideOf(pair)).poles);
  assert.deepEqual(fast[0], other[2]);
  assert.deepEqual([fast[2], other[0]], [designOf(PRESETS[0]).poles[2], designOf(PRESETS[0]).poles[0]]);
});

test('its switches do what the steps ask for, and undo it', () => {
  const turned = (s, name, on) => ({ ...s, design: SWITCHES[name].turned(s.design, on, s) });
  for (const [asked, name] of [
    ['pi', 'pi'],
    ['lag', 'lag'],
  ]) {
    const still = { ...going(creeping(9, 1)).reply, stable: true };
    const [before, on] = [state(), turned({ ...state(), reply: still }, name, true)];
    assert.deepEqual([step(asked).done(before, pitch, true), SWITCHES[name].on(before)], [false, false]);
    assert.deepEqual([step(asked).done(on, pitch, true), SWITCHES[name].on(on)], [true, true]);
    if (asked === 'pi') assert.equal(step(asked).done(on, pitch, false), false, 'a pole must have been moved');
    else
      for (const [reply, course] of [
        [{ stable: false }, creeping(9, 1)],
        [{ stable: true }, creeping(1.5, 1)],
      ]) {
        const other = { ...on, reply: { ...going(course).reply, ...reply } };
        assert.equal(step(asked).done(other, pitch, true), false, 'it must have come to rest');
      }
    const off = turned(on, name, false);
    assert.deepEqual([step(asked).done(off, pitch, true), SWITCHES[name].on(off)], [false, false]);
  }
  const crossed = turned(turned(state({ rga: 0.3 }), 'first-aero', true), 'cross', true);
  assert.deepEqual(
    [crossed.design.preset, crossed.design.pairing, crossed.design.outer],
    ['quanser-aero', 'cross', 'pi'],
  );
  assert.equal(step('cross').done(crossed, pitch), true);
  const usual = turned(state({ rga: 1.007 }), 'cross', true);
  assert.equal(step('cross').done(usual, pitch), false, 'where the relative gain is against it');
  assert.equal(turned(crossed, 'pi', false).design.pairing, 'diagonal', 'without loops there is no pairing');
});

test('saturation is of the motor of the pair that is seen', () => {
  const { done, now } = step('saturate');
  for (const saturated of [0, 0.001, 0.0094, 0.0096, 0.02]) {
    const it = state({ V_p: { saturated } });
    assert.equal(done(it, pitch), Number(/[\d.]+/.exec(now(it, pitch))[0]) >= 1, `${saturated}`);
    assert.equal(done(it, sideOf(1)), false);
  }
});
