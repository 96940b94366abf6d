import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { cameraMessages, cameraNamed, cameraPose, CAMERAS } from '../../static/scene/cameras.js';
import { flightsOf, ghostMessages, rgb, SLOTS } from '../../static/scene/ghosts.js';
import { poseMessages, slotOf, themeMessages, THRUST_SCALE } from '../../static/scene/pose.js';

const BODY = '/rig/yoke/body';
const rest = { t: 0, theta: 0, psi: 0, V_p: 0, V_y: 0 };
const limits = { V_p: 24, V_y: 15, theta: 0.7 };
const of = (pose) => {
  const messages = poseMessages({ ...rest, limits, ...pose });
  return {
    messages,
    seen: (name) => messages.findLast((m) => m.name === name && 'visible' in m)?.visible,
    position: (name) => messages.find((m) => m.name === name && m.position)?.position,
    prop: (name, prop) => messages.find((m) => m.name === name && m.updates?.[prop])?.updates[prop],
    turn: (name) => messages.find((m) => m.name === name && m.wxyz)?.wxyz,
  };
};
const near = (actual, expected, tolerance = 1e-9) =>
  actual.forEach((v, k) => assert.ok(Math.abs(v - expected[k]) < tolerance, `${actual} is not ${expected}`));

describe('thrust arrows', () => {
  test('are as long as the voltage is large', () => {
    for (const V_p of [8, 12, 23]) {
      const { position, prop } = of({ V_p });
      const neck = position(`${BODY}/pitch_thrust_positive/head`)[2];
      near([neck + 0.026], [V_p * THRUST_SCALE], 1e-9);
      near(prop(`${BODY}/pitch_thrust_positive/shaft`, 'scale'), [1, 1, neck]);
    }
  });
  test('a small one has a small head, and none is drawn at rest', () => {
    const { prop, position } = of({ V_p: 1 });
    const [head] = prop(`${BODY}/pitch_thrust_positive/head`, 'scale');
    assert.ok(head < 0.3);
    near([position(`${BODY}/pitch_thrust_positive/head`)[2] + head * 0.026], [THRUST_SCALE]);
    for (const sign of ['positive', 'negative']) assert.equal(of({}).seen(`${BODY}/pitch_thrust_${sign}`), false);
  });
  test("point to the side that the voltage's sign says", () => {
    const { seen } = of({ V_p: -3, V_y: 5 });
    assert.deepEqual(
      ['pitch', 'yaw'].map((m) => ['positive', 'negative'].map((sign) => seen(`${BODY}/${m}_thrust_${sign}`))),
      [
        [false, true],
        [true, false],
      ],
    );
  });
  test('are red and capped at the limit of the present design, and nowhere else', () => {
    const red = of({ V_p: 24, V_y: -15 });
    const free = of({ V_p: 23.9, V_y: -14.9 });
    for (const arrow of ['pitch_thrust_positive', 'yaw_thrust_negative']) {
      const [r, g, b] = red.prop(`${BODY}/${arrow}/head`, 'color');
      assert.ok(r > 150 && g < 60 && b < 60);
      assert.notDeepEqual(free.prop(`${BODY}/${arrow}/head`, 'color'), [r, g, b]);
      assert.deepEqual([red.seen(`${BODY}/${arrow}/cap`), free.seen(`${BODY}/${arrow}/cap`)], [true, false]);
    }
    assert.equal(of({ V_p: 24, limits: { ...limits, V_p: 30 } }).seen(`${BODY}/pitch_thrust_positive/cap`), false);
    assert.equal(of({ V_p: 24, limits: undefined }).seen(`${BODY}/pitch_thrust_positive/cap`), false);
  });
});

