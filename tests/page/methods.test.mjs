// The ways from poles to a gain: one key each, and back.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { STRUCTURES } from '../../static/model/method_names.js';
import { keyOf, nameOf, partOf, placesPoles } from '../../static/model/methods.js';

test("a structure's key gives back the structure", () => {
  for (const [key, name] of STRUCTURES) {
    assert.equal(keyOf(partOf(key)), key);
    assert.equal(nameOf(partOf(key)), name);
  }
});

test('another method is its name, and leaves the structure as it is', () => {
  assert.equal(keyOf({ method: 'lqr', coupling: 'triangular', lead: 'yaw' }), 'lqr');
  assert.deepEqual(partOf('tits-yang'), { method: 'tits-yang' });
  assert.equal(nameOf({ method: 'of-tomorrow', title: 'Of tomorrow' }), 'Of tomorrow');
});

test('who leads matters to the triangular coupling only', () => {
  assert.equal(keyOf({ method: 'full-rank', coupling: 'axis-decoupled', lead: 'yaw' }), 'full-rank/axis-decoupled');
  assert.equal(keyOf({ method: 'full-rank', coupling: 'triangular' }), 'full-rank/triangular/pitch');
});

test('the placed poles count unless the method is known to choose its own', () => {
  const methods = [
    { name: 'full-rank', places_poles: true },
    { name: 'lqr', places_poles: false },
  ];
  assert.equal(placesPoles({ design: { method: 'lqr' }, methods }), false);
  assert.equal(placesPoles({ design: { method: 'full-rank' }, methods }), true);
  assert.equal(placesPoles({ design: { method: 'lqr' }, methods: [] }), true);
});
