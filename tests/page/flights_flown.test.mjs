// Flights on the page: what it makes of frames, of hands, and of its own design as that changes.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { checksum } from '../../static/flight/checksum.js';
import { Clock } from '../../static/flight/clock.js';
import { bodyOfFlight } from '../../static/flight/designs.js';
import { LogError, readLog } from '../../static/flight/log.js';
import { INPUT, LOG, ROW } from '../../static/kernel/index.js';
import { designOf } from '../../static/model/index.js';
import { aboard, designs, page, PRESET, slowly } from './flight_pages.mjs';
import { flownAgain } from './flown_again.mjs';

const near = (a, b, by) => assert.ok(Math.abs(a - b) <= by, `${a} is not within ${by} of ${b}`);

test('for ten minutes a flight is the wall’s time within a millisecond, whatever the screen’s rate', async () => {
  const clock = new Clock();
  let [now, time, worst] = [100, 0, 0];
  for (let n = 0; n < 36_000; n++) {
    now += n % 3 ? 1000 / 60 : 1000 / 75 + (n % 7);
    const due = clock.due(now, time);
    time += Math.round((due - time) / 0.002) * 0.002;
    if (n === 0) assert.equal(due, 0);
    worst = Math.max(worst, Math.abs(time - due));
  }
  assert.ok(time > 590 && worst <= 0.001 + 1e-9, `${time} ${worst}`);
  const { flight, frames } = page();
  await flight.start({ seed: 1 });
  frames.late(0);
  frames(7);
  near(flight.state.time, 7, 0.001);
});

test('a page flies, freezes, steps, goes on, and tells of it', async () => {
  const { flight, told, frames } = page();
  assert.equal(flight.state.mode, 'idle');
  assert.ok(!flight.do('hands', 1) && flight.log() === null);
  assert.ok(await flight.start({ seed: 4, task: 'hold' }));
  assert.deepEqual(told('start'), [{ task: 'hold', seed: 4 }]);
  const rows = [];
  flight.addEventListener('frame', ({ detail }) => rows.push(detail));
  frames(0.5);
  assert.equal(rows[0].firstTick, 0);
  assert.ok(rows.every(({ count, rows: own, step }) => own.length === count * ROW.FLIGHT_ROW && step === 0.002));
  flight.freeze();
  const { time } = flight.state;
  frames(1);
  assert.equal(flight.state.time, time);
  flight.do('reference', 0.1, 0.1);
  flight.step();
  near(flight.state.time, time + 0.002, 1e-12);
  flight.step(50);
  near(flight.state.time, time + 0.102, 1e-12);
  flight.toggle();
  assert.equal(flight.state.mode, 'flying');
  frames(1);
  near(flight.state.time, time + 1.1, 0.02);
  flight.setSpeed(0.1);
  frames(1);
  near(flight.state.time, time + 1.2, 0.02);
  assert.deepEqual(told('did')[0], { tick: Math.round(time / 0.002), time, word: 'reference', values: [0.1, 0.1] });
  flight.end();
  assert.deepEqual([flight.state.mode, flight.do('hands', 1)], ['ended', false]);
  assert.equal(
    rows.reduce((sum, { count }) => sum + count, 0),
    flight.craft.tick,
  );
});

test('what a hand does has its voltage in the next tick', async () => {
  const { flight, frames } = page();
  await flight.start({ seed: 1 });
  frames(1);
  const rows = [];
  flight.addEventListener('frame', ({ detail }) => rows.push(detail));
  flight.do('hands', 1);
  flight.do('sticks', 3, -99);
  frames(1 / 60);
  const [{ rows: own }] = rows;
  assert.deepEqual([...own.slice(ROW.VOLTAGE, ROW.VOLTAGE + 2)], [3, -15]);
  assert.deepEqual([...own.slice(ROW.UNLIMITED, ROW.UNLIMITED + 2)], [3, -99]);
});

test('who hears of a frame may freeze it, or take it back: no more is flown then', async () => {
  const { flight, frames } = page();
  await flight.start({ seed: 1, plan: [0.5, 0.51].map((time) => ({ time, event: () => ['push', 0.1, 0] })) });
  let heard = 0;
  flight.addEventListener('did', () => heard++ === 0 && flight.freeze());
  frames(2);
  assert.deepEqual([flight.craft.tick, heard, flight.state.mode], [250, 1, 'frozen']);
  flight.addEventListener('frame', () => flight.state.time > 1 && flight.rewind(0.9));
  flight.go();
  frames(0.6);
  assert.ok(flight.state.time < 0.3, String(flight.state.time));
});

