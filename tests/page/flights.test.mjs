// A flight in hand: the craft, its clock and its course. tests/app/test_page_flights.py has numbers against the core's.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Clock, GAP_MS } from '../../static/flight/clock.js';
import { Course, KEPT } from '../../static/flight/course.js';
import { Craft } from '../../static/flight/craft.js';
import { ROW } from '../../static/kernel/index.js';
import { designOf } from '../../static/model/index.js';
import { aboard, flights, PRESET, sampled, slowly } from './flight_pages.mjs';

const near = (a, b, by) => assert.ok(Math.abs(a - b) <= by, `${a} is not within ${by} of ${b}`);

test('of a long gap no more than its most is time of the flight, and slow motion goes on from where it is', () => {
  const clock = new Clock();
  clock.due(0, 0);
  near(clock.due(GAP_MS, 0), GAP_MS / 1000, 1e-12);
  near(clock.due(3 * GAP_MS, 0.25), 0.25 + GAP_MS / 1000, 1e-12);
  assert.ok(clock.paced(1) && clock.slow === 0.95);
  clock.due(3 * GAP_MS, 0.5);
  for (let n = 0; n < 60; n++) clock.paced(n < 59 ? 1 : 0.98);
  assert.ok(clock.slow < 1, 'as long as something was left out');
  near(clock.due(3 * GAP_MS + 100, 0.5), 0.6, 1e-12);
  clock.speed = 0.1;
  clock.hold();
  assert.equal(clock.slow, 1);
  near(clock.due(9 * GAP_MS, 0.35), 0.35, 1e-12); // held
  near(clock.due(9 * GAP_MS + 100, 0.35), 0.36, 1e-12);
});

test('a rig stands at rest, goes where it is asked, and takes no notice of how its ticks are dealt', () => {
  const [one, other] = [new Craft(flights, aboard()), new Craft(flights, aboard())];
  assert.deepEqual([one.theta, one.psi, ...one.rates], [0, 0, 0, 0]);
  for (const craft of [one, other]) craft.do('reference', 0.1, 0.3);
  const rows = one.fly(3000).slice();
  const parts = [1, 2, 997, 500, 1500].map((ticks) => other.fly(ticks).slice());
  assert.deepEqual(rows, Float64Array.from(parts.flatMap((part) => [...part])));
  assert.deepEqual(one.check, other.check);
  assert.deepEqual(one.checks, other.checks);
  near(one.theta, 0.1, 1e-3);
  near(one.psi, 0.3, 1e-3);
  near(one.time, 6, 1e-9);
  assert.deepEqual(
    one.checks.map(([tick]) => tick),
    [500, 1000, 1500, 2000, 2500],
  );
});

test('set points that turn go on from where they are, also where ticks become longer', () => {
  const craft = new Craft(flights, aboard());
  craft.do('turn', 0.1, -0.2);
  craft.fly(500);
  near(craft.reference[0], 0.1 + PRESET.scenario.reference.theta, 1e-12);
  const before = craft.reference;
  craft.change(aboard(sampled(0.001)));
  craft.settle();
  assert.equal(craft.step, 0.001);
  near(craft.reference[0], before[0], 1e-12);
  craft.fly(1000);
  near(craft.reference[1], before[1] - 0.2, 1e-12);
  near(craft.time, 2, 1e-12);
});

test('from a snapshot it flies as it did, and knows no more than it did', () => {
  const craft = new Craft(flights, aboard({ scenario: { ...designOf(PRESET).scenario, digital: { delay: true } } }), 9);
  craft.do('reference', 0.2, 0.1);
  craft.fly(321);
  craft.change(aboard(slowly(designOf(PRESET))));
  const then = craft.snapshot();
  const course = () => {
    craft.do('push', 0.1, 0);
    craft.fly(200);
    craft.do('push', 0, 0);
    return [...craft.fly(400)];
  };
  const first = course();
  craft.restore(then);
  assert.deepEqual([craft.tick, craft.events.length, craft.takeovers.length], [321, 2, 0]);
  assert.ok(craft.waiting);
  assert.deepEqual(course(), first);
});

test('another design takes over at the next sample, without a jump', () => {
  const craft = new Craft(flights, aboard(sampled(0.01)));
  assert.equal(craft.ticksPerSample, 5);
  craft.do('reference', 0.1, 0.2);
  craft.fly(52);
  craft.change(aboard({ ...sampled(0.01), ...slowly(designOf(PRESET)) }));
  const rows = craft.fly(20);
  const [{ tick, jump, jumpWithout, bumpless }] = craft.takeovers;
  assert.deepEqual([tick, bumpless], [55, true]);
  assert.ok(Math.max(...jump.map(Math.abs)) <= 1e-9 && Math.max(...jumpWithout.map(Math.abs)) > 0.1);
  assert.equal(rows.length, 20 * ROW.FLIGHT_ROW);
});

test('hands off while a design waits: it is the new one that takes over', () => {
  const craft = new Craft(flights, aboard(sampled(0.01)));
  craft.do('hands', 1);
  craft.do('sticks', 7, 1);
  craft.fly(3);
  const next = aboard({ ...sampled(0.01), ...slowly(designOf(PRESET)) });
  craft.change(next);
  craft.do('hands', 0);
  craft.fly(10);
  assert.equal(craft.aboard, next);
  assert.equal(craft.takeovers.length, 1);
});

test('what is no event is refused before it stands in the log', () => {
  const craft = new Craft(flights, aboard());
  for (const wrong of [
    ['refer', 1, 1],
    ['reference', 1],
    ['reference', NaN, 0],
    ['hands', 2],
    ['toString', 1],
  ])
    assert.throws(() => craft.do(...wrong), RangeError);
  craft.do('push', -0, 0.1);
  assert.ok(Object.is(craft.events[0][2], 0), 'JSON has no −0');
  assert.equal(craft.events.length, 1);
});

test('a course keeps a minute, thins fast ticks, and forgets what was taken back', () => {
  const course = new Course();
  assert.deepEqual([course.last(5).count, course.last(5).step], [0, 0]);
  const rows = (count, from) =>
    Float64Array.from({ length: count * ROW.FLIGHT_ROW }, (_, i) =>
      i % ROW.FLIGHT_ROW ? 0 : from + i / ROW.FLIGHT_ROW,
    );
  for (let tick = 0; tick < 50_000; tick += 500) course.put(rows(500, tick), 0.002, tick, tick * 0.002);
  const all = course.last(1000);
  assert.ok(all.count * all.step >= 60 && all.count * all.step <= KEPT + 3);
  assert.equal(all.rows.at(-ROW.FLIGHT_ROW), 49_999);
  course.cut(45_000);
  const last = course.last(1);
  assert.deepEqual([last.count, last.firstTick, last.time.toFixed(3)], [501, 44_499, '88.998']);
  course.put(rows(1000, 45_000), 0.0001, 45_000, 90);
  const after = course.last(0.0985);
  assert.deepEqual([after.step.toFixed(4), after.count], ['0.0010', 99]);
  near(after.times[1] - after.times[0], 0.001, 1e-12);
});
