import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Pace } from '../../static/pace.js';

function clock() {
  const state = { time: 0, calls: /** @type {{at: number, act: () => void}[]} */ ([]) };
  const pace = new Pace({ every: 80, now: () => state.time, later: (act, delay) => state.calls.push({ at: state.time + delay, act }) });
  return { state, pace };
}

test('without a drag every frame is due', () => {
  const { state, pace } = clock();
  for (let k = 0; k < 5; k += 1, state.time += 16) assert.equal(pace.due(false, assert.fail), true);
  assert.equal(state.calls.length, 0);
});

test('in a drag figures are due every 80 ms, and the last state is never forgotten', () => {
  const { state, pace } = clock();
  const due = [];
  let again = 0;
  for (; state.time < 320; state.time += 16) {
    for (const call of state.calls.splice(0, state.calls.filter(({ at }) => at <= state.time).length)) call.act();
    if (pace.due(true, () => { again += 1; })) due.push(state.time);
    assert.ok(state.calls.length <= 1); // one wait for each span, not one for each frame
  }
  assert.deepEqual(due, [0, 80, 160, 240]);
  assert.equal(again, 3);
  assert.equal(state.calls.length, 1); // the last state's turn comes too
});

test('the end of a drag is due at once', () => {
  const { state, pace } = clock();
  pace.due(true, () => {});
  state.time = 10;
  assert.equal(pace.due(true, () => {}), false);
  assert.equal(pace.due(false, () => {}), true);
});
