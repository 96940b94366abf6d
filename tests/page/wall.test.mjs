// The instructor's wall: what follows of a class, events as they arrive, the connection, addresses and what is kept.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { hashOf, isOwnMachine, placeOf, readKept, secretLink, spoken, studentsPage } from '../../static/wall/kept.js';
import { window as planeWindow } from '../../static/wall/plane.js';
import {
  changed,
  crowd,
  heldUp,
  marksIn,
  needOf,
  nextToMark,
  ordered,
  standings,
  toMark,
} from '../../static/wall/state.js';
import { EventReader, Feed } from '../../static/wall/stream.js';
import { agoText, pointsText, shareOf } from '../../static/wall/words.js';

const STEPS = [
  { name: 'a', title: 'A', points: 4, goals: [{ name: 'g', label: 'g' }], questions: [] },
  {
    name: 'b',
    title: 'B',
    points: 6,
    goals: [
      { name: 'h', label: 'h' },
      { name: 'i', label: 'i' },
    ],
    questions: [],
  },
];
const done = (goals, attempts = 1, more = {}) => ({ points: 0, of: 0, goals, attempts, ...more });
const student = (id, step, steps = {}, more = {}) => ({
  id,
  number: id,
  name: `N${id}`,
  step,
  points: 0,
  of: 10,
  online: true,
  steps,
  ...more,
});
const room = (...students) => ({ code: 'ABCDEFG', title: 'T', open: true, steps: STEPS, students });

test('a change replaces students whole, adds new ones, drops those that are gone, and keeps the rest', () => {
  const before = room(student(1, 'a'), student(2, 'a'));
  const after = changed(before, { version: 3, open: false, students: [student(2, 'b'), student(3, 'a')], gone: [1] });
  assert.deepEqual(
    after.students.map(({ id, step }) => [id, step]),
    [
      [2, 'b'],
      [3, 'a'],
    ],
  );
  assert.equal(after.open, false);
  assert.equal(after.title, 'T');
  assert.equal(before.students.length, 2, 'what was there is left alone');
  assert.equal(changed(after, { closes: null }).closes, null);
});

test('a goal is met, tried or open; what nobody has judged as met is not met', () => {
  const of = (steps) => marksIn(student(1, 'b', steps), STEPS[1]);
  assert.deepEqual(of({}), ['open', 'open']);
  assert.deepEqual(of({ b: done([], 0) }), ['open', 'open']);
  assert.deepEqual(of({ b: done([true, false]) }), ['met', 'missed']);
  assert.deepEqual(of({ b: done([null]) }), ['missed', 'missed']);
  assert.deepEqual(marksIn({ steps: JSON.parse('{"__proto__": null}') }, { ...STEPS[0], name: 'toString' }), ['open']);
});

test('who needs help: tries in the step where one is, as long as not all of its goals are met', () => {
  assert.equal(needOf(student(1, 'b', { b: done([true, false], 5) }), STEPS), 5);
  assert.equal(needOf(student(1, 'b', { b: done([true, true], 5) }), STEPS), 0);
  assert.equal(needOf(student(1, 'b', { a: done([false], 9) }), STEPS), 0, 'another step is another matter');
  assert.equal(needOf(student(1, undefined), STEPS), 0);
});

test('the order: as they joined, by name whatever its accents, by points, by need; ties as they joined', () => {
  const all = room(
    student(3, 'b', { b: done([false, false], 2) }, { name: 'émile', points: 5 }),
    student(1, 'b', { b: done([true, false], 4) }, { name: 'Zoë', points: 7 }),
    student(2, 'a', {}, { name: 'Eva', points: 5 }),
  );
  const ids = (...how) => ordered(all, ...how).map(({ id }) => id);
  assert.deepEqual(ids('joined'), [1, 2, 3]);
  assert.deepEqual(ids('name'), [3, 2, 1]);
  assert.deepEqual(ids('points'), [1, 2, 3]);
  assert.deepEqual(ids('help'), [1, 3, 2]);
  assert.deepEqual(ids('joined', ' EMI'), [3]);
  assert.deepEqual(ids('joined', 'zoe'), [1]);
  assert.deepEqual(ids('joined', '2'), [2], 'the number of the projector’s wall');
  assert.deepEqual(ids('joined', 'nobody'), []);
});

