// Which poles are dragged: the placed ones, the rotors', the observer's; and where a path leaves the left half-plane.
import assert from 'node:assert/strict';
import test from 'node:test';
import { crossings } from '../../static/machine/crossings.js';
import { axisOf, dragHandle, handlesOf, kindOf, nudgeHandle, numeralOf } from '../../static/model/handles.js';
import { designOf } from '../../static/model/store.js';
import { pick } from '../../static/splane/math.js';
import { PRESETS } from './presets.mjs';

const HOW = { snap: 0.1, meet: 0.1, together: false };
const plain = designOf(PRESETS[0]);
const whole = { ...plain, place_rotors: true, scenario: { ...plain.scenario, measured: 'observer' } };
const re = (design) => handlesOf(design).map((p) => p?.re);

test('a handle for each pole that can be placed, and for no other', () => {
  assert.deepEqual(re(plain), [-12, -10, -9.25, -8.76, undefined, undefined]);
  assert.deepEqual(re(whole), [-12, -10, -9.25, -8.76, -15, -16, -40, -42, -41, -43]);
  assert.equal(handlesOf({ ...whole, observer: { method: 'kalman' } }).length, 6);
  assert.deepEqual([0, 3, 4, 5, 6, 9].map(kindOf), ['placed', 'placed', 'rotor', 'rotor', 'observer', 'observer']);
  assert.deepEqual([0, 2, 4, 5, 7, 8].map(axisOf), [0, 1, 0, 1, 0, 1]);
  assert.deepEqual([0, 4, 6, 9].map(numeralOf), ['1', '5', 'q1', 'q4']);
});

test('a rotor stays on the real axis, an observer pair turns complex, the others stay where they are', () => {
  const rotor = dragHandle(whole, 5, { re: -20, im: 7 }, HOW).design;
  assert.deepEqual(rotor, { ...whole, rotor_poles: [-15, -20] });
  const { design } = dragHandle(whole, 8, { re: -43, im: 6 }, HOW);
  assert.deepEqual(design.observer.poles.slice(2), [
    { re: -43, im: 6 },
    { re: -43, im: -6 },
  ]);
  assert.deepEqual([design.poles, design.observer.poles[0]], [whole.poles, { re: -40, im: 0 }]);
  assert.deepEqual(nudgeHandle(whole, 4, { re: -1, im: 1 }).rotor_poles, [-16, -16]);
  assert.equal(nudgeHandle(whole, 6, { re: -1, im: 0 }).observer.poles[0].re, -41);
});

test('a press takes no handle that is not there', () => {
  const view = { cx: -20, cy: 0, scale: 10, width: 600, height: 300 };
  const order = [9, 8, 7, 6, 5, 4, 3, 2, 1, 0];
  const at = { x: 300 + 10 * (-15 + 20), y: 150 };
  assert.equal(pick(view, handlesOf(whole), order, at, 8), 4);
  assert.equal(pick(view, handlesOf(plain), order, at, 8), null);
});

test('a path is marked where it leaves the left half-plane', () => {
  const path = [
    { re: -2, im: 1 },
    { re: -1, im: 3 },
    { re: 1, im: 5 },
    { re: 2, im: 6 },
  ];
  assert.deepEqual(crossings(path), [{ re: 0, im: 4 }]);
  assert.deepEqual(crossings(path.slice(0, 2)), []);
});
