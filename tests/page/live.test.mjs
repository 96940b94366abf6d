// The live socket: one request in flight, the newest one waits, stale answers are dropped, a lost connection returns.
import assert from 'node:assert/strict';
import { beforeEach, mock, test } from 'node:test';

import { Live } from '../../static/net/api.js';
import { decodeFrame, encodeFrame } from '../../static/net/wire.js';

class FakeSocket {
  readyState = 0;
  sent = [];
  send(text) {
    this.sent.push(JSON.parse(text));
  }
  open() {
    this.readyState = 1;
    this.onopen();
  }
  answer(seq) {
    this.onmessage({ data: encodeFrame({ seq, gains: {} }) });
  }
  close() {
    this.readyState = 3;
    this.onclose();
  }
}

let sockets, replies, problems, statuses, live;
const last = () => sockets[sockets.length - 1];
const seqs = () => last().sent.map((r) => r.seq);

beforeEach(() => {
  mock.timers.reset();
  mock.timers.enable({ apis: ['setTimeout'] });
  [sockets, replies, problems, statuses] = [[], [], [], []];
  live = new Live({
    onReply: (r) => replies.push(r.seq),
    onProblem: (p) => problems.push(p.code),
    onStatus: (s) => statuses.push(s),
    open: () => (sockets.push(new FakeSocket()), last()),
  });
});

test('what is asked before the socket is open is sent when it opens, the newest only', () => {
  live.send({ seq: 1 });
  live.send({ seq: 2 });
  last().open();
  assert.deepEqual(seqs(), [2]);
});

test('while one is in flight only the newest waits', () => {
  last().open();
  for (const seq of [1, 2, 3, 4]) live.send({ seq });
  assert.deepEqual(seqs(), [1]);
  last().answer(1);
  assert.deepEqual(seqs(), [1, 4]);
  last().answer(4);
  assert.deepEqual(replies, [1, 4]);
});

test('an answer that nobody waits for is dropped', () => {
  last().open();
  live.send({ seq: 5 });
  last().answer(3);
  assert.deepEqual(replies, []);
  last().answer(5);
  assert.deepEqual(replies, [5]);
});

test('a refusal is a problem, and the next request follows', () => {
  last().open();
  live.send({ seq: 1 });
  live.send({ seq: 2 });
  last().onmessage({ data: JSON.stringify({ seq: 1, status: 422, code: 'uncontrollable' }) });
  assert.deepEqual(problems, ['uncontrollable']);
  assert.deepEqual(seqs(), [1, 2]);
});

test('after a lost connection the unanswered request is sent again, or the newer one', () => {
  last().open();
  live.send({ seq: 1 });
  last().close();
  assert.deepEqual(statuses, ['open', 'lost']);
  mock.timers.tick(1000);
  assert.equal(sockets.length, 2);
  last().open();
  assert.deepEqual(seqs(), [1]);
  live.send({ seq: 2 });
  last().close();
  mock.timers.tick(1000);
  last().open();
  assert.deepEqual(seqs(), [2]);
});

test('attempts grow rarer, and never rarer than every ten seconds', () => {
  const waits = [];
  for (let k = 0; k < 8; k++) {
    const count = sockets.length;
    last().close();
    let waited = 0;
    while (sockets.length === count) {
      mock.timers.tick(50);
      waited += 50;
    }
    waits.push(waited);
  }
  assert.ok(waits[0] <= 350 && waits[7] > 4000 && Math.max(...waits) <= 10_050, String(waits));
});

test('a server that does not answer is taken for lost', () => {
  last().open();
  live.send({ seq: 1 });
  mock.timers.tick(10_000);
  assert.equal(statuses.at(-1), 'lost');
});

test('a closed client stays closed', () => {
  last().open();
  live.close();
  mock.timers.tick(60_000);
  assert.equal(sockets.length, 1);
});

test('a frame gives back what was put in, arrays as float32', () => {
  const value = { seq: 3, step: { t: Float32Array.of(0, 0.5, 1), ψ: Float32Array.of(-1, 2.25, 1e-3) }, stable: true };
  assert.deepEqual(decodeFrame(encodeFrame(value)), value);
});

test('arrays are read where they do not lie on a multiple of four', () => {
  const header = new TextEncoder().encode('{"t":{"$f32":[1,2]}}x'.replace('x', ' '));
  const bytes = new Uint8Array(4 + header.length + 12);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, header.length, true);
  bytes.set(header, 4);
  [7, 0.25, -3].forEach((v, i) => view.setFloat32(4 + header.length + 4 * i, v, true));
  assert.deepEqual([...decodeFrame(bytes.buffer).t], [0.25, -3]);
});

test('a frame that is cut short is refused', () => {
  assert.throws(() => decodeFrame(encodeFrame({ t: Float32Array.of(1) }).slice(0, 8)), RangeError);
});
