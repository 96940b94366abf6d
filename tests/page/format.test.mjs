// Numbers in words and figures.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import {
  brief,
  complex,
  decibel,
  degrees,
  fixed,
  forField,
  parseNumber,
  percent,
  poleText,
  seconds,
  significant,
} from '../../static/text/format.js';
import { Stats } from '../../static/ui/stats.js';

test('the minus is a minus, and zero has none', () => {
  assert.equal(fixed(-1.005, 1), '\u22121.0');
  assert.equal(fixed(-0.001, 2), '0.00');
  assert.equal(fixed(undefined), '–');
});

test('significant digits, with an exponent only where it helps', () => {
  assert.equal(significant(51.170053, 5), '51.170');
  assert.equal(significant(9.9999999, 5), significant(10, 5));
  assert.equal(significant(-0.61941, 5), '\u22120.6194');
  assert.equal(significant(4526.3, 4), '4526');
  assert.equal(significant(2.5e-7, 4), '2.50e\u22127');
});

test('a figure beside another is brief where it is large', () => {
  for (const [text, short] of [
    ['87.5', '87.5'],
    ['102.3 V', '102 V'],
    ['2155.7 %', '2156 %'],
    ['\u221247.68°', '\u221247.7°'],
    ['99.97 V', '100 V'],
    ['\u2212285.6°', '\u2212286°'],
    ['9999.4', '9999'],
    ['57296°', '6e4°'],
    ['0.00051', '0.00051'], // digits behind a point are no number of their own
    ['0.0123 V', '0.0123 V'],
    ['\u22120.000999', '\u22120.000999'],
    ['1.2345', '1.2345'],
    ['123456.0 V', '1e5 V'],
    ['–', '–'],
  ])
    assert.equal(brief(text), short);
});

test('fields show plain numbers and accept what people type', () => {
  assert.equal(forField(-8.76), '-8.76');
  assert.equal(parseNumber(' −9,25 '), -9.25);
  for (const nonsense of ['', 'abc', '1..2']) assert.ok(Number.isNaN(parseNumber(nonsense)));
});

test('a pole for a screen reader', () => {
  const poles = [
    { re: -12, im: 0 },
    { re: -10, im: 0 },
    { re: -3, im: 4 },
    { re: -3, im: -4 },
  ];
  assert.equal(poleText(poles[0], 'pitch pole 1'), 'pitch pole 1: \u221212.0 rad/s');
  assert.equal(poleText(poles[3], 'yaw pole 4'), 'yaw pole 4: \u22123.0 \u2212 4.0j rad/s');
  assert.equal(complex(poles[2]), '\u22123.00 + 4.00j');
});

test('figures of merit', () => {
  assert.equal(decibel(2), '6.0 dB');
  assert.equal(degrees(Math.PI / 4), '45.0°');
  assert.equal(seconds(0.012), '12 ms');
  assert.equal(seconds(1.234), '1.23 s');
  assert.equal(percent(0.256), '26 %');
});

test('statistics of the updates', () => {
  const stats = new Stats();
  for (let k = 0; k < 5; k++) stats.drawn(100 * k, k === 2 ? undefined : 100 * k - 10 * k, 3);
  const s = stats.summary();
  assert.equal(s.updates, 5);
  assert.equal(s.perSecond, 10);
  assert.equal(s.last, 40);
  assert.deepEqual(s.latencies, [0, 10, 30, 40]);
  stats.reset();
  assert.equal(stats.summary().median, null);
});

test('what is no number is a dash, in every way of writing', () => {
  for (const write of [fixed, significant]) {
    for (const nothing of [undefined, NaN, Infinity, -Infinity]) assert.equal(write(nothing), '–');
    assert.notEqual(write(0), '–');
  }
});

test('read back, a number is the one that was written, to all digits but one, and only zero is written as zero', () => {
  let seed = 3;
  const drawn = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
  const read = (text) => Number(text.replace('\u2212', '-').replace('e\u2212', 'e-'));
  for (let k = 0; k < 2000; k++) {
    const v = (drawn() < 0.5 ? -1 : 1) * 10 ** (18 * drawn() - 9);
    const digits = 3 + Math.floor(6 * drawn());
    const text = significant(v, digits);
    assert.ok(Math.abs(read(text) / v - 1) <= 0.5 * 10 ** (2 - digits), `${v} with ${digits} digits: ${text}`);
    assert.equal(text.includes('e'), Math.abs(v) >= 1e6 || Math.abs(v) < 1e-4, text);
    assert.equal(text.startsWith('\u2212'), v < 0);
  }
  assert.deepEqual(
    [1e-4, 0.99e-4, 0.001, 0.05, 999999, 1e6, 0].map((v) => significant(v, 3)),
    ['0.00010', '9.9e\u22125', '0.0010', '0.050', '999999', '1.0e6', '0.00'],
  );
});
