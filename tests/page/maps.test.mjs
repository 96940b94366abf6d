// Maps: their grids from coarse to fine, levels, contours, colours, what is chosen, and who is asked when.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { AT } from '../../static/kernel/layout.js';
import { choiceOf, CHOICES, linkOf, measureOf, valueText } from '../../static/maps/choices.js';
import { css, ramp, rgb } from '../../static/maps/colors.js';
import { between, linesOf, regions } from '../../static/maps/contours.js';
import { emptierSide } from '../../static/maps/corner.js';
import { ProblemError } from '../../static/net/index.js';
import { besides, changesOf, MapFeed, placeIn, shareIn } from '../../static/maps/feed.js';
import { fieldOf, refined } from '../../static/maps/grid.js';
import { layersOf, mirrored } from '../../static/maps/layers.js';
import { levelsOf } from '../../static/maps/levels.js';
import { designOf } from '../../static/model/index.js';
import { PRESETS } from './presets.mjs';

const linear = (from, to) => ({ from, to, log: false });

test('what is coarse is part of what is finer', () => {
  const { order, stops } = refined(129, 97, [8, 4, 2, 1]);
  assert.deepEqual(stops, [17 * 13, 33 * 25, 65 * 49, 129 * 97]);
  assert.equal(new Set(order).size, order.length);
  for (const [level, stride] of [8, 4, 2, 1].entries())
    for (const node of order.subarray(0, stops[level])) {
      assert.equal((node % 129) % stride, 0);
      assert.equal(Math.floor(node / 129) % stride, 0);
    }
});

test('a real pair’s own plane stands where it hides fewer poles', () => {
  const view = { width: 400, height: 300 };
  const side = (/** @type {[number, number][]} */ ...marks) => emptierSide(marks, view);
  assert.equal(side(), 'right');
  assert.equal(side([50, 150], [390, 150]), 'right', 'where both are alike');
  assert.equal(side([300, 150], [340, 200], [90, 220]), 'left');
  assert.equal(side([300, 60], [340, 100], [90, 220]), 'right', 'in the upper half nothing is hidden');
  assert.equal(side([-20, 150], [300, 150]), 'left', 'nor is what is out of sight');
});

test('a field is the finest grid that is known as a whole', () => {
  const size = { columns: 5, rows: 5 };
  const how = refined(5, 5, [2, 1]);
  const measures = 2;
  const found = {
    values: Float64Array.from({ length: 50 }, (_, i) => (i % 2 ? -1 : 1) * how.order[i >> 1]),
    stable: new Uint8Array(25).fill(2),
    abscissa: new Float64Array(25).fill(-1),
  };
  const at = (done) => fieldOf(how, size, { ...found, done }, measures);
  assert.equal(at(8), null);
  const coarse = at(24);
  assert.deepEqual([coarse.columns, coarse.rows, coarse.whole], [3, 3, false]);
  assert.deepEqual([...coarse.values], [0, 2, 4, 10, 12, 14, 20, 22, 24]);
  const whole = at(25);
  assert.deepEqual([...whole.values], [...Array(25).keys()]);
  assert.deepEqual(
    [...whole.others[0]],
    [...Array(25).keys()].map((v) => -v),
  );
  assert.equal(whole.whole, true);
});

test('levels are round, few, and no outlier makes the rest one colour', () => {
  const values = Array.from({ length: 1000 }, (_, i) => 0.4 + i / 500);
  const levels = levelsOf([...values, 900, NaN, Infinity], false);
  assert.ok(levels.length >= 6 && levels.length <= 16, levels.join());
  assert.ok(levels.at(-1) <= 2.4 && levels[0] > 0.4);
  for (const [i, v] of levels.slice(1).entries()) assert.ok(Math.abs(v - levels[i] - (levels[1] - levels[0])) < 1e-9);
  assert.deepEqual(levelsOf([NaN, NaN], false), []);
  assert.equal(levelsOf([3, 3, 3], false).length, 1);
  // what is written alike has one colour, that of the best
  assert.deepEqual(levelsOf([0, 0.004, 0.02, 0.3], false, 1), [1]);
  assert.deepEqual(levelsOf([0.52, 0.54], true, 0.1), [0.5]);
  assert.ok(levelsOf([0, 0, 0, 0, 0, 1, 2, 3, 4], false)[0] > 0, 'what is best has a colour of its own');
  assert.deepEqual(
    levelsOf(
      Array.from({ length: 400 }, (_, i) => 10 ** (i / 100 - 2)),
      false,
    ).slice(0, 4),
    [0.02, 0.05, 0.1, 0.2],
  );
});

