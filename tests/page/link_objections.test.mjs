// What a link may say of each field: one that there is, a value of its kind, and nothing in place of a whole part.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { readLink } from '../../static/link/permalink.js';
import { experimentWords } from '../../static/model/experiment.js';
import { QUANTITIES } from '../../static/model/quantities.js';
import { designOf } from '../../static/model/store.js';
import { KNOWN, PRESETS } from './presets.mjs';

const OF_EXPERIMENTS = Object.entries(QUANTITIES).filter(([path]) => path.startsWith('scenario.'));

test('a field that no experiment has, or of another kind, is named; one that it needs is not taken away', () => {
  for (const [part, why] of [
    ['scenario.disturbance.at=1', 'no field of an experiment'],
    ['scenario.digital=5', 'no field of an experiment'],
    ['scenario.nothing=', 'no field of an experiment'],
    ['scenario.disturbance.V_p=foo', 'not a number'],
    ['scenario.disturbance.time=null', 'not a number'],
    ['scenario.rtol=[1]', 'not a number'],
    ['scenario.saturation=1', 'neither true nor false'],
    ['scenario.anti_windup=perhaps', 'neither none nor clamping nor back-calculation'],
    ['step.theta=', 'empty'],
    ['duration=', 'empty'],
    ['loops.pitch.kp=', 'empty'],
    ['loops.yaw.ti=null', 'not a number'],
    ['observer.angle_noise=null', 'not a number in its range'],
  ]) {
    const { trouble, design } = readLink(`#v1&${part}&scenario.digital.sample_time=0.01`, KNOWN);
    assert.deepEqual(trouble, [{ part: part.split('=')[0], why }], part);
    assert.deepEqual(design.scenario.digital, { sample_time: 0.01 }, part);
  }
  for (const whole of ['poles', 'loops', 'loops.pitch', 'scenario', 'scenario.reference', 'parameters', 'limits'])
    for (const text of ['', 'null', '5', '[]']) {
      const { trouble, design } = readLink(`#v1&${whole}=${text}`, KNOWN);
      assert.deepEqual([trouble.length, design], [1, designOf(PRESETS[0])], whole + text);
    }
  for (const part of ['scenario.disturbance.V_y=2', 'scenario.noise.psi=0.001', 'scenario.saturation='])
    assert.deepEqual(readLink(`#v1&${part}`, KNOWN).trouble, [], part);
});

test('every field opens alone, and what it cannot be is left out', () => {
  for (const [path, { words: some, standard, min }] of OF_EXPERIMENTS) {
    const value = some ? some[0] : typeof standard === 'boolean' ? !standard : min || 1;
    const { trouble, design } = readLink(`#v1&${path}=${value}`, KNOWN);
    assert.deepEqual(trouble, [], path);
    assert.doesNotMatch(experimentWords(design.scenario).join(), /undefined|NaN|–/, path);
    assert.equal(readLink(`#v1&${path}=nonsense`, KNOWN).trouble.length, 1, path);
    assert.equal(readLink(`#v1&${path}=null`, KNOWN).trouble.length, 1, path);
  }
});
