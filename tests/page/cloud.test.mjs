/**
 * The feed of the cloud: of the server few rigs at once, many at rest, one request at a time; where the page computes,
 * all at once, and nobody is asked; nothing when it is off.
 */
import assert from 'node:assert/strict';
import { mock, test } from 'node:test';
import { CloudFeed, cloudRequest, cloudWords, uncertain } from '../../static/clouds/feed.js';
import { designOf, Store } from '../../static/model/store.js';
import { MACHINE } from './presets.mjs';

const preset = {
  name: 'rig',
  title: '',
  source: '',
  rig: 'helicopter',
  parameters: { K_pp: 1, g: 9.81 },
  limits: { V_p: 24, V_y: 15 },
  poles: [-1, -2, -3, -4].map((re) => ({ re, im: 0 })),
  loops: { pitch: { kp: 1, ti: 1 }, yaw: { kp: 1, ti: 1 } },
  ...MACHINE,
  scenario: { reference: { theta: 0.1, psi: 0.2 }, duration: 3 },
};

function rigged() {
  const store = new Store();
  store.set({ presets: [preset] });
  store.load(designOf(preset));
  const sockets = [];
  const feed = new CloudFeed(store, () => {
    const socket = {
      readyState: 0,
      sent: [],
      closed: false,
      send(text) {
        this.sent.push(JSON.parse(text));
      },
      close() {
        this.closed = true;
      },
    };
    sockets.push(socket);
    return socket;
  });
  const answer = (socket, samples, done = samples) =>
    socket.onmessage({
      data: JSON.stringify({
        done,
        samples,
        loop_poles: [],
        t: [],
        envelopes: { theta: [], psi: [] },
        share_stable: 1,
        share_within_limits: 0.999,
      }),
    });
  const open = (socket) => {
    socket.readyState = 1;
    socket.onopen();
  };
  return { store, feed, sockets, answer, open };
}

test('nothing is asked until an uncertainty is chosen', () => {
  const { store, feed, sockets } = rigged();
  feed.render(store.state);
  assert.equal(sockets.length, 0);
});

test('few rigs at once, many when the hand rests, one request at a time', () => {
  mock.timers.enable({ apis: ['setTimeout'] });
  const { store, feed, sockets, answer, open } = rigged();
  store.set({ spread: 0.1 });
  feed.render(store.state);
  open(sockets[0]);
  const { sent } = sockets[0];
  assert.deepEqual([sent[0].samples, sent[0].uncertainty], [200, { K_pp: 0.1 }]);
  store.edit((d) => ({ ...d, pairing: 'cross' }));
  feed.render(store.state);
  store.edit((d) => ({ ...d, pairing: 'diagonal', outer: 'none' }));
  feed.render(store.state);
  assert.equal(sent.length, 1);
  answer(sockets[0], 200);
  assert.equal(sent[1].outer, 'none');
  answer(sockets[0], 200);
  mock.timers.tick(600);
  assert.equal(sent[2].samples, 2000);
  answer(sockets[0], 2000, 250);
  assert.equal(store.state.cloud.done, 250);
  answer(sockets[0], 2000);
  assert.equal(store.state.cloud.done, 2000);
  mock.timers.reset();
});

test('switched off, the cloud goes and the socket with it', () => {
  const { store, feed, sockets, answer, open } = rigged();
  store.set({ spread: 0.2 });
  feed.render(store.state);
  open(sockets[0]);
  answer(sockets[0], 200);
  store.set({ spread: 0 });
  feed.render(store.state);
  assert.equal(store.state.cloud, null);
  assert.equal(sockets[0].closed, true);
});

test('the request is for the motion that is played', () => {
  const design = designOf(preset);
  assert.deepEqual(cloudRequest(design, 0.1, 'psi', ['m', 'g'], 5).scenario, { reference: { psi: 0.2 }, duration: 3 });
  assert.deepEqual(cloudRequest(design, 0.1, 'both', ['m', 'g'], 5).uncertainty, { m: 0.1 });
});

test('rotors that lag are uncertain as well, and no others', () => {
  const design = designOf(preset);
  assert.deepEqual(uncertain(design, preset), ['K_pp', 'g']);
  const lagging = { ...design, rotors: { pitch: { tau: 1e-9 }, yaw: { tau: 0.1 } } };
  assert.deepEqual(uncertain(lagging, preset), ['K_pp', 'g', 'tau_y']);
  const own = { ...preset, rotors: { pitch: { tau: 0.2 }, yaw: { tau: 0.2 } } };
  assert.deepEqual(uncertain(lagging, own), ['K_pp', 'g', 'tau_y']);
  assert.deepEqual(uncertain(designOf(own), own), ['K_pp', 'g', 'tau_p', 'tau_y']);
});

test('nearly all is not all', () => {
  assert.equal(cloudWords(null), '');
  assert.equal(
    cloudWords({ done: 2000, share_stable: 0.9995, share_within_limits: 1 }),
    '2000 rigs: 99 % stable, 100 % within limits',
  );
});

