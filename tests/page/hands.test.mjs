// Hands on a flight: what keys, gamepads and sticks ask for, and how a ray takes hold of the rig.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';

import { FINEST, nearestTurn, RATES, ratesOf, together, voltsOf } from '../../static/flight/demands.js';
import { beyondDead, DEAD, Gamepads, steadied } from '../../static/flight/gamepad.js';
import { keyOf } from '../../static/flight/keys.js';
import { pullOf, pushOf } from '../../static/flight/push.js';
import { bodyAxes, caught, dot, length, meets, minus, placed, plus } from '../../static/flight/ray.js';
import { rayThrough, seenAt, torquesOf } from '../../static/flight/ray.js';
import { stickAt } from '../../static/flight/sticks.js';
import { inSteps, MASSES, roundBelow, strengthOf } from '../../static/flight/strength.js';
import { actingIn, actingText, gustOf } from '../../static/flight/weather.js';
import { act, nothingActs } from '../../static/flight/events.js';

const RIG = {
  ...{ pivot_height: 0.364, reach: 0.312, outer: 0.4, arms: { pitch: 0.197, yaw: -0.168 } },
  ...{ offsets: { pitch: 0.046, yaw: -0.046 }, guard: 0.1155, wall: 0.03 },
};
const LARGE = { gains: { K_pp: 0.204, K_yy: 0.072 }, limits: { V_p: 24, V_y: 15 }, arm: 0.197 };
const LIGHT = { gains: { K_pp: 0.0011, K_yy: 0.0022 }, limits: { V_p: 24, V_y: 24 }, arm: 0.167 };
const strength = ({ gains, limits, arm }) => strengthOf(gains, limits, arm);
const near = (a, b, tolerance = 1e-12) => assert.ok(Math.abs(a - b) <= tolerance, `${a} and ${b}`);
const unit = (v) => v.map((x) => x / length(v));

/** A camera somewhere that looks somewhere, z up in its picture. */
function cameraAt(position, at) {
  const ahead = unit(minus(at, position));
  const above = unit(plus([0, 0, 1], ahead, -ahead[2]));
  return {
    ...{ position, ahead: plus(position, ahead), above: plus(position, above), fov: 0.62, aspect: 1.4 },
    box: [0, 0, 700, 500],
  };
}
const CAMERA = cameraAt([0.5, -1.3, 0.9], [0, 0, 0.25]);

describe('rays', () => {
  test('what is seen somewhere lies on the ray through there', () => {
    for (const point of [
      [0.2, 0.1, 0.4],
      [-0.3, -0.2, 0.1],
    ]) {
      const { x, y } = seenAt(CAMERA, point);
      const { from, along } = rayThrough(CAMERA, x, y);
      near(length(minus(plus(from, along, dot(minus(point, from), along)), point)), 0);
    }
    assert.equal(seenAt(CAMERA, [1, -2.6, 1.6]), null); // behind the camera
  });
  test('the right of the picture is the right of who looks, its top is up', () => {
    const { x, y } = seenAt(cameraAt([0, -2, 0], [0, 0, 0]), [0.3, 0, 0.2]);
    assert.ok(x > 0 && y > 0);
  });
  test('the body turns as the scene draws it', () => {
    const [theta, psi] = [0.3, -2.1];
    const { nose, left, top } = bodyAxes({ theta, psi });
    const { cos, sin } = Math;
    [cos(psi) * cos(theta), -sin(psi) * cos(theta), sin(theta)].forEach((v, i) => near(nose[i], v));
    for (const [a, b, c] of [
      [nose, left, 0],
      [left, top, 0],
      [nose, nose, 1],
      [top, top, 1],
    ])
      near(dot(a, b), c);
    assert.ok(top[2] > 0);
  });
  test('a force does the work that its torques do', () => {
    const attitude = { theta: 0.35, psi: 0.8 };
    const [own, force, h] = [[0.18, 0.04, -0.02], [1.2, -0.7, 2.1], 1e-6];
    const torques = torquesOf(force, own, RIG, attitude);
    for (const angle of ['theta', 'psi']) {
      const at = (by) => placed(own, RIG, { ...attitude, [angle]: attitude[angle] + by });
      near(torques[angle], dot(minus(at(h), at(-h)), force) / (2 * h), 1e-8);
    }
  });
  test('a force up at the nose lifts it, one to its right turns it clockwise', () => {
    const level = { theta: 0, psi: 0 };
    near(torquesOf([0, 0, 2], [0.2, 0, 0], RIG, level).theta, 0.4);
    near(torquesOf([0, -2, 0], [0.2, 0, 0], RIG, level).psi, 0.4);
  });
});

