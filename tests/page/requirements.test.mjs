// Requirements: one verdict, on the response; and the guide in the plane: formula, words, and regions that agree at
// every point.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import {
  forbidden,
  guideWords,
  leastDamping,
  missed,
  missing,
  NONE,
  verdictOf,
} from '../../static/model/requirements.js';
import { readoutLines } from '../../static/splane/readout.js';
import { Store } from '../../static/model/store.js';

const both = { settling: 1, overshoot: 5 };
const pair = (re, im) => [
  { re, im },
  { re, im: -im },
];

test('least damping is that of the textbook: 0.69 for 5 %, 0.59 for 10 %, 1 for none, 0 for all', () => {
  assert.ok(Math.abs(leastDamping({ settling: null, overshoot: 5 }) - 0.690107) < 1e-6);
  assert.ok(Math.abs(leastDamping({ settling: null, overshoot: 10 }) - 0.591155) < 1e-6);
  assert.equal(leastDamping({ settling: null, overshoot: 0 }), 1);
  assert.ok(leastDamping({ settling: null, overshoot: 100 }) === 0);
  assert.equal(leastDamping(NONE), undefined);
});

test('a pole on the border is inside the guide, one beyond it is not', () => {
  assert.deepEqual(missed({ re: -4, im: 0 }, both), { settling: false, overshoot: false });
  assert.deepEqual(missed({ re: -3.99, im: 0 }, both), { settling: true, overshoot: false });
  assert.deepEqual(missed({ re: -5, im: 20 }, both), { settling: false, overshoot: true });
  assert.deepEqual(missed({ re: 1, im: 0 }, both), { settling: true, overshoot: true });
  assert.deepEqual(missed({ re: 1, im: 0 }, NONE), { settling: false, overshoot: false });
});

test('the hatched regions are where a pole alone would miss, everywhere in view', () => {
  const inside = (p, corners) => {
    let odd = false;
    for (let i = 0, j = corners.length - 1; i < corners.length; j = i++) {
      const [a, b] = [corners[i], corners[j]];
      if (a.im > p.im !== b.im > p.im && p.re < ((b.re - a.re) * (p.im - a.im)) / (b.im - a.im) + a.re) odd = !odd;
    }
    return odd;
  };
  for (const seen of [
    { left: -20, right: 5, bottom: -12, top: 12 },
    { left: -3, right: -1, bottom: 2, top: 4 },
    { left: 1, right: 9, bottom: -1, top: 30 },
  ]) {
    for (const r of [
      both,
      { settling: 0.3, overshoot: 60 },
      { settling: 40, overshoot: 0.5 },
      { settling: 2, overshoot: 99 },
    ]) {
      const regions = forbidden(seen, r);
      for (let a = 0.013; a < 1; a += 0.0371) {
        for (let b = 0.017; b < 1; b += 0.0393) {
          const p = { re: seen.left + a * (seen.right - seen.left), im: seen.bottom + b * (seen.top - seen.bottom) };
          const m = missed(p, r);
          assert.equal(
            Boolean(regions.settling && inside(p, regions.settling)),
            m.settling,
            JSON.stringify({ seen, r, p }),
          );
          assert.equal(inside(p, regions.overshoot), m.overshoot, JSON.stringify({ seen, r, p }));
        }
      }
    }
  }
});

const replyOf = (theta, psi) => ({
  axis_steps: {
    theta: { nonlinear: { metrics: { theta } } },
    ...(psi && { psi: { nonlinear: { metrics: { psi } } } }),
  },
});

test('the verdict is on the response: met at the limit, missed beyond it and where it never settles', () => {
  const reply = replyOf({ settling_time: 1, overshoot: 5 }, { settling_time: 1.2, overshoot: 12.34 });
  assert.deepEqual(verdictOf(reply, 'theta', both), {
    met: true,
    settling: false,
    overshoot: false,
    text: 'requirements met',
  });
  assert.deepEqual(verdictOf(reply, 'psi', both), {
    met: false,
    settling: true,
    overshoot: true,
    text: 'settles in 1.20 s, overshoots by 12.3 %',
  });
  assert.deepEqual(missing(reply, both), ['yaw']);
  assert.deepEqual(missing(replyOf({ overshoot: 0 }, { settling_time: 0.2, overshoot: 9 }), both), ['pitch', 'yaw']);
  assert.equal(verdictOf(replyOf({ overshoot: 0 }), 'theta', both).text, 'not settled');
});

test('without a requirement, a step or an answer there is no verdict', () => {
  assert.equal(verdictOf(replyOf({ settling_time: 9, overshoot: 0 }), 'theta', NONE), null);
  assert.equal(verdictOf(replyOf({ settling_time: 9, overshoot: 0 }), 'psi', both), null);
  assert.equal(verdictOf(null, 'theta', both), null);
});

test("a pole's tip says both, alone and with PI, and the guide without a verdict", () => {
  assert.equal(guideWords({ re: -1, im: 9 }, both), 'slower and less damped');
  const poles = [{ re: -12, im: 0 }, { re: -2, im: 0 }, ...pair(-5, 20)];
  const reply = replyOf({ settling_time: 2.96, overshoot: 65.2 }, { overshoot: 3 });
  const methods = [
    { name: 'full-rank', places_poles: true },
    { name: 'lqr', places_poles: false },
  ];
  const lines = (outer, index, r, to, method = 'full-rank') =>
    readoutLines(
      {
        design: { poles, outer, method, scenario: {} },
        methods,
        reply,
        answered: null,
        requirements: r,
        view: 'design',
        motion: 'both',
      },
      index,
      to,
    );
  assert.deepEqual(lines('pi', 2, both, { re: -4.1, im: -2.61 }), [
    'yaw poles 3, 4',
    '−5.00 ± 20.00j rad/s',
    'ζ 0.24   ωₙ 20.62 rad/s',
    'alone: settles in 0.80 s, overshoot 46 %',
    'with PI: goes to −4.10 ± 2.61j rad/s',
    'with PI: not settled, overshoot 3 %',
    'guide: alone less damped than asked',
  ]);
  assert.deepEqual(lines('none', 1, NONE).slice(3), [
    'alone: settles in 2.00 s',
    '',
    'step: settles in 2.96 s, overshoot 65 %',
    '',
  ]);
  assert.doesNotMatch(lines('pi', 1, both).join(), /✓|✕/);
  assert.deepEqual(lines('pi', 1, both, undefined, 'lqr'), [
    'pitch pole 2',
    '−2.00 rad/s',
    'ζ 1.00   ωₙ 2.00 rad/s',
    'not used: the method chooses its own poles',
  ]);
});

test('requirements are no part of the design: undo leaves them', () => {
  const store = new Store();
  store.load({ poles: [] });
  store.edit((d) => ({ ...d, theta0: 1 }));
  store.set({ requirements: both });
  store.undo();
  assert.equal(store.state.requirements, both);
  assert.equal(store.state.design.theta0, undefined);
});
