// Many designs in workers: what is told and when, who overtakes whom, and figures that are those of an update.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { DesignRows } from '../../static/kernel/design_rows.js';
import { loadDesigns } from '../../static/kernel/designs.js';
import { AT, FACTORS, PLAIN } from '../../static/kernel/layout.js';
import { compiled, instantiated, MODULE } from '../../static/kernel/module.js';
import { fill, sizeOf } from '../../static/kernel/numbers.js';
import { replyOf } from '../../static/kernel/reply.js';
import { Updates } from '../../static/kernel/updates.js';
import { designOf } from '../../static/model/index.js';
import { PRESETS } from './presets.mjs';

const parameters = {
  ...{ K_pp: 0.204, K_py: 0.0068, K_yp: 0.0219, K_yy: 0.072, J_p: 0.0384, J_y: 0.0432 },
  ...{ m: 1.3872, l: 0.186, B_p: 0.8, B_y: 0.318, K_s: 0.0, g: 9.81 },
};
const encoders = { theta: 4096, psi: 8192 };
const PRESET = { parameter_info: {}, limit_info: {}, encoders, ...PRESETS[0], parameters };
const DESIGN = designOf(PRESET);
const models = { linear: { findings: [] }, nonlinear: { findings: [] } };
/** What only a server can say, left out. */
const SAID = { findings: [], gains: {}, rga: {}, step: models, axis_steps: { theta: models, psi: models } };
const kernels = await instantiated(await compiled(readFileSync(MODULE)));

const numbersOf = (design) => {
  const numbers = new Float64Array(AT.NUMBERS);
  fill(numbers, design, PRESET);
  return numbers;
};

/** Workers that answer when the test says so; of a design their figure is the number that stands at its place. */
async function pool(cores) {
  const sent = [];
  const workers = [];
  const open = () => {
    const worker = {
      ended: false,
      terminate: () => (worker.ended = true),
      postMessage({ id, part }) {
        if (part) sent.push({ worker, id, part });
        else queueMicrotask(() => worker.onmessage({ data: { ready: true } }));
      },
    };
    workers.push(worker);
    return worker;
  };
  const designs = await loadDesigns(null, open, cores);
  const answer = (what = sent.shift(), ms = 0) => {
    const n = what.part.values.length;
    const found = {
      values: what.part.values.slice(),
      stable: new Uint8Array(n).fill(2),
      abscissa: new Float64Array(n).fill(-1),
      poles: new Float64Array(),
    };
    what.worker.onmessage({ data: { id: what.id, found, ms: ms * n } });
  };
  const all = () => {
    while (sent.length) answer();
  };
  return { designs, sent, workers, answer, all };
}

const task = (count, more = {}) => ({
  numbers: new Float64Array(AT.NUMBERS),
  size: PLAIN,
  at: [0],
  values: Float64Array.from({ length: count }, (_, i) => i + (more.from ?? 0)),
  measures: [{ name: 'disk_margin' }],
  ...more,
});

test('a task is told at its stops, in order, however the parts come back', async () => {
  const { designs, sent, answer, all } = await pool(2);
  const told = [];
  designs.lane().ask(task(500, { stops: [20, 100] }), (found) => told.push([found.done, [...found.values]]));
  assert.equal(new Set(sent.map(({ worker }) => worker)).size, 2, 'both workers take part in the first picture');
  while (sent.length > 1) answer(sent.pop());
  all();
  assert.deepEqual(
    told.map(([done]) => done),
    [20, 100, 500].slice(-told.length),
  );
  for (const [done, values] of told) assert.ok(values.slice(0, done).every((v, i) => v === i));
  assert.equal(told.at(-1)[0], 500);
});

test('the newest holds, but the one before has told its beginning', async () => {
  const { designs, sent, answer, all } = await pool(1);
  const lane = designs.lane();
  const told = [];
  const ask = (from) => lane.ask(task(300, { from, stops: [10] }), ({ values, done }) => told.push([values[0], done]));
  ask(1000);
  ask(2000);
  ask(3000);
  answer();
  assert.deepEqual(told, [[1000, 10]]);
  all();
  assert.deepEqual(told.slice(1), [
    [3000, 10],
    [3000, 300],
  ]);
  ask(4000);
  answer();
  ask(5000);
  lane.forget();
  all();
  assert.deepEqual(told.slice(3), [[4000, 10]]);
  assert.equal(sent.length, 0);
});

test('lanes take turns, and a hand that moves leaves a worker free', async () => {
  const { designs, sent, answer } = await pool(2);
  const [one, other] = [designs.lane(), designs.lane()];
  const told = [];
  one.ask(task(1000, { workers: 1 }), () => told.push('one'));
  assert.equal(new Set(sent.map(({ worker }) => worker)).size, 1);
  other.ask(task(64), () => told.push('other'));
  assert.equal(new Set(sent.map(({ worker }) => worker)).size, 2);
  while (!told.length) answer();
  assert.deepEqual(told, ['other']);
});

