// Requirements on the poles: formula, words, and regions that agree with the verdict at every point of the plane.
import assert from "node:assert/strict";
import { test } from "node:test";

import { forbidden, leastDamping, missed, missedWords, NONE, pairVerdict, readoutWords } from "../../static/requirements.js";
import { readoutLines } from "../../static/splane_readout.js";
import { Store } from "../../static/store.js";

const both = { settling: 1, overshoot: 5 };
const pair = (re, im) => [{ re, im }, { re, im: -im }];

test("least damping is that of the textbook: 0.69 for 5 %, 0.59 for 10 %, 1 for none, 0 for all", () => {
  assert.ok(Math.abs(leastDamping({ settling: null, overshoot: 5 }) - 0.690107) < 1e-6);
  assert.ok(Math.abs(leastDamping({ settling: null, overshoot: 10 }) - 0.591155) < 1e-6);
  assert.equal(leastDamping({ settling: null, overshoot: 0 }), 1);
  assert.ok(leastDamping({ settling: null, overshoot: 100 }) === 0);
  assert.equal(leastDamping(NONE), undefined);
});

test("a pole on the border meets the requirement, one beyond it does not", () => {
  assert.deepEqual(missed({ re: -4, im: 0 }, both), { settling: false, overshoot: false });
  assert.deepEqual(missed({ re: -3.99, im: 0 }, both), { settling: true, overshoot: false });
  assert.deepEqual(missed({ re: -5, im: 20 }, both), { settling: false, overshoot: true });
  assert.deepEqual(missed({ re: 1, im: 0 }, both), { settling: true, overshoot: true });
  assert.deepEqual(missed({ re: 1, im: 0 }, NONE), { settling: false, overshoot: false });
});

test("the hatched regions are where a pole misses, everywhere in view", () => {
  const inside = (p, corners) => {
    let odd = false;
    for (let i = 0, j = corners.length - 1; i < corners.length; j = i++) {
      const [a, b] = [corners[i], corners[j]];
      if (a.im > p.im !== b.im > p.im && p.re < ((b.re - a.re) * (p.im - a.im)) / (b.im - a.im) + a.re) odd = !odd;
    }
    return odd;
  };
  for (const seen of [{ left: -20, right: 5, bottom: -12, top: 12 }, { left: -3, right: -1, bottom: 2, top: 4 }, { left: 1, right: 9, bottom: -1, top: 30 }]) {
    for (const r of [both, { settling: 0.3, overshoot: 60 }, { settling: 40, overshoot: 0.5 }, { settling: 2, overshoot: 99 }]) {
      const regions = forbidden(seen, r);
      for (let a = 0.013; a < 1; a += 0.0371) {
        for (let b = 0.017; b < 1; b += 0.0393) {
          const p = { re: seen.left + a * (seen.right - seen.left), im: seen.bottom + b * (seen.top - seen.bottom) };
          const m = missed(p, r);
          assert.equal(Boolean(regions.settling && inside(p, regions.settling)), m.settling, JSON.stringify({ seen, r, p }));
          assert.equal(inside(p, regions.overshoot), m.overshoot, JSON.stringify({ seen, r, p }));
        }
      }
    }
  }
});

test("words name what is missed, and by which pole", () => {
  assert.equal(missedWords({ re: -1, im: 9 }, both), "too slow, overshoots");
  const poles = [{ re: -12, im: 0 }, { re: -2, im: 0 }, ...pair(-5, 20)];
  assert.deepEqual(pairVerdict(poles, 0, both), { met: false, text: "2 too slow" });
  assert.deepEqual(pairVerdict(poles, 1, both), { met: false, text: "overshoots" });
  assert.deepEqual(pairVerdict(poles, 0, { settling: null, overshoot: 5 }), { met: true, text: "meets the requirements" });
  assert.equal(readoutWords(poles[1], NONE), "");
  assert.deepEqual(readoutLines(poles, 2, both), ["yaw poles 3, 4", "−5.00 ± 20.00j rad/s", "ζ 0.24   ωₙ 20.62 rad/s", "settles in 0.80 s, overshoot 46 %", "✕ overshoots"]);
  assert.deepEqual(readoutLines(poles, 0, both).slice(-2), ["settles in 0.33 s", "✓ meets the requirements"]);
});

test("requirements are no part of the design: undo leaves them", () => {
  const store = new Store();
  store.load({ poles: [] });
  store.edit((d) => ({ ...d, theta0: 1 }));
  store.set({ requirements: both });
  store.undo();
  assert.equal(store.state.requirements, both);
  assert.equal(store.state.design.theta0, undefined);
});
