// Pinned designs: letters, the table of differences, what the plots save, and the store's keeping of them.
import assert from 'node:assert/strict';
import { beforeEach, test } from 'node:test';

import { guarded } from '../../static/model/locks.js';
import { PinKeeper } from '../../static/link/pin_keeper.js';
import { differenceTable, FIGURES, letterOf } from '../../static/model/pins.js';
import { csvOf, linesOf } from '../../static/plots/export.js';
import { designOf, Store } from '../../static/model/store.js';
import { ProblemError } from '../../static/net/api.js';
import { PRESETS } from './presets.mjs';

const axis = (rise, overshoot, V) => ({
  nonlinear: {
    t: [0, 0.5, 1],
    theta: [0, 0.1, rise],
    psi: [0, 0, 0],
    V_p: [1, V, 1],
    V_y: [0, 0, 0],
    metrics: {
      theta: { rise_time: rise, overshoot },
      psi: { rise_time: rise },
      V_p: { peak: V, saturated: 0 },
      V_y: { peak: 1, saturated: 0 },
    },
  },
});
const reply = (norm, rise, margins, stable = true) => ({
  stable,
  gains: { norm, K: [[norm]] },
  step: axis(rise, 3, 9),
  axis_steps: { theta: axis(rise, 3, 9), psi: axis(rise, 1, 12) },
  margins,
});
const column = (table, id) => table.map((row) => row[FIGURES.findIndex((f) => f.id === id)]);

/** @type {Store} */ let store;
beforeEach(() => {
  store = new Store();
  store.set({ presets: PRESETS, methods: [] });
  store.load(designOf(PRESETS[0]));
});

test('letters go on after Z', () => {
  assert.deepEqual([0, 25, 26, 53].map(letterOf), ['A', 'Z', 'A2', 'B3']);
});

test('differences are those to the present design, less is better but for margins, and the best is marked', () => {
  const m = (gain, phase) => ({
    pitch: { gain_margin: gain, phase_margin: phase },
    yaw: { gain_margin: 9, phase_margin: 3 },
  });
  const table = differenceTable([reply(100, 0.3, m(2, 1)), reply(80, 0.4, m(4, 0.5)), null]);
  assert.deepEqual(
    column(table, 'norm').map((c) => [c.text, c.shift, c.best, c.better, c.worse]),
    [
      ['100.0', '', false, false, false],
      ['80.00', '−20.00', true, true, false],
      ['–', '', false, false, false],
    ],
  );
  assert.deepEqual(
    column(table, 'rise-theta').map((c) => [c.shift, c.best, c.worse]),
    [
      ['', true, false],
      ['+0.10 s', false, true],
      ['', false, false],
    ],
  );
  assert.deepEqual(
    column(table, 'gain')
      .slice(0, 2)
      .map((c) => [c.text, c.shift, c.better]),
    [
      ['6.0 dB', '', false],
      ['12.0 dB', '+6.0 dB', true],
    ],
  );
  assert.equal(column(table, 'V_p')[0].text, '12.0 V'); // the harder of both steps
});

test('what has not settled within the window says so, and is never the best', () => {
  const of = (own) => ({ ...reply(100, 0.3), axis_steps: { theta: { nonlinear: { metrics: { theta: own } } } } });
  const cells = column(
    differenceTable([
      of({ settled: false }),
      of({ settled: true, settling_time: 2.5 }),
      of({ settled: true, settling_time: 1.5 }),
    ]),
    'settling-theta',
  );
  assert.deepEqual(
    cells.map((c) => [c.text, c.shift, c.best]),
    [
      ['not settled', '', false],
      ['2.50 s', '', false],
      ['1.50 s', '', true],
    ],
  );
});

test('an unstable design has no figures of its step, and figures that read the same do not differ', () => {
  const table = differenceTable([reply(100, 0.3), reply(100.001, 0.3, undefined, false)]);
  assert.equal(column(table, 'rise-theta')[1].text, '–');
  assert.equal(column(table, 'norm')[1].shift, '');
});

test('a pin keeps design, its reply only if that answers it, and takes the first free letter', () => {
  const { design } = store.state;
  store.set({ reply: reply(1, 1), answered: design, heard: design });
  store.pin();
  store.edit((d) => ({ ...d, theta0: 0.1 }));
  store.pin();
  assert.deepEqual(
    store.state.pins.map((p) => [p.name, p.design.theta0, p.reply !== null]),
    [
      ['Design A', 0, true],
      ['Design B', 0.1, false],
    ],
  );
  store.unpin(store.state.pins[0].id);
  store.pin();
  assert.deepEqual(
    store.state.pins.map((p) => p.index),
    [1, 0],
  );
});

test('using a pin is one step that can be undone', () => {
  store.pin();
  store.edit((d) => ({ ...d, theta0: 0.1 }));
  store.usePin(store.state.pins[0].id);
  assert.equal(store.state.design.theta0, 0);
  store.undo();
  assert.equal(store.state.design.theta0, 0.1);
});

test('what is locked stays, whatever changes it; the rest of the change is made', () => {
  store.set({ locks: ['poles', 'loops'] });
  const { poles, loops } = store.state.design;
  store.edit(() => designOf(PRESETS[1]));
  assert.equal(store.state.design.preset, 'quanser-aero');
  assert.deepEqual([store.state.design.poles, store.state.design.loops], [poles, loops]);
  let events = 0;
  store.addEventListener('design', () => events++);
  store.edit((d) => ({ ...d, poles: d.poles.slice() }));
  assert.equal(events, 0);
  assert.equal(store.state.canUndo, true);
  const { design } = store.state;
  assert.equal(guarded(design, { ...design, decoupler: true }, ['loops']), design);
});