describe('taking hold', () => {
  const through = (point, attitude) => {
    const { x, y } = seenAt(CAMERA, point);
    return caught(rayThrough(CAMERA, x, y), RIG, attitude);
  };
  for (const attitude of [
    { theta: 0, psi: 0 },
    { theta: -0.4, psi: 0.6 },
  ])
    test(`of the disk of a rotor and of the beam at ${attitude.theta}, ${attitude.psi} rad`, () => {
      for (const own of [
        [0.27, 0.05, 0.046],
        [0.26, -0.06, 0.046],
        [-0.2, -0.046, 0.06],
      ])
        through(placed(own, RIG, attitude), attitude).forEach((v, i) => near(v, own[i], 1e-9));
      const beam = through(placed([0.03, 0, 0], RIG, attitude), attitude);
      near(length(minus(beam, [0.03, 0, 0])), 0, 1e-9);
    });
  test('of the wall of a guard, and of nothing where its rotor would be on the beam', () => {
    const level = { theta: 0, psi: 0 };
    const wall = through(placed([0.197, 0.11, 0.06], RIG, level), level);
    assert.ok(wall && Math.abs(wall[2] - 0.046) <= 0.015 + 1e-9);
    assert.equal(through(placed([0.197, -0.112, 0], RIG, level), level), null);
  });
  test('not of what is beside it, but a blunt finger holds what is close by', () => {
    const level = { theta: 0, psi: 0 };
    const beside = placed([0.02, 0, 0.075], RIG, level);
    assert.equal(through(beside, level), null);
    const { x, y } = seenAt(CAMERA, beside);
    near(caught(rayThrough(CAMERA, x, y), RIG, level, 0.06)[1], 0);
    assert.equal(caught({ from: [0, -1, 2], along: [0, 0, 1] }, RIG, level), null);
  });
  test('a plane behind the eye is not met', () => {
    assert.equal(meets({ from: [0, 0, 0], along: [1, 0, 0] }, [-1, 0, 0], [1, 0, 0]), null);
    assert.equal(meets({ from: [0, 0, 0], along: [1, 0, 0] }, [1, 0, 0], [0, 1, 0]), null);
  });
  test('a hand pulls as a spring, up to its largest force', () => {
    const large = strength(LARGE);
    near(length(pullOf([0, 0, 0], [0, 0.1, 0], large)), 0.6);
    near(length(pullOf([0, 0, 0], [3, 0, 0], large)), 4);
    assert.deepEqual(pullOf([1, 2, 3], [1, 2, 3], large), [0, 0, 0]);
  });
  test('keys push the nose along the ways that its angles move it', () => {
    const holding = { shape: RIG, strength: strength(LARGE), attitude: { theta: 0.5, psi: 2 } };
    const of = (demand) => {
      const { at, force } = pushOf(demand, holding);
      return torquesOf(force, at, RIG, holding.attitude);
    };
    near(of({ pitch: 1, yaw: 0 }).theta, 2 * 0.197);
    near(of({ pitch: 1, yaw: 0 }).psi, 0);
    near(of({ pitch: 0, yaw: 1 }).psi, 2 * 0.197 * Math.cos(0.5));
  });
});

