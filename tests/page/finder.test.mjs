// View Find: a design that is only looked at is no edit, what is asked for, what was found.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { beforeEach, test } from 'node:test';

import { Candidates } from '../../static/finder/candidates.js';
import { FindFeed } from '../../static/finder/feed.js';
import { Preview } from '../../static/finder/preview.js';
import {
  begun,
  brushed,
  firstAxes,
  limitsOn,
  nearest,
  pointsOf,
  soFarOn,
  stepped,
} from '../../static/finder/scatter_math.js';
import * as settings from '../../static/finder/settings.js';
import { linkOf, readLink } from '../../static/link/permalink.js';
import { bodyOf, designOf, initialState, Store } from '../../static/model/index.js';
import { PRESETS } from './presets.mjs';

const FOUND = JSON.parse(readFileSync(new URL('fixtures/find_reply.json', import.meta.url), 'utf8'));
const METHODS = [{ name: 'full-rank' }, { name: 'lqr' }];
const known = { presets: PRESETS, methods: METHODS };
const replyOf = (name) => ({ name, stable: true });
const moved = (design, re) => ({ ...design, poles: [{ re, im: 0 }, ...design.poles.slice(1)] });
const settle = () => new Promise((done) => setImmediate(done));

/** @type {Store} */ let store;
let own, edits, asked, answers;
beforeEach(() => {
  store = new Store();
  store.set({ ...known, view: 'find' });
  store.load(designOf(PRESETS[0]));
  own = store.state.design;
  store.set({ reply: replyOf('own'), answered: own, heard: own });
  edits = 0;
  store.addEventListener('design', () => (edits += 1));
  asked = [];
  answers = [];
});
/** A preview whose numbers are the server's alone; each answer comes when it is told to. */
const overServer = () =>
  new Preview(store, () => null, {
    ask(body) {
      asked.push(body.poles[0].re);
      return new Promise((answer, refuse) => answers.push({ answer, refuse }));
    },
  });
const shownPole = () => store.shown.design.poles[0].re;

test('a design that is looked at is no edit: nothing is asked, kept or written of it', () => {
  const preview = new Preview(store, (design) => replyOf(`computed ${design.poles[0].re}`));
  const [before, link, step] = [store.state, linkOf(store.state, known), store.step];
  const other = moved(own, -3);
  preview.show(other);
  assert.equal(store.shown.design, other);
  assert.equal(store.shown.answered, other);
  assert.equal(store.shown.reply.name, 'computed -3');
  assert.equal(store.shown.heard, own, 'words are of the present design, and faint');
  assert.equal(store.state.design, own);
  assert.equal(store.state.reply, before.reply);
  assert.equal(linkOf(store.state, known), link);
  assert.deepEqual([edits, store.step, store.state.canUndo], [0, step, false]);
  preview.end();
  assert.equal(store.shown, store.state);
  assert.equal(store.shown.reply.name, 'own');
});

test('the state as it is drawn is one object until something changes', () => {
  new Preview(store, () => replyOf('computed')).show(moved(own, -3));
  assert.equal(store.shown, store.shown);
});

test('poles and numbers are of one design: until its numbers are there, the present one is shown', async () => {
  const preview = overServer();
  preview.show(moved(own, -3));
  assert.equal(shownPole(), own.poles[0].re);
  answers[0].answer(replyOf('server'));
  await settle();
  assert.equal(shownPole(), -3);
  assert.equal(store.shown.heard, store.shown.design, 'the words are of this one');
});

test('an answer that comes late never wins, and is there when one looks again', async () => {
  const preview = overServer();
  const [a, b, c] = [-3, -4, -5].map((re) => moved(own, re));
  preview.show(a);
  preview.show(b);
  preview.show(c);
  assert.deepEqual(asked, [-3], 'one at a time');
  answers[0].answer(replyOf('a'));
  await settle();
  assert.equal(shownPole(), own.poles[0].re, 'c is looked at, and has no numbers yet');
  assert.deepEqual(asked, [-3, -5], 'b was passed over');
  preview.end();
  answers[1].answer(replyOf('c'));
  await settle();
  assert.equal(store.state.preview, null);
  assert.equal(store.shown.reply.name, 'own');
  preview.show(c);
  assert.deepEqual([shownPole(), store.shown.reply.name, asked.length], [-5, 'c', 2]);
});

test('a refusal leaves the present design in sight, and the next one is asked for', async () => {
  const preview = overServer();
  preview.show(moved(own, -3));
  answers[0].refuse(new Error('away'));
  await settle();
  assert.equal(shownPole(), own.poles[0].re);
  preview.show(moved(own, -4));
  assert.deepEqual(asked, [-3, -4]);
});

