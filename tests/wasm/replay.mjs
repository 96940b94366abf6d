// Calls the WebAssembly kernels as `tests.wasm.replay` wrote them down: `node replay.mjs FOLDER [MODULE]`.
// calls.json: [{ kernel, takes: { name: 'number' | [type, shape, byte at which it stands in before.bin] }, repeat }];
// written are after.bin, all arrays in the same places, and returned.json: [{ returned, error, milliseconds }] and
// how much of the stack was used at most.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { performance } from 'node:perf_hooks';
import { MODULE, compiled, instantiated } from '../../static/kernel/index.js';

const folder = process.argv[2];
const calls = JSON.parse(readFileSync(join(folder, 'calls.json'), 'utf8'));
const data = readFileSync(join(folder, 'before.bin'));

const kernels = await instantiated(await compiled(readFileSync(process.argv[3] ?? MODULE)));
const bytes = (at, length) => new Uint8Array(kernels.memory.buffer, at, length);
const bytesOf = (block) => bytes(block.at, block.items * (block.type === 'c128' ? 16 : 8));

/** The stack begins here and goes down to 0: what is painted still at the end was not used. */
const STACK = 65536;
const PAINT = 0xa5;
bytes(0, STACK).fill(PAINT);

function done({ kernel, takes, repeat }) {
  const mark = kernels.mark;
  const arrays = [];
  const values = {};
  for (const [name, value] of Object.entries(takes)) {
    if (typeof value === 'string') values[name] = Number(value);
    else {
      const [type, shape, at] = value;
      values[name] = kernels.array(type, ...shape);
      arrays.push({ block: values[name], at });
    }
  }
  const fill = () => {
    for (const { block, at } of arrays) {
      const own = bytesOf(block);
      own.set(data.subarray(at, at + own.length));
    }
  };
  const run = kernels.bound(kernel, values);
  const result = { milliseconds: Infinity };
  try {
    for (let k = 0; k < repeat; k++) {
      fill();
      const start = performance.now();
      const returned = run();
      result.milliseconds = Math.min(result.milliseconds, performance.now() - start);
      // JSON has no word for what is not finite
      result.returned = typeof returned === 'number' ? String(returned) : returned;
    }
  } catch (error) {
    result.error = String(error);
  }
  for (const { block, at } of arrays) data.set(bytesOf(block), at);
  kernels.release(mark);
  return result;
}

const results = calls.map(done);
writeFileSync(join(folder, 'after.bin'), data);
const used = bytes(0, STACK).findIndex((byte) => byte !== PAINT);
writeFileSync(join(folder, 'returned.json'), JSON.stringify({ results, stack: used < 0 ? 0 : STACK - used }));