describe('strength', () => {
  test('is a hand’s on the large rig, and what the motors can answer on a light one', () => {
    const [large, light] = [LARGE, LIGHT].map(strength);
    assert.deepEqual([large.force, large.spring, large.mass], [4, 6, 0.05]);
    near(large.step, 1e-3);
    assert.ok(light.force * LIGHT.arm < 0.0011 * 24 && light.force > 0.05);
    assert.ok(light.mass * MASSES.at(-1) * 9.81 * LIGHT.arm < 0.2 * 0.0011 * 24);
    assert.ok(light.step < light.force * LIGHT.arm * 0.01);
  });
  test('rounds to 1, 2 and 5', () => {
    for (const [v, round] of [
      [0.0479, 0.02],
      [1, 1],
      [9.99, 5],
      [2e-4, 2e-4],
      [0.001, 0.001],
    ])
      near(roundBelow(v), round, 1e-15);
  });
  test('steps leave neither dust nor −0', () => {
    assert.equal(inSteps(0.30000000000000004, 1e-4), 0.3);
    assert.ok(Object.is(inSteps(-1e-9, 1e-4), 0));
    assert.equal(inSteps(12.34567, 1e-3), 12.346);
  });
});

describe('keys', () => {
  const page = { closest: () => null };
  /** A place that is in elements of these selectors. */
  const within = (...own) => ({ closest: (all) => all.split(', ').some((one) => own.includes(one)) || null });
  const press = (key, more = {}, at = page, led = false) =>
    keyOf(
      { key, code: '', ctrlKey: false, metaKey: false, altKey: false, repeat: false, defaultPrevented: false, ...more },
      at,
      led,
    );
  const UP = { code: 'ArrowUp' };

  test('arrows and W, A, S, D wherever they are written are the sticks', () => {
    assert.deepEqual(press('ArrowUp', UP), { stick: { pitch: 1, yaw: 0 } });
    assert.deepEqual(press('z', { code: 'KeyW' }), { stick: { pitch: 1, yaw: 0 } });
    assert.deepEqual(press('q', { code: 'KeyA' }), { stick: { pitch: 0, yaw: -1 } });
  });
  test('all else by what is written on them', () => {
    for (const [key, act] of [
      ['h', 'hands'],
      ['H', 'hands'],
      [' ', 'toggle'],
      ['Backspace', 'rewind'],
      ['b', 'gust'],
    ])
      assert.equal(press(key).act, act);
    assert.equal(press('g'), null); // it leads to views
    assert.equal(press('toString'), null);
  });
  test('a held key acts once, but for single samples', () => {
    assert.equal(press('h', { repeat: true }).again, true);
    assert.equal(press('.', { repeat: true }).again, false);
  });
  test('fields, sliders and the s-plane keep theirs', () => {
    for (const own of ['input:not([type=checkbox])', 'textarea', 'select', '[role=slider]', '#splane', '.popup'])
      assert.equal(press('ArrowUp', UP, within(own)), null, own);
    assert.ok(press('ArrowUp', UP, within('[role=slider]', '[data-flies]')));
  });
  test('Space is the button’s that has the focus', () => {
    assert.equal(press(' ', {}, within('button')), null);
    assert.equal(press('b', {}, within('button')).act, 'gust');
    // and a ticked box has no other key
    assert.equal(press(' ', {}, within('input', '[type=checkbox]')), null);
    assert.ok(press('ArrowUp', UP, within('input', '[type=checkbox]')));
  });
  test('nothing with Ctrl, Alt or Meta, after somebody else, or right after G', () => {
    for (const held of ['ctrlKey', 'metaKey', 'altKey', 'defaultPrevented'])
      assert.equal(press('h', { [held]: true }), null);
    assert.equal(press('d', { code: 'KeyD' }, page, true), null);
    assert.ok(press('ArrowUp', UP, page, true));
  });
});