test('what holds the class up: the goal that most of those who are there have tried in vain', () => {
  const all = standings(
    room(
      student(1, 'b', { a: done([true]), b: done([true, false]) }),
      student(2, 'b', { a: done([true]), b: done([false, false]) }),
      student(3, 'b', { a: done([false]) }),
      student(4, 'a', { a: done([false]) }),
    ),
  );
  assert.deepEqual(
    all.map(({ tried, met, stuck }) => [tried, met, stuck]),
    [
      [4, 2, 1],
      [2, 1, 1],
      [2, 0, 2],
    ],
  );
  assert.equal(heldUp(all).label, 'i');
  assert.equal(heldUp(standings(room(student(1, 'b', { a: done([false]) })))), null, 'who has gone on is not held up');
  assert.equal(heldUp(standings(room())), null);
  assert.deepEqual(crowd(room(student(1, 'b'), student(2, 'b'), student(3, undefined))), [0, 2]);
});

test('the next answer to mark is the one after whom one looks at, and after the last the first', () => {
  const waiting = { b: done([true, true], 1, { to_mark: 2 }) };
  const all = room(student(1, 'b', waiting), student(2, 'b'), student(3, 'a', waiting));
  assert.equal(toMark(all.students[0]), 2);
  assert.deepEqual(nextToMark(all), { id: 1, step: 'b' });
  assert.deepEqual(nextToMark(all, 1), { id: 3, step: 'b' });
  assert.deepEqual(nextToMark(all, 3), { id: 1, step: 'b' });
  assert.equal(nextToMark(room(student(2, 'b'))), null);
});

test('events are read however the text is cut', () => {
  const text = ': hello\n\nevent: class\ndata: {"a":1}\ndata: 2\n\nid: 7\ndata:x\r\n\r\nevent: empty\n\ndata: y\r\r';
  const whole = [
    { event: 'class', data: '{"a":1}\n2' },
    { event: 'message', data: 'x' },
    { event: 'message', data: 'y' },
  ];
  for (const size of [1, 2, 3, 7, 1000]) {
    const reader = new EventReader();
    const found = [];
    for (let i = 0; i < text.length; i += size) found.push(...reader.read(text.slice(i, i + size)));
    found.push(...reader.read('\n'));
    assert.deepEqual(found, whole, `in parts of ${size}`);
  }
});

/** A feed whose connections and waits the test holds in its hands. */
function fed({ refused = () => false } = {}) {
  const told = { events: [], status: [], waits: [], opened: [] };
  const feed = new Feed({
    open: (signal) =>
      new Promise((good, bad) => {
        signal.addEventListener('abort', () => bad(signal.reason));
        told.opened.push({ good, bad, signal });
      }),
    onEvent: (event) => told.events.push(event),
    onStatus: (connected) => told.status.push(connected),
    onRefused: refused,
    later: (act, ms) => {
      told.waits.push({ act, ms });
      return 0;
    },
  });
  return { feed, told };
}
const turn = () => new Promise((done) => setImmediate(done));
/** An answer whose body the test writes. */
function streamed() {
  let control;
  const body = new ReadableStream({ start: (c) => (control = c) });
  const write = (text) => control.enqueue(new TextEncoder().encode(text));
  return { response: new Response(body), write, close: () => control.close(), fail: () => control.error(new Error()) };
}
/** The wait for another try, among those for silence. */
const retry = (told) => told.waits.findLast(({ ms }) => ms < 20_000);

test('a connection that breaks is made again, and says so', async () => {
  const { feed, told } = fed();
  feed.start();
  const first = streamed();
  told.opened[0].good(first.response);
  await turn();
  first.write('event: class\ndata: {}\n\nevent: change\nda');
  await turn();
  assert.deepEqual(told.events, [{ event: 'class', data: '{}' }]);
  first.fail();
  await turn();
  assert.deepEqual(told.status, [true, false]);
  retry(told).act();
  assert.equal(told.opened.length, 2);
  const second = streamed();
  told.opened[1].good(second.response);
  await turn();
  second.write('data: new\n\n');
  await turn();
  assert.deepEqual(
    told.events.at(-1),
    { event: 'message', data: 'new' },
    'what was cut off is not glued to what is new',
  );
  feed.start();
  assert.equal(told.opened.length, 2, 'one connection at a time');
  feed.stop();
});

test('a connection that falls silent is none any more; each sign of life begins the time anew', async () => {
  const { feed, told } = fed();
  feed.start();
  const first = streamed();
  told.opened[0].good(first.response);
  await turn();
  const before = told.waits.length;
  first.write(': still here\n\n');
  await turn();
  assert.equal(told.waits.length, before + 1);
  told.waits.at(-1).act();
  assert.equal(told.opened[0].signal.aborted, true);
  feed.stop();
});

