// Margins found again on a sampled frequency response, of loops whose margins are known in closed form.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { crossings, decibels, marginPlaces } from '../../static/compare/margins_math.js';

const close = (a, b, relative = 2e-3) => assert.ok(Math.abs(a - b) <= relative * Math.abs(b), `${a} is not ${b}`);
const w = Array.from({ length: 241 }, (_, i) => 0.1 * 10 ** (i / 60));

/** k / (s (s + 1)²): its phase is −180° at 1 rad/s, where its gain is k/2. */
const third = (k, turns = 0) => ({
  gain: w.map((x) => k / (x * (1 + x * x))),
  phase: w.map((x) => -Math.PI / 2 - 2 * Math.atan(x) + 2 * Math.PI * turns),
});

test('gain and phase margin of k/(s(s + 1)²) lie where they are known to lie', () => {
  const k = 0.5;
  let at = 0.3; // |L| = 1: x (1 + x²) = k
  for (let i = 0; i < 50; i++) at -= (at * (1 + at * at) - k) / (1 + 3 * at * at);
  const phase_margin = Math.PI / 2 - 2 * Math.atan(at);
  for (const turns of [0, 1, -2]) {
    const found = marginPlaces(w, third(k, turns), { gain_margin: 2 / k, phase_margin });
    close(found.phase.at, at);
    assert.equal(found.phase.to, -180 + 360 * turns);
    close(found.phase.from - found.phase.to, (phase_margin * 180) / Math.PI);
    close(found.gain.at, 1);
    close(found.gain.from, -20 * Math.log10(4));
    assert.equal(found.gain.to, 0);
  }
});

test('what does not belong to a margin is not drawn', () => {
  assert.deepEqual(marginPlaces(w, third(0.5), undefined), {});
  assert.deepEqual(marginPlaces(w, third(0.5), { phase_margin: 0.1, gain_margin: 40 }), {
    phase: undefined,
    gain: undefined,
  });
  assert.equal(marginPlaces(w, third(1e-6), { phase_margin: 1.5 }).phase, undefined); // it crosses below what is seen
});

test('every crossing is found once', () => {
  assert.deepEqual(
    crossings([2, 1, 0, -1, -3, 1], 0).map(({ i }) => i),
    [3, 5],
  );
  assert.deepEqual(crossings([1, -1], 0), [{ i: 1, share: 0.5 }]);
  assert.deepEqual(decibels([1, 10]), [0, 20]);
});
