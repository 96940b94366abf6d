// Why not: what is asked of the server, and what its moves do to the design.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { LOCKS } from '../../static/model/locks.js';
import { designOf, initialState } from '../../static/model/store.js';
import { locksOf } from '../../static/labs/parts.js';
import { freeOf, isKeptBack, requestOf, requiredOf } from '../../static/nearest/asked.js';
import { doneBy } from '../../static/nearest/line.js';
import { moved, numbersOf, waysOf, whatMoves, wordsOf } from '../../static/nearest/moves.js';
import { PRESETS } from './presets.mjs';

const design = designOf(PRESETS[0]);
const state = (part = {}) => ({ ...initialState(), design, ...part });
const free = (part) => freeOf(state(part));
const step = (unlocked, hidden = [], goals = []) => {
  const { locks, free: parts } = locksOf(unlocked);
  return { locks, task: { free: parts, hidden, goals } };
};

/** A reply whose steps settle and overshoot so. */
const replyOf = (settling, overshoot, lag) => ({
  stable: true,
  lag_margin: lag,
  axis_steps: Object.fromEntries(
    ['theta', 'psi'].map((axis) => [
      axis,
      { nonlinear: { metrics: { [axis]: { settling_time: settling, overshoot } } } },
    ]),
  ),
});

test('what is locked does not move', () => {
  assert.deepEqual(free(), ['poles', 'loops']);
  assert.deepEqual(free({ locks: ['poles'] }), ['loops']);
  assert.deepEqual(free({ locks: ['loops'] }), ['poles']);
  assert.deepEqual(free({ locks: Object.keys(LOCKS) }), []);
  assert.deepEqual(free(step(['pitch-poles', 'yaw-pi'])), ['pitch-pair', 'yaw-pi']);
  assert.deepEqual(free(step(['poles'])), ['poles']);
  // a pair whose rotor stays cannot be moved as one
  const placed = { design: { ...design, place_rotors: true } };
  assert.deepEqual(free({ ...placed, ...step(['pitch-poles']) }), []);
  assert.deepEqual(free({ ...placed, ...step(['pitch-poles', 'rotor-poles']) }), ['pitch-pair']);
});

test('what moves nothing, or takes the server long, is not asked for', () => {
  assert.deepEqual(free({ design: { ...design, outer: 'none' } }), ['poles']);
  assert.deepEqual(free({ design: { ...design, method: 'lqr' } }), ['loops']);
  assert.deepEqual(free({ design: null }), []);
});

test('all requirements are asked for where one is missed', () => {
  const requirements = { settling: 0.8, overshoot: 5, lag: null };
  const required = (reply) => requiredOf(state({ reply, requirements }), [], () => false);
  const both = {
    settling_time: [{ axis: 'both', max: 0.8 }],
    overshoot: [{ axis: 'both', max: 5 }],
  };
  assert.deepEqual(required(replyOf(0.9, 2)), both);
  assert.deepEqual(required(replyOf(undefined, 2)), both);
  assert.equal(required(replyOf(0.8, 5)), null);
  assert.equal(required(null), null);
  const lag = (own) =>
    requiredOf(
      state({ reply: replyOf(1, 1, own), requirements: { settling: null, overshoot: null, lag: 0.2 } }),
      [],
      () => false,
    );
  assert.deepEqual(lag(0.1), { lag_margin: [{ min: 0.2 }] });
  assert.equal(lag(0.3), null);
});

test("goals of a lab's step are asked for as the server takes them, those that are met too", () => {
  const goals = [
    {
      kind: 'figure',
      figure: 'overshoot',
      of: 'axis',
      axis: 'psi',
      model: 'nonlinear',
      steps: 'alone',
      max: 8,
      motor: null,
    },
    { kind: 'figure', figure: 'overshoot', of: 'axis', axis: 'theta', model: 'linear', steps: 'together', max: 5 },
    { kind: 'figure', figure: 'disk_margin', of: 'sensitivity', axis: null, model: 'nonlinear', min: 0.9 },
    { kind: 'figure', figure: 'gain_margin', of: 'margins', motor: 'V_p', model: 'nonlinear', min: 2 },
    { kind: 'figure', figure: 'coupling_peak', of: 'step', axis: 'theta', steps: 'together', max: 0.1 },
    { kind: 'figure', figure: 'norm', of: 'design', max: 80, unstable: true },
    { kind: 'cloud', share: 'stable', min: 0.95 },
    { kind: 'setting', path: 'scenario.duration', max: 5 },
  ];
  const required = (isMissed, part = {}) => requiredOf(state({ reply: replyOf(1, 1), ...part }), goals, isMissed);
  assert.deepEqual(
    required(({ figure }) => figure === 'disk_margin'),
    {
      overshoot: [
        { axis: 'psi', model: 'nonlinear', steps: 'alone', max: 8 },
        { axis: 'theta', model: 'linear', steps: 'together', max: 5 },
      ],
      disk_margin: [{ min: 0.9 }],
      gain_margin: [{ motor: 'V_p', min: 2 }],
    },
  );
  assert.equal(
    required(() => false),
    null,
  );
  assert.equal(
    required(({ figure }) => figure === 'norm'),
    null,
  ); // it counts for unstable loops, too
  const requirements = { settling: 3, overshoot: null, lag: null };
  assert.ok('settling_time' in required(({ figure }) => figure === 'overshoot', { requirements }));
  const hidden = step([], ['requirements']);
  assert.ok(!('settling_time' in required(({ figure }) => figure === 'overshoot', { requirements, ...hidden })));
});

