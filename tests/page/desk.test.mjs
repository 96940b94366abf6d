import assert from 'node:assert/strict';
import test from 'node:test';
import { PackageDesk, placeOf } from '../../static/scorm/desk.js';
import { Lms } from '../../static/scorm/lms.js';
import { MOST } from '../../static/scorm/suspended.js';
import { PRESETS } from './presets.mjs';

const [PRESET] = PRESETS;
const goal = (name, max, more = {}) => ({
  name,
  kind: 'figure',
  label: name,
  required_text: `≤ ${max} s`,
  points: 4,
  unstable: false,
  figure: 'settling_time',
  of: 'axis',
  axis: 'theta',
  model: 'nonlinear',
  steps: 'alone',
  max,
  ...more,
});
const CONTENT = {
  lab: {
    name: 'small',
    title: 'A small lab',
    preset: PRESET.name,
    points: 10,
    steps: [
      {
        name: 'settle',
        title: 'Settle',
        start: { outer: 'none', poles: [-2, -2.5, -9.25, -8.76] },
        unlocked: ['pitch-poles'],
        points: 6,
        goals: [goal('fast', 0.8)],
        questions: [
          { name: 'who', kind: 'choice', text: 'Who?', points: 2, choices: ['yaw', 'pitch'] },
          { name: 'why', kind: 'text', text: 'Why?', points: 0 },
        ],
        hints: [{ cost: 1 }, { cost: 0, text: 'Left.' }],
      },
      {
        name: 'again',
        title: 'Again',
        continue: true,
        start: { outer: 'pi' },
        unlocked: ['pitch-pi'],
        points: 4,
        goals: [goal('slow', 3)],
        questions: [],
        hints: [],
      },
    ],
  },
  left_out: [],
  pass: 0.8,
  presets: PRESETS,
  methods: [],
  hints: {
    settle: [
      { text: 'About 4/σ.', math: {} },
      { text: 'Left.', math: {} },
    ],
    again: [],
  },
  clouds: {},
  answers: { settle: { who: { kind: 'choice', answer: [2] }, why: { kind: 'text' } }, again: {} },
  rigs: [0.7, 0.75, 0.8].map((B_p) => ({ rig: { preset: PRESET.name, parameters: { B_p } }, right: {} })),
};

/** An LMS that keeps what it is told. */
function anLms(values = {}, refused = []) {
  const api = Object.fromEntries(['Initialize', 'Commit', 'Finish'].map((name) => [`LMS${name}`, () => 'true']));
  api.LMSGetValue = (element) => values[element] ?? '';
  api.LMSSetValue = (element, value) => (refused.includes(element) ? 'false' : ((values[element] = value), 'true'));
  api.LMSGetLastError = () => '405';
  api.LMSGetErrorString = () => 'Incorrect Data Type';
  return new Lms(api, () => 0);
}

/** Settles after so many seconds; without a number there is no such design. */
const answer = (settling) => () =>
  settling === undefined
    ? { problem: { detail: 'No gain of this structure places these poles.' } }
    : {
        reply: {
          stable: true,
          axis_steps: {
            theta: {
              nonlinear: {
                reference: { theta: 0.2, psi: 0.5 },
                metrics: { theta: { settling_time: settling, settled: true } },
              },
            },
          },
        },
      };

/** @param {object} values of the LMS */
const deskWith = (values, settling, refused) =>
  new PackageDesk(CONTENT, anLms(values, refused), answer(settling), async () => null);

const BODY = { preset: PRESET.name, outer: 'none', poles: [-5, -6, -9.25, -8.76], parameters: { B_p: 0.75 } };

test('a student has one of the rigs, always the same one', () => {
  const places = Array.from({ length: 300 }, (_, i) => placeOf(`student${i}`, 3));
  for (const place of [0, 1, 2]) assert.ok(places.filter((own) => own === place).length > 60);
  const desk = deskWith({ 'cmi.core.student_id': 's17' });
  assert.equal(desk.place, placeOf('s17', 3));
  assert.equal(desk.rig, CONTENT.rigs[desk.place].rig);
});

