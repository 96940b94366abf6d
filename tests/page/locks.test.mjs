// What a link locks: all that the contract has of a design, each part by one lock.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { freeParts, locksOf, PARTS } from '../../static/labs/parts.js';
import { guarded, hides, LOCKS, remarked } from '../../static/model/locks.js';
import { OUTER, QUANTITIES, STRUCTURE } from '../../static/model/quantities.js';
import { designOf } from '../../static/model/store.js';
import { PRESETS } from './presets.mjs';

const CALLED = { operating_point: 'theta0' }; // by the contract → in a design
const OF_RECORDINGS = 'columns';
const top = [...new Set(Object.keys(QUANTITIES).map((path) => path.split('.')[0]))];
const names = top.filter((name) => name !== OF_RECORDINGS).map((name) => CALLED[name] ?? name);
const locking = (key) => Object.keys(LOCKS).filter((lock) => LOCKS[lock].keys.includes(key));

test('each part of a design belongs to one lock', () => {
  const parts = new Set([...names, ...Object.keys(designOf(PRESETS[0]))]);
  assert.ok(parts.has('shift') && parts.has('theta0') && parts.has('scenario'));
  for (const key of parts) assert.equal(locking(key).length, 1, `${key}: ${locking(key)}`);
  const known = new Set([...parts, 'preset', 'rig', 'method']);
  for (const { keys } of Object.values(LOCKS)) for (const key of keys) assert.ok(known.has(key), key);
});

test("the contract's lists have each choice of a design once", () => {
  const choices = top.filter((name) => Object.hasOwn(QUANTITIES, name) && name !== 'poles');
  assert.deepEqual([...STRUCTURE, ...OUTER, 'place_rotors'].sort(), choices.sort());
  assert.deepEqual(new Set([...STRUCTURE, ...OUTER].map((key) => locking(key)[0])), new Set(['method', 'loops']));
});

for (const lock of Object.keys(LOCKS))
  test(`what is locked with “${lock}” stays, all else may change`, () => {
    for (const before of [designOf(PRESETS[0]), designOf({ ...PRESETS[0], shift: 0.25 })]) {
      const keys = [...new Set([...names, ...Object.keys(before)])];
      const after = Object.fromEntries(keys.map((key) => [key, ['changed', key]]));
      const kept = guarded(before, after, [lock]);
      for (const key of keys)
        assert.deepEqual(kept[key], LOCKS[lock].keys.includes(key) ? before[key] : ['changed', key], key);
      assert.equal(guarded(before, after, Object.keys(LOCKS)), before);
    }
  });

test('a lock adds nothing to a design that lacks a part of it', () => {
  const before = designOf(PRESETS[0]);
  assert.ok(!('shift' in before));
  const after = { ...before, theta0: 0.1 };
  assert.deepEqual(Object.keys(guarded(before, after, ['method'])), Object.keys(before));
});

const PRESET = PRESETS[0];
const real = (...res) => res.map((re) => ({ re, im: 0 }));

test('a step of a lab fixes all but what it frees, and within a part as well', () => {
  const before = { ...designOf(PRESET), poles: real(-1, -2, -3, -4) };
  const change = {
    ...before,
    poles: real(-5, -6, -7, -8),
    method: 'lqr',
    coupling: 'triangular',
    outer: 'none',
    loops: { pitch: { kp: 1, ti: 1 }, yaw: { kp: 2, ti: 2 } },
    scenario: { ...before.scenario, duration: 9, digital: { sample_time: 0.01 }, anti_windup: 'none' },
  };
  const kept = (...unlocked) => {
    const { locks, free } = locksOf(unlocked);
    return guarded(before, change, locks, free);
  };
  assert.equal(kept(), before);
  assert.deepEqual(kept('pitch-poles'), { ...before, poles: real(-5, -6, -3, -4) });
  assert.deepEqual(kept('yaw-poles', 'structure'), {
    ...before,
    poles: real(-1, -2, -7, -8),
    coupling: 'triangular',
  });
  assert.deepEqual(kept('poles'), { ...before, poles: change.poles });
  assert.deepEqual(kept('yaw-pi').loops, { ...before.loops, yaw: change.loops.yaw });
  assert.deepEqual(kept('yaw-pi').outer, before.outer);
  assert.deepEqual(kept('digital').scenario, { ...before.scenario, digital: change.scenario.digital });
  assert.deepEqual(kept('anti-windup').scenario, { ...before.scenario, anti_windup: 'none' });
  assert.deepEqual(kept('loops', 'scenario'), {
    ...before,
    outer: 'none',
    loops: change.loops,
    scenario: change.scenario,
  });
  // what was there and is free may go, what was there and is fixed stays
  const digital = { ...before, scenario: change.scenario };
  const off = { ...before, scenario: { ...before.scenario } };
  const { locks, free } = locksOf(['digital']);
  assert.deepEqual(guarded(digital, off, locks, free).scenario, {
    ...before.scenario,
    duration: 9,
    anti_windup: 'none',
  });
});

test('a change of what is fixed alone is none, also where lists were made anew', () => {
  const before = designOf(PRESET);
  const { locks, free } = locksOf(['pitch-poles']);
  const [a, b] = before.poles;
  assert.equal(guarded(before, { ...before, poles: [a, b, ...real(-7, -8)] }, locks, free), before);
});

test('each part that a lab can free belongs to a lock of links, and all of them are called', () => {
  const own = new Set(Object.values(LOCKS).flatMap(({ keys }) => keys));
  for (const [name, { keys, controls }] of Object.entries(PARTS)) {
    assert.ok(controls && keys.length && !LOCKS[name], name);
    for (const key of keys) assert.ok(own.has(key) || own.has(key.split('.')[0]), key);
  }
  assert.deepEqual(
    freeParts(['poles', 'yaw-pi', 'nothing']).map(({ name }) => name),
    ['poles', 'yaw PI'],
  );
});

test('a step keeps back remarks, or what tells of relative gains', () => {
  const findings = ['pairing_cross', 'saturation_V_p'].map((code) => ({ code, severity: 'info', message: '' }));
  const codes = (task, locks = []) => remarked({ reply: { findings }, locks, task }).map(({ code }) => code);
  assert.deepEqual(codes(null), ['pairing_cross', 'saturation_V_p']);
  assert.deepEqual(codes({ free: [], hidden: ['rga'] }), ['saturation_V_p']);
  assert.deepEqual(codes({ free: [], hidden: ['remarks'] }), []);
  assert.deepEqual(codes(null, ['remarks']), []);
  assert.equal(hides({ locks: [], task: { free: [], hidden: ['rga'] } }, 'remarks'), false);
});
