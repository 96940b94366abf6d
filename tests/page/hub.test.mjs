import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Hub } from '../../static/scene/hub.js';
import { edited, shownOf, steer, trajectoryIn } from '../../static/scene/panel.js';
import { InStep } from '../../static/scene/step.js';
import { decodeFrame } from '../../static/net/wire.js';

class FakeSocket {
  readyState = 1;
  /** @type {any[]} */ sent = [];

  send(/** @type {any} */ data) {
    this.sent.push(data);
  }

  say(/** @type {any} */ message) {
    this.onmessage({
      data: typeof message === 'object' && !(message instanceof ArrayBuffer) ? JSON.stringify(message) : message,
    });
  }

  /** What was sent of a kind. @param {string} type */
  texts(type) {
    return this.sent
      .filter((d) => typeof d === 'string')
      .map((d) => JSON.parse(d))
      .filter((m) => m.type === type);
  }

  frames() {
    return this.sent.filter((d) => typeof d !== 'string').map((d) => decodeFrame(d));
  }

  close() {}
}

/** A hub, its socket, and a clock that stands. */
function hub({ always = false, onClock } = {}) {
  const socket = new FakeSocket();
  const heard = [];
  const time = { now: 100 };
  const it = new Hub({
    open: () => socket,
    always,
    onClock,
    now: () => time.now,
    onShown: (shown) => heard.push(['shown', shown]),
    onTransport: (snapshot, elapsed) => heard.push(['transport', snapshot, elapsed]),
    onEdits: (edits, count) => heard.push(['edits', edits, count]),
    onWindows: ({ others, leads, count }) => heard.push(['windows', others, leads, count]),
  });
  socket.onopen();
  return { it, socket, heard, time };
}

const RUN = { playing: true, time: 1, speed: 1, loop: false };

test('a page sends nothing while nobody else listens', () => {
  const { it, socket } = hub();
  it.show({ K: 1 });
  it.run(RUN);
  assert.deepEqual(socket.frames(), []);
  assert.deepEqual(socket.texts('transport'), []);
  socket.say({ type: 'windows', others: 1, leads: true, count: 0 });
  it.show({ K: 2 });
  assert.deepEqual(socket.frames(), [{ K: 2 }]);
  socket.say({ type: 'windows', others: 0, leads: true, count: 0 });
  socket.say({ type: 'taken' });
  it.show({ K: 3 });
  assert.equal(socket.frames().length, 1);
});

test('who flies along is told of, and no longer once the connection is lost', () => {
  const { it, socket } = hub();
  const asked = [];
  it.onSticks = ({ pitch, yaw }) => asked.push([pitch, yaw]);
  it.steer({ pitch: 0.5, yaw: -1 });
  assert.deepEqual(socket.texts('sticks'), [{ type: 'sticks', pitch: 0.5, yaw: -1 }]);
  socket.say({ type: 'sticks', pitch: 1, yaw: 0.25 });
  socket.onclose();
  assert.deepEqual(asked, [
    [1, 0.25],
    [0, 0],
  ]);
  it.close();
});

test('of what is shown the newest waits until the last was taken', () => {
  const { it, socket } = hub({ always: true });
  for (let k = 0; k < 100; k += 1) it.show({ K: k });
  assert.deepEqual(socket.frames(), [{ K: 0 }]);
  socket.say({ type: 'taken' });
  assert.deepEqual(socket.frames(), [{ K: 0 }, { K: 99 }]);
  socket.say({ type: 'taken' });
  assert.equal(socket.frames().length, 2);
});

test('what is shown before the connection stands goes out when it does', () => {
  const socket = Object.assign(new FakeSocket(), { readyState: 0 });
  const nothing = () => {};
  const [onShown, onTransport, onEdits, onWindows] = Array(4).fill(nothing);
  const it = new Hub({ open: () => socket, always: true, onShown, onTransport, onEdits, onWindows });
  for (const K of [1, 2]) it.show({ K });
  assert.deepEqual(socket.sent, []);
  socket.readyState = 1;
  socket.onopen();
  assert.deepEqual(socket.frames(), [{ K: 2 }]);
  it.show({ K: 3 });
  socket.say({ type: 'taken' });
  assert.deepEqual(socket.frames(), [{ K: 2 }, { K: 3 }]);
});

test('snapshots carry the time of the server’s clock and arrive with their age', () => {
  const { it, socket, heard, time } = hub({ always: true });
  it.run(RUN); // before the clock is known
  assert.deepEqual(socket.texts('transport'), []);
  time.now = 100.2; // 0.2 s there and back
  socket.say({ type: 'clock', sent: 100, now: 5000.1 });
  assert.equal(socket.texts('transport')[0].at, 5000);
  time.now = 101;
  socket.say({ type: 'transport', ...RUN, at: 5000.4 });
  const [kind, snapshot, elapsed] = heard.at(-1);
  assert.equal(kind, 'transport');
  assert.deepEqual(snapshot, RUN);
  assert.ok(Math.abs(elapsed - 0.6) < 1e-9);
});

test('the shortest way to the server tells its clock best', () => {
  const { it, socket, time } = hub({ always: true });
  time.now = 100.02;
  socket.say({ type: 'clock', sent: 100, now: 5000.01 });
  time.now = 103;
  socket.say({ type: 'clock', sent: 100.02, now: 5009 }); // held up on its way
  it.run(RUN);
  assert.ok(Math.abs(socket.texts('transport')[0].at - 5003) < 1e-9);
});

