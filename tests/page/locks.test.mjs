// What a link locks: all that the contract has of a design, each part by one lock.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { guarded, LOCKS } from '../../static/model/locks.js';
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
