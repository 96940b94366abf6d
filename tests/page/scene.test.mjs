import assert from 'node:assert/strict';
import { afterEach, beforeEach, describe, test } from 'node:test';

import { ScenePlayer } from '../../static/scene/player.js';
import { poseMessages, rotorAngles, sampleTrajectory } from '../../static/scene/pose.js';

const ramp = {
  t: [0, 1, 2],
  theta: [0, 0.2, 0.2],
  psi: [0, -0.4, -0.2],
  V_p: [2, 2, 4],
  V_y: [-1, -1, -1],
  reference: { theta: 0.2, psi: -0.2 },
};

/** Rotates a vector by a quaternion given as viser gives it. */
function rotate([w, x, y, z], [a, b, c]) {
  const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
  const u = [x, y, z];
  const uv = cross(u, [a, b, c]);
  const uuv = cross(u, uv);
  return [a, b, c].map((v, k) => v + 2 * (w * uv[k] + uuv[k]));
}

function close(actual, expected, tolerance = 1e-12) {
  actual.forEach((value, k) => assert.ok(Math.abs(value - expected[k]) < tolerance, `${actual}`));
}

describe('sampleTrajectory', () => {
  test('interpolates between points and meets them', () => {
    assert.deepEqual(sampleTrajectory(ramp, 1), { t: 1, theta: 0.2, psi: -0.4, V_p: 2, V_y: -1 });
    const half = sampleTrajectory(ramp, 1.5);
    close([half.theta, half.psi, half.V_p], [0.2, -0.3, 3]);
  });
  test('rests before the start and after the end', () => {
    assert.equal(sampleTrajectory(ramp, -1).theta, 0);
    assert.equal(sampleTrajectory(ramp, 99).t, 2);
    assert.equal(sampleTrajectory(ramp, 99).V_p, 4);
  });
  test('takes typed arrays and a single point', () => {
    const one = Object.fromEntries(
      ['t', 'theta', 'psi', 'V_p', 'V_y'].map((k) => [k, Float32Array.of(k === 't' ? 0 : 0.5)]),
    );
    assert.equal(sampleTrajectory(one, 3).psi, 0.5);
  });
});

test('rotorAngles integrates the voltages', () => {
  const { pitch, yaw } = rotorAngles(ramp, 10);
  close([...pitch], [0, 20, 50]);
  close([...yaw], [0, -10, -20]);
});

describe('poseMessages', () => {
  const of = (pose, name) =>
    poseMessages({ t: 0, theta: 0, psi: 0, V_p: 0, V_y: 0, ...pose }).filter((m) => m.name === name);

  test("puts the nose where the model's centre of mass is", () => {
    for (const [theta, psi] of [
      [0.3, 0.5],
      [-0.4, 2.5],
      [0.1, -7],
    ]) {
      const [yoke] = of({ theta, psi }, '/rig/yoke');
      const [body] = of({ theta, psi }, '/rig/yoke/body');
      const nose = rotate(yoke.wxyz, rotate(body.wxyz, [1, 0, 0]));
      const { cos, sin } = Math;
      close(nose, [cos(psi) * cos(theta), -sin(psi) * cos(theta), sin(theta)]);
    }
  });
  test('spins each propeller about its own axis', () => {
    const pose = { pitchRotor: 1, yawRotor: 1 };
    close(rotate(of(pose, '/rig/yoke/body/pitch_rotor')[0].wxyz, [0, 0, 1]), [0, 0, 1]);
    close(rotate(of(pose, '/rig/yoke/body/yaw_rotor')[0].wxyz, [0, 1, 0]), [0, 1, 0]);
  });
  test('blurs a propeller when it is fast, whichever way it turns', () => {
    const seen = (pose, name) => of(pose, `/rig/yoke/body/${name}`).find((m) => 'visible' in m).visible;
    for (const [pose, motor, fast] of [
      [{ V_p: 1 }, 'pitch', false],
      [{ V_p: 12 }, 'pitch', true],
      [{ V_y: -12 }, 'yaw', true],
    ]) {
      assert.deepEqual([seen(pose, `${motor}_blur`), seen(pose, `${motor}_rotor`)], [fast, !fast]);
    }
  });
  test('shows the ghost at the reference while the rig is elsewhere', () => {
    const reference = { theta: 0.2, psi: 0.5 };
    assert.equal(of({ reference }, '/ghost')[0].visible, true);
    const [yoke] = of({ reference }, '/ghost/yoke');
    close(rotate(yoke.wxyz, [1, 0, 0]), [Math.cos(0.5), -Math.sin(0.5), 0]);
    assert.equal(of({ theta: 0.2, psi: 0.5, reference }, '/ghost')[0].visible, false);
    assert.equal(of({}, '/ghost')[0].visible, false);
  });
});

