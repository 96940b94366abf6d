// Views apart from each other, findings and their places, the projector's address.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { placeOf, remarksOf } from '../../static/model/finding_places.js';
import { isolated } from '../../static/ui/isolated.js';
import { projectorWanted, withoutProjector } from '../../static/ui/projector.js';
import { NONE } from '../../static/model/requirements.js';

test('a view that fails is told of once and tried again', () => {
  const told = [];
  let broken = true;
  const render = isolated(
    (n) => {
      if (broken) throw new Error('no');
      return n;
    },
    (error) => told.push(error.message),
  );
  assert.equal(render(1), undefined);
  assert.equal(render(2), undefined);
  broken = false;
  assert.equal(render(3), 3);
  assert.deepEqual(told, ['no']);
});

const poles = [-12, 1, -9, -8].map((re) => ({ re, im: 0 }));
const state = (part = {}) => ({ design: { poles }, requirements: NONE, problem: null, ...part });

test('a finding leads to the pole that it is about, to its field, or nowhere', () => {
  assert.equal(placeOf('right_half_plane', state()), '[data-testid="pole-1"]');
  assert.equal(placeOf('far_out', state()), '[data-testid="pole-0"]');
  const reply = {
    axis_steps: {
      theta: { nonlinear: { metrics: { theta: { settling_time: 0.5 } } } },
      psi: { nonlinear: { metrics: { psi: { settling_time: 0.9 } } } },
    },
  };
  assert.equal(
    placeOf('requirement_missed', state({ reply, requirements: { settling: 0.6, overshoot: null } })),
    '[data-testid="pole-3"]',
  ); // yaw's slower one, though pitch's are slower
  assert.equal(placeOf('high_gain', state()), '[data-testid="pole-0"]');
  assert.equal(placeOf('not_settled', state()), '[data-testid="duration"]');
  assert.equal(placeOf('saturation_V_y', state()), '[data-testid="plot-V_y"] .plot-body');
  assert.equal(placeOf('slow_sampling', state()), '[data-testid="experiment-sample-time"]');
  assert.equal(placeOf('unheard_of', state()), '');
  assert.equal(placeOf('invalid', state({ problem: { field: 'parameters.B_y' } })), '[data-field="parameters.B_y"]');
  assert.equal(placeOf('invalid', state({ problem: { field: 'x"] *' } })), '[data-field=""]');
});

test('what is said at the loops and plots is short, with its sentence behind', () => {
  const findings = [
    ['pi_unstable', 'error'],
    ['saturation_V_p', 'warning'],
    ['poorly_damped', 'warning'],
    ['travel_stop', 'warning'],
  ].map(([code, severity]) => ({ code, severity, message: `${code}.` }));
  const reply = { findings, step: { nonlinear: { metrics: { V_p: { saturated: 0.123 }, V_y: { saturated: 0 } } } } };
  const { loops, theta, V_p, V_y } = remarksOf({ reply, problem: null });
  assert.deepEqual(loops, { text: '✕ unstable', severity: 'error', message: 'pi_unstable.' });
  assert.equal(V_p.text, '▲ at limit 12 %');
  assert.equal(theta.text, '▲ hits a stop');
  assert.equal(V_y, null);
  assert.equal(remarksOf({ reply, problem: {} }).loops, null); // they would be those of another design
  assert.equal(remarksOf({ reply: null, problem: null }).V_p, null);
});

test('the address asks for the projector before the memory does', () => {
  assert.equal(projectorWanted('', null), false);
  assert.equal(projectorWanted('', 'on'), true);
  assert.equal(projectorWanted('?projector', 'off'), true);
  assert.equal(projectorWanted('?projector=false', 'on'), false);
  assert.equal(withoutProjector('?projector&lang=de'), '?lang=de');
  assert.equal(withoutProjector('?projector=1'), '');
  assert.equal(withoutProjector('?lang=de'), '?lang=de');
});

test('a share at the limit shows a decimal below one percent alone, so that it never reads as none', () => {
  const said = (share) =>
    remarksOf({
      reply: {
        findings: [{ code: 'saturation_V_p', severity: 'warning', message: '' }],
        step: { nonlinear: { metrics: { V_p: { saturated: share } } } },
      },
      problem: null,
    }).V_p.text;
  assert.deepEqual(
    [0.0004, 0.004, 0.0099, 0.01, 0.011, 1].map(said),
    ['< 0.1 %', '0.4 %', '1.0 %', '1 %', '1 %', '100 %'].map((share) => `▲ at limit ${share}`),
  );
  assert.equal(said(0), '▲ at limit'); // no share of the samples is known
});

test('a share at the limit is that of the step that is seen alone', () => {
  const of = (saturated) => ({ nonlinear: { metrics: { V_p: { saturated } } } });
  const reply = {
    step: of(0.2),
    axis_steps: { theta: of(0.05), psi: of(0) },
    findings: [{ code: 'saturation_V_p', severity: 'warning', message: 'm' }],
  };
  const texts = ['both', 'theta', 'psi'].map((motion) => remarksOf({ reply, problem: null, motion }).V_p.text);
  assert.deepEqual(texts, ['▲ at limit 20 %', '▲ at limit 5 %', '▲ at limit']);
});
