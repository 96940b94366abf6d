// Clouds that the page computes: which rigs, their percentiles, who overtakes whom, and what the worker is told.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { AT, FACTORS } from '../../static/kernel/layout.js';
import { FEW, ManyRigs } from '../../static/kernel/many.js';
import { compiled, instantiated, MODULE } from '../../static/kernel/module.js';
import { Newest } from '../../static/kernel/newest.js';
import { fill, sizeOf } from '../../static/kernel/numbers.js';
import { bandsOf, percentile } from '../../static/kernel/percentiles.js';
import { fillFactors, mixed, uniform } from '../../static/kernel/random.js';
import { loadRigs } from '../../static/kernel/rigs.js';
import { fillDots } from '../../static/clouds/dots.js';
import { designOf } from '../../static/model/index.js';
import { PRESETS } from './presets.mjs';

const parameters = {
  ...{ K_pp: 0.204, K_py: 0.0068, K_yp: 0.0219, K_yy: 0.072, J_p: 0.0384, J_y: 0.0432 },
  ...{ m: 1.3872, l: 0.186, B_p: 0.8, B_y: 0.318, K_s: 0.0, g: 9.81 },
};
const encoders = { theta: 4096, psi: 8192 };
const PRESET = { parameter_info: {}, limit_info: {}, encoders, ...PRESETS[0], parameters };
const DESIGN = designOf(PRESET);

test('a rig’s numbers depend on its place alone, and keep within their bounds', () => {
  const [few, many] = [new Float64Array(FACTORS * 3), new Float64Array(FACTORS * 2000)];
  const spreads = Array.from({ length: FACTORS }, (_v, k) => (k === 11 ? 0 : 0.1 * k));
  fillFactors(few, spreads, 0.02);
  fillFactors(many, spreads, 0.02);
  assert.deepEqual([...few], [...many.subarray(0, few.length)]);
  for (let k = 0; k < FACTORS; k++) {
    const column = many.filter((_v, i) => i % FACTORS === k);
    const [least, most] = [Math.min(...column), Math.max(...column)];
    assert.ok(least >= Math.max(1 - spreads[k], 0.02) && most <= 1 + spreads[k]);
    assert.ok(spreads[k] === 0 || most - least > 1.98 * Math.min(spreads[k], 0.99), `column ${k} is filled`);
  }
  const wide = new Float64Array(FACTORS * 2000);
  fillFactors(wide, Array(FACTORS).fill(1.5), 0.02);
  assert.equal(Math.min(...wide), 0.02);
  assert.notEqual(uniform(0, 0), uniform(1, 0));
  assert.notEqual(uniform(0, 0), uniform(0, 1));
});

test('the mixing is MurmurHash3’s', () => {
  // published hashes (x86, 32 bit) of nothing under these seeds, which are their seeds mixed
  assert.deepEqual([0, 1, 0xffffffff].map(mixed), [0, 0x514e28b7, 0x81f16f39]);
});

test('percentiles are NumPy’s', () => {
  // numpy.percentile([1, 2, 4, 8], [5, 50, 95, 0, 100]), and of one value
  const sorted = Float64Array.of(1, 2, 4, 8);
  assert.deepEqual(
    [5, 50, 95, 0, 100].map((p) => percentile(sorted, p)),
    [1.15, 3, 7.399999999999999, 1, 8],
  );
  assert.equal(percentile(Float64Array.of(7), 95), 7);
});

test('rigs that were given up are in no band', () => {
  const times = 3;
  const rig = (first, last) => [first, first, last, ...[2 * first, 2 * first, 2 * last]];
  const angles = Float64Array.from([...rig(1, 3), ...rig(5, NaN), ...rig(2, 6)]);
  const [theta, psi] = bandsOf(angles, 3, times, [0, 50, 100]);
  assert.deepEqual(
    theta.map((band) => [...band]),
    [
      [1, 1, 3],
      [1.5, 1.5, 4.5],
      [2, 2, 6],
    ],
  );
  assert.deepEqual([...psi[2]], [4, 4, 12]);
  assert.equal(bandsOf(angles.subarray(6), 1, times, [50]), null);
});

/** Tasks are lists of what is found; a pause ends when the test says so. */
function slow() {
  const told = [];
  const worked = [];
  const waiting = [];
  const newest = new Newest(
    function* (task) {
      for (const found of task) {
        if (found === 'trap') throw new Error('unreachable');
        worked.push(found);
        yield found;
      }
    },
    (id, found, problem) => told.push(problem ? `${id}: ${problem.message}` : `${id}: ${found}`),
    () => new Promise((go) => waiting.push(go)),
  );
  const step = async () => {
    waiting.shift()();
    await new Promise((turn) => setImmediate(turn));
  };
  return { newest, told, worked, step, waiting };
}

