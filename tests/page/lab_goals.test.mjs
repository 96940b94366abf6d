// Goals on the page are judged as the server judges them: its own examples (tests/labs/page_examples.py) say how.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { designFrom } from '../../static/bodies/index.js';
import { figureOf, judged, meets, shown, written } from '../../static/labs/goals.js';
import { PRESETS } from './presets.mjs';

const { attempts, goals, values } = JSON.parse(readFileSync(new URL('fixtures/lab_goals.json', import.meta.url)));

for (const [name, { of, values: rows, absent }] of Object.entries(values))
  test(`${name} is rounded, written and held to its limits as the server does`, () => {
    const figure = figureOf({ of, figure: name });
    assert.ok(figure, 'the page knows it');
    for (const [size, limit, below, above, number, text] of rows) {
      assert.equal(meets(figure, size, { max: limit }), below, `${size} ≤ ${limit}`);
      assert.equal(meets(figure, limit, { min: size }), above, `${limit} ≥ ${size}`);
      assert.ok(Math.abs(shown(figure, size) - number) <= 1e-12 * Math.abs(number), `${shown(figure, size)} ${number}`);
      assert.equal(written(figure, size), text);
    }
    const [below, above, text] = absent;
    assert.deepEqual([meets(figure, undefined, { max: 1 }), meets(figure, undefined, { min: 1 })], [below, above]);
    assert.equal(written(figure, undefined), text);
  });

attempts.forEach(({ body, reply, told }, i) =>
  test(`attempt ${i + 1}: every goal that the page can judge is judged alike`, () => {
    const design = designFrom(body, PRESETS);
    const known = goals.filter(({ kind }) => kind === 'figure');
    assert.equal(known.length, goals.length - 1);
    for (const goal of known) {
      const { met, text } = told.find(({ name }) => name === goal.name);
      assert.deepEqual(judged(goal, { reply, design }), { met, text }, goal.name);
    }
    const cloud = goals.find(({ kind }) => kind === 'cloud');
    assert.deepEqual(judged(cloud, { reply, design }), { met: null, text: '' });
    assert.deepEqual(judged({ ...known[0], page: false }, { reply, design }), { met: null, text: '' });
  }),
);

test('a setting is judged by what it is set to', () => {
  const [{ body, reply }] = attempts;
  const design = designFrom({ ...body, scenario: { ...body.scenario, digital: { sample_time: 0.025 } } }, PRESETS);
  const goal = { kind: 'setting', path: 'scenario.digital.sample_time' };
  const met = (limits) => judged({ ...goal, ...limits }, { reply, design }).met;
  assert.deepEqual([met({ min: 0.025 }), met({ min: 0.026 }), met({ max: 0.025 })], [true, false, true]);
  assert.equal(judged(goal, { reply, design: designFrom(body, PRESETS) }).met, null);
  const uneven = { ...body, scenario: { ...body.scenario, digital: { sample_time: 0.01542876909 } } };
  const inMs = { ...goal, scale: 1e3, unit: 'ms' };
  assert.equal(judged(inMs, { reply, design: designFrom(uneven, PRESETS) }).text, '15.4288 ms', 'as the server does');
});
