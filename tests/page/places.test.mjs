/** Where things that are laid over the page stand, and where keys lead in them. */
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { placeBeside, stepIn } from '../../static/ui/popup.js';
import { readoutPlace } from '../../static/splane/readout.js';

let seed = 7;
const drawn = (low, high) => low + (high - low) * ((seed = (seed * 16807) % 2147483647) / 2147483647);

test('a popup lies within the window, and beside its button wherever there is room', () => {
  const view = { width: 1000, height: 700 };
  let [below, above] = [0, 0];
  for (let k = 0; k < 500; k++) {
    const [top, right] = [drawn(0, 670), drawn(40, 1000)];
    const button = { top, bottom: top + 30, right };
    const size = { width: drawn(50, 600), height: drawn(40, 500) };
    const place = placeBeside(button, size, view);
    assert.ok(place.left >= 8 && place.left + size.width <= 992 + 1e-9, "in the window's width");
    assert.ok(place.top >= 8 && place.top + size.height <= 692 + 1e-9, "in the window's height");
    if (button.right - size.width >= 8 && button.right <= 992)
      assert.ok(Math.abs(place.left + size.width - button.right) < 1e-9);
    if (button.bottom + 4 + size.height <= 692) {
      assert.equal(place.top, button.bottom + 4);
      below++;
    } else if (button.top - 4 - size.height >= 8) {
      assert.ok(Math.abs(place.top + size.height - (button.top - 4)) < 1e-9);
      above++;
    }
  }
  assert.ok(below > 50 && above > 50, 'both were tried');
});

test('a popup that just fits below stays there, one that just fits above goes there', () => {
  const view = { width: 1000, height: 700 };
  assert.deepEqual(placeBeside({ top: 300, bottom: 330, right: 500 }, { width: 100, height: 358 }, view), {
    left: 400,
    top: 334,
  });
  assert.deepEqual(placeBeside({ top: 400, bottom: 430, right: 500 }, { width: 100, height: 388 }, view), {
    left: 400,
    top: 8,
  });
  assert.deepEqual(placeBeside({ top: 0, bottom: 30, right: 50 }, { width: 2000, height: 900 }, view), {
    left: 8,
    top: 8,
  }); // the beginning is seen
});

test('arrow keys walk through a grid as it is seen', () => {
  const boxes = [0, 1, 2, 3, 4, 5, 6].map((i) => ({
    left: 50 * (i % 3),
    top: 40 * Math.floor(i / 3),
    bottom: 40 * Math.floor(i / 3) + 30,
  })); // three rows: 3, 3, 1
  const from = (at) =>
    ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'Home', 'End'].map((key) => stepIn(boxes, at, key));
  assert.deepEqual(from(0), [0, 1, 0, 3, 0, 6]);
  assert.deepEqual(from(4), [3, 5, 1, 6, 0, 6]);
  assert.deepEqual(from(5), [4, 6, 2, 6, 0, 6]);
  assert.deepEqual(from(6), [5, 6, 3, 6, 0, 6]);
  assert.equal(stepIn(boxes, 4, 'Enter'), undefined);
  const touching = boxes.map((box) => ({ ...box, bottom: box.top + 41 })); // by a pixel's fraction, as zoomed pages do
  assert.deepEqual(
    ['ArrowUp', 'ArrowDown'].map((key) => stepIn(touching, 4, key)),
    [1, 6],
  );
});

test("a pole's lines stand clear of it and within the plane, above it wherever there is room", () => {
  const [width, height] = [190, 110];
  const sides = [0, 0, 0];
  for (const unit of [1, 1.7]) {
    for (const [plane, tall] of [
      [600, 400],
      [300, 180],
    ]) {
      for (let k = 0; k < 200; k++) {
        const at = {
          x: drawn(0, plane * unit),
          y: drawn(0, tall * unit),
          width: plane * unit,
          height: tall * unit,
          unit,
        };
        const { left, top } = readoutPlace(at, width, height);
        assert.ok(left >= 4 && left + width <= at.width - 4 + 1e-9);
        assert.ok(top >= 2 && (top + height <= at.height - 2 + 1e-9 || top === 2), 'all of it is seen');
        if (at.x + 24 * unit + width <= at.width - 4) assert.ok(Math.abs(left - at.x - 24 * unit) < 1e-9);
        const [above, below] = [at.y - 26 * unit, at.y + 26 * unit];
        const side = top + height <= above + 1e-9 ? 0 : top >= below - 1e-9 ? 1 : 2;
        sides[side]++;
        assert.equal(side === 0, above - height >= 2, 'above where it can');
        if (side === 2) assert.ok(below + height > at.height - 2, 'beside it where neither side has room');
      }
    }
  }
  assert.ok(
    sides.every((count) => count > 20),
    `each side was tried: ${sides}`,
  );
});
