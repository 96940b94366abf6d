// Where the PI loops take the placed poles: held against LAPACK's eigenvalues of the loop with its gains as they are
// and at a quarter.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { loopPaths, polynomial } from '../../static/splane/loop_paths.js';

const { cases } = JSON.parse(readFileSync(new URL('fixtures/loop_paths.json', import.meta.url), 'utf8'));
const away = (p, q) => Math.hypot(p.re - q.re, p.im - q.im);
const replyOf = ({ gains, loop_poles }) => ({ gains, loop_poles });

for (const own of cases) {
  test(`${own.name}: from each placed pole to one of its own, through those of a loop of a quarter`, () => {
    const paths = loopPaths(replyOf(own), own.design);
    assert.equal(paths.length, 4);
    const ends = paths.map((path, i) => {
      assert.deepEqual(path[0], own.gains.closed_loop_poles[i]);
      return own.loop_poles.indexOf(path.at(-1));
    });
    assert.ok(new Set(ends).size === 4 && !ends.includes(-1));
    const quarter = own.quarter.map(() => false);
    for (const path of paths) {
      const middle = path[(path.length - 1) / 2];
      const near = own.quarter.map((p, i) => (quarter[i] ? Infinity : away(p, middle)));
      const to = near.indexOf(Math.min(...near));
      assert.ok(
        near[to] < 1e-5 * Math.max(1, Math.hypot(middle.re, middle.im)),
        `${JSON.stringify(middle)} is none of that loop's poles`,
      );
      quarter[to] = true;
    }
  });
}

test("a pole that the loops leave where it is stays, though another one's path crosses it", () => {
  const { gains, loop_poles, design } = cases.find((c) => c.name === 'quanser-2dof-manual');
  const paths = loopPaths({ gains, loop_poles }, design);
  assert.ok(Math.abs(paths[1].at(-1).re + 10) < 1e-6 && paths[0].at(-1).re > -9.9);
});

test('without PI loops there are none', () => {
  const [own] = cases;
  assert.equal(loopPaths(replyOf(own), { ...own.design, outer: 'none' }), null);
  assert.equal(loopPaths(null, own.design), null);
});

test('coefficients are those of the roots', () => {
  assert.deepEqual(
    polynomial([
      { re: -1, im: 2 },
      { re: -1, im: -2 },
      { re: -3, im: 0 },
    ]),
    [1, 5, 11, 15],
  );
});