test('the server’s answer for the present design comes while another is looked at', () => {
  const preview = new Preview(store, () => replyOf('computed'));
  preview.show(moved(own, -3));
  store.set({ reply: replyOf('newer'), answered: own, heard: own, problem: null });
  assert.equal(store.shown.reply.name, 'computed');
  preview.end();
  assert.equal(store.shown.reply.name, 'newer');
});

for (const [what, act] of Object.entries({
  'an edit': () => store.edit((d) => moved(d, -7)),
  'another view': () => store.set({ view: 'design' }),
  undo: () => store.undo(),
  'a link': () => store.restore(moved(own, -8)),
}))
  test(`${what} ends it`, () => {
    store.edit((d) => moved(d, -6));
    new Preview(store, () => replyOf('computed')).show(moved(own, -3));
    act();
    assert.equal(store.state.preview, null);
    assert.notEqual(shownPole(), -3);
  });

test('what is set meanwhile leaves it', () => {
  new Preview(store, () => replyOf('computed')).show(moved(own, -3));
  store.set({ connection: 'open', view: 'find' });
  assert.equal(shownPole(), -3);
});

test('taking it is one step of undo, and what was seen stays in sight', () => {
  const preview = new Preview(store, () => replyOf('computed'));
  const other = moved(own, -3);
  preview.show(other);
  preview.take(other);
  assert.equal(store.state.design, other);
  assert.equal(edits, 1);
  assert.deepEqual([store.shown.reply.name, store.shown.answered], ['computed', other]);
  store.undo();
  assert.equal(store.state.design, own);
  assert.equal(store.state.canUndo, false);
});

const candidates = () => {
  const of = new Candidates(FOUND, own);
  assert.equal(of.follow(store.state), true);
  return of;
};

test('what was found stands over the design that the search began with', () => {
  const of = candidates();
  const design = of.design(1, store.state);
  const [first] = FOUND.designs[1].design.poles;
  assert.deepEqual(design.poles[0], first);
  assert.equal(design.loops.yaw.ti, FOUND.designs[1].design.loops.yaw.ti);
  assert.deepEqual({ ...bodyOf(design), poles: 0, loops: 0 }, { ...bodyOf(own), poles: 0, loops: 0 });
  assert.equal(design.scenario, own.scenario);
  assert.equal(of.design(1, store.state), design, 'one object, known again after undo');
  assert.deepEqual([of.indexOf(design), of.indexOf(own)], [1, -1]);
});

test('it stays what it is while one of the others is the present design', () => {
  const of = candidates();
  const design = of.design(2, store.state);
  store.edit(() => of.design(1, store.state));
  assert.equal(of.follow(store.state), true);
  assert.equal(of.design(2, store.state), design);
});

test('over another rig it is put onto that, and its figures are told to be of before', () => {
  const of = candidates();
  of.design(1, store.state);
  store.edit((d) => ({ ...d, theta0: 0.1 }));
  assert.equal(of.follow(store.state), false);
  assert.equal(of.design(1, store.state).theta0, 0.1);
  store.undo();
  assert.equal(of.follow(store.state), true);
});

test('what is locked is not found otherwise', () => {
  store.set({ locks: ['poles'] });
  const of = candidates();
  const design = of.design(1, store.state);
  assert.deepEqual(design.poles, own.poles);
  assert.equal(design.loops.yaw.ti, FOUND.designs[1].design.loops.yaw.ti);
  const free = settings.freeOf(store.state);
  assert.deepEqual(
    free.filter(({ locked }) => locked).map(({ name }) => name),
    ['poles'],
  );
});

test('a lab’s step says what is free all the same; of what is free in part nothing is searched', () => {
  const freed = (keys) => {
    store.set({ locks: ['poles', 'loops', 'method'], task: { free: [{ name: '', keys, controls: '' }], hidden: [] } });
    return settings.freeOf(store.state).flatMap(({ name, locked }) => (locked ? [] : [name]));
  };
  assert.deepEqual(freed(['loops']), ['loops']);
  assert.deepEqual(freed(['loops.yaw', 'pairing']), ['pairing']);
});

const ASKED = {
  rows: [
    settings.rowOf('settling_time', { where: 'theta', limit: 0.8, share: 0.95, better: true }),
    settings.rowOf('V_peak', { where: 'V_p', model: 'linear', steps: 'together', limit: 20 }),
    settings.rowOf('disk_margin', { limit: 0.5 }),
    settings.rowOf('share_stable', { limit: 0.99 }),
  ],
  free: ['poles', 'loops'],
  spread: 0.1,
  designs: 5000,
  seed: 3,
};

