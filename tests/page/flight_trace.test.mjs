/**
 * What the instruments of a flight keep and how: bins that keep extremes, scales, lanes, lamps that glow on, marks.
 */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { markOf } from '../../static/flight/instruments.js';
import { HOLD, LampStates } from '../../static/flight/lamps.js';
import { LANE, LaneScales, placed } from '../../static/flight/lanes.js';
import { arc, headingOf, turnsOf } from '../../static/flight/horizon.js';
import { joined, nearest } from '../../static/flight/marks.js';
import { ANGULAR, decimalsOf, PLAIN, Scale, spanOf } from '../../static/flight/scales.js';
import { loudnessOf, toneOf } from '../../static/flight/sound.js';
import { binOf, BINS_PER_SECOND, CHANNEL, CHANNELS, FLAG, KEPT, Trace } from '../../static/flight/trace.js';
import { INPUT, ROW } from '../../static/kernel/index.js';

const { FLIGHT_ROW } = ROW;
const LIMITS = [24, 15];

/** Rows of a flight of which some columns are told, each by its tick. */
function rowsOf(count, columns) {
  const rows = new Float64Array(count * FLIGHT_ROW);
  for (const [at, value] of Object.entries(columns))
    for (let i = 0; i < count; i++) rows[i * FLIGHT_ROW + Number(at)] = value(i);
  return rows;
}

const bin = (trace, k, channel) => {
  const at = (k & (KEPT - 1)) * CHANNELS + channel;
  return [trace.low[at], trace.high[at]];
};
const found = (trace, channels, from, to) => {
  const out = [0, 0];
  trace.extremes(channels, from, to, out);
  return out;
};

test('a voltage that peaks for one tick of 0.1 ms is not lost, nor that it was at the limit', () => {
  const trace = new Trace();
  const rows = rowsOf(20000, { [ROW.VOLTAGE]: (i) => (i === 12345 ? 24 : 1), [ROW.VOLTAGE + 1]: () => -3 });
  for (let n = 0; n < 20000; n += 250)
    trace.put(rows.subarray(n * FLIGHT_ROW, (n + 250) * FLIGHT_ROW), 250, 1e-4, n * 1e-4, LIMITS);
  assert.deepEqual(bin(trace, 123, CHANNEL.VOLTS), [1, 24]);
  assert.deepEqual(bin(trace, 122, CHANNEL.VOLTS), [1, 1]);
  assert.deepEqual(bin(trace, 123, CHANNEL.VOLTS + 1), [-3, -3]);
  assert.equal(trace.flags[123], FLAG.FULL);
  assert.deepEqual([trace.flags[122], trace.flags[124]], [0, 0]);
  assert.deepEqual(found(trace, [CHANNEL.VOLTS], 0, trace.head), [1, 24]);
});

test('each channel stands for its column', () => {
  const trace = new Trace();
  const columns = {
    [CHANNEL.ANGLE]: ROW.STATE,
    [CHANNEL.RATE]: ROW.STATE + 2,
    [CHANNEL.SEEN]: ROW.SENSED,
    [CHANNEL.SEEN_RATE]: ROW.SENSED + 2,
    [CHANNEL.VOLTS]: ROW.VOLTAGE,
    [CHANNEL.WISH]: ROW.WISH,
    [CHANNEL.TORQUE]: ROW.OUTSIDE,
  };
  trace.put(
    Float64Array.from({ length: FLIGHT_ROW }, (_, i) => i),
    1,
    0.002,
    0,
    [Infinity, Infinity],
  );
  for (const [channel, column] of Object.entries(columns))
    for (let axis = 0; axis < 2; axis++)
      assert.deepEqual(bin(trace, 0, Number(channel) + axis), [column + axis, column + axis]);
});

