import assert from 'node:assert/strict';
import test from 'node:test';
import * as net from '../../static/net/index.js';
import * as packaged from '../../static/net/packaged.js';

test('a page without a server has all names of the room net, and is told that nobody answers', async () => {
  assert.deepEqual(Object.keys(packaged).sort(), Object.keys(net).sort());
  const told = (error) => error instanceof net.ProblemError && /without/.test(error.message);
  await assert.rejects(packaged.suggestLoops({}), told);
  assert.throws(() => packaged.cloudAddress(), told);
});