test('travel stops stand where the design has them, and nowhere without', () => {
  const { turn, seen } = of({ limits: { theta: 0.5 } });
  near(turn('/rig/yoke/stop_up'), [Math.cos(0.25), 0, -Math.sin(0.25), 0]);
  near(turn('/rig/yoke/stop_down'), [Math.cos(0.25), 0, Math.sin(0.25), 0]);
  assert.deepEqual([seen('/rig/yoke/stop_up'), of({ limits: {} }).seen('/rig/yoke/stop_up')], [true, false]);
});

test('no two messages of a pose overwrite each other', () => {
  for (const messages of [of({ V_p: 24, V_y: -15 }).messages, themeMessages(true)]) {
    assert.equal(new Set(messages.map(slotOf)).size, messages.length);
  }
});

test('light and dark differ in every colour', () => {
  const [light, dark] = [false, true].map((d) => themeMessages(d));
  light.forEach((message, k) => {
    assert.equal(message.name, dark[k].name);
    assert.notDeepEqual(message.updates, dark[k].updates);
  });
});

describe('ghosts', () => {
  const step = (psi) => ({ t: [0, 1], theta: [0, 0.1], psi: [0, psi], V_p: [0, 0], V_y: [0, 0] });
  const reply = (psi) => ({
    step: { linear: step(psi + 1), nonlinear: step(psi) },
    axis_steps: { psi: { linear: step(psi + 1), nonlinear: step(-psi) } },
  });
  const pin = (index, psi) => ({ index, reply: psi === null ? null : reply(psi) });
  const color = (name) => ({ 'pin-0': '#ff0000', 'pin-1': '#00ff00', ink: '#0a0b0c' })[name] ?? '';
  const state = { reply: reply(0.3), motion: 'both', pins: [pin(1, 0.5), pin(0, null), pin(6, 0.7)] };

  test('are the linear model and the pins that have been computed, in their colours and letters', () => {
    const flights = flightsOf(state, { linear: true, pins: true }, color);
    assert.deepEqual(
      flights.map((f) => [f.slot, f.label, f.color]),
      [
        ['linear', 'linear', [10, 11, 12]],
        ['0', 'B', [0, 255, 0]],
        ['1', 'G', [255, 0, 0]],
      ],
    );
    assert.deepEqual(
      flights.map((f) => f.trajectory.psi[1]),
      [1.3, 0.5, 0.7],
    );
  });
  test('fly the motion that is played', () => {
    const flights = flightsOf({ ...state, motion: 'psi' }, { linear: false, pins: true }, color);
    assert.deepEqual(
      flights.map((f) => f.trajectory.psi[1]),
      [-0.5, -0.7],
    );
    assert.deepEqual(flightsOf({ ...state, motion: 'theta' }, { linear: true, pins: true }, color), []);
  });
  test('fly only as wanted, and no more than there are nodes', () => {
    assert.deepEqual(flightsOf(state, { linear: false, pins: false }, color), []);
    assert.deepEqual(flightsOf({ ...state, reply: null }, { linear: true, pins: false }, color), []);
    const many = { ...state, pins: Array.from({ length: 9 }, (_, k) => pin(k, 0.1)) };
    const { trajectory } = flightsOf(state, { linear: true, pins: false }, color)[0];
    const slots = (/** @type {boolean} */ ghost) =>
      flightsOf({ ...many, beside: { ...trajectory, ghost } }, { linear: true, pins: true }, color).map((f) => f.slot);
    assert.deepEqual(slots(true).sort(), [...SLOTS].sort(), 'a recording has a node of its own');
    assert.ok(!slots(false).includes('recorded'));
  });
  test('hold the end of their own response, and the others are hidden', () => {
    const messages = ghostMessages(flightsOf(state, { linear: false, pins: true }, color), 99);
    const shown = messages.filter((m) => /^\/ghosts\/\w+$/.test(m.name));
    assert.deepEqual(
      shown.map((m) => m.visible),
      SLOTS.map((slot) => slot === '0' || slot === '1'),
    );
    near(messages.find((m) => m.name === '/ghosts/0/yoke').wxyz, [Math.cos(0.25), 0, 0, -Math.sin(0.25)]);
    assert.equal(new Set(messages.map(slotOf)).size, messages.length);
  });
  test('what is no colour is grey', () => {
    assert.deepEqual(
      [rgb('#0180ff'), rgb(''), rgb('red')],
      [
        [1, 128, 255],
        [128, 128, 128],
        [128, 128, 128],
      ],
    );
  });
});

