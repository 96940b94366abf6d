/** Tracks on the page: what can be swept, designs with another value of it, courses and what is told of them. */
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { along, coursesOf, indexOf, nearest, stableRanges, stretches, summary } from '../../static/tracks/courses.js';
import { valueText } from '../../static/tracks/figures.js';
import { designAt, isOfDesign, isOfRig, offered, rounded, sweptOf, textOfSwept } from '../../static/tracks/numbers.js';
import { fromServer, TrackFeed } from '../../static/tracks/feed.js';
import { curvesOf } from '../../static/tracks/moving.js';
import { ProblemError } from '../../static/net/index.js';
import { designOf, initialState } from '../../static/model/index.js';
import { PRESETS } from './presets.mjs';

const design = {
  ...designOf(PRESETS[0]),
  poles: /** @type {import('../../static/types.js').Poles} */ ([
    { re: -12, im: 0 },
    { re: -10, im: 0 },
    { re: -3, im: 4 },
    { re: -3, im: -4 },
  ]),
};
const state = { ...initialState(), presets: PRESETS, design };
const polesOf = (/** @type {string} */ path, /** @type {number} */ value) => {
  const made = designAt(design, path, value);
  assert.ok(made);
  return made.poles.map(({ re, im }) => [re, im].map((v) => Math.round(1e9 * v) / 1e9));
};

test('what is swept stands in a link, and comes back', () => {
  for (const text of ['gain', 'loops.pitch.kp,1,100,log', 'parameters.m,0.5,3,kept', 'operating_point.theta,-0.5,0.5'])
    assert.equal(textOfSwept(/** @type {import('../../static/tracks/numbers.js').Swept} */ (sweptOf(text))), text);
  for (const text of ['', null, 'gain,1', 'gain,2,1', 'gain,a,b', '-,1,2', 'gain,1,2,3'])
    assert.equal(sweptOf(text), null);
});

test('a pair is moved as it is told, as on the server', () => {
  assert.deepEqual(polesOf('yaw-pair.re', -5).slice(2), [
    [-5, 4],
    [-5, -4],
  ]);
  assert.deepEqual(polesOf('pitch-pair.re', -10).slice(0, 2), [
    [-9, 0],
    [-11, 0],
  ]);
  assert.deepEqual(polesOf('pitch-pair.im', 2).slice(0, 2), [
    [-11, 2],
    [-11, -2],
  ]);
  assert.deepEqual(polesOf('yaw-pair.frequency', 10).slice(2), [
    [-6, 8],
    [-6, -8],
  ]);
  assert.deepEqual(polesOf('yaw-pair.damping', 1.25).slice(2), [
    [-2.5, 0],
    [-10, 0],
  ]);
  assert.deepEqual(polesOf('poles.1', -20)[1], [-20, 0]);
  assert.deepEqual(polesOf('poles.factor', 2)[3], [-6, -8]);
});

test('other numbers go where a request has them, and the design stays what it is', () => {
  const before = structuredClone(design);
  assert.equal(designAt(design, 'loops.yaw.ti', 0.7)?.loops.yaw.ti, 0.7);
  assert.deepEqual(designAt(design, 'rotors.tau', 0.1)?.rotors, { pitch: { tau: 0.1 }, yaw: { tau: 0.1 } });
  assert.deepEqual(designAt(design, 'parameters.J_p', 0.05)?.parameters, { J_p: 0.05 });
  assert.equal(designAt(design, 'operating_point.theta', 0.2)?.theta0, 0.2);
  assert.equal(designAt(design, 'scenario.digital.sample_time', 0.01)?.scenario.digital?.sample_time, 0.01);
  assert.equal(designAt(design, 'rotor_poles.1', -30)?.rotor_poles[1], -30);
  assert.equal(designAt(design, 'gain.pitch', 2), null);
  assert.ok(!isOfDesign('gain') && isOfRig('rotors.tau') && !isOfRig('loops.pitch.kp'));
  assert.deepEqual(design, before);
  assert.equal(rounded(0.0123456), 0.01235);
});