const area = (rings) => {
  let sum = 0;
  for (const ring of rings)
    for (let i = 0, j = ring.length - 2; i < ring.length; j = i, i += 2)
      sum += (ring[j] * ring[i + 1] - ring[i] * ring[j + 1]) / 2;
  return Math.abs(sum);
};
const grid = (columns, rows, f) => ({
  columns,
  rows,
  values: Float64Array.from({ length: columns * rows }, (_, i) => f(i % columns, Math.floor(i / columns))),
});

test('regions are those of the values, with their holes, up to the border', () => {
  const cone = grid(41, 41, (x, y) => -Math.hypot(x - 20, y - 20));
  assert.ok(Math.abs(area(regions(cone, -10)) / (Math.PI * 100) - 1) < 0.01);
  const ring = grid(41, 41, (x, y) => -Math.abs(Math.hypot(x - 20, y - 20) - 10));
  const rings = regions(ring, -4);
  assert.equal(rings.length, 2, 'a border and a hole');
  assert.ok(Math.abs(area(rings) / (Math.PI * (14 ** 2 - 6 ** 2)) - 1) < 0.02, 'they run opposite ways');
  const half = grid(11, 11, (x) => x);
  assert.ok(Math.abs(area(regions(half, 5.5)) - 45) < 1e-9);
  assert.deepEqual([area(regions(half, -1)), area(regions(half, 20))], [100, 0]);
  assert.deepEqual(
    [...linesOf(regions(half, 5.5), half)[0]].filter((_, i) => i % 2 === 0),
    Array(11).fill(5.5),
  );
  assert.equal(linesOf(regions(half, -1), half).length, 0, 'the border is no line');
  const [closed] = linesOf(regions(cone, -10), cone);
  assert.deepEqual([closed[0], closed[1]], [closed.at(-2), closed.at(-1)]);
  assert.equal(between(half, 3.25, 10), 3.25);
});

test('a saddle is joined or parted by its middle, and no line is lost', () => {
  const saddle = (middle) => ({ columns: 2, rows: 2, values: Float64Array.of(1, -1 + middle, -1 + middle, 1) });
  assert.equal(regions(saddle(0.5), 0).length, 1);
  assert.equal(regions(saddle(-0.5), 0).length, 2);
  // any grid: regions above and below a level make up the whole
  let seed = 7;
  const noise = grid(23, 17, () => (seed = (seed * 16807) % 2147483647) / 2147483647);
  const inverse = { ...noise, values: noise.values.map((v) => -v) };
  const [above, below] = [area(regions(noise, 0.5)), area(regions(inverse, -0.5))];
  assert.ok(Math.abs(above + below - 22 * 16) < 1e-6, `${above} + ${below}`);
});

test('forbidden is what is unstable, does not settle, or misses what is required', () => {
  const [columns, rows] = [21, 11];
  const at = (f) => Float64Array.from({ length: columns * rows }, (_, i) => f(i % columns));
  const field = {
    columns,
    rows,
    values: at((x) => (x > 12 ? NaN : x)),
    stable: Uint8Array.from(at((x) => (x > 15 ? 1 : 2))),
    abscissa: at((x) => x - 15.5),
    others: [],
  };
  const layers = layersOf(field, (v) => v, [2, 4, 6, 8], [{ max: 7 }]);
  assert.ok(Math.abs(area(layers.unstable) - 4.5 * 10) < 1e-9, 'where the loop’s largest real part is 0');
  assert.ok(Math.abs(area(layers.unsettled) - 3 * 10) < 3);
  const missed = area(layers.missed);
  assert.ok(missed > 5.9 * 10 && missed <= 13 * 10 + 1e-6, String(missed));
  assert.equal(layers.grid.values.includes(NaN), false);
  const both = mirrored(field);
  assert.equal(both.rows, 21);
  assert.deepEqual([...both.values.subarray(0, 12)], [...both.values.subarray(20 * columns, 20 * columns + 12)]);
});

