// Maps: one scale for all that is mapped of a figure, and what is told of the server's work.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { rangeText } from '../../static/maps/choices.js';
import { lookOf, PAPER } from '../../static/maps/look.js';
import { beyond, Scale } from '../../static/maps/scale.js';
import { together, wordsOf } from '../../static/maps/told.js';

const span = (from, to) => ({ from, to, log: false });
const domain = { x: span(-4, 0), y: span(0, 2) };

test('of several maps a refusal comes before work', () => {
  const [quiet, busy, refused] = [
    { computing: false, refused: '' },
    { computing: true, refused: '' },
    { computing: false, refused: 'away' },
  ];
  assert.equal(wordsOf(together([])), '');
  assert.equal(wordsOf(together([quiet, quiet])), '');
  assert.equal(wordsOf(together([quiet, busy])), 'Map: computing on the server…');
  assert.equal(wordsOf(together([busy, refused])), 'No map: away');
});

const fieldOfValues = (values, stable = values.map(() => 2)) => ({
  ...{ columns: values.length, rows: 1, domain, abscissa: Float64Array.of(), others: [], whole: true },
  ...{ values: Float64Array.from(values), stable: Uint8Array.from(stable) },
});

test('all that is mapped of a figure has one scale: the plane’s, or that of all fields', () => {
  let [busy, changes] = [false, 0];
  const scale = new Scale(
    () => busy,
    () => changes++,
  );
  const name = 'settling_time';
  const asked = { move: 'pitch-pi', real: false, domain, measure: { name, axis: 'theta' }, limits: [] };
  const values = (from) => fieldOfValues(Array.from({ length: 50 }, (_, i) => from + i / 50));
  scale.put('pitch', values(1), asked);
  const alone = scale.of(name);
  scale.put('yaw', values(3), asked);
  const both = scale.of(name);
  assert.ok(alone.at(-1) <= 2 && both[0] < 2 && both.at(-1) > 3, `${alone} ${both}`);
  assert.deepEqual([scale.of('overshoot'), scale.isLed], [[], false]);
  busy = true;
  scale.put('yaw', values(6), asked);
  assert.equal(scale.of(name), both, 'colours keep their meaning while something moves');
  scale.lead(name, [1, 2, 3]);
  assert.deepEqual([scale.of(name), scale.isLed], [[1, 2, 3], true]);
  const told = changes;
  scale.lead(name, [1, 2, 3]);
  assert.equal(changes, told, 'no change is none');
  busy = false;
  scale.lead(null, []);
  assert.ok(scale.of(name).at(-1) > 5);
  scale.put('pitch', null, null);
  scale.put('yaw', null, null);
  assert.deepEqual([scale.fields, scale.of(name)], [[], []]);
});

test('equal values have equal colours; beyond the scale lines go on', () => {
  const scale = [1, 2, 3];
  const levels = beyond(scale, [0.5, 1.5, 2.5, 3.5, 4.5]);
  assert.deepEqual(levels, [0.5, 1, 2, 3, 3.5, 4.5]);
  assert.deepEqual(beyond([], [1, 4]), [1, 4]);
  for (const name of ['settling_time', 'disk_margin']) {
    const plane = lookOf(name, scale, PAPER);
    const field = lookOf(name, levels, PAPER, scale);
    const colorAt = (look, own, v) => look.bands[own.filter((level) => level <= v).length];
    for (const v of [0.2, 0.7, 1.2, 2.2, 3.2, 3.7, 9])
      assert.equal(colorAt(field, levels, v), colorAt(plane, scale, v), `${name} ${v}`);
    assert.equal(new Set(plane.bands).size, 4);
    assert.equal(field.lines.length, levels.length);
  }
});

test('a field tells from what to what its values go, of stable places', () => {
  assert.equal(rangeText('settling_time', fieldOfValues([0.4, 2.5, 9, NaN, Infinity], [2, 2, 1, 2, 2])), '0.40–2.50 s');
  assert.equal(rangeText('settling_time', fieldOfValues([1, 1])), '1.00 s');
  assert.equal(rangeText('share_within_limits', fieldOfValues([0, 0.5])), '0–50 %');
  assert.equal(rangeText('overshoot', fieldOfValues([1], [1])), '');
});
