// Q and R on the page: weights as largest accepted values, ρ along the root locus, and what a design holds of them.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { bodyOf, designOf } from '../../static/model/store.js';
import { guarded } from '../../static/model/locks.js';
import { linkOf, readLink } from '../../static/link/permalink.js';
import { initialState } from '../../static/model/store.js';
import { slower } from '../../static/splane/math.js';
import { inSight } from '../../static/optimal/edge.js';
import {
  acceptedOf,
  locusBody,
  proposedWeight,
  rhoOf,
  weightFor,
  weightOf,
  WEIGHTS,
  withoutWeights,
  withRho,
  withWeight,
} from '../../static/optimal/weights.js';
import { PRESETS } from './presets.mjs';

const [PRESET] = PRESETS;
const of = (path) => WEIGHTS.find((w) => w.path === path);
const THETA = of('weights.states.theta');
const PITCH = of('weights.inputs.V_p');
const KNOWN = { presets: PRESETS, methods: [{ name: 'full-rank' }, { name: 'lqr' }] };
const near = (a, b) => assert.ok(Math.abs(a - b) <= 1e-9 * Math.abs(b), `${a} is not ${b}`);

test("the preset proposes Bryson's rule: 10°, 1 rad/s, 5°s, and the motors' limits", () => {
  const accepted = WEIGHTS.map((w) => acceptedOf(w, proposedWeight(PRESET, w)));
  [10, 10, 57.29577951308232, 57.29577951308232, 5, 5, 24, 15].forEach((v, i) => near(accepted[i], v));
});

test('a weight is 1/(largest accepted)², and back', () => {
  for (const w of WEIGHTS) for (const v of [0.02, 1, 37.5]) near(acceptedOf(w, weightFor(w, v)), v);
  near(weightFor(PITCH, 24), 1 / 576);
  near(weightFor(THETA, 10), (180 / Math.PI / 10) ** 2);
  assert.equal(weightFor(THETA, NaN), 0);
  assert.ok(Number.isNaN(acceptedOf(THETA, 0)));
});

test('a design holds only the weights that differ, and none where all are as proposed', () => {
  const before = designOf(PRESET);
  const once = withWeight(before, PRESET, THETA, 7);
  assert.deepEqual(once.weights, { states: { theta: 7 } });
  const twice = withWeight(once, PRESET, PITCH, 0.5);
  assert.deepEqual(bodyOf(twice).weights, { states: { theta: 7 }, inputs: { V_p: 0.5 } });
  assert.equal(weightOf(twice, PRESET, THETA), 7);
  assert.equal(weightOf(twice, PRESET, of('weights.states.psi')), proposedWeight(PRESET, of('weights.states.psi')));
  const back = withWeight(twice, PRESET, PITCH, proposedWeight(PRESET, PITCH));
  assert.deepEqual(back.weights, { states: { theta: 7 } });
  assert.deepEqual(withoutWeights(back), before);
  assert.deepEqual(withWeight(back, PRESET, THETA, proposedWeight(PRESET, THETA)), before);
  assert.equal('weights' in bodyOf(before), false);
});

test('weights stay in the range of the contract', () => {
  const before = designOf(PRESET);
  assert.equal(withWeight(before, PRESET, THETA, 1e30).weights.states.theta, 1e12);
  assert.equal(withWeight(before, PRESET, THETA, -1).weights.states.theta, 0);
  assert.equal(withWeight(before, PRESET, PITCH, 0).weights.inputs.V_p, 1e-12);
});

test('ρ scales R as a whole: the ratio of its entries stays, and so does the locus', () => {
  const tilted = withWeight(designOf(PRESET), PRESET, PITCH, 5 * proposedWeight(PRESET, PITCH));
  near(rhoOf(tilted, PRESET), Math.sqrt(5));
  const keys = new Set();
  for (const rho of [1e-4, 0.013, 1, 42, 1e4]) {
    const own = withRho(tilted, PRESET, rho);
    near(rhoOf(own, PRESET), rho);
    const [p, y] = ['V_p', 'V_y'].map((name) => weightOf(own, PRESET, of(`weights.inputs.${name}`)));
    near(p / y / (576 ** -1 / 225 ** -1), 5);
    keys.add(JSON.stringify(locusBody(own, PRESET)));
  }
  assert.equal(keys.size, 1);
});

test('weights travel in a link, are judged there, and can be locked', () => {
  const design = withWeight({ ...designOf(PRESET), method: 'lqr' }, PRESET, THETA, 7.25);
  const state = { ...initialState(), presets: PRESETS, design };
  const link = linkOf(state, KNOWN);
  assert.match(link, /weights\.states\.theta=7\.25/);
  const read = readLink(link, KNOWN);
  assert.deepEqual(read.trouble, []);
  assert.deepEqual(read.design, design);
  for (const part of ['weights.states.theta=-1', 'weights.inputs.V_p=0', 'weights.other=1', 'weights.states.theta=x']) {
    const { design: found, trouble } = readLink(`#v1&${part}`, KNOWN);
    assert.equal(trouble.length, 1, part);
    assert.equal(found.weights, undefined, part);
  }
  assert.equal(guarded(design, withoutWeights(design), ['weights']), design);
});

test('a pole far faster than the rest does not make the rest tiny', () => {
  const poles = [-5, -6, -10, -5000].map((re) => ({ re, im: 0 }));
  assert.deepEqual(slower(poles, 20), poles.slice(0, 3));
  assert.deepEqual(slower(poles, Infinity), poles);
});

test('a pole out of sight is marked at the edge, turned towards where it is', () => {
  const view = { cx: -5, cy: 0, scale: 20, width: 400, height: 300 };
  assert.deepEqual(inSight(view, { re: -6, im: 1 }, 10), { x: 180, y: 130, turn: null });
  assert.deepEqual(inSight(view, { re: -60, im: 0 }, 10), { x: 10, y: 150, turn: 0 });
  const right = inSight(view, { re: 40, im: 0 }, 10);
  assert.deepEqual([right.x, right.y, Math.abs(right.turn)], [390, 150, 180]);
  const above = inSight(view, { re: -5, im: 90 }, 10);
  assert.deepEqual([above.x, above.y, above.turn], [200, 10, 90]);
  const below = inSight(view, { re: -60, im: -60 }, 10);
  assert.ok(below.x === 10 && below.y === 290 && below.turn < 0 && below.turn > -90);
});
