// Pairs of poles stay closed under conjugation, whatever is done to them.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { character, drag, isComplex, nudge, setComplex, setMode, setReal } from '../../static/model/poles.js';

const real = (...values) => values.map((re) => ({ re, im: 0 }));
const START = real(-12, -10, -9.25, -8.76);
const how = { snap: 0.3, meet: 0.5, together: false };

function assertClosed(poles) {
  for (const pair of [0, 1]) {
    const [a, b] = [poles[2 * pair], poles[2 * pair + 1]];
    const conjugate = a.re === b.re && a.im === -b.im;
    assert.ok(conjugate || (a.im === 0 && b.im === 0), JSON.stringify(poles));
  }
}

test('a real pole slides along the axis and leaves the others alone', () => {
  const { poles, together } = drag(START, 0, { re: -15, im: 3 }, how);
  assert.deepEqual(poles, real(-15, -10, -9.25, -8.76));
  assert.equal(together, false);
  assert.deepEqual(drag(START, 0, { re: -5, im: 0.2 }, how).poles, real(-5, -10, -9.25, -8.76), 'past its partner');
});

test('a real pole that a quick hand takes over its partner has met it, from either side', () => {
  for (const [index, re] of [
    [0, -5],
    [1, -14],
    [2, -8],
    [3, -20],
  ]) {
    const { poles, together } = drag(START, index, { re, im: 0.4 }, how);
    assert.equal(together, true);
    assert.equal(isComplex(poles, index < 2 ? 0 : 1), true);
    assert.deepEqual(poles[index], { re, im: 0.4 });
    assertClosed(poles);
  }
  assert.equal(drag(START, 1, { re: -8, im: 4 }, how).together, false, 'those of the other axis do not count');
});

test('a real pole that has met its partner leaves the axis together with it', () => {
  const met = drag(START, 0, { re: -10.2, im: 0.1 }, how);
  assert.equal(isComplex(met.poles, 0), false);
  const { poles, together } = drag(met.poles, 0, { re: -10.1, im: 2 }, how);
  assert.deepEqual(poles.slice(0, 2), [
    { re: -10.1, im: 2 },
    { re: -10.1, im: -2 },
  ]);
  assert.equal(together, true);
  assert.deepEqual(poles.slice(2), START.slice(2));
});

test('a pole never pairs with one of the other axis', () => {
  const { poles } = drag(START, 1, { re: -9.25, im: 4 }, how);
  assert.equal(isComplex(poles, 0), false);
});

test('either pole of a complex pair leads, and its conjugate follows', () => {
  const complex = setComplex(START, 0, { re: -3, im: 4 });
  const { poles } = drag(complex, 1, { re: -2, im: -5 }, how);
  assert.deepEqual(poles.slice(0, 2), [
    { re: -2, im: 5 },
    { re: -2, im: -5 },
  ]);
  assertClosed(poles);
});

test('near the axis a complex pair turns real, and complex again within the same gesture', () => {
  const complex = setComplex(START, 2, { re: -3, im: 4 });
  const down = drag(complex, 2, { re: -3, im: 0.2 }, how);
  assert.deepEqual(down.poles.slice(2), real(-3, -3));
  const up = drag(down.poles, 2, { re: -6, im: 1 }, { ...how, together: down.together });
  assert.deepEqual(up.poles.slice(2), [
    { re: -6, im: 1 },
    { re: -6, im: -1 },
  ]);
});

test('a new gesture takes a double real pole apart', () => {
  const double = setReal(setReal(START, 0, -5), 1, -5);
  const { poles } = drag(double, 0, { re: -7, im: 0 }, how);
  assert.deepEqual(poles.slice(0, 2), real(-7, -5));
});

test('keys move a pole, and take a met pair off the axis and back', () => {
  assert.deepEqual(nudge(START, 1, { re: 0.5, im: 0 })[1], { re: -9.5, im: 0 });
  assert.deepEqual(nudge(START, 1, { re: 0, im: 0.5 }), START);
  const double = setReal(setReal(START, 0, -5), 1, -5);
  const complex = nudge(double, 0, { re: 0, im: 0.5 });
  assert.deepEqual(complex.slice(0, 2), [
    { re: -5, im: 0.5 },
    { re: -5, im: -0.5 },
  ]);
  assert.deepEqual(nudge(complex, 0, { re: 0, im: -0.5 }).slice(0, 2), real(-5, -5));
});

test('a key never steps over the partner: there the pair meets, and the next press goes on', () => {
  const near = setReal(setReal(START, 2, -9.25), 3, -8.76);
  const met = nudge(near, 2, { re: 0.5, im: 0 });
  assert.deepEqual(met.slice(2), real(-8.76, -8.76));
  assert.equal(isComplex(nudge(met, 2, { re: 0, im: 0.5 }), 1), true);
  assert.deepEqual(nudge(met, 2, { re: 0.5, im: 0 }).slice(2), real(-8.26, -8.76));
  assert.deepEqual(nudge(near, 2, { re: 10, im: 0 })[2], { re: -8.76, im: 0 });
  assert.deepEqual(nudge(near, 2, { re: 0.1, im: 0 })[2], { re: -9.15, im: 0 });
});

test('changing the kind of a pair keeps it stable, and twice gives it back', () => {
  const complex = setMode(START, 0, true);
  assert.deepEqual(complex.slice(0, 2), [
    { re: -11, im: 2.75 },
    { re: -11, im: -2.75 },
  ]);
  for (const im of [0.1, 4, 40]) {
    const back = setMode(setComplex(START, 0, { re: -3, im }), 0, false);
    assert.ok(back[0].re < 0 && back[1].re < 0, JSON.stringify(back));
    assertClosed(back);
  }
  assert.deepEqual(setMode(START, 1, false), START);
});

test('any sequence of drags leaves both pairs closed', () => {
  let seed = 1;
  const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
  let state = { poles: START, together: false };
  for (let k = 0; k < 2000; k++) {
    if (random() < 0.1) state = { ...state, together: false };
    const to = { re: 20 * random() - 15, im: random() < 0.3 ? 0 : 10 * random() - 5 };
    const index = state.together ? 0 : Math.floor(4 * random());
    state = drag(state.poles, index, to, { ...how, together: state.together });
    assertClosed(state.poles);
  }
});

test('what is out of reach is clamped, what is no number becomes 0', () => {
  assert.equal(setReal(START, 0, -1e9)[0].re, -1e5);
  assert.equal(setReal(START, 0, NaN)[0].re, 0);
});

test("a pole's damping, frequency, settling time and overshoot", () => {
  const { wn, zeta, settling, overshoot } = character({ re: -3, im: 4 });
  assert.equal(wn, 5);
  assert.equal(zeta, 0.6);
  assert.ok(Math.abs(settling - 4 / 3) < 1e-12);
  assert.ok(Math.abs(overshoot - 9.478) < 1e-3);
  assert.equal(character({ re: 1, im: 1 }).settling, undefined);
  assert.equal(character({ re: -2, im: 0 }).overshoot, undefined);
});
