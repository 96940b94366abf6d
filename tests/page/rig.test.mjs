// The rig's parameters and limits: what differs from the preset, and the way back.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { linkOf, readLink } from '../../static/link/permalink.js';
import {
  asProposed,
  changedWords,
  isChanged,
  lagOf,
  lags,
  proposedShown,
  quantities,
  valueOf,
  without,
  withValue,
} from '../../static/model/rig.js';
import { bodyOf, designOf, initialState } from '../../static/model/store.js';
import { KNOWN, PRESETS } from './presets.mjs';

const range = (meaning, unit, minimum, maximum = 1e6) => ({ meaning, unit, minimum, maximum });
const rig = (limits) => ({
  ...PRESETS[0],
  limits,
  parameter_info: {
    K_pp: range('thrust', 'N·m/V', -1e6),
    B_y: range('damping', 'N·m·s/rad', 0),
    m: range('mass', 'kg', 0),
  },
  limit_info: {
    V_p: range('voltage', 'V', 1e-3),
    V_y: range('voltage', 'V', 1e-3),
    theta: range('travel', 'rad', 1e-3, 3.2),
  },
});
const HELD = rig({ V_p: 24, V_y: 15, theta: Math.PI / 4 });
const FREE = rig({ V_p: 24, V_y: 24 });
const named = (preset, name) => quantities(preset).find((q) => q.name === name);

test('every parameter and limit is listed once, angles in degrees', () => {
  assert.deepEqual(
    quantities(HELD).map((q) => `${q.kind}.${q.name}`),
    [
      ...['parameters.K_pp', 'parameters.B_y', 'parameters.m', 'limits.V_p', 'limits.V_y', 'limits.theta'],
      ...['pitch', 'yaw'].flatMap((axis) =>
        ['tau', 'curve', 'dead_zone', 'matched_at'].map((name) => `rotors.${axis}.${name}`),
      ),
      ...['pitch', 'yaw'].flatMap((axis) => ['coulomb', 'static'].map((name) => `friction.${axis}.${name}`)),
    ],
  );
  const theta = named(HELD, 'theta');
  assert.equal(theta.unit, '°');
  assert.ok(Math.abs(theta.max - 183.3465) < 1e-3);
  assert.equal(valueOf(designOf(HELD), HELD, theta), 45);
});

test('a design holds only what differs, and sends it', () => {
  const [damping, theta] = [named(HELD, 'B_y'), named(HELD, 'theta')];
  let design = withValue(designOf(HELD), HELD, damping, 0.5);
  design = withValue(design, HELD, theta, 30);
  assert.deepEqual(design.parameters, { B_y: 0.5 });
  assert.ok(Math.abs(design.limits.theta - Math.PI / 6) < 1e-14);
  assert.equal(valueOf(design, HELD, theta), 30);
  assert.deepEqual(bodyOf(design).limits, design.limits);
  assert.deepEqual(withValue(design, HELD, damping, 0.318).parameters, {}); // typed back
  assert.equal(isChanged(without(design, theta), theta), false);
  const { parameters, limits } = asProposed(design);
  assert.deepEqual([parameters, limits], [{}, {}]);
});

test('the machine: overrides of each rotor and each axis, gone when they are as the preset has them', () => {
  const of = (kind, name) => quantities(HELD).find((q) => q.kind === kind && q.name === name);
  const [tau, curve, held] = [of('rotors.yaw', 'tau'), of('rotors.yaw', 'curve'), of('friction.pitch', 'static')];
  let design = withValue(designOf(HELD), HELD, tau, 0.16);
  design = withValue(design, HELD, curve, 'quadratic');
  design = withValue(design, HELD, held, 0.02);
  assert.deepEqual(design.rotors, { yaw: { tau: 0.16, curve: 'quadratic' } });
  assert.deepEqual(bodyOf(design).friction, { pitch: { static: 0.02 } });
  assert.equal(valueOf(design, HELD, curve), 'quadratic');
  assert.deepEqual([lagOf(design, HELD, 'yaw'), lags(design, HELD)], [0.16, true]);
  assert.deepEqual(curve.words, ['linear', 'quadratic']);
  design = withValue(without(design, tau), HELD, curve, 'linear');
  assert.deepEqual([design.rotors, lags(design, HELD)], [{}, false]);
  assert.deepEqual(withValue(design, HELD, held, NaN).friction, {}); // free, as the preset has it
  assert.deepEqual(asProposed(design).friction, {});
});

test('a travel can be free: null where the preset has stops, absent where it has none', () => {
  const theta = named(HELD, 'theta');
  assert.deepEqual(withValue(designOf(HELD), HELD, theta, NaN).limits, { theta: null });
  assert.ok(Number.isNaN(valueOf({ ...designOf(HELD), limits: { theta: null } }, HELD, theta)));
  assert.ok(Number.isNaN(proposedShown(FREE, theta)));
  assert.deepEqual(withValue(designOf(FREE), FREE, theta, NaN).limits, {});
});

test('what is changed is counted in words', () => {
  const words = (parameters, limits, rotors = {}) => changedWords({ parameters, limits, rotors, friction: {} });
  assert.equal(words({}, {}), '');
  assert.equal(words({ m: 1 }, {}), '1 parameter changed');
  assert.equal(words({ m: 1, B_y: 2 }, {}), '2 parameters changed');
  assert.equal(words({ m: 1 }, {}, { pitch: { tau: 0.1, curve: 'quadratic' } }), '3 parameters changed');
  assert.equal(words({}, { V_p: 1 }), '1 limit changed');
  assert.equal(words({ m: 1, B_y: 2 }, { V_p: 1, V_y: 2 }), '2 parameters, 2 limits changed');
});

test('a link carries limits, and refuses what is none', () => {
  const design = { ...designOf(PRESETS[0]), limits: { V_y: 5, theta: null } };
  const link = linkOf({ ...initialState(), design }, KNOWN);
  assert.match(link, /limits\.V_y=5/);
  assert.deepEqual(readLink(link, KNOWN).design.limits, design.limits);
  for (const part of ['limits.V_z=5', 'limits.V_p=null', 'limits.V_p=much', 'limits=5']) {
    const { trouble, design: read } = readLink(`#v1&${part}`, KNOWN);
    assert.equal(trouble.length, 1, part);
    assert.deepEqual(read.limits, {}, part);
  }
});
