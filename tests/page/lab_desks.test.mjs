// A lab alone: two tabs of one browser, a browser that keeps nothing.
import assert from 'node:assert/strict';
import { beforeEach, test } from 'node:test';

import { AloneDesk } from '../../static/labs/alone.js';
import { isForgetful, read, write } from '../../static/labs/kept.js';

/** The browser's storage, which may be full. */
const storage = new Map();
let full = false;
globalThis.localStorage = {
  getItem: (key) => storage.get(key) ?? null,
  setItem(key, text) {
    if (full) throw new DOMException('full', 'QuotaExceededError');
    storage.set(key, text);
  },
};
const page = new EventTarget();
globalThis.addEventListener = page.addEventListener.bind(page);
const LAB = { name: 'small', preset: 'quanser-2dof-manual', steps: [{ name: 'settle' }, { name: 'loop' }] };
let points = 0;
/** The server: a lab, marks, hints. */
globalThis.fetch = async (url) => {
  const body = String(url).includes('/mark')
    ? { goals: [], questions: [], points, of: 9 }
    : String(url).includes('/hints/')
      ? { text: 'Drag left.' }
      : LAB;
  return new Response(JSON.stringify(body), { headers: { 'content-type': 'application/json' } });
};
globalThis.document = { baseURI: 'http://page/' };

beforeEach(() => {
  full = false;
  storage.clear();
});

test('two tabs of a lab keep what either did', async () => {
  const one = await AloneDesk.open('small');
  const other = await AloneDesk.open('small');
  assert.equal(other.seed, one.seed);
  points = 7;
  await one.mark('settle', {}, { who: 2 });
  await one.hint('settle', 1);
  let told = 0;
  other.onChange(() => (told += 1));
  page.dispatchEvent(Object.assign(new Event('storage'), { key: 'heli2dof.lab.small' }));
  assert.deepEqual([told, other.kept.settle.best.points], [1, 7]);
  await one.hint('settle', 2);
  other.keep('loop', { method: 'lqr' }, {}); // before it has heard of the second hint
  const { settle, loop } = (await AloneDesk.open('small')).kept;
  assert.deepEqual([settle.best.points, settle.attempts, settle.hints.map(({ hint }) => hint)], [7, 1, [1, 2]]);
  assert.deepEqual(loop.design, { method: 'lqr' });
  points = 3;
  await other.mark('settle', {}, { who: 1 });
  assert.deepEqual([other.kept.settle.best.points, other.kept.settle.attempts], [7, 2]);
  one.leave();
  other.leave();
});

test('the best attempt keeps the answers to which its verdict was given, and a hint is there once', async () => {
  const desk = await AloneDesk.open('small');
  points = 5;
  await desk.mark('settle', {}, { who: 2 });
  await desk.mark('settle', {}, { who: 1 }); // no better
  assert.deepEqual(desk.kept.settle.best.answers, { who: 2 });
  await Promise.all([desk.hint('settle', 1), desk.hint('settle', 1)]); // a double click
  assert.deepEqual(
    desk.kept.settle.hints.map(({ hint }) => hint),
    [1],
  );
  desk.leave();
});

test('where the storage is full, the newest holds as long as the page is open, and this is said', async () => {
  const desk = await AloneDesk.open('small');
  desk.keep('settle', { method: 'lqr' }, {});
  assert.equal(desk.standing.words, '');
  full = true;
  desk.keep('settle', { method: 'full-rank' }, {});
  assert.deepEqual(read('lab.small', null).steps.settle.design, { method: 'full-rank' });
  assert.match(desk.standing.words, /keeps nothing/);
  full = false;
  write('lab.small', { seed: 1 });
  assert.deepEqual([read('lab.small', null), isForgetful()], [{ seed: 1 }, false]);
  desk.leave();
});