describe('cameras', () => {
  const rig = {
    pivot_height: 0.364,
    reach: 0.3124,
    outer: 0.3974,
    view: { position: [0.5, -1.2, 0.9], look_at: [0, 0, 0.2], fov: 0.62 },
  };

  /** Where a point is in the picture, from -1 to 1 upwards and to the right; z up. */
  function seen([x, y, z], { position, lookAt }, aspect) {
    const unit = (v) => v.map((c) => c / Math.hypot(...v));
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const ahead = unit(lookAt.map((c, k) => c - position[k]));
    const right = unit(cross(ahead, [0, 0, 1]));
    const up = cross(right, ahead);
    const from = [x, y, z].map((c, k) => c - position[k]);
    const scale = dot(from, ahead) * Math.tan(rig.view.fov / 2);
    return [dot(from, right) / scale / aspect, dot(from, up) / scale];
  }

  test('show the whole rig in pictures of any shape', () => {
    const around = Array.from({ length: 24 }, (_, k) => (k * Math.PI) / 12);
    for (const aspect of [0.6, 1, 1.25, 2.4]) {
      for (const name of ['front', 'side', 'top', 'follow']) {
        const pose = cameraPose(name, rig, { aspect, psi: 0.4 });
        for (const a of around)
          for (const z of [0, rig.pivot_height + 0.2]) {
            const point = [rig.reach * Math.cos(a), rig.reach * Math.sin(a), z];
            const [u, v] = seen(point, pose, aspect);
            assert.ok(Math.abs(u) < 1 && Math.abs(v) < 1, `${name} at ${aspect}: ${point} is at ${[u, v]}`);
          }
      }
    }
  });
  test('look from where their names say', () => {
    const right = seen([0.2, 0, 0.36], cameraPose('side', rig), 1);
    assert.ok(right[0] > 0.2, 'from the side, the nose is at the right');
    const nose = seen([0.2, 0, 0.36], cameraPose('top', rig), 1);
    assert.ok(nose[1] > 0.2 && Math.abs(nose[0]) < 0.01, 'from above, the nose is up');
    const turned = seen([0.2 * Math.cos(0.5), -0.2 * Math.sin(0.5), 0.36], cameraPose('front', rig), 1);
    assert.ok(turned[0] < -0.1, 'from ahead, positive yaw turns to the left');
  });
  test('the one that follows sees the body alike at every yaw', () => {
    const at = (psi) => seen([0.3 * Math.cos(psi), -0.3 * Math.sin(psi), 0.36], cameraPose('follow', rig, { psi }), 1);
    for (const psi of [0.7, -2, 9]) near(at(psi), at(0), 1e-9);
  });
  test('leave the free camera to the viewer, and know the first view', () => {
    assert.equal(cameraPose('free', rig), null);
    assert.deepEqual(cameraPose('home', rig), { position: rig.view.position, lookAt: rig.view.look_at });
    assert.deepEqual(['top', 'sideways', null, '__proto__'].map(cameraNamed), ['top', 'free', 'free', 'free']);
    assert.equal(cameraNamed(CAMERAS[4][0]), 'follow');
  });
  test('tell the position before what is looked at, as the second keeps the first', () => {
    assert.deepEqual(
      cameraMessages({ position: [1, 2, 3], lookAt: [0, 0, 0] }).map((m) => m.type),
      ['SetCameraPositionMessage', 'SetCameraLookAtMessage'],
    );
  });
});