test('a newer task overtakes between two parts, the newest of several, once the older has told something', async () => {
  const { newest, told, worked, step, waiting } = slow();
  newest.put(1, [null, 'few', null, 'all']);
  newest.put(2, ['never']);
  newest.put(3, ['newer', 'all of it']);
  await step();
  assert.deepEqual(told, ['1: few'], 'what has begun comes as far as this');
  await step();
  assert.deepEqual(told, ['1: few', '3: newer']);
  await step();
  await step();
  assert.deepEqual(told, ['1: few', '3: newer', '3: all of it']);
  assert.deepEqual(worked, [null, 'few', 'newer', 'all of it']);
  assert.equal(waiting.length, 0);
  newest.put(4, ['again']);
  assert.deepEqual(told.at(-1), '4: again', 'it goes on after a rest');
});

test('a hand that never rests is followed', async () => {
  const { newest, told, step } = slow();
  for (let id = 0; id < 20; id++) {
    newest.put(id, [null, null, 'few', 'all']);
    await step().catch(() => {});
  }
  assert.ok(told.length >= 6 && told.every((words) => words.endsWith('few')), String(told));
});

test('a task that cannot be done is told, and stops none that follows', async () => {
  const { newest, told, step } = slow();
  newest.put(1, []);
  await new Promise((turn) => setImmediate(turn));
  newest.put(2, [null, 'trap']);
  await step();
  newest.put(3, ['fine']);
  await step();
  assert.deepEqual(told, ['1: null', '2: unreachable', '3: fine']);
});

/** A worker by hand. */
function fake() {
  const worker = {
    sent: [],
    ended: false,
    postMessage: (message, transfer) => worker.sent.push({ ...message, transfer }),
    terminate: () => (worker.ended = true),
  };
  return worker;
}
const hear = (worker, data) => worker.onmessage({ data });

async function ready() {
  const worker = fake();
  const loading = loadRigs('module', () => worker);
  hear(worker, { ready: true });
  return { worker, rigs: await loading };
}

test('the worker gets the module, then numbers that it need not copy', async () => {
  const { worker, rigs } = await ready();
  const heard = [];
  assert.ok(rigs.serves(DESIGN, PRESET));
  rigs.ask(DESIGN, PRESET, { K_pp: 0.1, tau_y: 0.3 }, 2000, (cloud) => heard.push(cloud));
  assert.equal(worker.sent[0].module, 'module');
  const { id, task, transfer } = worker.sent[1];
  assert.equal(transfer[0], task.numbers.buffer);
  assert.equal(task.numbers[AT.DURATION], DESIGN.scenario.duration);
  assert.deepEqual(task.spreads, [0.1, ...Array(12).fill(0), 0.3]);
  assert.deepEqual([task.size, task.rigs], [sizeOf(DESIGN, PRESET), 2000]);
  hear(worker, { id, cloud: 'few' });
  rigs.ask(DESIGN, PRESET, {}, 2000, (cloud) => heard.push(`newer ${cloud}`));
  hear(worker, { id, cloud: null });
  hear(worker, { id, cloud: 'older' });
  hear(worker, { id: worker.sent[2].id, cloud: null });
  rigs.forget();
  hear(worker, { id: worker.sent[2].id, cloud: 'late' });
  assert.deepEqual(heard, ['few', 'newer older', 'newer null']);
});

test('a worker that fails is asked no more', async () => {
  for (const fail of [
    (worker) => hear(worker, { id: 1, cloud: null, problem: 'RuntimeError: unreachable' }),
    (worker) => worker.onerror({ message: 'gone', preventDefault() {} }),
  ]) {
    const { worker, rigs } = await ready();
    const heard = [];
    rigs.ask(DESIGN, PRESET, {}, 10, (cloud) => heard.push(cloud));
    fail(worker);
    assert.deepEqual([heard, worker.ended, rigs.serves(DESIGN, PRESET)], [[null], true, false]);
  }
});

test('a worker that cannot be had is told of', async () => {
  const one = fake();
  const loading = loadRigs('module', () => one);
  one.onerror({ preventDefault() {} });
  await assert.rejects(loading, /could not be loaded/);
  assert.ok(one.ended);
  const other = fake();
  const refused = loadRigs('module', () => other);
  hear(other, { problem: 'CompileError: refused' });
  await assert.rejects(refused, /CompileError/);
  const none = () => {
    throw new TypeError('no workers');
  };
  await assert.rejects(loadRigs('module', none), /no workers/);
});