test('only what a design has is offered', () => {
  const paths = (/** @type {typeof state} */ own) =>
    offered(own).flatMap(([, options]) => options.map(([path]) => path));
  const all = paths(state);
  assert.ok(all.includes('poles.0') && !all.includes('poles.2') && all.includes('yaw-pair.damping'));
  assert.ok(all.includes('loops.pitch.kp') && all.includes('parameters.B_y'));
  assert.ok(!paths({ ...state, design: { ...design, outer: 'none' } }).includes('loops.pitch.kp'));
  assert.equal(new Set(all).size, all.length);
  const growing = {
    ...design,
    poles: /** @type {typeof design.poles} */ ([{ re: 1, im: 0 }, ...design.poles.slice(1)]),
  };
  assert.ok(!paths({ ...state, design: growing }).includes('pitch-pair.damping'));
});

const line = (/** @type {number[][]} */ points) => points.map(([re, im]) => ({ re, im }));

test('a course changes its kind where it crosses, and has a gap where there is no loop', () => {
  const course = line([[-2, 1], [-1, 1], [1, 1], [2, 1], [-3, 1], [-4, 1]]); // prettier-ignore
  const found = stretches(course, [0, 4]);
  assert.deepEqual(
    found.map(({ stable, points }) => [stable, points.length]),
    [[true, 2], [false, 3], [true, 2]], // prettier-ignore
  );
  assert.equal(found[1].points[0], course[1]);
});

test('a sampled loop’s poles are shown where they would be in the s-plane', () => {
  const z = { re: Math.exp(-0.3) * Math.cos(0.4), im: Math.exp(-0.3) * Math.sin(0.4) };
  const track = /** @type {import('../../static/contract.js').TrackReply} */ (
    /** @type {unknown} */ ({ plane: 'z', poles: [[z]], values: [0.1] })
  );
  const [[p]] = coursesOf(track);
  assert.ok(Math.abs(p.re + 3) < 1e-12 && Math.abs(p.im - 4) < 1e-12);
});

test('values are found by place, by value and along the range', () => {
  const courses = [line([[0, 0], [1, 0], [2, 0]]), line([[0, 5], [1, 5], [2, 5]])]; // prettier-ignore
  assert.deepEqual(
    nearest(courses, ({ re, im }) => Math.hypot(re - 2, im - 4)),
    { index: 2, away: 1 },
  );
  assert.equal(indexOf([0, 1, 4, 9], 3), 2);
  const log = along([0.01, 100], true);
  assert.ok(Math.abs(log.share(1) - 0.5) < 1e-12 && Math.abs(log.value(0.75) - 10) < 1e-9);
  const below = along([-48, -3], true);
  assert.ok(Math.abs(below.value(0) + 48) < 1e-9 && Math.abs(below.value(1) + 3) < 1e-9);
  assert.equal(along([1, 3], false).value(0.5), 2);
});

const shown = (/** @type {number} */ v) => v.toFixed(2);

test('where the loop is stable is told to where poles cross', () => {
  const pole = { re: 0, im: 1 };
  const track = {
    plane: /** @type {const} */ ('s'),
    values: [0, 1, 2, 3, 4, 5],
    starts: [0],
    stable: [false, true, true, false, false, true],
    on_border: Array(6).fill(false),
    crossings: [
      { value: 0.4, pole, outwards: false },
      { value: 0.6, pole, outwards: false },
      { value: 2.3, pole, outwards: true },
      { value: 2.6, pole, outwards: true },
      { value: 4.9, pole, outwards: false },
    ],
  };
  assert.deepEqual(
    stableRanges(track).map((ends) => ends.map(({ value, by }) => [value, by])),
    [[[0.6, 'crossing'], [2.3, 'crossing']], [[4.9, 'crossing'], [5, 'known']]], // prettier-ignore
  );
  assert.equal(
    summary(track, shown),
    'stable from 0.60 (a pole crosses) to 2.30 (a pole crosses); stable from 4.90 (a pole crosses) to 5.00',
  );
  assert.deepEqual(
    stableRanges({ ...track, stable: Array(6).fill(true), starts: [0, 3], crossings: [] }).length,
    2,
    'a gap parts what is stable on both of its sides',
  );
});

test('poles on the border of stability at one end are no crossing', () => {
  const open = {
    plane: /** @type {const} */ ('s'),
    values: [0, 3.7e-6, 1, 3],
    starts: [0],
    stable: [false, true, true, true],
    on_border: [true, false, false, false],
    crossings: [],
  };
  assert.equal(
    summary(open, shown),
    'stable for every value above 0.00, up to 3.00; at 0.00 poles on the imaginary axis',
  );
  const beyond = { ...open, on_border: Array(4).fill(false) };
  assert.equal(summary(beyond, shown), 'stable from 0.00 to 3.00'); // nothing is known of between
  const sampled = { ...open, plane: /** @type {const} */ ('z') };
  assert.ok(summary(sampled, shown).endsWith('at 0.00 poles on the unit circle'));
  const upper = {
    ...open,
    stable: [true, true, true, false],
    on_border: [false, false, false, true],
  };
  assert.equal(summary(upper, shown), 'stable from 0.00 to below 3.00; at 3.00 poles on the imaginary axis');
});

