/**
 * What is asked of the server of its own accord: a hub that comes back, a recording that is simulated once its columns
 * are known.
 */
import assert from 'node:assert/strict';
import { afterEach, mock, test } from 'node:test';

import { Hub } from '../../static/scene/hub.js';
import { RecordingFeed } from '../../static/recordings/feed.js';
import { designOf, Store } from '../../static/model/store.js';
import { MACHINE } from './presets.mjs';

afterEach(() => {
  mock.timers.reset();
  mock.restoreAll();
  delete globalThis.document;
});

function hubOf() {
  mock.timers.enable({ apis: ['setTimeout'] });
  const sockets = [];
  const open = () => {
    const socket = {
      readyState: 1,
      sent: [],
      send(text) {
        this.sent.push(JSON.parse(text));
      },
      close() {
        this.onclose();
      },
    };
    sockets.push(socket);
    return socket;
  };
  const it = new Hub({
    open,
    always: false,
    now: () => 0,
    onShown() {},
    onTransport() {},
    onEdits() {},
    onWindows() {},
  });
  return { it, sockets };
}

test('a hub that was lost comes back, each time later, until it is closed', () => {
  const { it, sockets } = hubOf();
  const waits = [];
  for (let lost = 1; lost <= 4; lost++) {
    sockets[sockets.length - 1].onclose();
    let wait = 0;
    while (sockets.length === lost && wait < 60_000) (mock.timers.tick(50), (wait += 50));
    assert.equal(sockets.length, lost + 1);
    waits.push(wait);
  }
  const halves = waits.map((wait, k) => [0.75 * 500 * 2 ** k, 1.25 * 500 * 2 ** k + 50]);
  waits.forEach((wait, k) => assert.ok(halves[k][0] <= wait && wait <= halves[k][1], `${waits}`));
  it.close();
  mock.timers.tick(120_000);
  assert.equal(sockets.length, 5, 'closed by who opened it, it stays closed');
});

test('a hub asks for the time four times at once, and then every twenty seconds', () => {
  const {
    sockets: [socket],
  } = hubOf();
  const asked = () => socket.sent.filter((m) => m.type === 'clock').length;
  const answer = () => socket.onmessage({ data: JSON.stringify({ type: 'clock', sent: 0, server: 5 }) });
  socket.onopen();
  for (let k = 1; k <= 4; k++) {
    assert.equal(asked(), k);
    answer();
  }
  assert.equal(asked(), 4);
  mock.timers.tick(19_999);
  assert.equal(asked(), 4);
  mock.timers.tick(1);
  assert.equal(asked(), 5);
});

const names = { time: 't', theta: 'a', psi: 'b', V_p: 'c', V_y: 'd' };
const preset = {
  name: 'rig',
  title: '',
  source: '',
  rig: 'helicopter',
  parameters: { K_pp: 1, K_s: 0 },
  limits: { V_p: 24, V_y: 15 },
  poles: [-1, -2, -3, -4].map((re) => ({ re, im: 0 })),
  loops: { pitch: { kp: 1, ti: 1 }, yaw: { kp: 1, ti: 1 } },
  ...MACHINE,
  scenario: { reference: { theta: 0.1, psi: 0.2 }, duration: 3 },
};

for (const [what, columns, simulated] of [
  ['all columns', names, true],
  ['no yaw voltage', { ...names, V_y: '' }, false],
]) {
  test(`a file with ${what} guessed is ${simulated ? 'simulated' : 'left to be chosen'}`, async () => {
    globalThis.document = { baseURI: 'http://127.0.0.1/' };
    const asked = [];
    mock.method(globalThis, 'fetch', async (/** @type {URL} */ url) => {
      asked.push(url.pathname);
      const reply = url.pathname.endsWith('/overlay')
        ? { samples: 1 }
        : { id: 'x', name: 'run.csv', columns: Object.values(names), guess: { columns, unit: 'rad' } };
      return new Response(JSON.stringify(reply), { headers: { 'content-type': 'application/json' } });
    });
    const store = new Store();
    store.set({ presets: [preset] });
    store.load(designOf(preset));
    await new RecordingFeed(store, () => assert.fail('no search was asked for')).send([
      { file: new Blob(['t']), name: 'run.csv' },
    ]);
    assert.deepEqual(asked, ['/api/v1/recordings', ...(simulated ? ['/api/v1/recordings/x/overlay'] : [])]);
    const { overlay, busy, problem, columns: kept } = store.state.recorded;
    assert.deepEqual([overlay, busy, problem], [simulated ? { samples: 1 } : null, '', null]);
    assert.equal(kept.names.V_y, columns.V_y);
  });
}