describe('gamepads', () => {
  const pad = (more = {}) => ({
    ...{ id: 'Pad (STANDARD GAMEPAD Vendor: 045e Product: 02ea)', index: 0, connected: true, mapping: 'standard' },
    ...{ axes: [0, 0, 0, 0], buttons: Array.from({ length: 17 }, () => ({ pressed: false })), ...more },
  });
  const down = (...which) => Array.from({ length: 17 }, (_, k) => ({ pressed: which.includes(k) }));
  const browser = (...all) => {
    const own = { now: all[0], getGamepads: () => own.now };
    return own;
  };

  test('the middle is dead, the end is whole', () => {
    for (const [v, out] of [
      [0, 0],
      [DEAD, 0],
      [-DEAD, 0],
      [1, 1],
      [-1, -1],
      [1.02, 1],
      [NaN, 0],
    ])
      assert.equal(beyondDead(v), out);
    near(beyondDead(0.56), 0.5);
  });
  test('noise moves nothing, but the middle and the end are met', () => {
    assert.equal(steadied(0.508, 0.5), 0.5);
    near(steadied(0.5249, 0.5), 0.52, 1e-15);
    assert.equal(steadied(0, 0.004), 0);
    assert.equal(steadied(1, 0.99), 1);
  });
  test('there is none before a person has pressed something, in an old browser, or where it may not be asked', () => {
    assert.equal(new Gamepads(browser([null, null, null, null])).read(), null);
    assert.equal(new Gamepads({}).read(), null);
    const refused = () => {
      throw new DOMException('no', 'SecurityError');
    };
    assert.equal(new Gamepads({ getGamepads: refused }).read(), null);
    assert.equal(new Gamepads(browser([pad({ connected: false })])).read(), null);
  });
  test('the press that makes it known asks for nothing; later ones do once', () => {
    const own = browser([pad({ buttons: down(0) })]);
    const pads = new Gamepads(own);
    const acts = (...which) => ((own.now = [pad({ buttons: down(...which) })]), pads.read().acts);
    assert.deepEqual(pads.read().acts, []);
    assert.deepEqual(acts(0), []);
    assert.deepEqual(acts(), []);
    assert.deepEqual(acts(0, 1), ['toggle', 'gust']);
    assert.deepEqual(acts(0, 1), []);
    assert.deepEqual(acts(2, 3), ['hands', 'rewind']);
  });
  test('up is up, and hands on the right stick yaws', () => {
    const own = browser([pad()]);
    const pads = new Gamepads(own);
    pads.read();
    own.now = [pad({ axes: [1, -1, -1, 0] })];
    const { sticks, volts, name, known } = pads.read();
    assert.deepEqual(
      [sticks, volts],
      [
        { pitch: 1, yaw: 1 },
        { pitch: 1, yaw: -1 },
      ],
    );
    assert.deepEqual([name, known], ['Pad', true]);
  });
  test('an axis acts once it has been in its middle', () => {
    const own = browser([pad({ axes: [1, 0, 0, 0] })]);
    const pads = new Gamepads(own);
    assert.equal(pads.read().sticks.yaw, 0);
    own.now = [pad()];
    pads.read();
    own.now = [pad({ axes: [1, 0, 0, 0] })];
    assert.equal(pads.read().sticks.yaw, 1);
  });
  test('of an unknown layout only the first stick is taken; a known one is preferred, the one in use kept', () => {
    const other = pad({ id: '1234-5678-Wheel', index: 0, mapping: '', axes: [0, 0, -1] });
    const own = browser([other]);
    const pads = new Gamepads(own);
    const read = pads.read();
    assert.deepEqual([read.name, read.known, read.volts], ['Wheel', false, { pitch: 0, yaw: 0 }]);
    own.now = [other, pad({ index: 1 })];
    assert.equal(pads.read().name, 'Wheel');
    assert.equal(new Gamepads(own).read().name, 'Pad');
    own.now = [null, pad({ index: 1 })];
    assert.equal(pads.read().name, 'Pad');
  });
});