test('every tick falls into the bin of its time, whatever its length and however far on', () => {
  for (const step of [0.002, 0.001, 0.0005, 0.01 / 3, 0.0019]) {
    for (const start of [0, 599.9]) {
      const trace = new Trace();
      const first = Math.ceil(start / step);
      const count = Math.ceil(0.5 / step);
      trace.put(rowsOf(count, { [ROW.STATE]: (i) => i }), count, step, first * step, LIMITS);
      for (let i = 0; i < count; i++) {
        const [low, high] = bin(trace, Math.floor((first + i) * step * BINS_PER_SECOND + 1e-6), CHANNEL.ANGLE);
        assert.ok(low <= i && i <= high, `${step} ${i}`);
      }
      const whole = trace.head - binOf(first * step);
      assert.ok(whole === 49 || whole === 50);
    }
  }
});

test('a rewind leaves what was before it, and what follows takes the place of the rest', () => {
  const trace = new Trace();
  trace.put(rowsOf(5000, { [ROW.STATE]: (i) => i }), 5000, 0.002, 0, LIMITS);
  trace.cut(5.003);
  assert.equal(trace.head, 499);
  assert.deepEqual(bin(trace, 499, CHANNEL.ANGLE), [2495, 2499]);
  trace.put(rowsOf(500, { [ROW.STATE]: () => -7 }), 500, 0.002, 5.004, LIMITS);
  assert.deepEqual(bin(trace, 500, CHANNEL.ANGLE), [-7, -7]);
  assert.deepEqual(bin(trace, 499, CHANNEL.ANGLE), [2495, 2499]);
  assert.equal(trace.head, 600);
  trace.cut(0);
  assert.deepEqual([trace.first, trace.head], [0, 0]);
});

test('rows of a time before those that are known are a rewind that nobody told', () => {
  const trace = new Trace();
  trace.put(rowsOf(1000, {}), 1000, 0.002, 0, LIMITS);
  trace.put(rowsOf(5, { [ROW.STATE]: () => 3 }), 5, 0.002, 1, LIMITS);
  assert.equal(trace.head, 100);
  assert.deepEqual(bin(trace, 100, CHANNEL.ANGLE), [3, 3]);
});

test('a minute and the window before it are kept, and no more is taken for known', () => {
  const trace = new Trace();
  assert.ok(KEPT >= 80 * BINS_PER_SECOND);
  for (let n = 0; n < 12000; n += 5) trace.put(rowsOf(5, { [ROW.STATE]: (i) => n + i }), 5, 0.01, n * 0.01, LIMITS);
  assert.equal(trace.head, 11999);
  assert.equal(trace.first, 11999 - KEPT + 1);
  assert.deepEqual(found(trace, [CHANNEL.ANGLE], 0, trace.head), [trace.first, 11998]);
  trace.put(rowsOf(1, {}), 1, 0.01, 300, LIMITS); // a leap: what lies between is empty
  assert.equal(trace.first, 30000);
  assert.deepEqual(found(trace, [CHANNEL.ANGLE], 29000, 30000), [Infinity, -Infinity]);
});

test('what is left out of a course is empty', () => {
  const trace = new Trace();
  trace.put(rowsOf(5, { [ROW.STATE]: () => 1 }), 5, 0.002, 0, LIMITS);
  trace.put(rowsOf(5, { [ROW.STATE]: () => 2 }), 5, 0.002, 0.1, LIMITS);
  assert.deepEqual(bin(trace, 5, CHANNEL.ANGLE), [Infinity, -Infinity]);
  assert.deepEqual(found(trace, [CHANNEL.ANGLE], 1, 10), [Infinity, -Infinity]);
});