describe('ScenePlayer', () => {
  let frames, posted, listeners, states, samples, told, player, scene;

  /** Runs the waiting animation frames at a time in milliseconds. */
  const frame = (now) => frames.splice(0).forEach((callback) => callback(now));
  const say = (state, source = scene, origin = 'http://lab', reason = '') =>
    listeners.message({ source, origin, data: { channel: 'heli2dof-scene', state, reason } });
  const poses = () => posted.filter((message) => message.kind === 'pose');

  beforeEach(() => {
    [frames, posted, listeners, states, samples, told] = [[], [], {}, [], [], []];
    scene = { dispatchEvent: (event) => posted.push(event.data) };
    const target = {
      addEventListener: (name, listener) => (listeners[name] = listener),
      removeEventListener: (name) => delete listeners[name],
    };
    Object.assign(globalThis, {
      window: target,
      document: { ...target, hidden: false },
      location: { origin: 'http://lab' },
      MessageEvent: class {
        constructor(type, init) {
          Object.assign(this, { type }, init);
        }
      },
      requestAnimationFrame: (callback) => frames.push(callback),
      cancelAnimationFrame: () => frames.splice(0),
    });
    player = new ScenePlayer(
      { contentWindow: scene },
      {
        onFrame: (sample) => samples.push(sample),
        onState: (state) => states.push(state),
        onTransport: (snapshot, cause) => told.push([cause, snapshot]),
      },
    );
  });
  afterEach(() => player.destroy());

  test('plays in real time and stops at the end', () => {
    player.load(ramp);
    player.play();
    frame(5000);
    frame(5500);
    assert.equal(player.time, 0.5);
    close([samples.at(-1).theta], [0.1]);
    frame(6250);
    assert.equal(player.time, 1.25);
    frame(7100);
    assert.deepEqual([player.time, player.playing, frames.length], [2, false, 0]);
    assert.deepEqual([states.at(-1).playing, states.at(-1).time], [false, 2]);
  });
  test('plays from the start again after the end', () => {
    player.load(ramp);
    player.seek(2);
    player.play();
    assert.deepEqual([player.time, player.playing], [0, true]);
  });
  test('pauses, seeks within the response and replays', () => {
    player.load(ramp);
    player.play();
    frame(0);
    frame(400);
    player.pause();
    frame(900);
    assert.equal(player.time, 0.4);
    player.seek(1.5);
    assert.equal(samples.at(-1).t, 1.5);
    player.seek(77);
    assert.equal(player.time, 2);
    player.replay();
    assert.deepEqual([player.time, player.playing], [0, true]);
  });
  test('goes on playing when a new response arrives', () => {
    player.load(ramp);
    player.play();
    frame(0);
    frame(600);
    player.load(ramp, { keepTime: true });
    assert.deepEqual([player.time, player.playing], [0.6, true]);
    player.load({ ...ramp, t: [0, 0.2, 0.4] }, { keepTime: true });
    assert.equal(player.time, 0.4);
    player.load(ramp);
    assert.deepEqual([player.time, player.playing], [0, true]);
  });
  test('stands still while the page is hidden', () => {
    player.load(ramp);
    player.play();
    frame(0);
    frame(300);
    listeners.visibilitychange();
    frame(60_300);
    frame(60_400);
    close([player.time], [0.4]);
  });
  test('sends nothing before the scene is ready, the pose then, and again after a replay', () => {
    player.load(ramp);
    player.seek(1);
    assert.equal(poses().length, 0);
    say('ready');
    assert.equal(poses().length, 1);
    assert.ok(poses()[0].messages.some((m) => m.name === '/rig/yoke/body'));
    say('loading');
    player.seek(1.5);
    assert.equal(poses().length, 1);
    say('ready');
    assert.equal(poses().length, 2);
    assert.equal(states.at(-1).ready, true);
  });
  test('goes on moving a scene that has lost its connection, and says why it was lost', () => {
    player.load(ramp);
    say('closed', scene, 'http://lab', 'all scenes are in use');
    assert.deepEqual([states.at(-1).ready, states.at(-1).reason], [false, 'all scenes are in use']);
    assert.equal(poses().length, 0);
    say('ready');
    say('closed');
    player.seek(1);
    assert.deepEqual([poses().length, states.at(-1).ready], [2, false]);
  });
  test('sends only what changes', () => {
    player.load(ramp);
    say('ready');
    player.seek(1);
    const before = poses().length;
    player.seek(1);
    assert.equal(poses().length, before);
    player.seek(2); // theta stays as it is, psi and the propellers do not
    const names = poses()
      .at(-1)
      .messages.map((m) => m.name);
    assert.ok(names.includes('/rig/yoke') && !names.includes('/rig/yoke/body'));
  });
  test('listens to its own frame and origin only', () => {
    player.load(ramp);
    say('ready', {});
    say('ready', scene, 'http://elsewhere');
    assert.equal(states.at(-1).ready, false);
  });
  test('keeps the theme through a rebuilt scene', () => {
    player.setTheme(true);
    say('ready');
    assert.equal(posted.filter((m) => m.kind === 'theme' && m.dark).length, 2);
  });
  test('plays at another speed, and in a loop with a rest at the end', () => {
    player.load(ramp);
    player.setSpeed(4);
    player.setLoop(true);
    player.play();
    frame(0);
    frame(400);
    close([player.time], [1.6]);
    frame(900);
    assert.deepEqual([player.time, player.playing], [2, true]);
    frame(1500);
    close([player.time], [(1.5 - 0.5 - 0.9) * 4]);
    assert.deepEqual([states.at(-1).speed, states.at(-1).loop], [4, true]);
  });
  test('tells others of each change by hand, and not that time runs or that it follows', () => {
    player.load(ramp);
    player.play();
    frame(0);
    frame(500);
    player.pause();
    player.seek(1.5);
    player.setSpeed(0.5);
    player.setLoop(true);
    player.replay();
    assert.deepEqual(
      told.map(([cause]) => cause),
      ['load', 'play', 'pause', 'seek', 'speed', 'loop', 'restart'],
    );
    assert.deepEqual(told[3][1], { playing: false, time: 1.5, speed: 1, loop: false });
    player.follow({ playing: true, time: 1, speed: 2, loop: false }, 0.1);
    close([player.time], [1.2]);
    frame(1000);
    frame(1100);
    close([player.time], [1.4]);
    assert.equal(told.length, 7);
  });
  test('follows from when it has something to play', () => {
    player.follow({ playing: false, time: 0.75, speed: 2, loop: true });
    assert.equal(player.time, 0);
    player.load(ramp);
    assert.deepEqual(player.snapshot(), { playing: false, time: 0.75, speed: 2, loop: true });
    assert.deepEqual(told, []);
  });
  test("shows each frame's pose in that frame", () => {
    player.load(ramp);
    say('ready');
    player.play();
    for (const now of [0, 16, 33, 50, 66, 83]) {
      const before = poses().length;
      frame(now);
      if (now > 0) assert.equal(poses().length, before + 1);
    }
  });
  test('flies others beside the rig at the same time', () => {
    player.load(ramp);
    say('ready');
    player.setFlights([
      { slot: '2', label: 'C', color: [1, 2, 3], trajectory: { t: [0, 2], theta: [0, 0], psi: [0, 1] } },
    ]);
    player.seek(1);
    const sent = poses().flatMap((p) => p.messages);
    assert.equal(sent.findLast((m) => m.name === '/ghosts/2').visible, true);
    close(rotate(sent.findLast((m) => m.name === '/ghosts/2/yoke').wxyz, [1, 0, 0]), [
      Math.cos(0.5),
      -Math.sin(0.5),
      0,
    ]);
    player.setFlights([]);
    assert.equal(
      poses()
        .flatMap((p) => p.messages)
        .findLast((m) => m.name === '/ghosts/2').visible,
      false,
    );
  });
  test('a camera that follows turns with the rig; a fixed one is told once, and again to a scene built anew', () => {
    const view = {
      pivot_height: 0.36,
      reach: 0.31,
      outer: 0.4,
      view: { position: [1, 0, 0], look_at: [0, 0, 0], fov: 0.6 },
    };
    const aims = () =>
      poses()
        .flatMap((p) => p.messages)
        .filter((m) => m.type === 'SetCameraPositionMessage');
    player.load(ramp);
    player.setView(view);
    say('ready');
    assert.equal(aims().length, 0, "the viewer's own camera is left alone");
    player.setCamera('side');
    player.seek(0.5);
    assert.equal(aims().length, 1);
    player.setCamera('side');
    say('ready');
    assert.equal(aims().length, 3);
    player.setCamera('follow');
    player.seek(1);
    player.seek(1);
    assert.equal(aims().length, 5);
    player.setCamera('free');
    player.setView({ ...view });
    assert.deepEqual(aims().at(-1).position, [1, 0, 0]);
    assert.equal(aims().length, 6);
  });
  test('lets go when it is destroyed', () => {
    player.load(ramp);
    player.play();
    player.destroy();
    assert.deepEqual([listeners, frames, player.playing], [{}, [], false]);
  });
});
