// Flights of a lab's step: which is the best, which counts with the design that is shown, what is handed in.
import assert from 'node:assert/strict';
import { beforeEach, test } from 'node:test';

import { flightOf, judgedFlight, StepFlights } from '../../static/labs/flights.js';
import { Outbox } from '../../static/labs/outbox.js';

const storage = new Map();
globalThis.localStorage = {
  getItem: (key) => storage.get(key) ?? null,
  setItem: (key, text) => storage.set(key, text),
};
globalThis.document = new EventTarget();

const WRITTEN = { digits: 2, scale: 180 / Math.PI, after: '°' };
const goal = (own) => ({
  kind: 'flight',
  written: WRITTEN,
  task: 'hold',
  figure: 'flight_error_rms',
  points: 1,
  ...own,
});
const PITCH = goal({ axis: 'theta', max: Math.PI / 180, points: 3 });
const YAW = goal({ axis: 'psi', max: (2 * Math.PI) / 180 });
const STEP = { name: 'hold', goals: [PITCH, YAW, { kind: 'setting' }] };
const rad = (degrees) => (degrees * Math.PI) / 180;
const values = (theta, psi, by_hand = 0) => ({ flight_error_rms: { theta: rad(theta), psi: rad(psi) }, by_hand });
let design;
let told;

beforeEach(() => {
  storage.clear();
  design = { method: 'full-rank', poles: [-1, -2, -3, -4], scenario: { reference: { theta: 0.1 }, digital: {} } };
  told = 0;
});

/** Of a step, as its panel has them. */
function flights(step = STEP, signal = new AbortController().signal) {
  const own = new StepFlights({
    nameOf: (name) => `flight.${name}`,
    design: () => design,
    whole: (body) => ({ method: 'full-rank', ...body }),
    told: () => (told += 1),
  });
  own.listen(signal);
  own.show(step);
  return own;
}

/** A task was flown to its end, with the design that is shown; what it says anyway no log repeats. */
function flown(checksum, own, task = 'hold', events = []) {
  const { method: _usual, ...body } = design;
  const log = { task, checksum, ticks: 10, seed: 1, design: body, events };
  globalThis.document.dispatchEvent(Object.assign(new Event('flown'), { detail: { log, values: own } }));
}

test('a figure of a flight is judged as it is shown, of both axes by the worse, and by whose hands it was', () => {
  assert.deepEqual(judgedFlight(PITCH, values(1.004, 9)), { met: true, text: '1.00°' });
  assert.equal(judgedFlight(PITCH, values(1.006, 0)).met, false);
  assert.equal(judgedFlight({ ...YAW, axis: 'both' }, values(2.5, 0.1)).met, false);
  assert.equal(judgedFlight({ ...YAW, axis: 'both' }, values(1.9, 0.1)).met, true);
  assert.equal(judgedFlight({ ...PITCH, hands: 'on' }, values(0.5, 0, 0.97)).met, false);
  assert.equal(judgedFlight({ ...PITCH, hands: 'on' }, values(0.5, 0, 0.99)).met, true);
  assert.equal(judgedFlight({ ...PITCH, hands: 'off' }, values(0.5, 0, 0.01)).met, false);
  assert.equal(judgedFlight({ ...PITCH, hands: 'off' }, values(0.5, 0)).met, true);
  assert.equal(judgedFlight({ ...PITCH, written: undefined }, values(0.5, 0)).met, null);
  assert.deepEqual(judgedFlight(PITCH, {}), { met: false, text: 'not reached' });
  const share = { ...PITCH, axis: null, figure: 'by_hand', written: { digits: 0, scale: 100, after: ' %' }, max: 0.5 };
  assert.deepEqual(judgedFlight(share, values(0, 0, 0.504)), { met: true, text: '50 %' });
});

test('what is flown in a step is told once', () => {
  assert.equal(flightOf({ goals: [{ kind: 'figure' }] }), null);
  assert.deepEqual(flightOf(STEP), { task: 'hold' });
  assert.deepEqual(flightOf({ goals: [{ ...PITCH, seed: 0 }] }), { task: 'hold', seed: 0 });
  const free = [PITCH, { ...YAW, hands: 'on', changes: 'allowed' }].map((own) => ({ ...own, changes: 'allowed' }));
  assert.deepEqual(flightOf({ goals: free }), { task: 'hold', hands: 'on', changes: 'allowed' });
});