test('while every way to the server was long, its clock is asked soon again, and then seldom', (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  const errors = [];
  const { socket, time } = hub({ always: true, onClock: (error) => errors.push(error) });
  const asked = () => socket.texts('clock').length;
  const answer = (trip) => {
    const { sent } = socket.texts('clock').at(-1);
    time.now = sent + trip;
    socket.say({ type: 'clock', sent, now: 5000 + sent + trip / 2 });
  };
  for (let k = 0; k < 4; k++) answer(0.3);
  assert.equal(asked(), 4);
  t.mock.timers.tick(250);
  assert.equal(asked(), 5);
  answer(0.02);
  assert.ok(Math.abs(errors.at(-1) - 0.01) < 1e-9);
  t.mock.timers.tick(19_999);
  assert.equal(asked(), 5);
  t.mock.timers.tick(1);
  assert.equal(asked(), 6);
});

const DESIGN = {
  poles: [
    { re: -12, im: 0 },
    { re: -10, im: 0 },
    { re: -3, im: 4 },
    { re: -3, im: -4 },
  ],
  loops: { pitch: { kp: 30, ti: 0.1 }, yaw: { kp: 30, ti: 0.1 } },
  theta0: 0,
};

test('what is set at the panel changes the design, in conjugate pairs', () => {
  const a = edited(DESIGN, { 'pitch.first': -7, 'yaw.im': 2, 'yaw.kp': 12 });
  assert.deepEqual(a.poles, [
    { re: -7, im: 0 },
    { re: -10, im: 0 },
    { re: -3, im: 2 },
    { re: -3, im: -2 },
  ]);
  assert.deepEqual(a.loops, { pitch: { kp: 30, ti: 0.1 }, yaw: { kp: 12, ti: 0.1 } });
  assert.equal(a.theta0, 0);
  const b = edited(DESIGN, { 'pitch.complex': true, 'yaw.complex': false });
  assert.ok(b.poles[0].im > 0 && b.poles[1].im === -b.poles[0].im);
  assert.deepEqual(
    b.poles.slice(2).map((p) => p.im),
    [0, 0],
  );
});

test('what is set at the panel stays within bounds; what fits no slider changes nothing', () => {
  assert.equal(
    edited(DESIGN, { 'pitch.re': -2, 'yaw.first': -2, 'pitch.kp': NaN, 'yaw.ti': 'long', unknown: 3 }),
    DESIGN,
  );
  assert.equal(edited(DESIGN, { 'pitch.kp': -5 }).loops.pitch.kp, 0);
  assert.ok(edited(DESIGN, { 'yaw.im': 0 }).poles[2].im > 0, 'the pair stays complex under the hand');
});

test('the panel’s buttons steer the player', () => {
  const calls = [];
  const player = Object.fromEntries(
    ['play', 'pause', 'replay', 'setSpeed', 'setLoop'].map((name) => [
      name,
      (/** @type {any} */ v) => calls.push(v === undefined ? name : `${name} ${v}`),
    ]),
  );
  steer(player, { play: 'Pause' });
  steer(player, { play: 'Replay', speed: 2, loop: true });
  steer(player, { play: 'Explode' });
  assert.deepEqual(calls, ['pause', 'setSpeed 2', 'setLoop true', 'replay']);
});

test('a motion shown to another window arrives as a trajectory, and nothing else does', () => {
  const motion = {
    t: [0, 1],
    theta: [0, 0.5],
    psi: [0, 0.25],
    V_p: [1, 2],
    V_y: [3, 4],
    reference: { theta: 0.5, psi: 0.25 },
  };
  const shown = shownOf(DESIGN, { gains: { K: [[1]] }, limits: { V_p: 24 } }, motion, {
    motion: 'both',
    rig: 'aero',
    after: 3,
  });
  assert.deepEqual([...trajectoryIn(shown).theta], [0, 0.5]);
  assert.deepEqual(trajectoryIn(shown).reference, motion.reference);
  assert.equal(trajectoryIn({ ...shown, trajectory: { ...shown.trajectory, psi: new Float32Array(3) } }), null);
  assert.equal(trajectoryIn({ ...shown, trajectory: { ...shown.trajectory, psi: new Float32Array([0, NaN]) } }), null);
  assert.equal(trajectoryIn({}), null);
  assert.equal(trajectoryIn(null), null);
});

test('a player that lost time is put where the others are', () => {
  const time = { now: 10 };
  const followed = [];
  const player = {
    time: 0,
    duration: 5,
    follow: (/** @type {any} */ snapshot, /** @type {number} */ elapsed) => followed.push([snapshot.time, elapsed]),
  };
  const step = new InStep(player, () => time.now);
  assert.equal(step.correct(), false); // nothing is known yet
  step.keep({ playing: true, time: 1, speed: 2, loop: false });
  [time.now, player.time] = [11, 2.9];
  assert.equal(step.correct(), false); // 3 s would be exact
  player.time = 1.5; // as after a second without frames
  assert.equal(step.correct(), true);
  assert.deepEqual(followed, [[1, 1]]);
  time.now = 60; // long past the end
  player.time = 5;
  assert.equal(step.correct(), false);
});
