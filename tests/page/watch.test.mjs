// A view is rendered when something that it read has changed, and only then.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { watched } from '../../static/ui/watch.js';

const START = { design: { a: 1 }, reply: null, dragging: false, cloud: null };

function counted(read) {
  const calls = [];
  return { calls, render: watched({ render: (state) => calls.push(read(state)) }) };
}

test('a view that reads one thing rests while another changes', () => {
  const { calls, render } = counted(({ design }) => design.a);
  assert.equal(render(START), true);
  assert.equal(render({ ...START, reply: {}, dragging: true }), false);
  assert.equal(render({ ...START, design: { a: 2 } }), true);
  assert.deepEqual(calls, [1, 2]);
});

test('what was read last counts, not what was read at first', () => {
  const { calls, render } = counted((state) => (state.design ? state.reply : 'nothing'));
  render({ ...START, design: null });
  assert.equal(render({ ...START, design: null, reply: {} }), false); // it never came to the reply
  assert.equal(render(START), true);
  assert.equal(render({ ...START, reply: {} }), true);
  assert.equal(calls.length, 3);
});

test('what a view hands to its parts is noted too', () => {
  const { calls, render } = counted((state) => ((s) => s.cloud)(state));
  render(START);
  assert.equal(render({ ...START, cloud: {} }), true);
  assert.equal(calls.length, 2);
});

test('a view that reads nothing is rendered once', () => {
  const { calls, render } = counted(() => 0);
  render(START);
  render({ ...START, design: {} });
  assert.equal(calls.length, 1);
});