test('a figure is told in words where it has no value', () => {
  const of = { words: '', unit: 's', values: [0.5, 0], valid: [true, false] };
  const settling = { ...of, measure: 'settling_time', axis: 'theta', model: 'nonlinear', steps: 'alone' };
  assert.deepEqual([0, 1].map((k) => valueText(settling, k)), ['0.50 s', 'not settled']); // prettier-ignore
  const lag = { ...of, measure: 'lag_margin', unlimited: [false, true] };
  assert.equal(valueText(lag, 1), 'unlimited');
});

const swept = (/** @type {string} */ path) => ({ path, over: null, log: false, kept: false });
const wanted = (/** @type {string} */ path) => ({ design, swept: swept(path), measures: [{ name: 'disk_margin' }] });

test('of what is asked the newest is told, and only when the hand rests', async () => {
  /** @type {string[]} */ const told = [];
  /** @type {((track: never) => void)[]} */ const answers = [];
  /** @type {() => void} */ let rest = () => {};
  const feed = new TrackFeed(
    (news) => told.push(news.wanted.swept.path),
    () => new Promise((resolve) => answers.push(resolve)),
    (act) => {
      rest = act;
      return setTimeout(() => {}, 0);
    },
  );
  feed.want(wanted('gain'));
  feed.want(wanted('gain.pitch'));
  assert.equal(answers.length, 0);
  rest();
  feed.want(wanted('gain.yaw'));
  rest();
  feed.want(wanted('gain.yaw'));
  assert.equal(answers.length, 2);
  for (const answer of answers) answer(/** @type {never} */ (null));
  await Promise.resolve().then(() => null);
  await new Promise((resolve) => setImmediate(resolve));
  assert.deepEqual(told, ['gain.yaw']);
});

test('what was asked of a server that is away is asked again, what it refuses is not', async () => {
  const refusals = [new TypeError('Failed to fetch'), new ProblemError({ detail: 'too much' })];
  let asked = 0;
  const feed = new TrackFeed(
    () => {},
    () => Promise.reject(refusals[asked++]),
    (act) => {
      act();
      return setTimeout(() => {}, 0);
    },
  );
  for (const count of [1, 2, 2]) {
    feed.want(wanted('gain'));
    await new Promise((resolve) => setImmediate(resolve));
    assert.equal(asked, count);
  }
});

test('what has no figures is asked for once more without, other refusals are told', async () => {
  /** @type {number[]} */ const asked = [];
  const refusing =
    (/** @type {string} */ field) =>
    (
      /** @type {string} */ _,
      /** @type {ReturnType<typeof import('../../static/tracks/feed.js').requestOf>} */ body,
    ) => {
      asked.push(body.track.measures.length);
      return body.track.measures.length
        ? Promise.reject(new ProblemError({ field }))
        : Promise.resolve(/** @type {never} */ (7));
    };
  assert.equal(await fromServer(wanted('gain'), refusing('track.measures')), 7);
  assert.deepEqual(asked, [1, 0]);
  await assert.rejects(fromServer(wanted('gain'), refusing('poles.1')));
  assert.deepEqual(asked, [1, 0, 1]);
});

test('curves from the workers follow each pole, without what drives nothing', () => {
  const values = [0, 1, 2];
  const rows = [[-1, 0, -5, 0, 0, 0], [-4, 0, -2, 0, 0, 0], [-3, 0, -3, 0, 0, 0]]; // prettier-ignore
  const curves = curvesOf(values, Float64Array.from(rows.flat()), Uint8Array.from([2, 1, 2]), 3);
  const real = curves.poles.map((course) => course.map(({ re }) => re));
  assert.deepEqual(real, [[-1, -2, -3], [-5, -4, -3]]); // prettier-ignore
  const gap = curvesOf(values, Float64Array.from(rows.flat()), Uint8Array.from([2, 0, 2]), 3);
  assert.deepEqual([gap.values, gap.starts], [[0, 2], [0, 1]]); // prettier-ignore
});