test('nothing is told where suggestions are kept back', () => {
  assert.equal(isKeptBack(state()), false);
  assert.equal(isKeptBack(state(step([], ['margins']))), false);
  for (const what of ['remarks', 'suggestions', 'poles']) assert.equal(isKeptBack(state(step([], [what]))), true);
  assert.equal(isKeptBack(state({ locks: ['remarks'] })), true);
});

test('the request is the design with its experiment', () => {
  const body = requestOf(design, { lag_margin: [{ min: 0.2 }] }, ['poles']);
  assert.deepEqual(body.nearest, { require: { lag_margin: [{ min: 0.2 }] }, free: ['poles'] });
  assert.equal(body.preset, design.preset);
  assert.deepEqual(body.scenario.reference, design.scenario.reference);
});

const to = {
  poles: [
    { re: -11, im: 2 },
    { re: -11, im: -2 },
    { re: -8.7, im: 0 },
    { re: -9.3, im: 0 },
  ],
  loops: { pitch: { kp: 28, ti: 0.1 }, yaw: { kp: 30, ti: 0.25 } },
};
const move = (...handles) => ({ handles, design: to, distance: 0.1, figures: [], words: '' });

test('a move changes what moves, and leaves all else as it is', () => {
  const pair = moved(design, move('pitch-pair'));
  assert.deepEqual(pair.poles.slice(0, 2), to.poles.slice(0, 2));
  assert.deepEqual(pair.poles.slice(2), design.poles.slice(2));
  assert.deepEqual({ ...pair, poles: design.poles }, { ...design });
  const pi = moved(design, move('yaw-pi'));
  assert.deepEqual(pi.loops, { pitch: design.loops.pitch, yaw: to.loops.yaw });
  assert.deepEqual(pi.poles, design.poles);
  const rotor = moved(design, { ...move('yaw-pair'), design: { ...to, rotor_poles: [-20, -21] } });
  assert.deepEqual(rotor.rotor_poles, [design.rotor_poles[0], -21]);
});

test('each pole goes to the nearer place of its pair', () => {
  const ways = waysOf(design, moved(design, move('pitch-pair', 'yaw-pair')));
  assert.deepEqual(
    ways.map(({ index, from, to: end }) => [index, from.re, end.re]),
    [
      [0, -12, -11],
      [1, -10, -11],
      [2, -9.25, -9.3],
      [3, -8.76, -8.7],
    ],
  );
  assert.deepEqual(waysOf(design, moved(design, move('yaw-pi'))), []);
});

test('words name what moves, and where it goes', () => {
  const all = move('pitch-pair', 'yaw-pair', 'pitch-pi', 'yaw-pi');
  assert.deepEqual(
    wordsOf(design, all).map(({ text }) => text),
    ['pitch poles to −11 ± 2j', 'yaw poles to −8.7, −9.3', 'pitch PI to kₚ 28', 'yaw PI to Tᵢ 0.25 s'],
  );
  assert.equal(whatMoves(all), 'poles + PI');
  assert.equal(whatMoves(move('yaw-pair', 'pitch-pi', 'yaw-pi')), 'yaw poles + PI');
  assert.equal(whatMoves(move('pitch-pi')), 'pitch PI');
  assert.deepEqual(numbersOf(design, moved(design, move('yaw-pi'))), [{ axis: 'yaw', text: '→ 30, 0.25' }]);
});

test('what a move does is told in a sentence', () => {
  const to = { poles: design.poles, loops: { ...design.loops, yaw: { kp: 31.5, ti: 0.1 } } };
  const move = { handles: ['yaw-pi'], distance: 0.017, design: to, figures: [{ text: '0.80 s' }, { text: '0.7 %' }] };
  assert.equal(doneBy(design, move), '1.7 % away: yaw PI to kₚ 31.5. It gives 0.80 s, 0.7 %.');
});