test('colours keep their order in grey, and equal steps look alike', () => {
  const grey = ([r, g, b]) => 0.2126 * r ** 2.2 + 0.7152 * g ** 2.2 + 0.0722 * b ** 2.2;
  for (const dark of [false, true]) {
    const colors = ramp(12, dark);
    const greys = colors.map((color) => grey(rgb(color)));
    for (let i = 1; i < 12; i++) assert.ok(greys[i] < greys[i - 1], `${dark} ${i}`);
    const steps = colors.slice(1).map((color, i) => Math.hypot(...color.map((v, k) => v - colors[i][k])));
    assert.ok(Math.max(...steps) / Math.min(...steps) < 1.06, steps.join());
    assert.ok(Math.min(...steps) > 0.02, 'neighbours can be told apart');
  }
  assert.equal(css([1, 0, 0]), '#ffffff');
  assert.equal(css([0, 0, 0]), '#000000');
  assert.deepEqual(rgb([0.6279, 0.2249, 0.1258]), [255, 0, 0]); // CSS Color 4: red in Oklab
});

test('a choice is what its link says', () => {
  for (const text of [
    'settling_time',
    'overshoot,psi',
    'V_peak,both,linear',
    'disk_margin,yaw-pair',
    'settling_time,linear,pitch-pair',
  ])
    assert.equal(linkOf(choiceOf(text)), text);
  for (const text of [null, '', 'nothing', 'settling_time,up', 'constructor', '__proto__'])
    assert.equal(choiceOf(text), null);
  assert.deepEqual(measureOf(choiceOf('overshoot,linear'), 'psi'), { name: 'overshoot', axis: 'psi', model: 'linear' });
  assert.deepEqual(measureOf(choiceOf('disk_margin'), 'psi'), { name: 'disk_margin' });
  assert.equal(valueText('settling_time', NaN), 'not settled');
  assert.equal(valueText('lag_margin', Infinity), 'unlimited');
  assert.equal(valueText('coupling_peak', 0.1), '5.73°');
  assert.equal(valueText('share_within_limits', 0.975), '98 %');
  assert.ok(Object.keys(CHOICES).length >= 9);
});

const domain = { x: linear(-4, 0), y: linear(0, 2) };

test('designs of a map differ where it is over', () => {
  const size = { columns: 3, rows: 2 };
  const order = Uint16Array.of(0, 5);
  const of = (asked) => changesOf({ domain, real: false, ...asked }, size, order);
  const P = AT.POLES;
  assert.deepEqual(of({ move: 'yaw-pair' }).at, [P + 4, P + 5, P + 6, P + 7]);
  assert.deepEqual([...of({ move: 'pitch-pair' }).values], [-4, 0, -4, -0, 0, 2, 0, -2]);
  assert.deepEqual([...of({ move: 'pitch-pair', real: true }).values], [-4, 0, 0, 0, 0, 0, 2, 0]);
  const log = { x: { from: 1, to: 100, log: true }, y: linear(1, 2) };
  const loops = changesOf({ move: 'yaw-pi', real: false, domain: log }, size, Uint16Array.of(1));
  assert.deepEqual(loops.at, [AT.PI_GAINS + 2, AT.PI_GAINS + 3]);
  assert.ok(Math.abs(loops.values[0] - 10) < 1e-12);
  assert.ok(Math.abs(shareIn(log.x, placeIn(log.x, 0.3)) - 0.3) < 1e-12);
});

