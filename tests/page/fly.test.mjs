import assert from 'node:assert/strict';
import { test } from 'node:test';

import { changedParts, changeOf, changeWords, joined } from '../../static/flight/changes.js';
import { canPack, MOST_IN_LINK, packed, unpacked } from '../../static/flight/link_text.js';
import { Watched } from '../../static/flight/watched.js';
import { viewOfPlace } from '../../static/model/index.js';
import { trajectoryIn } from '../../static/scene/panel.js';
import { Spectator } from '../../static/scene/spectator.js';

const pole = (re, im = 0) => ({ re, im });
const design = {
  preset: 'rig',
  poles: [pole(-12), pole(-10), pole(-9), pole(-8)],
  loops: { pitch: { kp: 30, ti: 0.1 }, yaw: { kp: 30, ti: 0.1 } },
  method: 'full-rank',
  limits: {},
  outer: 'pi',
  scenario: { reference: { theta: 0.1, psi: 0.2 }, duration: 5 },
};

test('what of a design is another is named part by part', () => {
  assert.deepEqual(changedParts(design, structuredClone(design)), []);
  const moved = { ...design, poles: [pole(-12), pole(-10), pole(-4, 1), pole(-4, -1)] };
  assert.deepEqual(changedParts(design, moved), ['p₃', 'p₄']);
  const more = { ...moved, loops: { ...design.loops, yaw: { kp: 31, ti: 0.1 } }, limits: { V_p: 20 }, outer: 'none' };
  assert.deepEqual(changedParts(design, more), ['p₃', 'p₄', 'yaw’s loop', 'the limits', 'the structure']);
  assert.deepEqual(changedParts(design, { ...design, observer: { poles: [] } }), ['the observer']);
  const asked = { ...design, scenario: { reference: { theta: 0, psi: 1 }, duration: 9 } };
  assert.deepEqual(changedParts(design, asked), [], 'what is asked of it is no part of it');
  const sampled = { ...design, scenario: { ...design.scenario, digital: { sample_time: 0.01 } } };
  assert.deepEqual(changedParts(design, sampled), ['the sampling']);
});

const takeover = (time, jump, jumpWithout, bumpless = true) => ({ tick: 1, time, jump, jumpWithout, bumpless });

test('a change says which voltage would have jumped, and that it did not', () => {
  const change = changeOf(takeover(12.4, [0, 1e-13], [0.4, -3.1]), ['p₃', 'p₄']);
  assert.equal(changeWords(change), 'p₃, p₄ changed at 12.4 s: V_y would have jumped by 3.1 V; it did not.');
  const still = changeOf(takeover(1, [0, 0], [0, 0.001]), ['p₁']);
  assert.equal(changeWords(still), 'p₁ changed at 1.0 s: no voltage would have jumped.');
});

test('where nothing can prevent the jump it is told with its size', () => {
  const words = changeWords(changeOf(takeover(3, [0.8, 0.1], [0.8, 0.1], false), ['p₁']));
  assert.match(words, /^p₁ changed at 3\.0 s: V_p jumped by 0\.8 V\. Without an integrator/);
});

test('the controller that takes over from the sticks is told so', () => {
  const words = changeWords(changeOf(takeover(8, [0, 0], [2, 5]), []));
  assert.equal(words, 'The controller took over from the sticks at 8.0 s: V_y would have jumped by 5.0 V; it did not.');
});

test('the controllers of one gesture are one change, with the largest jump of them', () => {
  const first = changeOf(takeover(2, [0, 0], [1, 0.2]), ['p₁']);
  const both = joined(first, changeOf(takeover(3.5, [1e-12, 0], [-0.5, 2.5], true), ['p₁', 'p₂']));
  assert.deepEqual([both.parts, both.without, both.bumpless], [['p₁', 'p₂'], [1, 2.5], true]);
  assert.equal(
    changeWords(both),
    'p₁, p₂ changed from 2.0 to 3.5 s: V_y would have jumped by up to 2.5 V; it did not.',
  );
  assert.equal(joined(both, changeOf(takeover(4, [1, 0], [1, 0], false), [])).bumpless, false);
});