test('a hand that rests without letting go gets its many rigs when it does', () => {
  mock.timers.enable({ apis: ['setTimeout'] });
  const { store, feed, sockets, answer, open } = rigged();
  store.set({ spread: 0.1, dragging: true });
  feed.render(store.state);
  open(sockets[0]);
  answer(sockets[0], 200);
  mock.timers.tick(600);
  feed.render(store.state);
  assert.equal(sockets[0].sent.length, 1);
  store.set({ dragging: false });
  feed.render(store.state);
  mock.timers.tick(600);
  assert.equal(sockets[0].sent[1].samples, 2000);
  mock.timers.reset();
});

test('while the page computes itself what moves nothing is asked, and no cloud of another design is seen', () => {
  const { store, feed, sockets, answer, open } = rigged();
  store.set({ spread: 0.1, answered: store.state.design, heard: store.state.design });
  feed.render(store.state);
  open(sockets[0]);
  answer(sockets[0], 200);
  assert.equal(store.state.cloud.done, 200);
  const moved = () => {
    store.edit((d) => ({ ...d, theta0: d.theta0 + 0.01 }), { gesture: 'drag' });
    store.set({ answered: store.state.design });
    feed.render(store.state);
  };
  store.set({ dragging: true });
  moved();
  moved();
  assert.equal(store.state.cloud, null);
  answer(sockets[0], 2000);
  assert.equal(store.state.cloud, null, 'it is of a design that is no more');
  assert.equal(sockets[0].sent.length, 1);
  store.set({ dragging: false, heard: store.state.design });
  feed.render(store.state);
  assert.equal(sockets[0].sent.length, 2);
  feed.render({ ...store.state, spread: 0 });
});

/** The page computes itself, by hand; another method it cannot. */
function computing() {
  const made = rigged();
  const asked = [];
  const rigs = {
    asked,
    forgotten: 0,
    serves: (design) => design.method !== 'lqr',
    ask: (design, _preset, spreads, count, then) => asked.push({ design, spreads, count, then }),
    forget: () => (rigs.forgotten += 1),
  };
  return { ...made, rigs, asked };
}
const found = (done, judged = done) => ({ done, judged, share_stable: 1, share_within_limits: 1 });

test('where the page computes, every move of the hand asks for all rigs, and no server', () => {
  const { store, feed, sockets, open, rigs, asked } = computing();
  store.set({ spread: 0.1 });
  feed.render(store.state);
  open(sockets[0]);
  feed.take(rigs);
  assert.equal(sockets[0].closed, true, 'the server is asked no more');
  assert.deepEqual([asked.length, asked[0].count, asked[0].spreads], [1, 2000, { K_pp: 0.1 }]);
  feed.render(store.state);
  assert.equal(asked.length, 1, 'once for a design');
  store.set({ dragging: true, connection: 'lost' });
  for (const outer of ['none', 'pi']) {
    store.edit((d) => ({ ...d, outer }), { gesture: 'drag-0' });
    store.set({ answered: store.state.design }); // the page's own numbers
    feed.render(store.state);
    asked.at(-1).then(found(2000, 200));
    assert.deepEqual(store.state.cloud, found(2000, 200));
    assert.equal(asked.at(-1).design.outer, outer);
  }
  asked.at(-1).then(found(2000));
  assert.equal(store.state.cloud.judged, 2000);
  store.set({ motion: 'psi' });
  feed.render(store.state);
  assert.deepEqual(asked.at(-1).design.scenario, { reference: { psi: 0.2 }, duration: 3 });
  store.set({ spread: 0.2 });
  feed.render(store.state);
  assert.deepEqual([asked.length, asked.at(-1).spreads.K_pp], [5, 0.2]);
  assert.equal(sockets.length, 1);
  store.set({ spread: 0 });
  feed.render(store.state);
  assert.deepEqual([store.state.cloud, rigs.forgotten], [null, 1]);
});

test('what the page does not serve, or does not find, the server is asked', () => {
  const { store, feed, sockets, open, rigs, asked } = computing();
  feed.take(rigs);
  store.set({ spread: 0.1 });
  feed.render(store.state);
  assert.deepEqual([sockets.length, asked.length], [0, 1]);
  asked[0].then(null);
  open(sockets[0]);
  assert.equal(sockets[0].sent[0].samples, 200);
  assert.equal(rigs.forgotten, 1);
  feed.render(store.state);
  assert.equal(asked.length, 1, 'not again for this design');
  store.edit((d) => ({ ...d, pairing: 'cross' }));
  feed.render(store.state);
  assert.deepEqual([sockets[0].closed, asked.length], [true, 2]);
  store.edit((d) => ({ ...d, method: 'lqr' }));
  feed.render(store.state);
  open(sockets[1]);
  assert.equal(sockets[1].sent[0].method, 'lqr');
  assert.equal(asked.length, 2);
});

test('words say of how many rigs the responses are known', () => {
  const cloud = { done: 2000, judged: 200, share_stable: 1, share_within_limits: 0.5 };
  assert.equal(cloudWords(cloud), '2000 rigs: 100 % stable, 50 % of 200 within limits');
});
