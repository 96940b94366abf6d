import assert from 'node:assert/strict';
import { test } from 'node:test';
import { powerOfTen, rangeOf, resampled } from '../../static/plant/curves.js';
import { linkText, matlabText, plantIn, withLetter } from '../../static/plant/link_text.js';
import { conjugateOf, moved, polesIn, polesLine, polesWord, proposal } from '../../static/plant/poles.js';
import { escaped, unescaped } from '../../static/link/link_values.js';

const c = (re, im = 0) => ({ re, im });
const PAIR = [c(-1, 2), c(-1, -2), c(-3), c(-5)];

test('conjugates are found, also of pairs that coincide', () => {
  assert.deepEqual(
    PAIR.map((_, i) => conjugateOf(PAIR, i)),
    [1, 0, 2, 3],
  );
  const twice = [c(-1, 2), c(-1, 2), c(-1, -2), c(-1, -2)];
  assert.deepEqual(
    twice.map((_, i) => conjugateOf(twice, i)),
    [2, 3, 0, 1],
  );
});

test('a pole takes its conjugate along, wherever it goes', () => {
  assert.deepEqual(moved(PAIR, 0, c(-4, 1), 0.1).slice(0, 2), [c(-4, 1), c(-4, -1)]);
  assert.deepEqual(moved(PAIR, 1, c(-4, -1), 0.1).slice(0, 2), [c(-4, 1), c(-4, -1)]);
  assert.deepEqual(moved(PAIR, 0, c(-4, 0.05), 0.1).slice(0, 2), [c(-4), c(-4)], 'near the axis both turn real');
  assert.deepEqual(moved(PAIR, 2, c(-4, 0.05), 0.1)[2], c(-4), 'a real one stays on the axis');
  assert.deepEqual(
    moved(PAIR, 2, c(-4, 1), 0.1).slice(2),
    [c(-4, 1), c(-4, -1)],
    'off it, it takes the nearest real one',
  );
  assert.deepEqual(moved([c(-1)], 0, c(-2, 3), 0.1), [c(-2)], 'where there is none it stays real');
});

test('whatever is dragged, poles stay closed under conjugation', () => {
  let seed = 1;
  const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
  let poles = [c(-1), c(-2), c(-3), c(-4), c(-5)];
  for (let k = 0; k < 2000; k++) {
    poles = moved(poles, Math.floor(random() * 5), c(-4 * random(), 2 * random() - 1), 0.2);
    const sum = poles.reduce((total, p) => total + p.im, 0);
    assert.ok(Math.abs(sum) < 1e-9 && poles.every((p, i) => p.im === 0 || conjugateOf(poles, i) !== i));
  }
});

test('poles are read as people write them', () => {
  assert.deepEqual(polesIn('-1, -2±3j'), [c(-1), c(-2, 3), c(-2, -3)]);
  assert.deepEqual(polesIn('[-2+3j, -2-3j; −4]'), [c(-2, 3), c(-2, -3), c(-4)]);
  assert.deepEqual(polesIn('-2+3j'), [c(-2, 3), c(-2, -3)], 'one alone brings its conjugate');
  assert.deepEqual(polesIn('-3 + 4i, -1'), [c(-3, 4), c(-3, -4), c(-1)]);
  assert.equal(polesIn('-1, x'), null);
  assert.deepEqual(polesIn(polesLine(PAIR)), PAIR);
  assert.deepEqual(polesIn(polesWord(PAIR)), PAIR);
});

test('a proposal is real, stable and distinct', () => {
  const found = proposal([c(0, 2), c(0, -2), c(0), c(3)]);
  assert.ok(found.every((p) => p.im === 0 && p.re < 0));
  assert.equal(new Set(found.map((p) => p.re)).size, 4);
  assert.equal(proposal([c(0)])[0].re, -1);
});

const PLANT = {
  rows: {
    A: [
      ['0', '1'],
      ['-k/m', '-b/(M+m)'],
    ],
    B: [['0'], ['1/m']],
    C: [['1', '0']],
  },
  letters: { k: 3, m: 2, b: 1e-3, M: 1.5 },
  poles: [c(-1, 2), c(-1, -2)],
  observer: [c(-5), c(-6)],
  method: 'lqr',
  weights: { states: [1, 0], inputs: [2e-5] },
};

test('a plant goes through a link unharmed', () => {
  const text = linkText(PLANT);
  assert.deepEqual(plantIn(unescaped(escaped(text))), PLANT);
  assert.match(text, /^A:0,1:-k\/m,-b\/\(M\+m\)::B:0:1\/m::/);
  const plain = { ...PLANT, observer: null, method: 'full-rank', weights: null, letters: {} };
  assert.deepEqual(plantIn(linkText(plain)), plain);
  assert.deepEqual(plantIn(linkText(plain).replaceAll('+', ' ')), plain, 'where a plus was taken for a blank');
});

test('what is no plant is none', () => {
  for (const text of ['', 'x', 'A:1', 'B:1', `A:1::B:1${'0'.repeat(5000)}`]) assert.equal(plantIn(text), null);
  assert.equal(plantIn('A:1::B:1::p:x').poles, null);
  assert.equal(plantIn('A:1::B:1::.m:two').letters.m, undefined);
});

test('a plant is written as MATLAB has it', () => {
  assert.equal(
    matlabText(PLANT),
    'A = [0 1; -k/m -b/(M+m)];\nB = [0; 1/m];\nC = [1 0];\nk = 3, m = 2, b = 0.001, M = 1.5',
  );
});

test('a letter gets its value where it stands, or at the end', () => {
  assert.equal(withLetter('A = [m 0]; m = 2, k = 3', 'm', 5), 'A = [m 0]; m = 5, k = 3');
  assert.equal(withLetter('A = [m 0]\n', 'm', 5), 'A = [m 0]\nm = 5\n');
  assert.equal(withLetter('am = 1\nm = 2 % kg', 'm', 5), 'am = 1\nm = 5% kg');
});

test('lines are compared at the same places', () => {
  assert.deepEqual(resampled([0, 1, 2], [0, 10, 30], [0, 0.5, 1.5, 2, 3]), [0, 5, 20, 30, null]);
  assert.deepEqual(resampled([1, 2], [1, 2], [0, 1]), [null, 1]);
});

test('ranges hold all that is shown', () => {
  const [low, high] = rangeOf(
    [
      [0, 1],
      [null, 3],
    ],
    false,
  );
  assert.ok(low < 0 && high > 3 && high < 3.5);
  assert.deepEqual(rangeOf([[0.02, 500]], true), [0.01, 1000]);
  assert.deepEqual(rangeOf([[]], true), [0.1, 10]);
  const flat = rangeOf([[2, 2]], false);
  assert.ok(flat[0] < 2 && flat[1] > 2);
  assert.deepEqual([-5, 0, 2, 12].map(powerOfTen), ['10⁻⁵', '1', '100', '10¹²']);
});