test('all poles come first, with a few responses; then all responses, the same rigs throughout', async () => {
  let clock = 0;
  const rigs = new ManyRigs(await instantiated(await compiled(readFileSync(MODULE))), () => (clock += 0.2));
  const numbers = new Float64Array(AT.NUMBERS);
  fill(numbers, DESIGN, PRESET);
  const size = sizeOf(DESIGN, PRESET);
  const task = { numbers, size, spreads: Array(FACTORS).fill(0.1), rigs: 500 };
  const told = [...rigs.cloud(task)].filter(Boolean);
  assert.deepEqual(
    told.map(({ done, judged }) => [done, judged]),
    [
      [500, FEW],
      [500, 500],
    ],
  );
  assert.deepEqual(told[0].poles, told[1].poles);
  assert.equal(told[0].poles.length % 1000, 0);
  assert.notEqual(told[0].poles.buffer, told[1].poles.buffer, 'each may be sent away');
  const [few] = [...rigs.cloud({ ...task, rigs: 7 })].filter(Boolean);
  assert.deepEqual(few.poles, told[0].poles.subarray(0, few.poles.length));
  const parallel = numbers.slice();
  parallel.fill(0, AT.PARAMETERS, AT.PARAMETERS + 4);
  assert.deepEqual([...rigs.cloud({ ...task, numbers: parallel })], [], 'motors that act alike');
});

test('rigs may be given, and are those then', async () => {
  const rigs = new ManyRigs(await instantiated(await compiled(readFileSync(MODULE))), () => 0);
  const numbers = new Float64Array(AT.NUMBERS);
  fill(numbers, DESIGN, PRESET);
  const [count, spreads] = [5, Array(FACTORS).fill(0.1)];
  const task = { numbers, size: sizeOf(DESIGN, PRESET), spreads, rigs: count };
  const [usual] = [...rigs.cloud(task)].filter(Boolean);
  const drawn = new Float64Array(FACTORS * count);
  fillFactors(drawn, spreads, 0.02);
  const [same] = [...rigs.cloud({ ...task, spreads: [], drawn })].filter(Boolean);
  assert.deepEqual(same.poles, usual.poles);
  const [nominal] = [...rigs.cloud({ ...task, drawn: drawn.fill(1) })].filter(Boolean);
  assert.deepEqual(nominal.poles.subarray(0, 12), nominal.poles.subarray(12, 24), 'all alike');
  assert.notDeepEqual(nominal.poles, usual.poles);
});

test('a slow rig is shown with fewer responses', async () => {
  let clock = 0;
  const rigs = new ManyRigs(await instantiated(await compiled(readFileSync(MODULE))), () => (clock += 15));
  const numbers = new Float64Array(AT.NUMBERS);
  fill(numbers, DESIGN, PRESET);
  const task = { numbers, size: sizeOf(DESIGN, PRESET), spreads: Array(FACTORS).fill(0.1), rigs: 300 };
  const told = [...rigs.cloud(task)].filter(Boolean);
  assert.ok(told[0].judged > 0 && told[0].judged < FEW, String(told[0].judged));
  assert.deepEqual([told[1].judged, told.length], [300, 2]);
});

test('dots lie where their poles are, denser where there are several, unstable ones on top', () => {
  const view = { cx: 0, cy: 0, scale: 10, width: 20, height: 10 };
  const pixels = new Uint32Array(200);
  const [grey, red] = [0x333333, 0x0000ff];
  const poles = Float64Array.of(-0.5, 0, -0.5, 0, 0.5, 0.3, NaN, NaN, 9, 0, 0.5, 0.3);
  fillDots(pixels, view, 2, { poles, done: 3 }, [grey, red]);
  const at = (x, y) => [pixels[20 * y + x] & 0xffffff, pixels[20 * y + x] >>> 24];
  assert.deepEqual(at(4, 4), [grey, 192]);
  assert.deepEqual(at(5, 5), [grey, 192]);
  assert.deepEqual(at(14, 1), [red, 192]);
  assert.equal(pixels.filter(Boolean).length, 8);
  fillDots(pixels.fill(0), view, 2, { poles, done: 2000 }, [grey, red]);
  assert.deepEqual(at(4, 4), [grey, 112], 'lighter where there are many');
});
