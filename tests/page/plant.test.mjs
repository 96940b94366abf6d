import assert from 'node:assert/strict';
import { test } from 'node:test';
import { powerOfTen, rangeOf, resampled } from '../../static/plant/curves.js';
import { linkText, matlabText, plantIn, withLetter } from '../../static/plant/link_text.js';
import { numbersIn, reader } from '../../static/plant/line.js';
import { designOf } from '../../static/plant/pins.js';
import { conjugateOf, moved, polesIn, polesLine, polesWord, proposal } from '../../static/plant/poles.js';
import { bodyOf, fitting, NO_WISH } from '../../static/plant/wish.js';
import { ProblemError } from '../../static/net/api.js';
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

test('a real pole takes along what it passes, however far it goes from one event to the next', () => {
  const poles = [c(-1), c(-0.8), c(-3), c(-6)];
  const pair = (to) =>
    moved(poles, 0, to, 0.1)
      .map((p, i) => (p.im ? i : -1))
      .filter((i) => i >= 0);
  assert.deepEqual(pair(c(-3.3, 1)), [0, 2], 'the one it has passed, not the one that was nearer');
  assert.deepEqual(pair(c(-9, -1)), [0, 2], 'of two the first');
  assert.deepEqual(pair(c(-0.5, 1)), [0, 1], 'to the right, too');
  assert.deepEqual(pair(c(-2.7, 1)), [0, 2], 'where it passes none, the nearest to where it leaves');
  assert.deepEqual(pair(c(-9, 0.05)), [], 'along the axis it passes all of them');
  assert.deepEqual(moved(poles, 3, c(-0.9, 2), 0.1)[2], c(-0.9, -2), 'and so does every other');
  const double = [c(-2), c(-2), c(-1.9)];
  assert.deepEqual(moved(double, 0, c(-1.8, 1), 0.1)[1], c(-1.8, -1), 'where it stands on one, that one');
});

test('numbers are read as people write them', () => {
  for (const text of ['1 0 -2.5', '[1; 0; -2.5]', '1, 0, −2.5', "x0 = [1 0 -2.5]';", 'np.array([[1], [0], [-2.5]])'])
    assert.deepEqual(numbersIn(text), [1, 0, -2.5], text);
  assert.deepEqual(numbersIn('  1e-3\t2E2\n.5'), [1e-3, 200, 0.5]);
  for (const text of ['1 x', '1 Infinity', '1e999', '1+j', 'NaN']) assert.equal(numbersIn(text), null, text);
  const read = reader(() => 2, { least: 1e-12 });
  assert.deepEqual(read('1 2'), [1, 2]);
  for (const text of ['', '1', '1 2 3', '1 0', '1 -1', '1 1e13', 'one'])
    assert.equal(typeof read(text), 'string', text);
  assert.deepEqual(reader(() => 1)('-5'), [-5]);
});

const matrix = (values) => ({ values, rows: values.map((row) => row.map(String)) });
const READ = {
  matrices: {
    A: matrix([
      [0, 1],
      [2, 3],
    ]),
    B: matrix([[0], [1]]),
    C: matrix([[1, 0]]),
  },
  analysis: { poles: [c(3), c(1)] },
};