describe('what hands ask for', () => {
  test('is added and bounded', () => {
    const all = [
      { pitch: 0.7, yaw: -1 },
      { pitch: 0.7, yaw: 0.25 },
    ];
    assert.deepEqual(together(all), { pitch: 1, yaw: -0.75 });
  });
  test('moves the set points, pitch’s to the end of its travel', () => {
    assert.deepEqual(ratesOf({ pitch: 0.333333, yaw: -1 }, 0, 0.7), [0.2, -RATES.psi]);
    assert.deepEqual(ratesOf({ pitch: 1, yaw: 0 }, 0.7, 0.7), [0, 0]);
    assert.deepEqual(ratesOf({ pitch: -1, yaw: 0 }, 0.71, 0.7), [-RATES.theta, 0]);
    assert.deepEqual(ratesOf({ pitch: -1, yaw: 0 }, -1.6, Infinity), [0, 0]);
  });
  test('hands on, is the voltage at rest in the middle and all at the ends', () => {
    const of = (pitch, yaw) => voltsOf({ pitch, yaw }, [12.4, -1.25], [24, 15]);
    assert.deepEqual(of(0, 0), [12.4, -1.25]);
    assert.deepEqual(of(1, -1), [24, -15]);
    assert.deepEqual(of(-1, 1), [-24, 15]);
    assert.deepEqual(of(0.5, 0), [18.2, -1.25]);
    assert.deepEqual(voltsOf({ pitch: 0, yaw: 0 }, [30, 0], [24, 15]), [24, 0]);
    assert.equal(FINEST.volts, 1e-3);
  });
  test('a rig that was spun is caught at the nearest turn', () => {
    near(nearestTurn(0.1, 20), 0.1 + 6 * Math.PI, 1e-12);
    assert.equal(nearestTurn(0.1, 3), 0.1);
  });
  test('a stick ends where its knob meets the edge', () => {
    assert.equal(stickAt(60, 120, 40), 0);
    assert.equal(stickAt(100, 120, 40), 1);
    assert.equal(stickAt(-5, 120, 40), -1);
    assert.equal(stickAt(80, 120, 40), 0.5);
  });
});

describe('weather', () => {
  test('of a seed is always the same, of another another', () => {
    const course = (seed) => Array.from({ length: 50 }, (_, k) => gustOf(seed, k));
    assert.deepEqual(course(7), course(7));
    assert.notDeepEqual(course(7), course(8));
    const ways = new Set();
    for (const { after, theta, psi, lasts } of course(3)) {
      const share = Math.hypot(theta, psi);
      assert.ok(after >= 1.6 && after <= 4 && share >= 0.2 && share <= 1 && lasts >= 0.4 && lasts <= 1.5);
      assert.ok(lasts < after); // a gust is over before the next comes
      ways.add(`${Math.sign(theta)} ${Math.sign(psi)}`);
    }
    assert.equal(ways.size, 4);
  });
  test('what acts is read out of what acts', () => {
    const u = nothingActs();
    assert.equal(actingText(actingIn(u, 0)), '');
    act(u, 'gust', [0.2, 0, 100], 50, 0.002);
    assert.ok(actingIn(u, 149).gust && !actingIn(u, 150).gust);
    act(u, 'hung', [0.1, 0.197], 60, 0.002);
    act(u, 'thrust', [1, 0.5], 60, 0.002);
    act(u, 'stuck', [0, 1], 60, 0.002);
    const acting = actingIn(u, 100);
    near(acting.mass, 0.1);
    near(acting.arm, 0.197);
    assert.equal(
      actingText(acting),
      'a gust, 100 g at the nose, yaw rotor at 50 % of its thrust, the encoder of ψ sticks',
    );
    act(u, 'hung', [0, 0], 60, 0.002);
    assert.equal(actingIn(u, 100).mass, 0);
  });
});
