// Parts of the view Fly beside one another: hands, tasks, the bar and what is opened, on a document that is hardly one.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { FlyRoom } from '../../static/further/fly.js';
import { packed, PLACE } from '../../static/flight/link_text.js';
import { Hands } from '../../static/flight/hands.js';
import { SceneFeed } from '../../static/flight/scene_feed.js';
import { FlightShare } from '../../static/flight/share.js';
import { Sound } from '../../static/flight/sound.js';
import { Tasks } from '../../static/flight/tasks.js';
import { FlightBar } from '../../static/flight/transport.js';
import { INPUT, NEAR, ROW } from '../../static/kernel/index.js';
import { designOf } from '../../static/model/index.js';
import * as ghosts from '../../static/scene/ghosts.js';
import * as poses from '../../static/scene/pose.js';
import { page, PRESET } from './flight_pages.mjs';
import { smallDocument } from './small_dom.mjs';

/** Events of the document. */ let heard = [];

before(() => {
  globalThis.window = smallDocument();
  smallDocument().dispatchEvent = ({ type, detail }) => heard.push([type, detail]);
  globalThis.navigator ??= {};
  globalThis.matchMedia = () => ({ matches: false });
  globalThis.getComputedStyle = () => ({ getPropertyValue: () => '#102030' });
});
after(() => {
  for (const name of ['document', 'window', 'matchMedia', 'getComputedStyle']) delete globalThis[name];
});

/** A page with hands and tasks, which begins a task. */
async function tasked(name, part = {}) {
  const own = page();
  const { flight, store } = own;
  store.load({ ...designOf(PRESET), ...part });
  const feed = { ghosts: [], colorOf: ghosts.rgb };
  const tasks = new Tasks(flight, { store, feed });
  const hands = new Hands(flight, { store, frame: null, shape: () => null, seen: () => true, restart() {} });
  tasks.select.value = name;
  heard = [];
  assert.ok(await tasks.start());
  const frames = (seconds) => {
    for (let n = 0; n < seconds * 60; n++) {
      hands.before(n * 20);
      own.frames(1 / 60);
    }
  };
  return { ...own, tasks, hands, feed, frames };
}

test('hands on where no limit holds the motors, the middle hovers and the ends are the rig’s own', async () => {
  const scenario = { ...designOf(PRESET).scenario, saturation: false };
  const { flight, hands, frames } = await tasked('', { scenario });
  frames(0.1);
  assert.deepEqual(flight.craft.limits, [Infinity, Infinity]);
  hands.act('hands');
  frames(0.1);
  const [hover] = flight.craft.u.slice(INPUT.STICK);
  assert.ok(hover > 5 && hover < 20, `${hover} V`);
  hands.demand('partner', { pitch: 1, yaw: -1 });
  frames(0.1);
  assert.deepEqual([...flight.craft.u.slice(INPUT.STICK, INPUT.STICK + 2)], [24, -15]);
  assert.ok(
    hands.weather.mass.options.every(({ value }) => Number(value) >= 0),
    'masses that can be hung on',
  );
});

test('a task by hand begins with the voltages at which the rig hovers, in its first tick', async () => {
  const { flight, store, tasks, frames } = await tasked('hold');
  store.set({ task: { free: [], hidden: [], flight: { task: 'hold', hands: 'on' } } });
  await tasks.start();
  frames(0.1);
  const { events } = flight.log();
  const [reference, hands, sticks] = events;
  assert.deepEqual(
    [reference.slice(0, 2), hands],
    [
      [0, 'reference'],
      [0, 'hands', 1],
    ],
  );
  assert.ok(sticks[0] === 0 && sticks[1] === 'sticks' && sticks[2] > 5, String(sticks));
});

test('what a task asks stays as it began, though the page’s operating point is moved in the air', async () => {
  const { store, feed, frames } = await tasked('land');
  const asked = () => feed.ghosts.find(({ label }) => label === 'asked').theta;
  frames(0.1);
  const before = asked();
  assert.ok(Math.abs(before - 0.8 * NEAR.HIGHEST) < 1e-12);
  store.edit((design) => ({ ...design, theta0: 0.2 }));
  frames(0.1);
  assert.equal(asked(), before);
});

test('a task that is flown by single steps is practice', async () => {
  const { flight, tasks, frames } = await tasked('hold');
  frames(29.9);
  flight.step();
  flight.go();
  frames(0.2);
  assert.equal(flight.state.mode, 'ended');
  assert.match(tasks.result.textContent, /^Practice: .*It was slowed, so it does not count\.$/);
  assert.deepEqual(heard, []);
});

test('a task is told once it is flown to its end, with its log', async () => {
  const { flight, frames } = await tasked('hold');
  frames(30.1);
  const [[type, { log, values }]] = heard;
  assert.deepEqual([type, log, heard.length], ['flown', flight.log(), 1]);
  assert.ok(values.path_error > 0 && log.task === 'hold');
});

