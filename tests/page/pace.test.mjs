import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Turns } from '../../static/pace.js';

/** A clock that the test moves on, and views that note what they have drawn, each time or where `changed` says so. */
function stage(count, changed = () => true) {
  const state = { time: 0, calls: /** @type {{at: number, act: () => void}[]} */ ([]), drawn: /** @type {[number, number][]} */ ([]), again: 0 };
  const turns = new Turns({ every: 80, now: () => state.time, later: (act, delay) => state.calls.push({ at: state.time + delay, act }) });
  const views = Array.from({ length: count }, (_, i) => () => {
    if (!changed(i)) return false;
    state.drawn.push([state.time, i]);
    return true;
  });
  const take = (/** @type {boolean} */ dragging) => turns.take({ dragging }, views, () => { state.again += 1; });
  return { state, take };
}

test('without a drag all are drawn in each frame', () => {
  const { state, take } = stage(3);
  take(false);
  take(false);
  assert.deepEqual(state.drawn.map(([, i]) => i), [0, 1, 2, 0, 1, 2]);
  assert.equal(state.again + state.calls.length, 0);
});

test('in a drag one is drawn in each frame, in turn, and none again within 80 ms', () => {
  const { state, take } = stage(3);
  for (; state.time < 160; state.time += 16) take(true);
  assert.deepEqual(state.drawn, [[0, 0], [16, 1], [32, 2], [80, 0], [96, 1], [112, 2]]);
});

test('a view with nothing new gives its turn to the next', () => {
  const { state, take } = stage(3, (i) => i === 2);
  take(true);
  assert.deepEqual(state.drawn, [[0, 2]]);
});

test('the last state is never forgotten: who has to wait is called for when the time has come', () => {
  const fresh = [true];
  const { state, take } = stage(1, () => fresh[0]);
  take(true); // draws, and asks for the next frame
  state.time = 16;
  take(true); // too early
  take(true);
  assert.equal(state.again, 1);
  assert.deepEqual(state.calls.map(({ at }) => at), [80]); // one wait, not one for each frame
  state.time = 80;
  state.calls[0].act();
  assert.equal(state.again, 2);
  take(true);
  fresh[0] = false;
  assert.deepEqual(state.drawn, [[0, 0], [80, 0]]);
  state.time = 200;
  take(true);
  assert.equal(state.calls.length, 1); // nothing to draw, nothing to wait for
});

test('at the end of a drag all are drawn at once', () => {
  const { state, take } = stage(3);
  take(true);
  state.time = 10;
  take(false);
  assert.deepEqual(state.drawn.map(([, i]) => i), [0, 0, 1, 2]);
});
