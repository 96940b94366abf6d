// The state: what can be undone, what counts as one step, and what is sent.
import assert from 'node:assert/strict';
import { beforeEach, test } from 'node:test';

import { bodyOf, designOf, requestOf, Store } from '../../static/model/store.js';
import { MACHINE } from './presets.mjs';

const PRESET = {
  name: 'rig',
  title: 'Rig',
  source: 'a manual',
  rig: 'helicopter',
  parameters: { m: 1 },
  limits: { V_p: 24, V_y: 15 },
  poles: [
    { re: -12, im: 0 },
    { re: -10, im: 0 },
    { re: -9, im: 0 },
    { re: -8, im: 0 },
  ],
  coupling: 'triangular',
  lead: 'pitch',
  outer: 'pi',
  pairing: 'diagonal',
  decoupler: false,
  loops: { pitch: { kp: 30, ti: 0.1 }, yaw: { kp: 20, ti: 0.2 } },
  ...MACHINE,
  scenario: { reference: { theta: 0.1, psi: 0.2 }, duration: 4 },
};
/** @type {Store} */
let store;
const kp = () => store.state.design.loops.pitch.kp;
const setKp = (value, how) =>
  store.edit((d) => ({ ...d, loops: { ...d.loops, pitch: { ...d.loops.pitch, kp: value } } }), how);

beforeEach(() => {
  store = new Store();
  store.set({ presets: [PRESET] });
  store.load(designOf(PRESET));
});

test("a preset's design is its own copy", () => {
  store.state.design.loops.pitch.kp = 1;
  assert.equal(PRESET.loops.pitch.kp, 30);
  assert.equal(store.preset, PRESET);
});

test('edits are undone and redone one by one', () => {
  setKp(1);
  setKp(2);
  store.undo();
  assert.equal(kp(), 1);
  store.undo();
  assert.equal(kp(), 30);
  assert.equal(store.state.canUndo, false);
  store.redo();
  store.redo();
  assert.equal(kp(), 2);
  assert.equal(store.state.canRedo, false);
});

test('a gesture is one step, however many edits it has', () => {
  for (const value of [1, 2, 3, 4]) setKp(value, { gesture: 'drag' });
  store.undo();
  assert.equal(kp(), 30);
});

test('two gestures of the same name are two steps once the first is over', () => {
  setKp(1, { gesture: 'drag' });
  store.commit();
  setKp(2, { gesture: 'drag' });
  store.undo();
  assert.equal(kp(), 1);
});

test('an edit after undo forgets what was undone', () => {
  setKp(1);
  store.undo();
  setKp(5);
  assert.equal(store.state.canRedo, false);
  store.redo();
  assert.equal(kp(), 5);
});

test('undo beyond the beginning and an edit that changes nothing are silent', () => {
  let events = 0;
  store.addEventListener('design', () => events++);
  store.undo();
  store.edit((d) => d);
  assert.equal(events, 0);
});

test('each change of the design is announced with the time of its input', () => {
  const stamps = [];
  store.addEventListener('design', (e) => stamps.push(e.detail.stamp));
  setKp(1, { stamp: 12.5 });
  store.set({ motion: 'psi' });
  assert.deepEqual(stamps, [12.5]);
});

test('the request holds the whole design and asks for each axis', () => {
  const request = requestOf(store.state.design, 7);
  assert.equal(request.seq, 7);
  assert.equal(request.each_axis, true);
  assert.deepEqual(request.loops, PRESET.loops);
  assert.deepEqual(request.scenario.reference, { theta: 0.1, psi: 0.2 });
  assert.equal(request.scenario.duration, 4);
});

test('a design begins with full-rank placement, and as its preset has it', () => {
  const { method, decoupler, operating_point } = bodyOf(store.state.design);
  assert.deepEqual([method, decoupler, operating_point], ['full-rank', false, { theta: 0 }]);
  const other = designOf({ ...PRESET, decoupler: true, operating_point: { theta: 0.3 }, coupling: 'axis-decoupled' });
  assert.deepEqual([other.decoupler, other.theta0, other.coupling], [true, 0.3, 'axis-decoupled']);
});

test("a design's body is the request without number and experiment", () => {
  const { seq: _seq, scenario: _scenario, each_axis: _each, ...rest } = requestOf(store.state.design, 3);
  assert.deepEqual(rest, bodyOf(store.state.design));
});

test('a plant has a history of its own, which is that of its view', () => {
  store.editPlant('a');
  setKp(1);
  const { step } = store;
  store.set({ view: 'plant' });
  assert.deepEqual([store.step, store.state.canUndo, store.state.canRedo], [step, true, false]);
  store.editPlant('b');
  store.editPlant('b');
  assert.equal(store.step, step + 1);
  store.undo();
  assert.deepEqual([store.state.plant, kp(), store.state.canRedo], ['a', 1, true]);
  store.undo();
  store.undo();
  assert.deepEqual([store.state.plant, store.state.canUndo, kp()], [null, false, 1]);
  store.redo();
  store.set({ view: 'design' });
  assert.deepEqual([store.state.canUndo, store.state.canRedo], [true, false]);
  store.undo();
  assert.deepEqual([store.state.plant, kp()], ['a', 30]);
  store.set({ view: 'plant' });
  store.redo();
  assert.equal(store.state.plant, 'b');
});

test('what is typed of a plant before its field is left is one step, and the same in another order is none', () => {
  store.set({ view: 'plant' });
  for (const plant of ['A:1', 'A:2', 'A:3']) store.editPlant(plant, 'text 0');
  assert.equal(store.busy, false);
  store.commit();
  store.editPlant('A:4::B:1', 'text 0');
  store.commit();
  store.editPlant('B:1::A:4');
  assert.equal(store.state.plant, 'A:4::B:1');
  store.undo();
  assert.equal(store.state.plant, 'A:3');
  store.undo();
  assert.equal(store.state.plant, null);
});

test('pinned plants are four at most, none twice, each with a letter of its own', () => {
  const letters = () => store.state.plantPins.map(({ index, plant }) => `${index}${plant}`);
  store.addPlantPins([{ plant: 'A:1' }, { index: 3, plant: 'A:2' }, { index: 0, plant: 'A:3' }, { plant: 'A:1' }]);
  assert.deepEqual(letters(), ['0A:1', '3A:2', '1A:3']);
  const [first] = store.state.plantPins;
  store.changePlantPin(first.id, { refused: 'no' });
  store.unpinPlant(store.state.plantPins[1].id);
  store.addPlantPins([{ plant: 'A:5' }, { plant: 'A:6' }, { plant: 'A:7' }]);
  assert.deepEqual(letters(), ['0A:1', '1A:3', '2A:5', '3A:6']);
  assert.deepEqual([store.state.plantPins[0].refused, store.state.canUndo], ['no', false]);
});
