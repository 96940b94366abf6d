import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Turns } from '../../static/ui/pace.js';

/**
 * A clock that the test moves on, and views that note what they have drawn, each time or where `changed` says so; each
 * takes its time.
 */
function stage(count, { changed = (/** @type {number} */ _i) => true, cost = 1 } = {}) {
  const state = {
    time: 0,
    calls: /** @type {{at: number, act: () => void}[]} */ ([]),
    drawn: /** @type {[number, number][]} */ ([]),
    again: 0,
    frame: 0,
  };
  const turns = new Turns({
    now: () => state.time,
    later: (act, delay) => state.calls.push({ at: state.time + delay, act }),
  });
  const views = Array.from({ length: count }, (_, i) => () => {
    if (!changed(i)) return false;
    state.drawn.push([state.frame, i]);
    state.time += cost;
    return true;
  });
  const take = (/** @type {number} */ at, { dragging = true, busy = false } = {}) => {
    state.time = state.frame = at;
    turns.take({ dragging }, views, {
      busy,
      again: () => {
        state.again += 1;
      },
    });
  };
  return { state, take };
}

test('without a drag all are drawn in each frame', () => {
  const { state, take } = stage(3);
  take(0, { dragging: false });
  take(16, { dragging: false, busy: true });
  assert.deepEqual(
    state.drawn.map(([, i]) => i),
    [0, 1, 2, 0, 1, 2],
  );
  assert.equal(state.again + state.calls.length, 0);
});

test('in a drag each frame draws as many as its share of time allows, in turn, and none again within 80 ms', () => {
  const slow = stage(3);
  for (let t = 0; t < 160; t += 16) slow.take(t);
  assert.deepEqual(slow.state.drawn, [
    [0, 0],
    [16, 1],
    [32, 2],
    [80, 0],
    [96, 1],
    [112, 2],
  ]);
  const quick = stage(5, { cost: 0.4 });
  quick.take(0);
  quick.take(16);
  assert.deepEqual(quick.state.drawn, [
    [0, 0],
    [0, 1],
    [0, 2],
    [16, 3],
    [16, 4],
  ]);
});

test('a frame that draws the plots leaves the figures to others, but not for long', () => {
  const { state, take } = stage(2);
  take(0, { busy: true });
  for (let t = 16; t < 240; t += 16) take(t, { busy: true });
  assert.deepEqual(state.drawn, [
    [0, 0],
    [16, 1],
    [208, 0],
    [224, 1],
  ]);
});

test('a view with nothing new gives its turn to the next', () => {
  const { state, take } = stage(3, { changed: (i) => i === 2 });
  take(0);
  assert.deepEqual(state.drawn, [[0, 2]]);
});

test('the last state is never forgotten: who has to wait is called for when the time has come', () => {
  const fresh = [true];
  const { state, take } = stage(1, { changed: () => fresh[0] });
  take(0); // draws, and asks for the next frame
  take(16); // too early
  take(32);
  assert.equal(state.again, 1);
  assert.deepEqual(
    state.calls.map(({ at }) => at),
    [80],
  ); // one wait, not one for each frame
  state.calls[0].act();
  assert.equal(state.again, 2);
  take(80);
  fresh[0] = false;
  assert.deepEqual(state.drawn, [
    [0, 0],
    [80, 0],
  ]);
  take(200);
  assert.equal(state.calls.length, 1); // nothing to draw, nothing to wait for
});

test('at the end of a drag all are drawn at once', () => {
  const { state, take } = stage(3);
  take(0);
  take(10, { dragging: false });
  assert.deepEqual(
    state.drawn.map(([, i]) => i),
    [0, 0, 1, 2],
  );
});
