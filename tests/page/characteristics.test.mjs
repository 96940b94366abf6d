// What is marked on the curves: the server's figures, at their place on the curve.
import assert from 'node:assert/strict';
import { afterEach, test } from 'node:test';

import { marksOf, reaches, valueAt } from '../../static/plots/characteristics.js';
import pseudo from '../../static/text/languages/pseudo.js';
import { DEGREE } from '../../static/text/format.js';
import { scaleOf } from '../../static/ui/picture_scale.js';
import { limitOf, namePlaces, referenceOf, regionsOf, rulesOf } from '../../static/plots/rules.js';
import { useWords } from '../../static/text/words.js';

afterEach(() => useWords(null));

const close = (a, b, tolerance = 1e-9) => assert.ok(Math.abs(a - b) <= tolerance, `${a} is not ${b}`);

/** An underdamped second-order step, whose figures are known in closed form (Ogata, 2010, section 5.3). */
const [ZETA, WN, FROM, TO] = [0.5, 4, 0.1, 0.3];
const WD = WN * Math.sqrt(1 - ZETA ** 2);
const t = Float64Array.from({ length: 1001 }, (_, i) => i * 0.005);
const angle = t.map(
  (s) =>
    FROM +
    (TO - FROM) *
      (1 - Math.exp(-ZETA * WN * s) * (Math.cos(WD * s) + (ZETA / Math.sqrt(1 - ZETA ** 2)) * Math.sin(WD * s))),
);
const first = (share) => t[angle.findIndex((v) => v >= FROM + share * (TO - FROM))];
const overshoot = Math.exp((-Math.PI * ZETA) / Math.sqrt(1 - ZETA ** 2));
const peak_time = Math.PI / WD;
const metrics = {
  rise_time: first(0.9) - first(0.1),
  settling_time: 2.0,
  overshoot: 100 * overshoot,
  peak: TO + overshoot * (TO - FROM),
  peak_time,
};
const other = t.map((s) => -0.02 * Math.sin(s) * Math.exp(-s));
const step = (axis, own) => ({
  nonlinear: {
    t,
    theta: axis === 'theta' ? angle : other,
    psi: axis === 'psi' ? angle : other,
    reference: { theta: axis === 'theta' ? TO : 0, psi: axis === 'psi' ? TO : 0 },
    metrics: own,
  },
});
const reply = {
  stable: true,
  axis_steps: { theta: step('theta', { theta: metrics }), psi: step('psi', { psi: metrics }) },
};

test("rise, peak, settling and the other axis' move lie on their curves, in the order of time", () => {
  const marks = marksOf(reply, 'theta');
  assert.deepEqual(marks.map((m) => m.kind).sort(), ['coupling', 'peak', 'rise', 'settling']);
  assert.deepEqual(
    marks.map((m) => m.t),
    marks.map((m) => m.t).sort((a, b) => a - b),
  );
  const of = Object.fromEntries(marks.map((m) => [m.kind, m]));
  close(of.rise.t, first(0.9), 0.005);
  close(of.rise.value, (FROM + 0.9 * (TO - FROM)) * DEGREE, 0.02);
  close(of.peak.t, peak_time);
  close(of.peak.value, Math.max(...angle) * DEGREE, 1e-3);
  close(of.settling.value, valueAt(t, angle, 2.0) * DEGREE);
  assert.equal(of.coupling.axis, 'psi');
  close(of.coupling.t, Math.PI / 4, 0.003);
  assert.match(of.peak.text, /^Peak 19\.06° at 0\.91 s: overshoot 16\.3 %$/);
  assert.match(of.coupling.text, /^The yaw step moves pitch by 0\.37° at 0\.7[89] s$/);
});

test('a step downwards rises as well, and overshoots below', () => {
  const down = angle.map((v) => -v);
  close(reaches(t, down, -FROM, -TO, 0.9), reaches(t, angle, FROM, TO, 0.9));
});

test('what does not happen has no mark', () => {
  const slow = {
    stable: true,
    axis_steps: { theta: step('theta', { theta: { overshoot: 0.02, peak: TO, peak_time: 5 } }) },
  };
  assert.deepEqual(marksOf(slow, 'theta'), []);
  assert.deepEqual(marksOf({ stable: true, axis_steps: { theta: step('theta', {}) } }, 'theta'), []);
  assert.deepEqual(marksOf(reply, 'V_p'), []);
  assert.deepEqual(marksOf(null, 'theta'), []);
  assert.deepEqual(marksOf({ ...reply, stable: false }, 'theta'), []);
  assert.equal(
    reaches(
      t,
      t.map(() => 0),
      0,
      1,
      0.9,
    ),
    undefined,
  );
});