test('the flight of most points is kept, of those alike the nearer one, and a page reads it again', () => {
  const own = flights();
  assert.equal(own.best, null);
  flown('a', values(0.5, 9));
  flown('b', values(2, 0.5)); // fewer points
  assert.equal(own.best.log.checksum, 'a');
  flown('c', values(0.5, 6)); // as many, nearer
  flown('d', values(0.5, 7));
  assert.equal(own.best.log.checksum, 'c');
  flown('e', values(0.9, 1.9));
  flown('x', values(0.1, 0.1), 'land'); // of another task
  const seeded = flights({ ...STEP, name: 'seeded', goals: [{ ...PITCH, seed: 7 }] });
  flown('y', values(0.9, 1.9)); // through other gusts
  assert.equal(seeded.best, null);
  assert.equal(own.best.log.checksum, 'e');
  assert.equal(flights().best.log.checksum, 'e');
  assert.equal(told >= 5, true);
});

test('a flight counts with the design that flew, and with others where changes are allowed', () => {
  const own = flights();
  flown('a', values(0.5, 0.5));
  design = { ...design, scenario: { ...design.scenario, reference: { theta: 1 }, duration: 9 } };
  assert.equal(own.best.log.checksum, 'a');
  design = { ...design, poles: [-1, -2, -3, -5] };
  assert.deepEqual([own.best, own.stale], [null, true]);
  const free = { ...STEP, goals: STEP.goals.map((one) => ({ ...one, changes: 'allowed' })) };
  assert.equal(flights(free).best.log.checksum, 'a');
  flown('b', values(3, 9)); // worse, but of the design that is shown
  assert.deepEqual([own.best.log.checksum, own.stale], ['b', false]);
});

test('a flight in which the design was changed does not count, but where that is allowed', () => {
  const own = flights();
  const changes = [5, 'design', { ...design, poles: [-1, -2, -3, -5] }];
  const asked = [7, 'design', { scenario: { digital: {}, reference: { theta: 0.3 } }, poles: design.poles }];
  flown('a', values(0.5, 0.5), 'hold', [[3, 'turn', 0, 0], changes, asked]);
  assert.deepEqual([own.best, own.changed, told > 0], [null, true, true]);
  flown('b', values(2, 3), 'hold', [asked]); // no more than its set points
  assert.deepEqual([own.best.log.checksum, own.changed], ['b', false]);
  const free = flights({ ...STEP, name: 'free', goals: STEP.goals.map((one) => ({ ...one, changes: 'allowed' })) });
  flown('c', values(0.5, 0.5), 'hold', [changes]);
  assert.deepEqual([free.best.log.checksum, free.changed], ['c', false]);
  assert.deepEqual([own.best.log.checksum, own.changed], ['b', true]);
  own.show(STEP);
  assert.equal(own.changed, false);
});

test('a step without flights has none, and one that is left hears of none', () => {
  const gone = new AbortController();
  const own = flights(STEP, gone.signal);
  gone.abort();
  flown('a', values(0.5, 0.5));
  assert.equal(own.best, null);
  const none = flights({ name: 'settle', goals: [{ kind: 'figure', points: 1 }] });
  flown('a', values(0.5, 0.5));
  assert.equal(none.best, null);
});

test('of attempts that wait long the newest twenty keep their flights, and all are sent', async () => {
  let away = true;
  const sent = [];
  const box = new Outbox(
    async (attempt) => {
      if (away) throw new Error('away');
      sent.push(attempt);
      return { points: 1 };
    },
    (act) => act(),
  );
  const put = (n) => box.put({ id: `${n}`, step: 'hold', flight: n % 2 ? { checksum: `${n}` } : undefined });
  for (let n = 0; n < 50; n++) put(n);
  await box.flush();
  away = false;
  await box.flush();
  assert.deepEqual(
    sent.map(({ id }) => id),
    Array.from({ length: 50 }, (_, n) => `${n}`),
  );
  const kept = sent.filter(({ flight }) => flight).map(({ id }) => Number(id));
  assert.deepEqual(
    kept,
    Array.from({ length: 20 }, (_, n) => 11 + 2 * n),
  );
});
