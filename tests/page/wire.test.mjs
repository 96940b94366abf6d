import assert from 'node:assert/strict';
import { test } from 'node:test';
import { decodeFrame, encodeFrame } from '../../static/net/wire.js';

test('frames come out as they went in', () => {
  const message = {
    seq: 1,
    text: 'ψ',
    step: { t: Float32Array.of(0, 0.5), theta: Float32Array.of(1, -2) },
    list: [1, 2],
  };
  const read = decodeFrame(encodeFrame(message));
  assert.deepEqual(read, message);
  assert.throws(() => decodeFrame(encodeFrame(message).slice(0, 20)), RangeError);
});