test('a span holds all, is the narrowest that does, and stands about 0 where that costs little', () => {
  const ruler = { least: 5, ladder: ANGULAR, floating: true };
  assert.deepEqual(spanOf(0, 0, ruler), { low: -10, high: 10 });
  assert.deepEqual(spanOf(-3, 10.01, ruler), { low: -20, high: 20 });
  assert.deepEqual(spanOf(-3, 31, ruler), { low: -60, high: 60 });
  assert.deepEqual(spanOf(21, 39, ruler), { low: 20, high: 40 }); // six times narrower
  assert.deepEqual(spanOf(715, 728, ruler), { low: 710, high: 730 }); // two turns on
  assert.deepEqual(spanOf(-3000, 3000, ruler), { low: -5760, high: 5760 });
  assert.deepEqual(spanOf(715, 728, { least: 5, ladder: PLAIN }), { low: -1000, high: 1000 });
  assert.deepEqual(spanOf(0, 0.0101, { least: 0.005, ladder: PLAIN }), { low: -0.02, high: 0.02 });
  for (let i = 0; i < 500; i++) {
    const [a, b] = [1.7 ** (i % 17) * Math.sin(7 * i), 1.7 ** (i % 13) * Math.cos(3 * i)];
    for (const own of [ruler, { least: 0.05, ladder: PLAIN }]) {
      const { low, high } = spanOf(Math.min(a, b), Math.max(a, b), own);
      assert.ok(low <= Math.min(a, b) && high >= Math.max(a, b));
    }
  }
});

test('a scale grows at once and shrinks only after three seconds', () => {
  const scale = new Scale({ least: 1, ladder: PLAIN });
  assert.equal(scale.fit(-1, 1, 0), false);
  assert.equal(scale.fit(-1, 7, 1), true);
  assert.deepEqual(scale.span, { low: -10, high: 10 });
  assert.equal(scale.fit(-1, 1, 2), false);
  assert.equal(scale.fit(-1, 1, 4.9), false);
  assert.equal(scale.fit(-1, 9, 5), false); // all of it is needed again: it waits anew
  assert.equal(scale.fit(-1, 1, 6), false);
  assert.equal(scale.fit(-1, 1, 8.9), false);
  assert.equal(scale.fit(-1, 1, 9), true);
  assert.deepEqual(scale.span, { low: -2, high: 2 });
  assert.equal(scale.fit(Infinity, -Infinity, 20), false);
  assert.equal(scale.fit(-Infinity, 1, 20), false);
});

test('divisions are written with the decimals that they need', () => {
  assert.equal(decimalsOf({ low: -10, high: 10 }), 0);
  assert.equal(decimalsOf({ low: -1, high: 1 }), 1);
  assert.equal(decimalsOf({ low: -0.01, high: 0.01 }), 3);
});

test('as many lanes as have room, one above the other, none over another', () => {
  for (const [height, head, count] of [
    [230, 0, 4],
    [130, 0, 3],
    [90, 0, 2],
    [60, 0, 1],
    [20, 0, 1],
    [300, 22, 4],
    [200, 22, 3],
  ]) {
    const places = placed(height, 1, head);
    assert.equal(places.length, count, `${height} ${head}`);
    places.forEach(({ top, height: own }, i) => {
      assert.ok(top >= (i ? places[i - 1].top + places[i - 1].height : 0) + head);
      assert.ok(top + own <= height);
    });
  }
});

test('a lane of voltages has the limits of its motors, else it follows what is seen, both axes by themselves', () => {
  const trace = new Trace();
  const rows = rowsOf(1000, { [ROW.VOLTAGE]: () => 40, [ROW.STATE + 1]: () => 2, [ROW.SENSED]: () => 0.5 });
  trace.put(rows, 1000, 0.002, 0, LIMITS);
  const volts = new LaneScales(LANE.volts);
  assert.equal(volts.fit(trace, 0, 0, trace.head, [24, 15]), true);
  assert.equal(volts.fit(trace, 0, 0, trace.head, [24, 15]), false);
  assert.deepEqual(
    volts.numbers(0, false).map(({ text }) => text),
    ['−24', '0', '24'],
  );
  assert.deepEqual(
    volts.numbers(1, false).map(({ text }) => text),
    ['−15', '0', '15'],
  );
  assert.deepEqual(
    volts.numbers(0, true).map(({ share }) => share.toFixed(9)),
    volts.numbers(1, true).map(({ share }) => share.toFixed(9)), // on the same lines
  );
  assert.deepEqual(volts.lines, [0.5]);
  assert.equal(volts.fit(trace, 0, 0, trace.head, [Infinity, Infinity]), true);
  assert.deepEqual(volts.spans[0], { low: -40, high: 40 });

  const angles = new LaneScales(LANE.angles);
  angles.fit(trace, 0, 0, trace.head, [24, 15]);
  assert.deepEqual(angles.spans, [
    { low: -30, high: 30 }, // of what was measured: 28.6°
    { low: -180, high: 180 },
  ]);
  assert.deepEqual(
    angles.numbers(1, true).map(({ text }) => text),
    ['−180', '0', '180'],
  );
  assert.equal(angles.numbers(1, false).length, 5);
});

