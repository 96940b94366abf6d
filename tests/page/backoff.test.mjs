import assert from 'node:assert/strict';
import test from 'node:test';
import { backoff } from '../../static/net/backoff.js';

test('waits twice as long each time, up to a bound, a quarter more or less', () => {
  for (let attempt = 0; attempt < 12; attempt += 1) {
    const middle = Math.min(8000, 250 * 2 ** attempt);
    const waits = Array.from({ length: 200 }, () => backoff(attempt, 250, 8000));
    assert.ok(Math.min(...waits) >= 0.75 * middle && Math.max(...waits) <= 1.25 * middle);
    assert.ok(new Set(waits).size > 100); // pages do not come back together
  }
});
