import assert from 'node:assert/strict';
import test from 'node:test';
import { MOST, resume, suspend } from '../../static/scorm/suspended.js';

const real = (...all) => all.map((re) => ({ re, im: 0 }));
const START = {
  preset: 'quanser-2dof-manual',
  parameters: { B_p: 0.81234 },
  poles: real(-2, -2.5, -9.25, -8.76),
  outer: 'none',
  loops: { pitch: { kp: 30, ti: 0.1 }, yaw: { kp: 30, ti: 0.1 } },
  scenario: { reference: { theta: 0.2 }, duration: 5 },
};
/** The second step goes on with the first one's design. */
const starts = (name, designs) => ({ settle: START, pair: { ...(designs.settle ?? START), outer: 'pi' } })[name];

const WORK = {
  rig: 3,
  at: 'pair',
  steps: {
    settle: {
      design: { ...START, poles: [{ re: -3.125, im: 4 }, { re: -3.125, im: -4 }, ...real(-9.25, -8.76)] },
      answers: { who: 2, why: 'Because “yaw” lags & lags = 1' },
      hints: [0],
      attempts: 2,
      points: 7,
      met: [true, false, null],
    },
    pair: {
      design: {
        ...START,
        outer: 'pi',
        poles: real(-7.1234567890123, -2.5, -9.25, -8.76),
        observer: { poles: real(-40, -41, -42, -43), coupling: 'axis-decoupled' },
        scenario: { reference: { theta: 0.2 }, duration: 3, digital: { sample_time: 0.02 } },
      },
    },
  },
};

test('work comes back as it was kept, to the last digit', () => {
  const { text, whole } = suspend(WORK, starts);
  assert.equal(whole, true);
  assert.ok(text.length < 500, `${text.length} letters`);
  assert.deepEqual(resume(text, starts), WORK);
});

test('a design that is as its step began is kept as one that is', () => {
  const work = { rig: 0, at: 'settle', steps: { settle: { design: START } } };
  assert.deepEqual(resume(suspend(work, starts).text, starts), work);
});

test('what is gone from the start is gone when it comes back', () => {
  const { outer: _gone, ...rest } = START;
  const work = { rig: 0, at: 'settle', steps: { settle: { design: rest } } };
  assert.deepEqual(resume(suspend(work, starts).text, starts), work);
});

test('what is too long loses the middle of answers first, then other designs, never points', () => {
  const long = {
    ...WORK,
    steps: { ...WORK.steps, settle: { ...WORK.steps.settle, answers: { why: 'ab '.repeat(3000) } } },
  };
  const { text, whole } = suspend(long, starts);
  assert.equal(whole, false);
  assert.ok(text.length <= MOST);
  const back = resume(text, starts);
  assert.ok(back.steps.settle.answers.why.startsWith('ab ab'));
  assert.ok(back.steps.settle.answers.why.length >= 400);
  assert.deepEqual(back.steps.settle.design, WORK.steps.settle.design);
  const answers = Object.fromEntries(Array.from({ length: 60 }, (_, i) => [`q${i}`, 'x'.repeat(500)]));
  const longer = suspend({ ...WORK, steps: { ...WORK.steps, settle: { ...WORK.steps.settle, answers } } }, starts);
  assert.ok(longer.text.length <= MOST);
  const left = resume(longer.text, starts);
  assert.equal(left.steps.settle.points, 7);
  assert.deepEqual(left.steps.settle.met, [true, false, null]);
  assert.deepEqual(left.steps.pair.design.poles, WORK.steps.pair.design.poles);
});

test('what is none of ours is nothing, and a step that the lab lost is left out', () => {
  for (const text of ['', '{', 'null', '[]', '{"v":2,"r":0,"at":"settle","s":{}}', 'page=3', '{"v":1,"r":"x","at":1}'])
    assert.equal(resume(text, starts), null);
  const text = suspend({ ...WORK, steps: { ...WORK.steps, settle: WORK.steps.settle } }, starts).text;
  const without = (name, designs) => (name === 'settle' ? undefined : starts(name, designs));
  assert.deepEqual(Object.keys(resume(text, without).steps), ['pair']);
});
