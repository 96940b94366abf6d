// What a press of a key does in either s-plane.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { actOf, keyStep } from '../../static/splane/math.js';

const VIEW = { cx: -2, cy: 0, scale: 40, width: 400, height: 300 };
const step = keyStep(VIEW);
const press = (key, more = {}) =>
  actOf({ key, altKey: false, ctrlKey: false, metaKey: false, shiftKey: false, ...more }, VIEW);

test('arrows and page keys move a pole by steps, with Shift by tenths', () => {
  assert.deepEqual(press('ArrowLeft'), { by: { re: -step, im: 0 } });
  assert.deepEqual(press('ArrowUp'), { by: { re: 0, im: step } });
  assert.deepEqual(press('PageUp'), { by: { re: 10 * step, im: 0 } });
  assert.deepEqual(press('ArrowDown', { shiftKey: true }), { by: { re: 0, im: -0.1 * step } });
});

test('Ctrl and an arrow move the view, plus and minus zoom, F fits', () => {
  assert.deepEqual(press('ArrowRight', { ctrlKey: true }), { view: { ...VIEW, cx: -1 } });
  assert.deepEqual(press('PageDown', { ctrlKey: true }), { view: { ...VIEW, cx: -3 } });
  assert.ok(press('+').view.scale > VIEW.scale && press('-').view.scale < VIEW.scale);
  assert.deepEqual(press('F'), { fit: true });
});

test('all else is left to the browser', () => {
  for (const [key, more] of [
    ['ArrowLeft', { altKey: true }],
    ['ArrowLeft', { metaKey: true }],
    ['z', { ctrlKey: true }],
    ['f', { ctrlKey: true }],
    ['Tab', {}],
    ['toString', {}],
  ])
    assert.equal(press(key, more), null, key);
});