test('what a design’s preset says anyway no log repeats', () => {
  const design = designOf(PRESET);
  const { preset, scenario } = bodyOfFlight(design);
  assert.deepEqual(bodyOfFlight(design, [PRESET]), { preset, scenario });
  assert.deepEqual(bodyOfFlight({ ...design, theta0: 0.1, outer: 'none' }, [PRESET]), {
    ...{ preset, scenario, outer: 'none', operating_point: { theta: 0.1 } },
  });
});

test('a tab that was hidden pauses', async () => {
  const { flight, frames } = page();
  await flight.start({ seed: 4 });
  frames(1);
  const { time } = flight.state;
  flight.hold();
  frames.late(60_000);
  assert.equal(flight.state.time, time);
  frames(1);
  near(flight.state.time, time + 1, 0.002);
});

test('a slow machine slows time, and says so', async () => {
  let clock = 0;
  const { flight, frames, told } = page({ now: () => (clock += 9) });
  await flight.start({ seed: 1 });
  frames(4, 5);
  assert.ok(flight.state.slow < 0.7 && flight.state.slow > 0.05, String(flight.state.slow));
  assert.ok(told('change').length > 2);
  const { time } = flight.state;
  assert.ok(time > 0.1 && time < 3.5);
});

test('who draws twice in a second flies slowly, without a jump, and is told so', async () => {
  const { flight, frames } = page();
  await flight.start({ seed: 1 });
  frames(30, 2);
  near(flight.state.time, 14.75, 0.01); // a quarter of a second in each frame
  near(flight.state.slow, 0.5, 0.01);
  frames(1);
  assert.equal(flight.state.slow, 1);
});

test('what is rewound has not happened; what a task has in store comes again', async () => {
  const { flight, told, frames } = page();
  await flight.start({ seed: 2, plan: [{ time: 3.0001, event: (step) => ['gust', 0.1, 0, 0.2 / step] }] });
  frames(2);
  flight.do('reference', 0.2, 0);
  const then = flight.state.time;
  frames(2);
  flight.do('thrust', 0.5, 1);
  frames(1);
  assert.deepEqual(
    flight.log().events.map(([tick, word]) => [tick, word]),
    [
      [Math.round(then / 0.002), 'reference'],
      [1501, 'gust'],
      [Math.round(told('did').at(-1).time / 0.002), 'thrust'],
    ],
  );
  const before = flight.lastRows(60);
  flight.rewind(flight.state.time - 2.5);
  assert.deepEqual([told('cut')[0].tick, flight.state.mode], [1250, 'flying']);
  assert.equal(flight.craft.events.length, 1);
  frames(2);
  assert.deepEqual(
    flight.log().events.map(([, word]) => word),
    ['reference', 'gust'],
  );
  const after = flight.lastRows(60);
  const same = (to) => [...before.rows.slice(0, to * ROW.FLIGHT_ROW)];
  assert.deepEqual([...after.rows.slice(0, 1950 * ROW.FLIGHT_ROW)], same(1950)); // until the thrust was lost
  const again = await flownAgain(readLog(JSON.stringify(flight.log())), designs);
  assert.equal(again.apart, 0);
});

test('a task’s gust is as long as it shall be where ticks become longer as it begins', async () => {
  const { store, flight, frames } = page();
  await flight.start({ seed: 2, plan: [{ time: 1, event: (step) => ['gust', 0.1, 0, Math.round(0.2 / step)] }] });
  flight.step(500);
  store.edit((design) => ({ ...design, scenario: { ...design.scenario, digital: { sample_time: 0.001 } } }));
  flight.go();
  frames(0.1);
  const events = flight.log().events.map(([tick, word, , , ticks]) => [tick, word, ticks]);
  assert.deepEqual(events, [
    [500, 'design', undefined],
    [500, 'gust', 200],
  ]);
});

test('a task’s gust comes in time where ticks become longer right before it', async () => {
  const { store, flight, frames } = page();
  const { digital: _own, ...scenario } = designOf(PRESET).scenario;
  store.edit((design) => ({ ...design, scenario: { ...scenario, digital: { sample_time: 0.0001 } } }));
  await flight.start({ seed: 2, plan: [{ time: 0.105, event: (step) => ['gust', 0.1, 0, Math.round(0.2 / step)] }] });
  flight.step(1000);
  store.edit((design) => ({ ...design, scenario }));
  flight.go();
  frames(0.1);
  const events = flight.log().events.map(([tick, word, , , ticks]) => [tick, word, ticks]);
  assert.deepEqual(events, [
    [1000, 'design', undefined],
    [1003, 'gust', 100],
  ]);
});