test('of two links the later one is flown, and of a broken one the page’s design knows nothing', async () => {
  const { flight, store, frames } = page();
  const share = new FlightShare(flight, store);
  const logs = [];
  for (const seed of [1, 2]) {
    await flight.start({ seed });
    frames(0.5);
    logs.push(PLACE + (await packed(flight.log())));
  }
  let unpacked = () => {};
  const second = new Promise((on) => (unpacked = on)); // before it the first is not
  const unpacking = globalThis.DecompressionStream;
  let first = true;
  globalThis.DecompressionStream = function (format) {
    const late = first;
    first = false;
    const inner = new unpacking(format);
    const wait = new TransformStream({
      transform: async (chunk, to) => {
        if (late) await second;
        to.enqueue(chunk);
      },
    });
    return { readable: inner.readable.pipeThrough(wait), writable: inner.writable };
  };
  const [late, next] = logs.map((place) => share.fromLink(place));
  assert.equal(await next, '');
  unpacked();
  assert.equal(await late, '');
  globalThis.DecompressionStream = unpacking;
  assert.deepEqual([flight.state.mode, flight.state.seed], ['replaying', 2]);
  store.edit((design) => ({ ...design, outer: 'none' }));
  const { design } = store.state;
  const { checksum: _own, ...log } = flight.log();
  assert.match(await share.fromLink(PLACE + (await packed(log))), /damaged/);
  assert.equal(store.state.design, design);
});

test('whoever looks back looks no more once it flies on', async () => {
  const { flight, frames } = page();
  const looked = [];
  const bar = new FlightBar(flight, { again() {}, look: (...own) => looked.push(own) });
  flight.addEventListener('change', () => bar.render());
  await flight.start({ seed: 1 });
  frames(3);
  bar.past.value = '-1';
  bar.past.send('input');
  assert.deepEqual([bar.looks, flight.state.mode, looked.length], [true, 'frozen', 1]);
  flight.go(); // by a key or a gamepad
  assert.equal(bar.looks, false);
  const { time } = flight.state;
  bar.past.send('change'); // let go only now
  assert.equal(flight.state.time, time);
  bar.past.value = '-1';
  bar.past.send('input');
  bar.past.send('change');
  assert.ok(Math.abs(flight.state.time - (time - 1)) < 0.01);
});

test('what cannot be fetched says so, and is fetched again at the next visit, not at every change', async (context) => {
  context.mock.method(console, 'error', () => {});
  const root = globalThis.document.createElement('section');
  globalThis.document.getElementById = () => root;
  let asked = 0;
  const shown = [];
  const fetched = async () => {
    asked += 1;
    throw new Error('no network');
  };
  const room = new FlyRoom({}, { fetched, styles: async () => {}, show: (parts) => shown.push(parts) });
  const drags = async () => {
    for (let n = 0; n < 5; n++) {
      room.render({ view: 'fly' });
      await new Promise(setImmediate);
    }
  };
  room.render({ view: 'design' });
  assert.equal(asked, 0);
  await drags();
  assert.deepEqual([asked, shown.length], [1, 0]);
  assert.match(root.textContent, /could not fetch/);
  room.render({ view: 'design' });
  await drags();
  assert.equal(asked, 2);
});

test('what makes the sound sleeps while nothing is to be heard', (context) => {
  context.mock.timers.enable({ apis: ['setTimeout'] });
  let state = 'suspended';
  const louds = [];
  class Node {
    constructor(_context, { gain } = {}) {
      for (const name of ['gain', 'frequency']) this[name] = { setTargetAtTime: (value) => (this[name].value = value) };
      if (gain !== undefined) louds.push(this);
    }
    connect(next) {
      return next;
    }
    start() {}
  }
  globalThis.AudioContext = class {
    resume = async () => void (state = 'running');
    suspend = async () => void (state = 'suspended');
  };
  for (const name of ['OscillatorNode', 'BiquadFilterNode', 'GainNode', 'StereoPannerNode']) globalThis[name] = Node;
  const sound = new Sound();
  const rows = new Float64Array(ROW.FLIGHT_ROW).fill(12);
  let now = 0;
  const flies = (ms) => {
    for (const end = now + ms; now < end; now += 16) {
      sound.put(rows, 1, now);
      sound.render(now);
    }
  };
  flies(100);
  assert.deepEqual([state, louds.length], ['suspended', 0], 'nobody asked for it');
  sound.node.send('click');
  assert.equal(state, 'running');
  context.mock.timers.tick(2000);
  assert.equal(state, 'suspended', 'nothing flies');
  flies(100);
  assert.ok(state === 'running' && louds.every(({ gain }) => gain.value > 0.05));
  context.mock.timers.tick(2000);
  assert.equal(state, 'running');
  sound.hush(); // time stands still, and the view may be left: no frame comes
  assert.ok(louds.every(({ gain }) => gain.value === 0));
  context.mock.timers.tick(2000);
  assert.equal(state, 'suspended');
  flies(100);
  sound.node.send('click');
  assert.deepEqual([state, sound.on], ['suspended', false]);
});

test('of all ghosts of the scene only those of the flight are seen', () => {
  const shown = [];
  const node = () => globalThis.document.createElement('span');
  const hud = { theta: node(), psi: node(), V_p: node(), V_y: node() };
  const feed = new SceneFeed({ hud, player: { live: (pose) => shown.push(pose) } }, { poses, ghosts });
  const sample = { theta: 0.1, psi: 0.2, V_p: 3, V_y: 24, reference: { theta: 0, psi: 0 } };
  const seen = () =>
    shown
      .at(-1)
      .messages.filter(({ name, visible }) => /^\/ghosts\/\w+$/.test(name) && visible)
      .map(({ name }) => name);
  feed.show(sample, { V_p: 24, V_y: 24 });
  assert.deepEqual(seen(), []);
  assert.deepEqual([hud.V_p.textContent, hud.V_y.textContent], ['3.0 V', '24.0 V limit']);
  feed.ghosts = [{ slot: '1', label: 'asked', color: [1, 2, 3], theta: 0, psi: 1 }];
  feed.show(sample);
  assert.deepEqual(seen(), ['/ghosts/1']);
  assert.equal(shown[0].messages.filter(({ name }) => name.startsWith('/ghosts/')).length, ghosts.SLOTS.length);
});