test('what is new and too large changes a scale at once, also between two looks at all', () => {
  const trace = new Trace();
  trace.put(rowsOf(500, {}), 500, 0.002, 0, LIMITS);
  const rates = new LaneScales(LANE.rates);
  rates.fit(trace, 0, 0, trace.head, LIMITS);
  const before = trace.head;
  trace.put(rowsOf(10, { [ROW.STATE + 2]: () => 3 }), 10, 0.002, 1, LIMITS);
  assert.equal(rates.fit(trace, 0, before, trace.head, LIMITS), true);
  assert.deepEqual(rates.spans[0], { low: -200, high: 200 });
});

const row = (volts, more = {}) => rowsOf(1, { [ROW.VOLTAGE]: () => volts, ...more });
const acting = (columns = {}) => {
  const u = new Float64Array(INPUT.FLIGHT_INPUTS);
  u[INPUT.THRUST] = u[INPUT.THRUST + 1] = 1;
  for (const [at, value] of Object.entries(columns)) u[at] = value;
  return u;
};

test('a saturation of one tick among many is seen, for as long as a lamp glows on', () => {
  const lamps = new LampStates();
  lamps.put(rowsOf(100, { [ROW.VOLTAGE]: (i) => (i === 40 ? -24 : 1) }), 100, LIMITS);
  lamps.look(1000, {});
  assert.equal(lamps.glow('full_p'), 'glow');
  assert.equal(lamps.glow('full_y'), 'off');
  for (let now = 1016; now < 1000 + HOLD; now += 16) {
    lamps.put(row(1), 1, LIMITS);
    lamps.look(now, {});
    assert.equal(lamps.glow('full_p'), 'glow');
  }
  lamps.look(1000 + HOLD, {});
  assert.equal(lamps.glow('full_p'), 'off');
});

test('a lamp is on while it is so, and where time stands still nothing goes out', () => {
  const lamps = new LampStates();
  lamps.put(row(24, { [ROW.VOLTAGE + 1]: () => -15 }), 1, LIMITS);
  lamps.look(0, {});
  lamps.look(10 * HOLD, {}); // no row since, as in slow motion: the last one holds
  assert.deepEqual([lamps.glow('full_p'), lamps.glow('full_y')], ['on', 'on']);
  lamps.put(row(1), 1, LIMITS);
  lamps.look(10 * HOLD + 1, { still: true });
  lamps.look(30 * HOLD, { still: true });
  assert.equal(lamps.glow('full_p'), 'glow');
  lamps.look(31 * HOLD, {});
  assert.equal(lamps.glow('full_p'), 'off');
  lamps.put(row(24), 1, LIMITS);
  lamps.look(40 * HOLD, {});
  lamps.clear();
  assert.equal(lamps.glow('full_p'), 'off');
});

test('a stop that pitch hits and leaves within a tick is told by the count of impacts', () => {
  const lamps = new LampStates();
  lamps.put(row(1), 1, LIMITS);
  lamps.look(0, { impacts: 0 });
  assert.equal(lamps.glow('stop'), 'off');
  lamps.look(16, { impacts: 1 });
  assert.equal(lamps.glow('stop'), 'glow');
  lamps.look(32 + HOLD, { impacts: 1 });
  assert.equal(lamps.glow('stop'), 'off');
  lamps.put(row(1, { [ROW.ON_STOP]: () => 1 }), 1, LIMITS);
  lamps.look(48 + HOLD, { impacts: 1 });
  assert.equal(lamps.glow('stop'), 'on');
});

