// What is read off the comparisons: the best of a column, margins, splits, dominance in words.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import {
  best,
  dominanceWords,
  hardest,
  inOrder,
  logSpaced,
  pairText,
  sameSplit,
  worseMargins,
} from '../../static/model/compare_math.js';

const real = (...values) => values.map((re) => ({ re, im: 0 }));
const pair = (re, im) => [
  { re, im },
  { re, im: -im },
];

test('frequencies are spaced evenly on a logarithmic axis, ends included', () => {
  const w = logSpaced(0.01, 1000, 121);
  assert.equal(w.length, 121);
  assert.deepEqual([w[0], w[24], w[120]], [0.01, 0.1, 1000]);
});

test('the best is the least that is known, and what reads the same', () => {
  assert.deepEqual([...best([3, 1, undefined, 2], ['3', '1', '–', '2'])], [1]);
  assert.deepEqual([...best([1.001, 1.002, 5, 6, NaN], ['1.0', '1.0', '5.0', '6.0', '–'])], [0, 1]);
});

test('where most are alike, or only one is known, none stands out', () => {
  assert.equal(best([1, 1, 1, 2], ['1', '1', '1', '2']).size, 0);
  assert.equal(best([1e-9, 1e-9, 1e-9], ['5e-14', '1e-13', '2e-12']).size, 0);
  assert.equal(best([undefined, 4], ['–', '4']).size, 0);
});

test('the smaller margins of both motors; a missing gain margin is infinite', () => {
  assert.deepEqual(worseMargins({ pitch: { phase_margin: 1.2 }, yaw: { gain_margin: 7, phase_margin: 1.3 } }), {
    gain: 7,
    phase: 1.2,
  });
  assert.equal(worseMargins({ pitch: { phase_margin: 1 } }).gain, Infinity);
  assert.equal(worseMargins({}), undefined);
});

test("a motor's peak is the higher of both steps", () => {
  const steps = {
    theta: { V_p: { peak: 17, saturated: 0 }, V_y: { peak: 4, saturated: 0 } },
    psi: { V_p: { peak: 12, saturated: 0.25 }, V_y: { peak: 6, saturated: 0 } },
  };
  assert.deepEqual(hardest(steps), { V_p: { peak: 17, saturated: 0.25 }, V_y: { peak: 6, saturated: 0 } });
  assert.equal(hardest(undefined).V_p, undefined);
});

test('a pair in words', () => {
  assert.equal(pairText(real(-12, -9.25)), '\u221212.0, \u22129.25');
  assert.equal(pairText(pair(-1.8, 1)), '\u22121.80 ± 1.00j');
});

test('poles in order stay closed pairs, however they were dealt', () => {
  const poles = [...real(-3, -1), ...pair(-2, 1)];
  assert.deepEqual(inOrder(poles), [{ re: -2, im: -1 }, { re: -2, im: 1 }, ...real(-3, -1)]);
  assert.deepEqual(inOrder([...pair(-2, 1), ...real(-1, -3)]), inOrder(poles));
  assert.deepEqual(
    inOrder([...pair(-2, 3), ...pair(-2, 1)]).map((p) => p.im),
    [-1, 1, -3, 3],
  );
});

test('a split is the same whatever the order within its pairs, and another when the pairs change places', () => {
  const poles = real(-12, -10, -9, -8);
  assert.ok(sameSplit(poles, real(-10, -12, -8, -9)));
  assert.ok(!sameSplit(poles, real(-9, -8, -12, -10)));
  assert.ok(!sameSplit(poles, real(-12, -9, -10, -8)));
});

const W = [0.01, 1, 100, 1000];
const dominance = (rows, columns) => ({ rows: rows.map((v) => [v, v / 2]), columns: columns.map((v) => [v / 2, v]) });

test('dominance at all frequencies, as the paper says', () => {
  const { dominant, text } = dominanceWords(W, dominance([0.2, 0.3384, 0.3, 0.3], [0.1, 0.1, 0.1, 0.1]));
  assert.equal(dominant, true);
  assert.match(
    text,
    /^Between 0.01 and 1000 rad\/s Ĝ\(jω\) is diagonally dominant everywhere, by rows and by columns, as the paper/,
  );
  assert.match(text, /reach 0.338 of the diagonal ones, at 1 rad\/s\.$/);
});

test('dominance that fails is told with where', () => {
  const words = (rows, columns) => dominanceWords(W, dominance(rows, columns)).text;
  assert.match(
    words([0.2, 0.2, 2, 3], [0.1, 0.1, 0.1, 0.1]),
    /by rows only below 100 rad\/s, by columns everywhere\. .*reach 3 .*at 1000 rad\/s/,
  );
  assert.match(
    words([2, 0.2, 0.2, 0.2], [0.1, 2, 2, 0.1]),
    /by rows only above 0.01 rad\/s, by columns except between 1 rad\/s and 100 rad\/s/,
  );
  assert.match(words([0.1, 2, 0.1, 0.1], [0.1, 2, 0.1, 0.1]), /dominant except at 1 rad\/s, by rows and by columns\./);
  assert.match(words([2, 2, 2, 2], [3, 3, 3, 3]), /nowhere diagonally dominant, neither by rows nor by columns\./);
  assert.equal(dominanceWords(W, dominance([1, 0.2, 0.2, 0.2], [0.1, 0.1, 0.1, 0.1])).dominant, false);
});

test('a diagonal entry that vanishes is no dominance, and reaches no figure', () => {
  const { dominant, text } = dominanceWords([1, 10], {
    rows: [
      [null, 0.1],
      [0.1, 0.1],
    ],
    columns: [
      [0.1, 0.1],
      [0.1, 0.1],
    ],
  });
  assert.equal(dominant, false);
  assert.ok(!text.includes('reach'));
});
