// Where more of a formula lies than is seen, and letters as a drawing slants them.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { slanted } from '../../static/paper/drawing.js';
import { hiddenSide } from '../../static/paper/ends.js';

test('the side on which more lies', () => {
  const box = (scrollLeft, clientWidth, scrollWidth) => hiddenSide({ scrollLeft, clientWidth, scrollWidth });
  assert.equal(box(0, 300, 300), '');
  assert.equal(box(0, 300, 301), '', 'a rounded pixel is nothing');
  assert.equal(box(0, 300, 400), 'right');
  assert.equal(box(50, 300, 400), 'both');
  assert.equal(box(100, 300, 400), 'left');
});

test('letters are Unicode’s slanted ones, h is Planck’s', () => {
  assert.equal(slanted('V'), '𝑉');
  assert.equal(slanted('ah'), '𝑎ℎ');
  assert.equal(slanted('θαω'), '𝜃𝛼𝜔');
  assert.equal(slanted('θ̇'), '𝜃\u0307');
  assert.equal(slanted('3 × Z'), '3 × 𝑍');
  assert.equal(slanted('Az'), '𝐴𝑧');
});