test('handing in tells the LMS points and status: incomplete, then passed, and never less than the best', async () => {
  const values = {};
  const desk = deskWith(values, 0.5);
  assert.equal(values['cmi.core.lesson_status'], 'incomplete');
  assert.equal('cmi.core.score.raw' in values, false);
  const first = await desk.mark('settle', BODY, { who: 2, why: 'Since' });
  assert.deepEqual(
    [...first.goals, ...first.questions].map(({ met, points }) => [met, points]),
    [
      [true, 4],
      [true, 2],
      [null, 0],
    ],
  );
  assert.equal(values['cmi.core.score.raw'], '60');
  assert.equal(values['cmi.core.lesson_status'], 'incomplete');
  const worse = await desk.mark('settle', BODY, { who: 1 });
  assert.equal(worse.points, 4);
  assert.equal(values['cmi.core.score.raw'], '60');
  assert.equal(desk.kept.settle.attempts, 2);
  await desk.mark('again', { ...BODY, outer: 'pi' }, {});
  assert.equal(values['cmi.core.score.raw'], '100');
  assert.equal(values['cmi.core.lesson_status'], 'passed');
});

test('all handed in with too few points is completed', async () => {
  const values = {};
  const desk = deskWith(values, 5);
  await desk.mark('settle', BODY, { who: 2 });
  await desk.mark('again', BODY, {});
  assert.equal(values['cmi.core.lesson_status'], 'completed');
  assert.equal(values['cmi.core.score.raw'], '20');
});

test('a hint costs once, and its text comes back with the rest', async () => {
  const values = {};
  const desk = deskWith(values, 0.5);
  assert.equal((await desk.hint('settle', 1)).text, 'About 4/σ.');
  await desk.hint('settle', 1);
  assert.equal((await desk.mark('settle', BODY, { who: 2 })).points, 5);
  const back = deskWith(values, 0.5);
  assert.deepEqual(back.kept.settle.hints, [{ text: 'About 4/σ.', math: {}, hint: 1 }]);
});

test('what was kept comes back: rig, step, design, answers, and what was met', async () => {
  const values = { 'cmi.core.student_id': 's1' };
  const desk = deskWith(values, 0.5);
  await desk.mark('settle', BODY, { who: 1, why: 'Since' });
  desk.keep('again', { ...BODY, outer: 'pi', poles: [-7, -6, -9.25, -8.76] }, {});
  desk.leave();
  assert.ok(values['cmi.suspend_data'].length < MOST / 4);
  const back = deskWith({ ...values, 'cmi.core.student_id': 'another id of the same student' }, 0.5);
  assert.equal(back.place, desk.place);
  assert.equal(back.at, 'again');
  assert.deepEqual(back.kept.settle.answers, { who: 1, why: 'Since' });
  assert.equal(back.kept.settle.design.poles[0].re, -5);
  assert.equal(back.kept.again.design.poles[0].re, -7);
  assert.equal(back.kept.settle.best.points, 4);
  assert.deepEqual(
    [...back.kept.settle.best.goals, ...back.kept.settle.best.questions].map(({ name, met }) => [name, met]),
    [
      ['fast', true],
      ['who', false],
      ['why', null],
    ],
  );
  assert.equal(values['cmi.core.score.raw'], '40');
});

test('where nothing is kept it says so: no LMS, a review, one that refuses', () => {
  const none = new PackageDesk(CONTENT, new Lms(null, () => 0), answer(1), async () => null);
  assert.match(none.standing.words, /nothing is kept/);
  const values = { 'cmi.core.lesson_mode': 'review', 'cmi.suspend_data': '' };
  assert.match(deskWith(values, 1).standing.words, /review: nothing is kept/);
  assert.deepEqual(Object.keys(values), ['cmi.core.lesson_mode', 'cmi.suspend_data']);
  assert.match(deskWith({}, 1, ['cmi.suspend_data']).standing.words, /does not keep.*Incorrect Data Type/);
  assert.match(deskWith({}, 1).standing.words, /^Kept in your course/);
});

test('a design that does not exist meets nothing, with the reason', async () => {
  const { goals, points } = await deskWith({}).mark('settle', BODY, {});
  assert.equal(goals[0].met, false);
  assert.match(goals[0].message, /No gain/);
  assert.equal(points, 0);
});

test('work of a package with more rigs goes on with one that is here', () => {
  const values = { 'cmi.core.student_id': 's1', 'cmi.suspend_data': '{"v":1,"r":63,"at":"gone","s":{}}' };
  const desk = deskWith(values, 1);
  assert.equal(desk.place, placeOf('s1', 3));
  assert.equal(desk.at, 'settle');
});
