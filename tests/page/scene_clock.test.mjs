import assert from 'node:assert/strict';
import { beforeEach, describe, test } from 'node:test';
import { REST, SceneClock, SPEEDS, nearestSpeed } from '../../static/scene/clock.js';

const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-12, `${a} is not ${b}`);

describe('SceneClock', () => {
  /** @type {SceneClock} */
  let clock;
  beforeEach(() => {
    clock = new SceneClock();
    clock.setDuration(2);
  });

  test('stands still until it is told to play', () => {
    clock.advance(1);
    assert.deepEqual(clock.snapshot(), { playing: false, time: 0, speed: 1, loop: false });
  });
  test('runs at each speed', () => {
    for (const speed of SPEEDS) {
      clock.setSpeed(speed);
      clock.restart();
      clock.advance(0.3);
      near(clock.time, 0.3 * speed);
    }
  });
  test('stops at the end and says so once', () => {
    clock.play();
    assert.equal(clock.advance(1.9), false);
    assert.equal(clock.advance(0.2), true);
    assert.deepEqual([clock.time, clock.playing], [2, false]);
    assert.equal(clock.advance(0.2), false);
  });
  test('plays from the start after the end, and goes on after a pause', () => {
    clock.seek(2);
    clock.play();
    assert.deepEqual([clock.time, clock.playing], [0, true]);
    clock.advance(0.5);
    clock.pause();
    clock.advance(0.5);
    clock.play();
    near(clock.time, 0.5);
  });
  test('loops with a rest at the end, whatever the speed', () => {
    clock.setLoop(true);
    for (const speed of SPEEDS) {
      clock.setSpeed(speed);
      clock.restart();
      clock.advance(2 / speed + REST / 2);
      assert.deepEqual([clock.time, clock.playing], [2, true]);
      clock.advance(REST / 2 + 0.1);
      near(clock.time, 0.1 * speed);
    }
  });
  test('a loop that is switched off while it rests ends there', () => {
    clock.setLoop(true);
    clock.play();
    clock.advance(2 + REST / 2);
    clock.setLoop(false);
    assert.equal(clock.advance(0.01), true);
    assert.equal(clock.time, 2);
  });
  test('a loop of many rounds in one step ends where small steps would', () => {
    const other = new SceneClock();
    for (const c of [clock, other]) {
      c.setDuration(2);
      c.setLoop(true);
      c.restart();
    }
    clock.advance(13);
    for (let k = 0; k < 1300; k += 1) other.advance(0.01);
    assert.ok(Math.abs(clock.time - other.time) < 1e-9);
  });
  test('seeks within the response, running or not', () => {
    clock.seek(-3);
    assert.equal(clock.time, 0);
    clock.seek(99);
    assert.equal(clock.time, 2);
    clock.seek(NaN);
    assert.equal(clock.time, 2);
    clock.restart();
    clock.seek(0.7);
    assert.deepEqual([clock.time, clock.playing], [0.7, true]);
  });
  test('another response keeps the time, within it', () => {
    clock.seek(1.5);
    clock.setDuration(5);
    assert.equal(clock.time, 1.5);
    clock.setDuration(1);
    assert.equal(clock.time, 1);
  });
  test('responses that change faster than a loop rests do not keep it from starting again', () => {
    clock.setLoop(true);
    clock.play();
    clock.advance(2.1);
    for (let k = 0; k < 10; k += 1) {
      clock.setDuration(2 + k / 10);
      clock.advance(0.1);
    }
    near(clock.time, 2.1 + 10 * 0.1 - 2 - REST);
  });
  test('without a response nothing plays', () => {
    const empty = new SceneClock();
    empty.play();
    assert.equal(empty.playing, false);
    empty.restart();
    empty.apply({ playing: true, time: 1, speed: 1, loop: true }, 5);
    assert.deepEqual(empty.snapshot(), { playing: false, time: 0, speed: 1, loop: true });
  });
  test('takes only speeds that are offered', () => {
    assert.deepEqual([3, 0.1, 100, 0, NaN, -1, Infinity].map(nearestSpeed), [4, 0.25, 4, 1, 1, 1, 1]);
  });
  test('a clock that applies a snapshot late stands where the first one has come to', () => {
    for (const [loop, elapsed] of /** @type {[boolean, number][]} */ ([
      [false, 0.2],
      [false, 9],
      [true, 0.2],
      [true, 0.6],
      [true, 9],
    ])) {
      const other = new SceneClock();
      other.setDuration(2);
      clock.setLoop(loop);
      clock.setSpeed(4);
      clock.restart();
      clock.advance(0.1);
      const snapshot = JSON.parse(JSON.stringify(clock.snapshot()));
      clock.advance(elapsed);
      other.apply(snapshot, elapsed);
      near(other.time, clock.time);
      assert.equal(other.playing, clock.playing);
    }
  });
  test("a snapshot taken in a loop's rest keeps the rest", () => {
    const other = new SceneClock();
    other.setDuration(2);
    clock.setLoop(true);
    clock.play();
    clock.advance(2 + REST / 2);
    other.apply(clock.snapshot());
    for (const c of [clock, other]) c.advance(REST / 2 + 0.25);
    near(clock.time, 0.25);
    near(other.time, 0.25);
  });
  test('a held clock is followed exactly, however late', () => {
    clock.apply({ playing: false, time: 1.25, speed: 0.5, loop: false }, 60);
    assert.deepEqual(clock.snapshot(), { playing: false, time: 1.25, speed: 0.5, loop: false });
  });
});