test('what is asked for goes into a link and comes back', () => {
  assert.deepEqual(settings.settingsIn(settings.linkText(ASKED)), ASKED);
  const link = linkOf({ ...store.state, find: settings.linkText(ASKED) }, known);
  assert.match(link, /&find=settling_time:theta:max:0.8:share:0.95:better::V_peak/, 'nothing is escaped');
  assert.equal(readLink(link, known).shown.find, settings.linkText(ASKED));
  assert.equal(readLink('#v1', known).shown.find, null);
});

test('what a link cannot ask for is left out', () => {
  assert.deepEqual(settings.settingsIn('nonsense:max:1::free:poles,toString::spread:9::designs:7::seed:-1'), {
    rows: [],
    free: ['poles'],
    spread: 0,
    designs: 20000,
    seed: 0,
  });
  const [row] = settings.settingsIn('overshoot:max:many:elsewhere').rows;
  assert.deepEqual(row, settings.rowOf('overshoot'));
});

test('the server is asked for rows with a limit, and to better those that wish it', () => {
  const asked = settings.askedOf(ASKED, ['poles'], ['J_p', 'tau_p']);
  assert.deepEqual(asked, {
    free: ['poles'],
    require: {
      settling_time: [{ max: 0.8, share: 0.95, axis: 'theta', model: 'nonlinear' }],
      V_peak: [{ max: 20, axis: 'both', motor: 'V_p', model: 'linear', steps: 'together' }],
      disk_margin: [{ min: 0.5 }],
      share_stable: [{ min: 0.99 }],
    },
    minimize: [{ measure: 'settling_time', axis: 'theta', model: 'nonlinear' }],
    uncertainty: { spread: { J_p: 0.1, tau_p: 0.1 } },
    designs: 5000,
    seconds: 10,
    seed: 3,
  });
  const certain = settings.askedOf({ ...ASKED, spread: 0 }, ['poles'], ['J_p']);
  assert.deepEqual(Object.keys(certain.require), ['settling_time', 'V_peak', 'disk_margin']);
  assert.equal(certain.uncertainty, undefined);
  assert.equal(certain.require.settling_time[0].share, undefined);
});

test('what cannot be asked is said', () => {
  const asked = settings.askedOf(ASKED, [], []);
  assert.match(settings.objectionTo(asked), /Nothing is free/);
  assert.match(settings.objectionTo({ ...asked, free: ['poles'], require: {}, minimize: [] }), /Nothing is asked/);
  assert.equal(settings.objectionTo({ ...asked, free: ['poles'] }), '');
});

test('limits are read in the units of the page', () => {
  for (const [measure, value, shown, unit] of [
    ['settling_time', 0.8, 0.8, 's'],
    ['coupling_peak', Math.PI / 180, 1, '°'],
    ['gain_margin', 10 ** 0.3, 6, 'dB'],
    ['saturated', 0.05, 5, '%'],
    ['share_stable', 0.95, 95, '%'],
    ['iae', Math.PI / 180, 1, '°s'],
    ['V_peak', 20, 20, 'V'],
  ]) {
    assert.ok(Math.abs(settings.shownValue(measure, value) - shown) < 1e-9, measure);
    assert.ok(Math.abs(settings.valueOfShown(measure, shown) - value) < 1e-9, measure);
    assert.equal(settings.unitOf(measure), unit);
  }
});

test('what is proposed are the requirements of the s-plane', () => {
  const { rows } = settings.proposed({
    ...initialState(),
    requirements: { settling: 1.2, overshoot: null, lag: 0.16 },
  });
  const limits = Object.fromEntries(rows.map(({ measure, limit }) => [measure, limit]));
  assert.deepEqual(limits, { settling_time: 1.2, overshoot: 10, V_peak: null, disk_margin: 0.4, lag_margin: 0.16 });
});

test('two figures as points; the nearest; those within the brushed ranges; the next along x', () => {
  const { x, y } = firstAxes(FOUND);
  assert.deepEqual([FOUND.figures[x].measure, FOUND.figures[y].measure], ['settling_time', 'V_peak']);
  const points = pointsOf(FOUND, x, y);
  assert.equal(points.length, FOUND.designs.length);
  assert.equal(nearest(points, points[3].x, points[3].y), points[3].index);
  assert.equal(nearest(points, 1e4, 1e4), -1);
  const few = brushed(FOUND, new Map([[x, [0, points[2].x]]]));
  assert.deepEqual([...few], [0, 1, 2]);
  assert.deepEqual(brushed(FOUND, new Map()).size, FOUND.designs.length);
  assert.equal(stepped(points, few, -1, 1), 0);
  assert.equal(stepped(points, few, 1, 1), 2);
  assert.equal(stepped(points, few, 2, 1), 2, 'the last that the brush keeps');
  assert.equal(stepped(points, few, 2, -Infinity), 0);
  assert.equal(stepped(points, few, -1, Infinity), 2);
  assert.equal(stepped(points, few, -1, -1), 2);
  assert.equal(stepped(points, new Set(), 2, 1), -1);
});