test('a final refusal ends it; others are tried again, ever later', async () => {
  const final = fed({ refused: () => true });
  final.feed.start();
  final.told.opened[0].bad(new Error('gone'));
  await turn();
  assert.equal(retry(final.told), undefined);
  final.feed.start();
  assert.equal(final.told.opened.length, 1);

  const { feed, told } = fed();
  feed.start();
  for (let k = 0; k < 8; k++) {
    told.opened.at(-1).bad(new Error('away'));
    await turn();
    retry(told).act();
  }
  const waits = told.waits.filter(({ ms }) => ms < 20_000).map(({ ms }) => ms);
  assert.ok(waits[0] < 1_500 && waits.at(-1) > 10_000 && waits.at(-1) < 20_000, String(waits));
  feed.stop();
});

test('an address leads to a class, its projector’s wall or its join sheet; a secret is taken out of it', () => {
  assert.deepEqual(placeOf(''), { kind: 'new' });
  assert.deepEqual(placeOf('#content'), { kind: 'new' });
  assert.deepEqual(placeOf('#class=no!'), { kind: 'new' });
  assert.deepEqual(placeOf('#class=abcdefg&key=a%2Bb'), { kind: 'wall', code: 'ABCDEFG', key: 'a+b' });
  assert.deepEqual(placeOf('#class=ABCDEFG&view=join'), { kind: 'join', code: 'ABCDEFG' });
  for (const place of [{ kind: 'new' }, { kind: 'projector', code: 'ABCDEFG' }, { kind: 'wall', code: 'ABCDEFG' }])
    assert.deepEqual(placeOf(hashOf(place)), place);
  assert.equal(hashOf({ kind: 'wall', code: 'ABCDEFG', key: 'secret' }), '#class=ABCDEFG');
  const link = secretLink('https://lab.example/heli/class?lang=en#class=OLD', { code: 'ABCDEFG', key: 'a+b&c' });
  assert.equal(placeOf(new URL(link).hash).key, 'a+b&c');
  assert.equal(studentsPage('https://lab.example/heli/class?x#y'), 'https://lab.example/heli/');
  assert.equal(studentsPage('https://lab.example/heli/class', '#class=A'), 'https://lab.example/heli/#class=A');
  assert.equal(spoken('http://heli.lab:8000/'), 'heli.lab:8000');
  assert.deepEqual(
    ['http://localhost:8000/class', 'http://127.0.0.1/class', 'http://10.0.0.7/class'].map(isOwnMachine),
    [true, true, false],
  );
});

test('what a browser kept is read as far as it is what was kept', () => {
  const one = { code: 'ABCDEFG', key: 'k', title: 'T', ends: '2027' };
  assert.deepEqual(readKept(JSON.stringify([one, { code: 'x' }, null, { ...one, key: '' }])), [one]);
  for (const text of [null, '', '{', '{}', '7']) assert.deepEqual(readKept(text), []);
});

test('the plane shows most poles with one scale; an unstable one is seen, one far out leaves the rest large', () => {
  const usual = Array.from({ length: 40 }, (_, k) => ({ re: -3 - k / 10, im: k % 2 ? 2 : -2 }));
  const view = planeWindow(usual);
  for (const p of usual) assert.ok(p.re > view.left && p.re < view.right && Math.abs(p.im) < view.top);
  const far = planeWindow([...usual, { re: -90_000, im: 0 }]);
  assert.ok(far.left > -20, String(far.left));
  const unstable = planeWindow([...usual, { re: 2, im: 0 }]);
  assert.ok(unstable.right > 2);
  for (const of of [[], [{ re: 0, im: 0 }], [{ re: -1e-9, im: 0 }]]) {
    const { left, right, top, scale } = planeWindow(of);
    assert.ok(left < 0 && right > 0 && top > 0 && Number.isFinite(scale));
  }
});

test('shares in per cent, points without needless digits, times in the unit that says something', () => {
  assert.equal(shareOf(2, 3), '67 %');
  assert.equal(shareOf(0, 0), '–');
  assert.deepEqual([3, 2.5, 2.25].map(pointsText), ['3', '2.5', '2.25']);
  const now = Date.parse('2027-01-01T12:00:00Z');
  const ago = (minutes) => agoText(new Date(now - 60_000 * minutes).toISOString(), now);
  assert.deepEqual([-5, 0.5, 7, 150, 60 * 24 * 3].map(ago), [
    'just now',
    'just now',
    '7 min ago',
    '2 h ago',
    '3 days ago',
  ]);
  assert.equal(agoText(null, now), '–');
});