test('parts are as long as the work allows', async () => {
  const { designs, sent, answer } = await pool(1);
  const lane = designs.lane();
  lane.ask(task(1000), () => {});
  answer(sent.shift(), 2); // ms for each
  answer(sent.shift(), 2);
  assert.equal(sent.at(-1).part.values.length, 2);
});

test('where a worker fails, everybody is told, and nobody is asked again', async (t) => {
  t.mock.method(console, 'warn', () => {});
  const { designs, workers, sent } = await pool(2);
  const told = [];
  const lane = designs.lane();
  lane.ask(task(100), (found) => told.push(found));
  workers[0].onmessage({ data: { id: sent[0].id, problem: 'RangeError' } });
  assert.deepEqual(told, [null]);
  assert.ok(workers.every(({ ended }) => ended));
  assert.equal(designs.works, false);
  lane.ask(task(100), (found) => told.push(found));
  assert.deepEqual(told, [null, null]);
});

test('a pool that cannot be had rejects', async () => {
  const open = () => {
    const worker = {
      terminate() {},
      postMessage: () => queueMicrotask(() => worker.onmessage({ data: { problem: 'no modules here' } })),
    };
    return worker;
  };
  await assert.rejects(loadDesigns(null, open, 2), /no modules here/);
});

test('figures are those of an update, row by row, in any batch', () => {
  const updates = new Updates(kernels);
  const rows = new DesignRows(kernels);
  const measures = [
    { name: 'settling_time', axis: 'theta' },
    { name: 'overshoot', axis: 'psi', model: 'linear' },
    { name: 'coupling_peak', axis: 'theta' },
    { name: 'V_peak', motor: 'V_p', axis: 'theta' },
    { name: 'disk_margin' },
    { name: 'gain_margin', motor: 'V_y' },
    { name: 'lag_margin' },
    { name: 'norm' },
  ];
  const values = Float64Array.from({ length: 70 }, (_, i) => -0.5 - 0.1 * i);
  const part = { numbers: numbersOf(DESIGN), size: sizeOf(DESIGN, PRESET), at: [AT.POLES], values, measures };
  const found = rows.run({ ...part, poles: true });
  const size = part.size;
  for (const [i, re] of values.entries()) {
    const poles = DESIGN.poles.map((p, k) => (k ? p : { re, im: 0 }));
    fill(updates.numbers, { ...DESIGN, poles }, PRESET);
    const said = { reply: SAID, design: null };
    const block = updates.update(size, 2);
    const reply = replyOf(block, updates.numbers, { ...DESIGN, poles }, { size, samples: 2 }, said);
    const { theta, psi } = reply.axis_steps;
    assert.deepEqual(
      [...found.values.subarray(i * measures.length, (i + 1) * measures.length)],
      [
        theta.nonlinear.metrics.theta.settling_time ?? NaN,
        psi.linear.metrics.psi.overshoot,
        theta.nonlinear.metrics.coupling_peak,
        theta.nonlinear.metrics.V_p.peak,
        reply.sensitivity?.disk_margin ?? NaN,
        reply.stable ? (reply.margins?.yaw.gain_margin ?? Infinity) : NaN,
        reply.stable ? (reply.lag_margin ?? Infinity) : NaN,
        reply.gains.norm,
      ].map((v, k) => (reply.stable || k === 7 ? v : NaN)),
      `p1 = ${re}`,
    );
    assert.equal(found.stable[i], reply.stable ? 2 : 1);
    assert.equal(found.abscissa[i], Math.max(...reply.loop_poles.map((p) => p.re)));
    assert.equal(found.poles[2 * i * size], block.connected[0]);
  }
});

test('shares are of the same rigs under every design', () => {
  const rows = new DesignRows(kernels);
  const spreads = Array.from({ length: FACTORS }, (_v, k) => (k === 11 ? 0 : 0.2));
  const measures = [{ name: 'share_stable' }, { name: 'share_within_limits' }];
  const values = Float64Array.of(-1, -3, -1);
  const part = { numbers: numbersOf(DESIGN), size: PLAIN, at: [AT.POLES], values, measures };
  const found = rows.run({ ...part, rigs: { count: 40, spreads } }).values;
  assert.deepEqual([...found.subarray(0, 2)], [...found.subarray(4, 6)]);
  assert.ok([...found].every((v) => v >= 0 && v <= 1 && Number.isInteger(Math.round(v * 40 * 1e9) / 1e9)));
  assert.ok(found[0] > 0);
  const drawn = new Float64Array(FACTORS).fill(1); // the nominal rig
  assert.deepEqual([...rows.run({ ...part, rigs: { count: 1, drawn } }).values], Array(6).fill(1));
});