const encoders = { theta: 4096, psi: 8192 };
const parameters = {
  ...{ K_pp: 0.204, K_py: 0.0068, K_yp: 0.0219, K_yy: 0.072, J_p: 0.0384, J_y: 0.0432 },
  ...{ m: 1.3872, l: 0.186, B_p: 0.8, B_y: 0.318, K_s: 0.0, g: 9.81 },
};
const PRESET = { parameter_info: {}, limit_info: {}, encoders, ...PRESETS[0], parameters };
const DESIGN = designOf(PRESET);
const ASKED = { move: 'pitch-pair', real: false, domain, measure: { name: 'overshoot', axis: 'theta' }, limits: [] };

/** A feed whose clock, hand, workers and server the test holds. */
function held() {
  let [now, busy] = [1000, false];
  const waiting = [];
  const hand = {
    busy: () => busy,
    now: () => now,
    later: (act, ms) => waiting[waiting.push({ act, at: now + ms }) - 1],
    cancel: (timer) => timer && (timer.act = () => {}),
  };
  const [shown, tasks, served] = [[], [], []];
  const lane = {
    designs: { works: true },
    ask: (task, then) => tasks.push({ task, then }),
    forget: () => tasks.push('forget'),
  };
  const server = (wanted, size) => new Promise((found, refused) => served.push({ wanted, size, found, refused }));
  const told = [];
  const tell = ({ computing, refused }) => told.push(refused || (computing ? 'computing' : ''));
  const feed = new MapFeed((field) => shown.push(field), server, hand, false, tell);
  const pass = (ms) => {
    now += ms;
    for (const timer of waiting.filter(({ at }) => at <= now).toSorted((a, b) => a.at - b.at)) {
      waiting.splice(waiting.indexOf(timer), 1);
      timer.act();
    }
  };
  const computed = ({ task }, done) => ({
    values: new Float64Array(task.values.length / task.at.length).fill(1),
    stable: new Uint8Array(task.values.length / task.at.length).fill(2),
    abscissa: new Float64Array(task.values.length / task.at.length).fill(-1),
    done,
  });
  const designs = { lane: () => lane };
  return { feed, shown, tasks, served, pass, computed, told, designs, lane, hold: (v) => (busy = v) };
}
const wanted = (design = DESIGN, asked = ASKED) => ({ design, preset: PRESET, asked, spread: 0.1 });
const moved = (re) => ({ ...DESIGN, poles: DESIGN.poles.map((p, i) => (i < 2 ? p : { re: re - i, im: 0 })) });

test('at rest the whole map is computed by all workers', () => {
  const { feed, tasks, designs, shown, computed } = held();
  feed.render(wanted());
  assert.equal(tasks.length, 0, 'nothing before there are workers');
  feed.take(designs);
  feed.render(wanted());
  const [{ task, then }] = tasks;
  assert.equal(task.workers, undefined);
  assert.deepEqual(task.stops, [17 * 13, 33 * 25, 65 * 49]);
  then(computed({ task }, 221));
  assert.deepEqual([shown.at(-1).columns, shown.at(-1).rows], [17, 13]);
  feed.render(wanted({ ...DESIGN, poles: DESIGN.poles.map((p, i) => (i > 1 ? p : { re: -1 - i, im: 0 })) }));
  assert.equal(tasks.length, 1, 'the own pair’s place is no other map');
  feed.render(null);
  assert.deepEqual([tasks.at(-1), shown.at(-1)], ['forget', null]);
});

test('while something moves: coarse, one worker, at a pace; then the whole', () => {
  const { feed, tasks, designs, pass, hold, computed, shown } = held();
  feed.take(designs);
  feed.render(wanted());
  pass(1000);
  hold(true);
  feed.render(wanted(moved(-3)));
  assert.equal(tasks.length, 2);
  assert.equal(tasks[1].task.workers, 1);
  assert.equal(tasks[1].task.values.length / 4, 33 * 25);
  pass(10);
  feed.render(wanted(moved(-4)));
  pass(10);
  feed.render(wanted(moved(-5)));
  assert.equal(tasks.length, 2, 'not faster than the pace');
  pass(60);
  assert.equal(tasks.length, 3);
  tasks[2].then(computed(tasks[2], 825));
  assert.equal(shown.at(-1).columns, 33);
  pass(200);
  assert.equal(tasks.length, 4);
  assert.equal(tasks[3].task.workers, undefined, 'it rests');
});