class FakeStorage {
  items = new Map();
  getItem = (key) => this.items.get(key) ?? null;
  setItem = (key, value) => void this.items.set(key, value);
  removeItem = (key) => void this.items.delete(key);
}

test('missing replies are asked for one by one while open, refusals are told, and pins outlast a reload', async () => {
  const storage = new FakeStorage();
  const asked = [];
  const ask = async (request) => {
    asked.push(request.operating_point.theta);
    if (request.operating_point.theta === 0.2) throw new ProblemError({ detail: 'no such rig' });
    return reply(1, 1);
  };
  const keeper = new PinKeeper(store, { ask, storage });
  keeper.open();
  for (const theta0 of [0.1, 0.2]) {
    store.edit((d) => ({ ...d, theta0 }));
    store.pin();
  }
  keeper.render(store.state);
  assert.deepEqual(asked, []); // not connected
  store.set({ connection: 'open' });
  for (let k = 0; k < 3; k++) {
    keeper.render(store.state);
    await new Promise((resolve) => setImmediate(resolve));
  }
  assert.deepEqual(asked, [0.1, 0.2]);
  assert.deepEqual(
    store.state.pins.map((p) => [p.reply !== null, p.refused]),
    [
      [true, undefined],
      [false, 'no such rig'],
    ],
  );

  const other = new Store();
  other.set({ presets: PRESETS });
  other.load(designOf(PRESETS[0]));
  other.addPins([{ index: 0, name: 'from the link', design: designOf(PRESETS[1]), reply: null }]);
  new PinKeeper(other, { ask, storage }).open();
  assert.deepEqual(
    other.state.pins.map((p) => [p.index, p.name, p.design.theta0]),
    [
      [0, 'from the link', 0],
      [1, 'Design A', 0.1],
      [2, 'Design B', 0.2],
    ],
  );
  for (const pin of store.state.pins) store.unpin(pin.id);
  keeper.render(store.state);
  assert.equal(storage.items.size, 0);
});

test("a plot's numbers: units in the header, a column for each line, another time where a pin has one", () => {
  store.set({ reply: reply(1, 0.2), answered: store.state.design, heard: store.state.design });
  store.pin();
  const pin = store.state.pins[0];
  const slow = structuredClone(pin.reply);
  slow.axis_steps.theta.nonlinear.t = [0, 1, 2];
  store.changePin(pin.id, { reply: slow, name: 'a "slow", one' });
  const csv = csvOf('theta', linesOf({ ...store.state, showLinear: false }, 'theta'));
  const rows = csv.trimEnd().split('\r\n');
  assert.equal(
    rows[0],
    't [s],"theta, pitch step [deg]","theta, yaw step [deg]",t [s],"theta, A a ""slow"", one, pitch step [deg]",t ' +
      '[s],"theta, A a ""slow"", one, yaw step [deg]","theta, both steps [deg]"',
  );
  assert.equal(rows.length, 4);
  assert.deepEqual(rows[2].split(',').map(Number), [0.5, 5.729578, 5.729578, 1, 5.729578, 0.5, 5.729578, 5.729578]);
  assert.match(csvOf('V_p', linesOf(store.state, 'V_p')), /^t \[s\],"V_p, pitch step \[V\]"/);
  const beside = { plotted: true, t: [0, 0.5], theta: [0, Math.PI / 18], psi: [0, 0], V_p: [1, 2], V_y: [3, 4] };
  const [recorded] = linesOf({ ...store.state, beside }, 'theta').filter((l) => l.kind === 'recorded');
  assert.deepEqual([recorded.t, [...recorded.values].map((v) => v.toFixed(6))], [beside.t, ['0.000000', '10.000000']]);
  assert.ok(
    linesOf({ ...store.state, beside: { ...beside, plotted: false } }, 'V_p').every((l) => l.kind !== 'recorded'),
  );
});

test('pinned plants outlast a reload beside those of the link, with the plant from which they differ', () => {
  const storage = new FakeStorage();
  const keeper = new PinKeeper(store, { storage });
  keeper.open();
  store.editPlant('A:1::B:1::p:-1');
  store.addPlantPins([{ plant: 'A:1::B:1::p:-2' }, { plant: 'A:5::B:1' }]);
  keeper.render(store.state);
  store.editPlant('A:9::B:1'); // is not noted, and need not be
  keeper.render(store.state);
  const other = new Store();
  other.set({ presets: PRESETS });
  other.load(designOf(PRESETS[0]));
  other.addPlantPins([{ plant: 'A:7::B:1' }, { plant: 'B:1::A:5' }]);
  new PinKeeper(other, { storage }).open();
  assert.deepEqual(
    other.state.plantPins.map((p) => [p.index, p.plant]),
    [
      [0, 'A:7::B:1'],
      [1, 'B:1::A:5'],
      [2, 'A:1::B:1::p:-2'],
    ],
  );
  for (const pin of store.state.plantPins) store.unpinPlant(pin.id);
  keeper.render(store.state);
  assert.equal(storage.items.size, 0);
});
