// With which design a step of a lab begins: as the core has it (tests/labs/page_examples.py).
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { bodyFrom, designFrom, merged } from '../../static/bodies/index.js';
import { designIn, startOf } from '../../static/labs/starts.js';
import { PRESETS } from './presets.mjs';

const { small } = JSON.parse(readFileSync(new URL('fixtures/lab_goals.json', import.meta.url)));
const { lab, rig, starts, before, continued } = small;
const [settle, loop] = lab.steps;

/** Without what comes from the preset in one of both alone. */
const whole = (body) => {
  const { observer: _o, weights: _w, ...design } = designFrom(body, PRESETS);
  const { rtol: _r, ...scenario } = design.scenario;
  return { ...bodyFrom({ ...design, scenario }), limits: undefined, parameters: undefined };
};

test('a step begins as the core begins it, on the rig of the student', () => {
  for (const step of lab.steps) {
    const start = startOf(lab, step, rig, {}, PRESETS);
    assert.deepEqual(whole(bodyFrom(start)), whole(starts[step.name]), step.name);
    assert.deepEqual(start.parameters, rig.parameters);
  }
});

test('a step that goes on takes what was free in the step before, and nothing else', () => {
  const kept = { settle: { design: merged(starts.settle, before) } };
  const start = startOf(lab, loop, rig, kept, PRESETS);
  assert.deepEqual(whole(bodyFrom(start)), whole(continued));
  assert.deepEqual(
    start.poles.map(({ re }) => re),
    [-7, -8, -9.25, -8.76],
  );
  assert.equal(start.loops.pitch.kp, 20);
});

test('what was kept of a step comes again, but for what is fixed in it', () => {
  const own = { ...starts.settle, poles: [-5, -6, -1, -1], outer: 'pi', parameters: { K_pp: 1 } };
  const design = designIn(lab, settle, rig, { settle: { design: own } }, PRESETS);
  assert.deepEqual(
    design.poles.map(({ re }) => re),
    [-5, -6, -9.25, -8.76],
  );
  assert.equal(design.outer, 'none');
  assert.deepEqual(design.parameters, rig.parameters);
});