test('a design that has one of the figures not is no point', () => {
  const [first, ...rest] = FOUND.designs;
  const figures = [{ text: 'not settled' }, ...first.figures.slice(1)];
  const found = { ...FOUND, designs: [{ ...first, figures }, ...rest] };
  assert.deepEqual(
    pointsOf(found, 0, 1).map(({ index }) => index),
    rest.map((_, i) => i + 1),
  );
});

test('limits stand in the units of the axes', () => {
  const share = { figure: 2, max: 0.1, limit: '≤ 10 %', words: '' };
  const found = { ...FOUND, figures: [...FOUND.figures.slice(0, 2), { ...FOUND.figures[2], measure: 'saturated' }] };
  assert.deepEqual(limitsOn({ ...found, requirements: [share] }, 2), [{ at: 10, most: true, limit: '≤ 10 %' }]);
});

test('the front so far lies where its designs will, in whichever figures the search makes better', () => {
  const peak = { measure: 'V_peak', axis: 'both', model: 'nonlinear', title: '' };
  const error = { measure: 'steady_state_error', title: '' };
  const soFar = {
    figures: [{ measure: 'settling_time', title: '' }, peak, error],
    points: [[0.7, 12, -Math.PI / 180], [0.9, 10, 0]], // prettier-ignore
  };
  const settled = [{ x: 0.7, y: 12 }, { x: 0.9, y: 10 }]; // prettier-ignore
  const { x, y } = firstAxes(FOUND);
  assert.deepEqual(soFarOn(FOUND, x, y, soFar), settled, 'the same response, whether it is said or not');
  assert.deepEqual(
    soFarOn(FOUND, y, x, soFar),
    settled.map((p) => ({ x: p.y, y: p.x })),
  );
  assert.deepEqual(soFarOn(begun(soFar), 0, 1, soFar), settled);
  const [first] = soFarOn(begun(soFar), 0, 2, soFar);
  assert.ok(Math.abs(first.y - 1) < 1e-12, 'in degrees, without a sign that says nothing');
  assert.equal(soFarOn(FOUND, x, 2, soFar), null, 'a figure that has a limit alone');
  const linear = [soFar.figures[0], { ...peak, model: 'linear' }];
  assert.equal(soFarOn(FOUND, x, y, { ...soFar, figures: linear }), null, 'of another response');
  assert.deepEqual([begun(soFar).designs, pointsOf(begun(soFar), 0, 1)], [[], []]);
});

/** A feed, its sockets, and what it has told. */
function fed() {
  const sockets = [];
  const found = [];
  const feed = new FindFeed({ changed() {}, found: (one) => found.push(one) }, () => {
    const socket = {
      sent: [],
      closed: false,
      send(text) {
        this.sent.push(JSON.parse(text));
      },
      close() {
        this.closed = true;
      },
      says(message) {
        this.onmessage({ data: JSON.stringify(message) });
      },
    };
    sockets.push(socket);
    return socket;
  });
  feed.ask({ find: 1 });
  sockets[0].onopen();
  return { feed, sockets, found };
}

test('a search tells how far it is and what it found, and ends', () => {
  const { feed, sockets, found } = fed();
  assert.deepEqual(sockets[0].sent, [{ find: 1 }]);
  sockets[0].says({ done: false, tried: 10, designs: 100, met: 1, points: [], seconds: 0.1 });
  assert.deepEqual([feed.standing.busy, feed.standing.progress.tried], [true, 10]);
  sockets[0].says(FOUND);
  assert.deepEqual([feed.standing.busy, found.length, sockets[0].closed], [false, 1, true]);
});

test('what was called off says nothing more, nor what a newer search has overtaken', () => {
  const { feed, sockets, found } = fed();
  feed.cancel();
  assert.deepEqual([sockets[0].closed, feed.standing.busy, feed.standing.cancelled], [true, false, true]);
  sockets[0].says(FOUND);
  feed.ask({ find: 2 });
  feed.ask({ find: 3 });
  assert.equal(sockets[1].closed, true);
  sockets[1].says(FOUND);
  sockets[1].onclose();
  assert.deepEqual([found.length, feed.standing.busy], [0, true]);
});

test('a refusal and a lost server are told', () => {
  const refused = fed();
  refused.sockets[0].says({ status: 422, detail: 'nothing is free' });
  assert.equal(refused.feed.standing.problem.detail, 'nothing is free');
  const lost = fed();
  lost.sockets[0].onclose();
  assert.match(lost.feed.standing.problem.detail, /cannot be reached/);
  assert.equal(lost.feed.standing.busy, false);
});