test('the page’s design flies on as it changes: the newest, so many times in a second', async () => {
  const { store, flight, told, frames } = page();
  await flight.start({ seed: 1 });
  frames(0.5);
  for (let n = 0; n < 60; n++) {
    store.edit((design) => ({ ...design, poles: design.poles.map(({ re, im }) => ({ re: re * 0.995, im })) }));
    frames(1 / 60);
  }
  frames(0.1);
  const changes = told('takeover');
  assert.ok(changes.length >= 10 && changes.length <= 21, String(changes.length));
  assert.ok(changes.every(({ bumpless, jump }) => bumpless && Math.max(...jump.map(Math.abs)) < 1e-9));
  const flies = () => assert.deepEqual(flight.craft.aboard.body, bodyOfFlight(store.state.design, store.state.presets));
  flies();
  const { length } = flight.log().events;
  store.edit((design) => ({ ...design, scenario: { ...design.scenario, duration: 9 } }));
  frames(0.2);
  assert.equal(flight.log().events.length, length, 'an experiment’s duration is none of a flight’s');
  flight.rewind(0.8);
  frames(0.1);
  flies(); // the page’s own, after a rewind
});

test('a design that only the server knows comes when it answers; one that is refused does not', async () => {
  const answers = [];
  const ask = (body) => new Promise((go, refuse) => answers.push({ body, go, refuse }));
  const { store, flight, told, frames } = page({ ask });
  await flight.start({ seed: 1 });
  frames(0.2);
  store.edit((design) => ({ ...design, method: 'lqr' }));
  frames(0.1);
  assert.equal(answers[0].body.method, 'lqr');
  answers[0].refuse(new Error('Not so.'));
  await new Promise(setImmediate);
  assert.equal(flight.state.problem, 'Not so.');
  store.edit((design) => ({ ...design, weights: { states: { theta: 5 } } }));
  frames(0.1);
  answers[1].go(aboard(slowly(designOf(PRESET))).controller.numbers);
  await new Promise(setImmediate);
  frames(0.1);
  assert.equal(flight.state.problem, '');
  assert.equal(told('takeover').length, 1);
  assert.equal(flight.log().events.at(-1)[2].method, 'lqr');
  store.load(designOf(store.state.presets[1]));
  assert.deepEqual([flight.state.mode, flight.state.why], ['ended', 'Another rig was chosen.']);
});

test('a flight that is asked for and overtaken does not begin', async () => {
  const answers = [];
  const { store, flight } = page({ ask: () => new Promise((go) => answers.push(go)) });
  store.edit((design) => ({ ...design, method: 'lqr' }));
  const first = flight.start();
  flight.end();
  answers[0](aboard().controller.numbers);
  assert.equal(await first, false);
  assert.equal(flight.state.mode, 'idle');
});

test('an answer that comes late changes no flight but the one that asked', async () => {
  const answers = [];
  const { store, flight, told, frames } = page({ ask: () => new Promise((go) => answers.push(go)) });
  await flight.start({ seed: 1 });
  frames(0.3);
  flight.do('reference', 0.1, 0.2);
  frames(0.3);
  const log = flight.log();
  store.edit((design) => ({ ...design, method: 'lqr' }));
  frames(0.1);
  assert.equal(answers.length, 1);
  await flight.replay(log);
  frames(0.2);
  answers[0](aboard(slowly(designOf(PRESET))).controller.numbers);
  await new Promise(setImmediate);
  frames(2);
  assert.deepEqual([told('takeover').length, flight.craft.events], [0, log.events]);
  assert.deepEqual([flight.state.mode, flight.state.apart], ['ended', 0]);
});

test('a flight of another rig is neither taken back nor flown on', async () => {
  const { store, flight, frames } = page();
  await flight.start({ seed: 1 });
  frames(1);
  const [log, { time }] = [flight.log(), flight.state];
  assert.ok(flight.state.past);
  store.load(designOf(store.state.presets[1]));
  assert.deepEqual([flight.state.mode, flight.state.past], ['ended', false]);
  flight.rewind(0.5);
  assert.deepEqual([flight.state.mode, flight.state.time], ['ended', time]);
  store.load(designOf(PRESET));
  flight.rewind(0.5);
  assert.equal(flight.state.mode, 'frozen');
  assert.ok(await flight.replay(log));
  store.load(designOf(store.state.presets[1]));
  assert.deepEqual([flight.state.mode, flight.state.why], ['ended', 'Another rig was chosen.']);
});