test('what was asked of a server that is away is asked again, what it refuses is not', async () => {
  const { feed, designs, served, pass } = held();
  feed.take(designs);
  const own = wanted({ ...DESIGN, method: 'robust' });
  pass(1000);
  feed.render(own);
  served[0].refused(new TypeError('Failed to fetch'));
  await new Promise((resolve) => setImmediate(resolve));
  pass(1000);
  feed.render(own);
  assert.equal(served.length, 2);
  served[1].refused(new ProblemError({ detail: 'too much' }));
  await new Promise((resolve) => setImmediate(resolve));
  pass(1000);
  feed.render(own);
  assert.equal(served.length, 2);
});

test('what the kernel does not serve is asked of the server, when the hand rests', async () => {
  const { feed, tasks, designs, served, pass, hold, shown } = held();
  feed.take(designs);
  const other = (re) => wanted({ ...moved(re), method: 'robust' });
  hold(true);
  feed.render(other(-3));
  assert.equal(served.length, 0);
  pass(200);
  assert.equal(served.length, 1);
  assert.ok(tasks.every((task) => task === 'forget'));
  hold(false);
  pass(500);
  feed.render(other(-4));
  served[1].found('a map');
  served[0].found('an older one');
  await null;
  await null;
  assert.deepEqual(shown.filter(Boolean), ['a map']);
  assert.equal(served.length, 3, 'a finer one');
  served[2].refused(new Error('too much'));
  await null;
  await null;
  await null;
  assert.deepEqual(shown.filter(Boolean), ['a map'], 'the coarse one stays');
});

test('where workers fail or there are none the server is asked', async () => {
  const { feed, tasks, designs, served, lane } = held();
  feed.take(designs);
  feed.render(wanted());
  lane.designs.works = false;
  tasks[0].then(null);
  assert.equal(served.length, 1);
  const without = held();
  without.feed.take(null);
  without.feed.render(wanted());
  assert.equal(without.served.length, 1);
});

test('what a map is besides its own move', () => {
  const of = (move, design) => JSON.stringify(besides(design, { ...ASKED, move }));
  const loops = { ...DESIGN, loops: { ...DESIGN.loops, yaw: { kp: 99, ti: 9 } } };
  assert.equal(of('yaw-pi', DESIGN), of('yaw-pi', loops));
  assert.notEqual(of('pitch-pi', DESIGN), of('pitch-pi', loops));
  assert.equal(of('yaw-pair', DESIGN), of('yaw-pair', moved(-7)));
  assert.notEqual(of('pitch-pair', DESIGN), of('pitch-pair', moved(-7)));
});

const settled = () => new Promise((resolve) => setImmediate(resolve));

test('what the server does is told, and its refusal with its words', async () => {
  const { feed, designs, served, pass, shown, told } = held();
  feed.take(designs);
  pass(1000);
  feed.render(wanted());
  assert.equal(told.at(-1), '', 'the page computes by itself');
  const other = (re) => wanted({ ...moved(re), method: 'robust' });
  feed.render(other(-3));
  assert.equal(told.at(-1), 'computing', 'from the first moment on what is shown is of what was before');
  pass(200);
  served[0].found('a map');
  await settled();
  assert.equal(told.at(-1), '', 'a finer one is no other');
  pass(1000);
  feed.render(other(-4));
  pass(200);
  served.at(-1).refused(new ProblemError({ status: 503, title: 'busy', detail: 'There is too much to do.' }));
  await settled();
  assert.match(told.at(-1), /There is too much to do/);
  assert.equal(shown.at(-1), null, 'nothing stale stays');
  pass(1000);
  const before = served.length;
  feed.again();
  pass(1000);
  assert.equal(served.length, before + 1);
  assert.equal(told.at(-1), 'computing');
  feed.render(null);
  assert.equal(told.at(-1), '');
  feed.again();
  assert.equal(served.length, before + 1, 'nobody wants any');
});
