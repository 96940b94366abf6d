// What a student is told of what was handed in: points and why they are fewer, and an attempt that had to wait.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { ClassDesk } from '../../static/labs/class.js';
import { lateText, whyFewer } from '../../static/labs/verdict.js';

const text = (name, of, value_text = 'Integrate.') => ({ name, label: name, met: null, value_text, points: 0, of });
const marked = (more) => ({ goals: [], questions: [], points: 0, of: 8, ...more });

test('hints that were taken are told, with what they cost', () => {
  assert.deepEqual(whyFewer(marked({ cost: 0 }), {}, true), []);
  assert.deepEqual(whyFewer(marked({ cost: 1 }), {}, true), ['Hints that you took cost 1 point.']);
  assert.deepEqual(whyFewer(marked({ cost: 2.5 }), {}, true), ['Hints that you took cost 2.5 points.']);
});

test('answers in words that wait for a mark are told, where somebody marks', () => {
  const { met: _met, ...unsaid } = text('why', 1);
  const right = { ...text('who', 4), met: true };
  const three = marked({ questions: [text('cure', 2), unsaid, text('empty', 4, ' '), right] });
  const more = (n) => [`${n} points more may come: your instructor marks an answer.`];
  assert.deepEqual(whyFewer(three, {}, true), more(3));
  assert.deepEqual(whyFewer(three, {}, false), []);
  const hand = [{ question: 'why', points: 1 }];
  assert.deepEqual(whyFewer(three, { hand }, true), more(2));
  const all = [...hand, { question: 'cure', points: 0 }];
  assert.deepEqual(whyFewer(three, { hand: all }, true), []);
});

test('what waits is said for as long as it waits', () => {
  assert.match(lateText({ kind: 'away', words: '' }), /as soon as it can/);
  assert.match(lateText({ kind: 'waiting', words: '' }), /as soon as it can/);
  assert.match(lateText({ kind: 'closed', words: '' }), /if the class opens again/);
  assert.equal(lateText({ kind: 'fine', words: '' }), '');
});

test('an attempt that was kept while the server was away arrives with its mark', async (t) => {
  const steps = { settle: { attempts: 0 } };
  const joined = { id: 1, name: 'Ada', student: 's', rig: {}, lab: { steps: [] }, steps, open: true };
  const kept = marked({ points: 4 });
  let away = false;
  const refusal = { status: 422, code: 'invalid_design', detail: 'No.' };
  let answer = { status: 200, body: { ...kept, best: kept } };
  t.mock.method(globalThis, 'fetch', async (url) => {
    if (away) throw new TypeError('away');
    const said = String(url).includes('/attempts') ? answer : { status: 200, body: joined };
    return Response.json(said.body, { status: said.status });
  });
  globalThis.addEventListener = () => {};
  globalThis.document = { baseURI: 'http://127.0.0.1/' };
  const stored = new Map();
  globalThis.localStorage = {
    getItem: (name) => stored.get(name) ?? null,
    setItem: (name, value) => stored.set(name, value),
    removeItem: (name) => stored.delete(name),
  };
  const desk = new ClassDesk('ABCDEFG', joined);
  t.after(() => {
    desk.leave();
    delete globalThis.addEventListener;
    delete globalThis.document;
    delete globalThis.localStorage;
  });
  const arrived = [];
  desk.onChange(
    () => {},
    (...all) => arrived.push(all),
  );
  for (const refused of [false, true]) {
    away = true;
    assert.equal(await desk.mark('settle', { outer: 'none' }, {}), null);
    assert.equal(desk.standing.kind, 'away');
    assert.equal(arrived.length, 0);
    away = false;
    if (refused) answer = { status: 422, body: refusal };
    await desk.heal();
    const [[{ step, design, answers }, mark, error]] = arrived.splice(0);
    assert.deepEqual([step, design, answers, desk.standing.kind], ['settle', { outer: 'none' }, {}, 'fine']);
    assert.equal(mark?.points, refused ? undefined : 4);
    assert.equal(error?.problem?.code, refused ? 'invalid_design' : undefined);
  }
});