test('what hides behind a good checksum is told: wrong states, a design that is none', async (context) => {
  context.mock.method(console, 'error', () => {});
  const { flight, frames } = page();
  await flight.start({ seed: 7 });
  frames(2);
  const { checksum: _own, ...log } = flight.log();
  log.checks[0][1] += 1e-6;
  const summed = (own) => ({ ...own, checksum: checksum(own) });
  assert.ok(await flight.replay(summed(log)));
  frames(3);
  assert.equal(flight.state.why, 'This was the whole flight, but not as its log has it.');
  const none = { ...log.design, poles: 7 };
  await assert.rejects(flight.replay(summed({ ...log, design: none })), /Nobody is there/, 'the server is asked');
  for (const part of [{ seed: 1.5 }, { seed: '1' }, { task: {} }, { checks: [[500, 0, 0, 0, '']] }])
    assert.throws(() => readLog(summed({ ...log, ...part })), /not sound/);
  const many = Array.from({ length: LOG.MOST_DESIGNS + 1 }, () => [1, 'design', log.design]);
  assert.throws(() => readLog(summed({ ...log, events: many })), /not sound/);
});

test('a task may begin with a design of its own, and follows the page’s from its next change on', async () => {
  const { store, flight, told, frames } = page();
  const own = { ...slowly(designOf(PRESET)), scenario: { reference: { theta: 0, psi: 0 }, duration: 1 } };
  await flight.start({ design: own, seed: 1 });
  frames(1);
  assert.deepEqual(flight.log().design.poles, [-6, -5, -4.625, -4.38]);
  assert.equal(told('takeover').length, 0);
  store.edit((design) => ({ ...design, outer: 'none' }));
  frames(0.2);
  assert.equal(told('takeover').length, 1);
});

test('a rig that is past flying ends the flight; a rewind picks it up', async () => {
  const { store, flight, told, frames } = page();
  const poles = [9, 8, 7, 6].map((re) => ({ re, im: 0 }));
  store.load({ ...designOf(PRESET), poles, limits: { theta: null } });
  await flight.start({ seed: 1 });
  flight.do('push', 5, 5);
  frames(120, 30);
  assert.equal(flight.state.mode, 'ended');
  assert.equal(flight.state.why, 'It has turned more than 150 times.');
  assert.deepEqual(told('end'), [{ why: flight.state.why }]);
  const again = await flownAgain(readLog(flight.log()), designs);
  assert.equal(again.craft.ended, flight.state.why);
  flight.rewind(1);
  assert.deepEqual([flight.state.mode, flight.craft.ended], ['frozen', '']);
});

test('the flight of a log is shown to its end, and can be sought in', async () => {
  const { store, flight, frames } = page();
  await flight.start({ seed: 7 });
  frames(1);
  flight.do('gust', 0.3, 0.3, 200);
  store.edit(slowly);
  frames(1.5);
  const log = flight.log();
  const shown = page();
  assert.ok(await shown.flight.replay(JSON.stringify(log)));
  assert.deepEqual([shown.flight.state.mode, shown.flight.state.replay], ['replaying', true]);
  assert.ok(!shown.flight.do('push', 1, 1));
  shown.frames(2);
  shown.store.edit((design) => ({ ...design, outer: 'none' })); // the page's own: not of this flight
  shown.flight.rewind(1.5);
  shown.flight.freeze();
  shown.flight.go();
  assert.equal(shown.flight.state.mode, 'replaying');
  shown.frames(3);
  assert.deepEqual([shown.flight.state.mode, shown.flight.state.apart], ['ended', 0]);
  assert.deepEqual(shown.flight.craft.check, flight.craft.check);
  assert.deepEqual(shown.flight.log(), log);
  assert.equal(shown.told('takeover').length, 2, 'one, and once more after the rewind');
});

test('a file that is no flight, or an edited one, is refused in words', async () => {
  const { flight, frames } = page();
  await flight.start({ seed: 7 });
  frames(1);
  const log = flight.log();
  for (const wrong of ['', '{', 'null', '[]', '{"flight":2}', null, 7])
    assert.throws(() => readLog(wrong), /no flight/);
  assert.throws(() => readLog({ ...log, ticks: log.ticks + 1 }), /damaged or edited/);
  await assert.rejects(flight.replay({ ...log, seed: 8 }), LogError);
  assert.equal(flight.state.mode, 'flying');
  readLog(JSON.stringify(log));
});

test('ten minutes are the most', async () => {
  const { flight, frames } = page();
  await flight.start({ seed: 1 });
  frames(1);
  flight.freeze();
  flight.craft.fly(Math.round((599.9 - flight.craft.time) / flight.craft.step));
  flight.go();
  frames(1);
  assert.deepEqual([flight.state.mode, flight.state.why], ['ended', 'A flight lasts ten minutes at most.']);
  near(flight.state.time, 600, 1e-6);
  assert.ok(flight.log().ticks <= LOG.MOST_TICKS && flight.craft.u[INPUT.THRUST] === 1);
});
