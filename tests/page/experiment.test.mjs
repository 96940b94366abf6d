/** The experiment's options: what is kept, what is sent, what is said. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { cloudRequest, cloudWords } from '../../static/clouds/feed.js';
import {
  cloudCaveat,
  cloudScenario,
  experimentWords,
  isStandard,
  scenarioBody,
  standard,
  STANDARD,
  withDigital,
  withDisturbance,
  withEncoder,
  withOption,
  withStart,
} from '../../static/model/experiment.js';
import { differs } from '../../static/text/format.js';
import { findingsOf } from '../../static/panels/findings.js';
import { motorText, notSettled } from '../../static/panels/metrics.js';
import { QUANTITIES } from '../../static/model/quantities.js';
import { NONE } from '../../static/model/requirements.js';
import { designOf, requestOf } from '../../static/model/store.js';
import { MACHINE } from './presets.mjs';

const STEPS = { reference: { theta: 0.1, psi: 0.2 }, duration: 3 };
const RIG = { theta: 2880, psi: 4096 };
const preset = {
  name: 'rig',
  title: '',
  source: '',
  rig: 'helicopter',
  parameters: { K_pp: 1 },
  limits: { V_p: 24, V_y: 15 },
  poles: [-1, -2, -3, -4].map((re) => ({ re, im: 0 })),
  loops: { pitch: { kp: 1, ti: 1 }, yaw: { kp: 1, ti: 1 } },
  ...MACHINE,
  scenario: STEPS,
};

test('an option that is put back to its standard leaves nothing behind', () => {
  const changes = [
    [(s) => withOption(s, { saturation: false }), (s) => withOption(s, { saturation: true })],
    [(s) => withOption(s, { anti_windup: 'none' }), (s) => withOption(s, { anti_windup: 'clamping' })],
    [
      (s) => withOption(s, { anti_windup: 'back-calculation', tracking_time: 0.05 }),
      (s) => withOption(s, { anti_windup: 'clamping' }),
    ],
    [(s) => withOption(s, { rtol: 1e-8 }), (s) => withOption(s, { rtol: 1e-5 })],
    [(s) => withDigital(s, {}), (s) => withDigital(s, null)],
    [(s) => withDisturbance(s, { V_y: 2 }), (s) => withDisturbance(s, null)],
    [(s) => withStart(s, 'theta', 0), (s) => withStart(s, 'theta', undefined)],
  ];
  for (const [there, back] of changes) {
    const changed = there(STEPS);
    assert.equal(isStandard(changed), false);
    assert.notEqual(experimentWords(changed).join(), '');
    assert.deepEqual(back(changed), STEPS);
  }
  assert.equal(isStandard(STEPS), true);
  assert.deepEqual(experimentWords(STEPS), []);
});

test('a change leaves the other options as they are, and the scenario that it came from', () => {
  const before = Object.freeze(withStart(withDigital(STEPS, { delay: true }), 'psi', 0.3));
  const after = withDigital(before, { sample_time: 0.01 });
  assert.deepEqual(after, { ...STEPS, initial: { psi: 0.3 }, digital: { delay: true, sample_time: 0.01 } });
  assert.deepEqual(withStart(after, 'theta', 0.1).initial, { theta: 0.1, psi: 0.3 });
  assert.deepEqual(standard(after), STEPS);
});

test('one encoder that is not the rig’s sends both, so that the server fills in no other rig’s', () => {
  const one = withEncoder(withDigital(STEPS, {}), 'theta', 512, RIG);
  assert.deepEqual(one.digital.encoders, { theta: 512, psi: 4096 });
  assert.equal(withEncoder(one, 'theta', undefined, RIG).digital.encoders, undefined);
  assert.equal(withEncoder(one, 'theta', 2880, RIG).digital.encoders, undefined);
});

test('the request says what differs, and the page’s own tolerance', () => {
  const design = { ...designOf(preset), scenario: withDisturbance(withDigital(STEPS, { noise: 0.01 }), { time: 1 }) };
  const { scenario } = requestOf(design, 1);
  assert.deepEqual(scenario, {
    ...STEPS,
    digital: { noise: 0.01 },
    disturbance: { V_p: 1, V_y: 0, time: 1 },
    rtol: 1e-5,
    samples: 501,
  });
  assert.equal(scenarioBody(withOption(STEPS, { rtol: 1e-8 })).rtol, 1e-8);
});

test('the cloud is asked for what it knows and says what it leaves out', () => {
  const scenario = withDisturbance(
    withDigital(withOption(withStart(STEPS, 'psi', 0.1), { saturation: false, rtol: 1e-8 }), {}),
    {},
  );
  assert.deepEqual(cloudScenario(scenario), { ...STEPS, initial: { psi: 0.1 }, saturation: false });
  assert.deepEqual(cloudRequest({ ...designOf(preset), scenario }, 0.1, 'psi', ['K_pp'], 5).scenario, {
    reference: { psi: 0.2 },
    duration: 3,
    initial: { psi: 0.1 },
    saturation: false,
  });
  assert.equal(cloudCaveat(STEPS), '');
  assert.equal(cloudCaveat(scenario), 'not digital, not disturbed');
  const cloud = { done: 200, share_stable: 1, share_within_limits: 1 };
  assert.equal(cloudWords(cloud, withDigital(STEPS, {})), '200 rigs (not digital): 100 % stable, 100 % within limits');
  assert.equal(cloudWords(cloud, STEPS), '200 rigs: 100 % stable, 100 % within limits');
});

test('words name what differs, with units, and nothing else', () => {
  const cases = [
    [withDigital(STEPS, {}), 'digital rig, 2 ms'],
    [
      withDigital(STEPS, {
        sample_time: 1,
        delay: true,
        rates: 'true',
        noise: Math.PI / 360,
        encoders: { theta: 0, psi: 0 },
      }),
      'digital rig, 1 s, one sample late, true rates, exact angles, noise 0.5°',
    ],
    [withDisturbance(STEPS, { time: 2 }), 'disturbance 1 V (pitch) at 2 s'],
    [withDisturbance(STEPS, { V_p: 0, V_y: -2.5 }), 'disturbance −2.5 V (yaw) at 1.5 s'],
    [withOption(STEPS, { anti_windup: 'back-calculation', tracking_time: 0.05 }), 'back-calculation, 50 ms'],
    [withOption(STEPS, { saturation: false, anti_windup: 'none' }), 'no voltage limits'],
    [withOption(STEPS, { travel_stops: false, trim_feedforward: false }), 'no stops · no trim'],
    [withStart(STEPS, 'theta', -Math.PI / 18), 'starts at θ −10.0°'],
    [withOption(STEPS, { rtol: 1e-8 }), 'tolerance 1e−8'],
  ];
  for (const [scenario, words] of cases) assert.equal(experimentWords(scenario).join(' · '), words);
});

test('figures differ from five percent on, and what is missing from what is there', () => {
  assert.deepEqual(
    [
      differs(1, 1.04),
      differs(1, 1.06),
      differs(0.001, 0.002, 0.01),
      differs(undefined, 1),
      differs(undefined, undefined),
    ],
    [false, true, false, true, false],
  );
});

test('a motor’s peak, or the share of time at its limit', () => {
  assert.equal(motorText({ V_p: { peak: 24, saturated: 0.004 } }, 'V_p'), 'at limit 0.4 %');
  assert.equal(motorText({ V_p: { peak: 12.34, saturated: 0 } }, 'V_p'), '12.3 V');
});

test('what has not settled is said in words, and only that', () => {
  assert.equal(notSettled({ theta: { settled: false } }, 'theta'), 'not settled');
  for (const m of [{ theta: { settled: true, settling_time: 1 } }, {}, undefined])
    assert.equal(notSettled(m, 'theta'), undefined);
});

test('what explains others, or says what limits cost, comes first among warnings, errors before all', () => {
  const codes = ['saturation_V_p', 'unlike_linear', 'slow_sampling', 'loop_unstable'];
  const findings = codes.map((code, i) => ({ code, severity: i === 3 ? 'error' : 'warning', message: code }));
  const order = (part) =>
    findingsOf({ reply: part, problem: null, design: designOf(preset), requirements: NONE }).map((f) => f.code);
  assert.deepEqual(order({ findings }), ['loop_unstable', 'unlike_linear', 'slow_sampling', 'saturation_V_p']);
  assert.deepEqual(order({ findings: [] }), []);
});

test('each option that is not standard is told in words', () => {
  const other = { number: (/** @type {number} */ v) => v / 100, boolean: (/** @type {boolean} */ v) => !v };
  for (const [name, value] of Object.entries(STANDARD)) {
    const words = QUANTITIES[`scenario.${name}`].words ?? [];
    const changed = words.find((word) => word !== value) ?? other[typeof value](value);
    assert.notDeepEqual(experimentWords({ ...STEPS, [name]: changed }), [], name);
  }
});
