// The paper's section: counts, anchors, figures of numbers, the worked example.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import {
  anchorOf,
  centreSteps,
  clean,
  countsOf,
  dampingRatio,
  digitsText,
  figure,
  groupBy,
  minus,
  polesText,
  shortOf,
  thrustSteps,
} from '../../static/paper/math.js';

const COMPONENTS = {
  R_p: 0.83,
  R_y: 1.6,
  K_tp: 0.0182,
  K_ty: 0.0109,
  K_fp: 1.037,
  K_fy: 0.4278,
  r_p: 0.19685,
  r_y: 0.168275,
  m_p: 0.292,
  m_y: 0.128,
  m_shield: 0.167,
};

test("an equation's anchor and its name in the contents follow from its number", () => {
  assert.equal(anchorOf('Eq. 13'), 'eq-13');
  assert.equal(anchorOf('Eqs. 21, 22'), 'eq-21-22');
  assert.equal(anchorOf('Fig. 1'), 'fig-1');
  assert.equal(anchorOf('Table I'), 'table-i');
  assert.equal(anchorOf('trim'), 'eq-trim');
  assert.equal(shortOf('Eqs. 21, 22'), '21–22');
  assert.equal(shortOf('Fig. 4'), 'Fig. 4');
});

test('the tally counts verdicts and proofs', () => {
  const paper = {
    numbers: [...'rrdgg'].map((c) => ({ verdict: { r: 'reproduced', d: 'differs', g: 'given' }[c] })),
    errata: [
      { standing: 'confirmed', proof: { holds: true } },
      { standing: 'confirmed', proof: { holds: false } },
      { standing: 'unclear', proof: { holds: true } },
    ],
    equations: [{ status: 'corrected' }, { status: 'corrected' }, { status: 'explained' }],
  };
  const c = countsOf(/** @type {any} */ (paper));
  assert.deepEqual([c.reproduced, c.derivable, c.differs, c.given, c.numbers], [2, 3, 1, 2, 5]);
  assert.deepEqual([c.errata, c.unclear, c.proofs], [2, 1, 2]);
  assert.deepEqual(c.status, { corrected: 2, explained: 1 });
});

test('digits that agree, or none to compare', () => {
  assert.equal(digitsText({ digits: 5, digits_printed: 5 }), '5 of 5');
  assert.equal(digitsText({ digits: 0, digits_printed: 3 }), '0 of 3');
  assert.equal(digitsText({ digits_printed: 3 }), '–');
});

test('figures: a true minus, no trailing zeros, integers as integers', () => {
  assert.equal(figure(51.170053, 6), '51.1701');
  assert.equal(figure(-0.069164), '\u22120.069164');
  assert.equal(figure(0.9999999999999999), '1');
  assert.equal(figure(-1e-17), '0');
  assert.equal(figure(-0), '0');
  assert.equal(figure(8.09e-6), '8.09e\u22126');
  assert.equal(figure(undefined), '–');
  assert.equal(minus('-8.730, (0, -1) and A-B'), '\u22128.730, (0, \u22121) and A-B');
});

test('what rounding left of zeros is taken away, small entries stay', () => {
  assert.deepEqual(
    clean([
      [0, 1, -2e-18],
      [-120, 1e-9, 3e-15],
    ]),
    [
      [0, 1, 0],
      [-120, 1e-9, 0],
    ],
  );
  assert.equal(clean(undefined), undefined);
  assert.deepEqual(
    clean([
      [-0, 0],
      [0, -0],
    ]),
    [
      [0, 0],
      [0, 0],
    ],
  ); // a zero has no sign to be read
});

test('a conjugate pair is written once', () => {
  const text = polesText([
    { re: -12.0036, im: 0 },
    { re: -6.1284, im: 6.2685 },
    { re: -6.1284, im: -6.2685 },
  ]);
  assert.equal(text.replaceAll('\u00a0', ' '), '\u221212.004, \u22126.128 ± 6.268j'.replace('6.268j', '6.269j'));
  assert.ok(Math.abs(dampingRatio({ re: -3, im: 4 }) - 0.6) < 1e-12);
});

test('groups keep their order', () => {
  assert.deepEqual(
    groupBy(['b1', 'a1', 'b2'], (s) => s[0]),
    [
      ['b', ['b1', 'b2']],
      ['a', ['a1']],
    ],
  );
});

test('Eq. 8 worked through', () => {
  const [first, , third] = thrustSteps(COMPONENTS);
  assert.equal(
    `${first.name} = ${first.symbols} = ${first.figures} = ${figure(first.value)} ${first.unit}`,
    'K_pp = K_f,p r_p = 1.037 N/V × 0.19685 m = 0.20413 N·m/V',
  );
  assert.equal(third.name, 'K_py');
  assert.ok(Math.abs(third.value - 0.0068125) < 1e-12);
});

test('Eq. 1 worked through', () => {
  const steps = centreSteps(COMPONENTS);
  assert.ok(Math.abs(steps[2].value - 0.185670126) < 1e-9);
  assert.equal(steps[0].figures, '0.459 kg × 0.19685 m + 0.295 kg × 0.168275 m');
  assert.ok(Math.abs(steps[0].value / steps[1].value - steps[2].value) < 1e-15);
});