test('between the samples a curve is straight', () => {
  assert.equal(valueAt([0, 1, 2], [0, 10, 0], 0.25), 2.5);
  assert.equal(valueAt([0, 1, 2], [0, 10, 0], 9), 0);
});

test("limits and references are named in the page's language", () => {
  const asked = {
    limits: { theta: 40.5 / DEGREE, V_p: 24 },
    step: { nonlinear: { reference: { theta: 10 / DEGREE, psi: 0 } } },
  };
  assert.deepEqual(
    rulesOf(asked, 'theta').map((r) => r.label),
    ['stop 40.5°', 'stop \u221240.5°', 'reference 10.0°'],
  );
  assert.deepEqual(
    rulesOf(asked, 'V_p').map((r) => [r.value, r.label]),
    [
      [24, 'limit 24 V'],
      [-24, 'limit \u221224 V'],
    ],
  );
  assert.deepEqual(
    [limitOf(asked, 'psi'), referenceOf(asked, 'V_p'), rulesOf(null, 'psi')],
    [undefined, undefined, []],
  );
  useWords(pseudo.default ?? pseudo, 'qps-ploc');
  for (const label of [...rulesOf(asked, 'theta'), ...rulesOf(asked, 'V_p')].map((r) => r.label))
    assert.match(label, /⟦/);
  for (const { text, brief } of marksOf(reply, 'theta')) assert.ok(text.startsWith('⟦') && brief.startsWith('⟦'), text);
});

test('pictures grow as the stylesheets say', () => {
  const style = (fontSize, type, lines) => ({
    fontSize,
    getPropertyValue: (name) => ({ '--picture-type': ` ${type}`, '--picture-lines': lines })[name],
  });
  assert.deepEqual(scaleOf(style('10px', 1.1, '1')), { type: 1, line: 1 });
  const { type, line } = scaleOf(style('18px', 2, '1.7'));
  close(type, 36 / 11);
  close(line, 3.06);
});

test('what is asked walls in the response: overshoot until it should have settled, 2 % from then on', () => {
  const [from, to] = [FROM * DEGREE, TO * DEGREE];
  const size = to - from;
  const walls = regionsOf(reply, 'theta', { settling: 2, overshoot: 10 });
  assert.deepEqual(
    walls.map((r) => [r.left, r.right]),
    [
      [0, 2],
      [2, 5],
      [2, 5],
    ],
  );
  [to + 0.1 * size, to + 0.02 * size, to - 0.02 * size].forEach((v, i) => close(walls[i].inner, v));
  assert.ok(walls[0].outer > walls[0].inner && walls[1].outer > walls[1].inner && walls[2].outer < walls[2].inner);
  close(regionsOf(reply, 'theta', { settling: 2, overshoot: 1 })[1].inner, to + 0.01 * size);
  assert.deepEqual(
    regionsOf(reply, 'theta', { settling: null, overshoot: 10 }).map((r) => [r.left, r.right]),
    [[0, 5]],
  );
  assert.equal(regionsOf(reply, 'theta', { settling: 60, overshoot: null }).length, 0);
  assert.deepEqual(regionsOf(reply, 'V_p', { settling: 2, overshoot: 10 }), []);
  assert.deepEqual(regionsOf(reply, 'theta', { settling: null, overshoot: null }), []);
});

test('names of lines lie apart, in the plot, wherever the lines are', () => {
  const room = { gap: 9, high: 14, top: 0, bottom: 140 };
  const apart = (places) =>
    places.every((a, i) => a >= 7 && a <= 133 && places.every((b, j) => i === j || Math.abs(a - b) >= 14));
  assert.deepEqual(namePlaces([{ value: 24, y: 30 }], room), [39]); // towards zero
  assert.deepEqual(namePlaces([{ value: -24, y: 110 }], room), [101]);
  for (const ys of [
    [70, 70],
    [69, 71],
    [60, 75],
    [3, 5],
    [138, 139],
    [70, 70, 70],
    [66, 74, 69],
    [8, 8, 8],
  ]) {
    const lines = ys.map((y, i) => ({ value: [24, -24, 10][i], y }));
    assert.ok(apart(namePlaces(lines, room)), `${ys}: ${namePlaces(lines, room)}`);
  }
});
