// Designs as requests have them, and back.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { bodyFrom, designFrom, merged } from '../../static/bodies/index.js';
import { designOf, STANDARD } from '../../static/model/index.js';
import { PRESETS } from './presets.mjs';

const changed = (preset) => ({
  ...designOf(preset),
  parameters: { K_pp: 0.3 },
  limits: { theta: null, V_p: 18 },
  rotors: { pitch: { tau: 0.16 } },
  friction: { yaw: { coulomb: 0.001 } },
  theta0: 0.1,
  poles: [
    { re: -3, im: 2 },
    { re: -3, im: -2 },
    { re: -4, im: 0 },
    { re: -5, im: 0 },
  ],
  rotor_poles: [-20, -30],
  place_rotors: true,
  method: 'lqr',
  weights: { states: { theta: 100 } },
  outer: 'none',
  loops: { pitch: { kp: 10, ti: 1 }, yaw: { kp: 20, ti: 2 } },
  observer: { method: 'full-rank', poles: [-40, -41, -42, -43].map((re) => ({ re, im: 0 })) },
  scenario: {
    reference: { theta: 0.1, psi: 0 },
    duration: 8,
    digital: { sample_time: 0.01, delay: true },
    disturbance: { V_p: 1, V_y: 0, time: 2 },
    noise: { theta: 0.001 },
    initial: { psi: 0.2 },
    measured: 'observer',
    saturation: false,
    anti_windup: 'none',
  },
});

for (const preset of PRESETS)
  test(`${preset.name}: there and back nothing is lost or gained`, () => {
    for (const design of [designOf(preset), changed(preset)]) {
      const body = JSON.parse(JSON.stringify(bodyFrom(design)));
      assert.deepEqual(designFrom(body, PRESETS), design);
      assert.deepEqual(JSON.parse(JSON.stringify(bodyFrom(designFrom(body, PRESETS)))), body);
    }
  });

test('what a body leaves out is the preset’s, what it says in numbers alone is understood', () => {
  const [preset] = PRESETS;
  assert.deepEqual(designFrom({ preset: preset.name }, PRESETS), designOf(preset));
  const { poles, loops, scenario } = designFrom(
    {
      preset: preset.name,
      poles: [-1, -2, -3, -4],
      loops: { yaw: { kp: 5 } },
      scenario: { reference: { theta: 0.1 } },
    },
    PRESETS,
  );
  assert.deepEqual(poles[1], { re: -2, im: 0 });
  assert.deepEqual(loops, { pitch: preset.loops.pitch, yaw: { ...preset.loops.yaw, kp: 5 } });
  assert.deepEqual(scenario.reference, { theta: 0.1, psi: 0 }, 'yaw is not stepped');
  const above = { preset: preset.name, operating_point: { theta: 0.2 }, scenario: { reference: { psi: 0.3 } } };
  assert.deepEqual(designFrom(above, PRESETS).scenario.reference, { theta: 0.2, psi: 0.3 }, 'pitch rests where it is');
});

test('what is said as the server says it by itself is no change', () => {
  const [preset] = PRESETS;
  const scenario = { ...STANDARD, samples: 501, measured: 'states', digital: null, disturbance: null, initial: {} };
  assert.deepEqual(designFrom({ preset: preset.name, observer: null, scenario }, PRESETS), designOf(preset));
});

test('bodies are laid over one another leaf by leaf', () => {
  const rig = { preset: 'a', rotors: { pitch: { tau: 0.1 }, yaw: { tau: 0.2 } }, poles: [-1, -2] };
  assert.deepEqual(merged(rig, { rotors: { yaw: { tau: 0.3 } }, poles: [-3], preset: null }), {
    rotors: { pitch: { tau: 0.1 }, yaw: { tau: 0.3 } },
    poles: [-3],
  });
});
