/** What an identification is shown as, and a recording beside the design: aligned, shifted, cut. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { alignedTrace, alignmentWords, stepsOf, stepWords } from '../../static/recordings/alignment.js';
import {
  correlationCurve,
  fittedCurves,
  heldOut,
  partRows,
  rangeOfCorrelation,
  rangeOfFit,
  rangeOfRest,
  residualCurve,
  whitenessWords,
} from '../../static/recordings/found.js';
import { identifyBody } from '../../static/recordings/recordings.js';

const RAD = Math.PI / 180;
const axes = (theta, psi = theta) => ({ theta, psi });
const near = (fit, rms) => ({ fit: axes(fit), variance: axes(fit), rms: axes(rms) });
const found = {
  parts: [
    { held_out: false, first: 0, end: 20, segments: 3, before: null, after: near(99.9999, 0.001) },
    { held_out: true, first: 20.002, end: 30, segments: 2, before: near(-120, 0.1), after: near(null, 0.002) },
  ],
  courses: {
    t: [0, 1, 2],
    measured: axes([0, RAD, 2 * RAD]),
    before: axes([null, 90 * RAD, null]),
    after: axes([0, RAD, null]),
    residuals: axes([0, -0.5 * RAD, null]),
  },
  whiteness: {
    theta: { white: true, probability: 0.42, correlations: [0.01, -0.02], band: 0.03, span: 0.002 },
    psi: { white: false, probability: 1e-9, correlations: [0.9, 0.8], band: 0.03, span: 0.096 },
  },
  sample_time: 0.002,
};

test('curves are in degrees, gaps stay, and what was wrong before makes no room for itself', () => {
  const data = fittedCurves(found, 'theta');
  assert.deepEqual(
    data.map((own) => own.map((v) => (v === null ? null : Math.round(v)))),
    [
      [0, 1, 2],
      [0, 1, 2],
      [null, 90, null],
      [0, 1, null],
    ],
  );
  const [low, high] = rangeOfFit(data);
  assert.ok(low < 0 && high > 2 && high < 4);
  assert.ok(Math.abs(residualCurve(found, 'psi')[1][1] + 0.5) < 1e-12);
  const [down, up] = rangeOfRest(residualCurve(found, 'psi'));
  assert.ok(up > 0.5 && down === -up);
});

test('what is held out, and a row for each part and axis', () => {
  assert.deepEqual(heldOut(found), [20.002, 30]);
  assert.equal(heldOut({ parts: found.parts.slice(0, 1) }), null);
  const rows = partRows(found);
  assert.deepEqual(
    rows.map((row) => row.id),
    ['fitted-theta', 'fitted-psi', 'held-theta', 'held-psi'],
  );
  assert.equal(rows[0].part, 'fitted, 0.0 … 20.0 s');
  assert.deepEqual(rows[0].fit, ['–', '99.99 %'], 'no fit is told as perfect');
  assert.deepEqual(rows[3].fit, ['below −100 %', '–']);
  assert.equal(rows[2].rms[1], '0.11°');
});

test('correlations begin one sample apart, and the band of white residuals has room', () => {
  assert.deepEqual(correlationCurve(found, 'theta'), [
    [2, 4],
    [0.01, -0.02],
  ]);
  assert.ok(rangeOfCorrelation(found, 'theta')[1] > 2 * 0.03);
  assert.ok(rangeOfCorrelation(found, 'psi')[1] > 0.9);
  assert.match(whitenessWords(found, 'theta'), /^White: .* 0\.42\.$/);
  assert.match(whitenessWords(found, 'psi'), /^Not white: correlated over some 96 ms\./);
});

test('all of the recording is fitted where nothing is to be held out', () => {
  const design = { loops: {}, theta0: 0 };
  const recorded = { preview: { id: 'x' }, columns: { names: {} } };
  assert.equal(identifyBody(design, recorded, ['J_p'], true).held_out, 0);
  assert.ok(!('held_out' in identifyBody(design, recorded, ['J_p'])));
});

const overlay = {
  t: [0, 1, 2, 3, 4],
  measured: { theta: [0.1, 0.1, 0.15, 0.2, 0.2], psi: [0.5, 0.5, 0.5, 0.5, 0.4] },
  references: { theta: [0.1, 0.1, 0.2, 0.2, 0.2], psi: [0.5, 0.5, 0.5, 0.5, 0.5001] },
  voltages: { V_p: [1, 2, 3, 4, 5], V_y: [5, 4, 3, 2, 1] },
};

test('steps of the recorded references are found; what is no step is none', () => {
  const steps = stepsOf(overlay);
  assert.deepEqual(
    steps.map(({ t, axis }) => [t, axis]),
    [[2, 'theta']],
  );
  assert.equal(stepWords(steps[0]), '2.00 s: pitch +5.7°');
  assert.deepEqual(stepsOf({ t: [0, 1] }), []);
});

test('a stretch begins at the plots’ zero, where the design does', () => {
  const trace = alignedTrace(overlay, { from: 2, duration: 1.5, shifted: true, theta0: -0.2 });
  assert.deepEqual([...trace.t], [0, 1]);
  assert.ok(Math.abs(trace.theta[1] - (0.2 - 0.3)) < 1e-12, 'by the reference before its step');
  assert.ok(Math.abs(trace.psi[0]) < 1e-12);
  assert.deepEqual([...trace.V_p], [3, 4], 'voltages are as they were');
  assert.match(alignmentWords(trace), /2\.00 s are the plots’ 0 s\. Pitch is shifted by −17\.19°, yaw by −28\.65°/);
  const raw = alignedTrace(overlay, { from: 2, duration: 9, shifted: false, theta0: -0.2 });
  assert.deepEqual([...raw.theta], [0.15, 0.2, 0.2]);
  assert.match(alignmentWords(raw), /as measured/);
  const blind = alignedTrace({ ...overlay, references: undefined }, { from: 2, duration: 9, shifted: true, theta0: 0 });
  assert.ok(Math.abs(blind.theta[0]) < 1e-12, 'by the angle where no reference was recorded');
  assert.equal(alignedTrace(overlay, { from: 4, duration: 9, shifted: true, theta0: 0 }), null);
  assert.equal(alignedTrace(overlay, { from: 40, duration: 9, shifted: true, theta0: 0 }), null);
});
