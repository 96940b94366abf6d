import assert from 'node:assert/strict';
import test from 'node:test';
import { findApi, Lms, timespan } from '../../static/scorm/lms.js';

/** An LMS that keeps what it is told and writes down every call. */
function anLms(values = {}, refused = []) {
  const calls = [];
  const told = { ...values };
  const api = {
    LMSInitialize: (nothing) => (calls.push(`LMSInitialize(${nothing})`), 'true'),
    LMSFinish: (nothing) => (calls.push(`LMSFinish(${nothing})`), 'true'),
    LMSCommit: (nothing) => (calls.push(`LMSCommit(${nothing})`), 'true'),
    LMSGetValue: (element) => told[element] ?? '',
    LMSSetValue: (element, value) => {
      calls.push(element);
      if (refused.includes(element)) return 'false';
      told[element] = value;
      return 'true';
    },
    LMSGetLastError: () => '405',
    LMSGetErrorString: (code) => (code === '405' ? 'Incorrect Data Type' : ''),
  };
  return { api, calls, told };
}

/** Windows one above the other, the lowest returned; the highest is its own parent. */
function windows(above, highest = {}) {
  highest.parent = highest;
  let lowest = highest;
  for (let i = 0; i < above; i++) lowest = { parent: lowest };
  return Object.assign(lowest, { top: highest });
}

test('the API is found in windows above, not beyond seven, and in those that opened the page', () => {
  const { api } = anLms();
  assert.equal(findApi(windows(0, { API: api })), api);
  assert.equal(findApi(windows(1, { API: api })), api);
  assert.equal(findApi(windows(7, { API: api })), api);
  assert.equal(findApi(windows(8, { API: api })), null);
  assert.equal(findApi(windows(3)), null);
  assert.equal(findApi({ ...windows(0), opener: windows(2, { API: api }) }), api);
  assert.equal(findApi(windows(2, { opener: windows(1, { API: api }) })), api);
});

test('a window of another site is passed over', () => {
  const { api } = anLms();
  const foreign = {
    get API() {
      throw new Error('SecurityError');
    },
  };
  const above = windows(0, { API: api });
  assert.equal(
    findApi({ parent: Object.defineProperties({ parent: above }, Object.getOwnPropertyDescriptors(foreign)) }),
    api,
  );
  const closed = {
    get parent() {
      throw new Error('SecurityError');
    },
  };
  assert.equal(findApi(closed), null);
});

test('a span of time has four digits of hours and two of all else', () => {
  assert.equal(timespan(0), '0000:00:00.00');
  assert.equal(timespan(83_456_789), '0023:10:56.79');
  assert.equal(timespan(59_999), '0000:01:00.00');
  assert.equal(timespan(4e10), '9999:06:40.00');
  assert.match(timespan(123_456), /^\d{4}:\d\d:\d\d\.\d\d$/);
});

test('a session: what was kept is there, what is told is committed, time is told at the end, and only once', () => {
  let now = 1000;
  const { api, calls, told } = anLms({
    'cmi.core.student_id': 's17',
    'cmi.core.student_name': 'Lovelace, Ada',
    'cmi.suspend_data': 'kept',
    'cmi.core.lesson_status': 'incomplete',
  });
  const lms = new Lms(api, () => now);
  assert.deepEqual(lms.begin(), {
    id: 's17',
    name: 'Lovelace, Ada',
    suspended: 'kept',
    status: 'incomplete',
    kept: true,
  });
  assert.equal(lms.tell({ status: 'incomplete', suspended: 'a' }), true);
  assert.equal('cmi.core.score.raw' in told, false);
  assert.equal(lms.tell({ status: 'passed', score: 66.666, suspended: 'b' }), true);
  assert.equal(told['cmi.core.score.raw'], '66.7');
  assert.equal(told['cmi.core.score.min'], '0');
  assert.equal(told['cmi.core.score.max'], '100');
  assert.equal(told['cmi.core.lesson_status'], 'passed');
  assert.equal(told['cmi.core.exit'], 'suspend');
  assert.equal(told['cmi.suspend_data'], 'b');
  assert.equal(calls.at(-1), 'LMSCommit()');
  now += 61_230;
  lms.end();
  lms.end();
  assert.equal(told['cmi.core.session_time'], '0000:01:01.23');
  assert.deepEqual(calls.slice(-3), ['cmi.core.session_time', 'LMSCommit()', 'LMSFinish()']);
  assert.equal(lms.tell({ status: 'incomplete', suspended: 'c' }), false);
  assert.equal(told['cmi.suspend_data'], 'b');
});

test('what the LMS refuses is said in its words, and the rest is told all the same', () => {
  const { api, told } = anLms({}, ['cmi.suspend_data']);
  const lms = new Lms(api, () => 0);
  lms.begin();
  assert.equal(lms.tell({ status: 'completed', score: 50, suspended: 'x' }), false);
  assert.equal(lms.trouble, 'cmi.suspend_data: Incorrect Data Type');
  assert.equal(told['cmi.core.score.raw'], '50');
});

test('without an LMS, and with one that refuses to begin, nothing is told', () => {
  const none = new Lms(null, () => 0);
  assert.equal(none.begin(), null);
  assert.equal(none.tell({ status: 'incomplete', suspended: '' }), false);
  none.end();
  const { api, calls } = anLms();
  const shut = new Lms({ ...api, LMSInitialize: () => 'false' }, () => 0);
  assert.equal(shut.begin(), null);
  assert.equal(shut.open, false);
  shut.end();
  assert.deepEqual(calls, []);
});

test('in a review nothing will be kept', () => {
  for (const [mode, kept] of [
    ['review', false],
    ['browse', false],
    ['normal', true],
    ['', true],
  ])
    assert.equal(new Lms(anLms({ 'cmi.core.lesson_mode': mode }).api, () => 0).begin().kept, kept);
});

test('an LMS whose window has gone is no error, and says nothing more', () => {
  const { api } = anLms();
  const lms = new Lms(api, () => 0);
  lms.begin();
  const gone = () => {
    throw new Error('the window is closed');
  };
  for (const name of Object.keys(api)) api[name] = gone;
  assert.equal(lms.tell({ status: 'incomplete', suspended: '' }), false);
  lms.end();
  assert.equal(lms.open, false);
  assert.equal(new Lms(api, () => 0).begin(), null);
});