test('what is wanted stays where it fits the system that is read; what is opened comes before what is typed', () => {
  const wish = {
    poles: [c(-1), c(-2)],
    observer: [c(-7), c(-8)],
    method: 'lqr',
    weights: { states: [1, 2], inputs: [3], integrals: [4] },
    x0: [5, 6],
  };
  assert.deepEqual(fitting(READ, wish, false), wish);
  const larger = { ...wish, poles: [c(-1)], observer: [c(-1)], x0: [1], weights: { states: [1], inputs: [1] } };
  const found = fitting(READ, larger, false);
  assert.deepEqual([found.observer, found.weights, found.x0], [null, null, null]);
  assert.equal(found.poles.length, 2);
  const typed = { ...READ, poles: [c(-5), c(-6)], observer_poles: [c(-9), c(-9)] };
  assert.deepEqual(fitting(typed, wish, false), { ...wish, poles: typed.poles, observer: typed.observer_poles });
  assert.deepEqual(fitting(typed, { ...wish, observer: null }, true), { ...wish, observer: null });
  const blind = { ...READ, matrices: { A: READ.matrices.A, B: READ.matrices.B } };
  const { observer, weights } = fitting(blind, wish, false);
  assert.deepEqual([observer, weights], [null, { states: [1, 2], inputs: [3] }], 'without C neither is');
  const two = {
    ...READ,
    matrices: {
      ...READ.matrices,
      C: matrix([
        [1, 0],
        [0, 1],
      ]),
    },
  };
  assert.equal(fitting(two, wish, false).weights.integrals, undefined);
});

test('a call has what is wanted, and nothing of what is not', () => {
  const { poles, ...rest } = { ...NO_WISH, poles: [c(-1), c(-2)] };
  assert.deepEqual(Object.keys(bodyOf(READ, { poles, ...rest })), ['A', 'B', 'C', 'poles', 'method', 'exactly']);
  const full = {
    ...rest,
    poles,
    weights: { states: [1, 1], inputs: [1], integrals: [9] },
    x0: [0, 1],
    observer: poles,
  };
  const body = bodyOf(READ, full, false);
  assert.deepEqual([body.weights.integrals, body.x0, body.observer_poles, body.exactly], [[9], [0, 1], poles, false]);
});

test('a pinned plant that is known by its link alone is read, fitted and designed', async () => {
  const asked = [];
  const ask = async (path, body) => {
    asked.push([path, body]);
    return path.endsWith('read') ? READ : { K: [[1, 2]] };
  };
  assert.deepEqual(await designOf('A:0,1:2,3::B:0:1::C:1,0::p:-4,-5::by:tits-yang::x:0,1', ask), { K: [[1, 2]] });
  assert.deepEqual(asked[0], ['api/v1/system/read', { text: 'A = [0 1; 2 3];\nB = [0; 1];\nC = [1 0];' }]);
  assert.deepEqual([asked[1][1].poles, asked[1][1].method, asked[1][1].x0], [[c(-4), c(-5)], 'tits-yang', [0, 1]]);
  for (const text of ['nothing', 'A:1::B:1::p:-x', 'A:1::B:1']) await assert.rejects(designOf(text, ask), ProblemError);
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
  method: 'lqr-integral',
  weights: { states: [1, 0], inputs: [2e-5], integrals: [30] },
  x0: [0.1, -2e-3],
};

test('a plant goes through a link unharmed', () => {
  const text = linkText(PLANT);
  assert.deepEqual(plantIn(unescaped(escaped(text))), PLANT);
  assert.match(text, /^A:0,1:-k\/m,-b\/\(M\+m\)::B:0:1\/m::/);
  const plain = { ...PLANT, observer: null, method: 'full-rank', weights: null, x0: null, letters: {} };
  assert.deepEqual(plantIn(linkText(plain)), plain);
  assert.deepEqual(plantIn(linkText(plain).replaceAll('+', ' ')), plain, 'where a plus was taken for a blank');
});

test('what is no plant is none', () => {
  for (const text of ['', 'x', 'A:1', 'B:1', `A:1::B:1${'0'.repeat(25000)}`]) assert.equal(plantIn(text), null);
  assert.equal(plantIn('A:1::B:1::p:x').poles, null);
  assert.equal(plantIn('A:1::B:1::.m:two').letters.m, undefined);
  assert.deepEqual([plantIn('A:1::B:1::x:1,').x0, plantIn('A:1::B:1::Q:1').weights], [null, null]);
  assert.deepEqual(plantIn('A:1::B:1::Q:1::R:2::Qz:a').weights, { states: [1], inputs: [2] });
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