test('what acts on the rig lights its lamp', () => {
  const lit = (how) => {
    const lamps = new LampStates();
    lamps.look(0, how);
    return ['hands', 'stuck', 'weak', 'hung', 'slow'].filter((name) => lamps.glow(name) === 'on');
  };
  assert.deepEqual(lit({ u: acting() }), []);
  assert.deepEqual(lit({}), []);
  assert.deepEqual(lit({ u: acting({ [INPUT.MANUAL]: 1 }) }), ['hands']);
  assert.deepEqual(lit({ u: acting({ [INPUT.STUCK + 1]: 1 }) }), ['stuck']);
  assert.deepEqual(lit({ u: acting({ [INPUT.THRUST + 1]: 0.4 }) }), ['weak']);
  assert.deepEqual(lit({ u: acting({ [INPUT.HUNG]: 0.001, [INPUT.HUNG + 1]: -0.2 }) }), ['hung']);
  assert.deepEqual(lit({ u: acting({ [INPUT.HUNG]: 0.001 }) }), ['hung']); // below the axis: inertia alone
  assert.deepEqual(lit({ u: acting(), slow: 0.8 }), ['slow']);
  assert.deepEqual(lit({ u: acting(), slow: 0.8, still: true }), []);
});

test('marks of one gesture are one, with its last words; of another kind, or later, they are others', () => {
  const marks = [];
  const first = joined(marks, 1, 'p₁', 'design');
  assert.equal(joined(marks, 1.4, 'p₁, p₂', 'design'), first);
  joined(marks, 1.5, 'Gust', 'gust');
  assert.equal(joined(marks, 1.9, 'p₂', 'design'), first);
  joined(marks, 5, 'p₃', 'design');
  assert.deepEqual(
    marks.map(({ time, until, title, kind }) => [time, until, title, kind]),
    [
      [1, 1.9, 'p₂', 'design'],
      [1.5, 1.5, 'Gust', 'gust'],
      [5, 5, 'p₃', 'design'],
    ],
  );
  assert.equal(nearest(marks, 4.8, 0.5)?.title, 'p₃');
  assert.equal(nearest(marks, 1.2, 0.1)?.title, 'p₂');
  assert.equal(nearest(marks, 3, 0.5), null);
});

test('what is done to a rig has its words on the chart; set points and sticks have none', () => {
  assert.deepEqual(markOf('hands', [1]), ['Hands on', 'hands']);
  assert.deepEqual(markOf('hands', [0]), ['Hands off', 'hands']);
  assert.deepEqual(markOf('stuck', [0, 0]), ['Encoder free', 'fault']);
  assert.deepEqual(markOf('thrust', [1, 1]), ['Full thrust', 'fault']);
  assert.deepEqual(markOf('thrust', [1, 0.5]), ['Thrust changed', 'fault']);
  for (const word of ['reference', 'turn', 'sticks', 'design']) assert.equal(markOf(word, [1, 1]), null);
});

test('a compass counts turns, and a heading is between half turns', () => {
  assert.equal(turnsOf(0.5), '');
  assert.equal(turnsOf(4 * Math.PI + 0.2), '+2');
  assert.equal(turnsOf(-2 * Math.PI), '−1');
  assert.ok(Math.abs(headingOf(7) - (7 - 2 * Math.PI)) < 1e-12);
  assert.equal(arc(0, 90, 10), 'M10.00 0.00A10 10 0 0 0 0.00 -10.00');
  assert.equal(arc(-90, 135, 10).slice(11, 24), 'A10 10 0 1 0 ');
});

test('a rotor is heard the higher and the louder the faster it turns, either way round, and at rest not at all', () => {
  for (const rotor of [0, 1]) {
    assert.equal(toneOf(rotor, -8), toneOf(rotor, 8));
    assert.ok(toneOf(rotor, 12) > toneOf(rotor, 8));
  }
  assert.equal(loudnessOf(0), 0);
  assert.ok(loudnessOf(10) > loudnessOf(5));
  assert.equal(loudnessOf(1e3), loudnessOf(24));
});