test('a log comes out of a link as it went in', async () => {
  assert.ok(canPack());
  const log = { flight: 1, design: { preset: 'rig' }, ticks: 5000, events: [[10, 'reference', 0.1, -0.25]], task: '' };
  const text = await packed(log);
  assert.match(text, /^[\w-]+$/);
  assert.deepEqual(JSON.parse(await unpacked(text)), log);
  assert.equal(viewOfPlace(`flight-${text}`), 'fly');
});

test('a flight that is too long makes no link, a damaged one is refused, a swollen one is not unpacked', async () => {
  const random = Array.from({ length: 4000 }, (_, k) => [k, 'push', Math.sin(k * k), Math.cos(k)]);
  assert.equal(await packed({ events: random }), null);
  const text = await packed({ events: random.slice(0, 50) });
  assert.ok(text.length <= MOST_IN_LINK);
  await assert.rejects(unpacked(text.slice(0, -9)));
  await assert.rejects(unpacked('~~~'));
  const swollen = await packed({ words: ' '.repeat(3_000_000) });
  assert.ok(swollen.length < MOST_IN_LINK, 'a few letters');
  await assert.rejects(unpacked(swollen), RangeError);
});

const sample = (psi) => ({ theta: 0.1, psi, V_p: 12, V_y: -4, reference: { theta: 0.1, psi: 0.5 } });

/** What a flight of one turn per ten seconds tells other windows at 60 frames/s. */
function told({ others = 1, until = 2, speed = 1 } = {}) {
  const sent = [];
  const watched = new Watched({ hub: { others }, tell: (motion, more) => sent.push({ ...more, trajectory: motion }) });
  for (let n = 0; n <= until * 60; n++) watched.put(sample((0.1 * n) / 60), n / 60, (1000 * n) / 60, speed);
  return { sent, watched };
}

test('nothing is sent while nobody watches, and twenty times in a second where somebody does', () => {
  assert.equal(told({ others: 0 }).sent.length, 0);
  const { sent } = told();
  assert.ok(sent.length >= 28 && sent.length <= 41, `${sent.length}`);
  for (const own of sent) assert.ok(trajectoryIn(own), 'a trajectory as the windows take it');
  const ends = sent.map(({ flight, trajectory: { t } }) => flight.from + t.at(-1));
  sent.slice(1).forEach(({ flight }, k) => assert.ok(Math.abs(flight.from - ends[k]) < 1e-6, 'without a gap'));
});

test('who watches sees the flight a moment later, and smoothly', () => {
  const { sent } = told();
  const spectator = new Spectator();
  assert.equal(spectator.at(0), null);
  let next = 0;
  let before = null;
  for (let n = 0; n <= 120; n++) {
    const now = (1000 * n) / 60;
    while (next < sent.length && 1000 * (sent[next].flight.from + sent[next].trajectory.t.at(-1)) <= now + 1e-3) {
      spectator.take(sent[next].flight, sent[next].trajectory, now);
      next += 1;
    }
    const seen = spectator.at(now);
    if (!seen) continue;
    if (n > 60) {
      const late = now / 1000 - seen.t;
      assert.ok(late > 0.05 && late < 0.25, `${late} s late`);
      assert.ok(seen.t - before > 0.01 && seen.t - before < 0.024, `moves on by ${seen.t - before} s`);
      assert.ok(Math.abs(seen.psi - 0.1 * seen.t) < 1e-5);
      assert.deepEqual(seen.reference, { theta: 0.1, psi: 0.5 });
    }
    before = seen.t;
  }
  assert.ok(spectator.watches(2500) && !spectator.watches(5000), 'a silent flight is over');
});

test('a flight that is rewound is seen where it goes on, and one that stands still is seen to its end', () => {
  const { sent, watched } = told();
  const spectator = new Spectator();
  for (const own of sent) spectator.take(own.flight, own.trajectory, 2000);
  sent.length = 0;
  watched.put(sample(0.05), 0.5, 3000, 0);
  assert.equal(sent.length, 1);
  spectator.take(sent[0].flight, sent[0].trajectory, 3000);
  const seen = spectator.at(3001);
  assert.ok(Math.abs(seen.t - 0.5) < 1e-3 && Math.abs(seen.psi - 0.05) < 1e-6, `${seen.t}`);
});
