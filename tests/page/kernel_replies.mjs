// The page's kernel room under Python's eyes. Per line of stdin a JSON object with a preset and a part of a design; the
// answer is what the server would be asked, and the numbers that the kernel takes. Where the object has the server's
// reply, the answer is the page's own, made of the block that it has or of what the module fills, and what differs.
import { readFileSync } from 'node:fs';
import { createInterface } from 'node:readline';
import { differenceOf } from '../../static/kernel/compare.js';
import { AT } from '../../static/kernel/layout.js';
import { compiled, instantiated, MODULE } from '../../static/kernel/module.js';
import { fill, serves, sizeOf } from '../../static/kernel/numbers.js';
import { replyOf } from '../../static/kernel/reply.js';
import { Updates } from '../../static/kernel/updates.js';
import { designOf, evaluationOf, scenarioOf } from '../../static/model/index.js';

const UNUSUAL = { NaN, Infinity, '-Infinity': -Infinity };
const told = (v) => (Number.isFinite(v) ? v : String(v));
const heard = (v) => (typeof v === 'string' ? UNUSUAL[v] : v);

let updates;
/** The module's block. */
async function run(design, preset, size) {
  updates ??= new Updates(await instantiated(await compiled(readFileSync(MODULE))));
  fill(updates.numbers, design, preset);
  return updates.update(size, scenarioOf(design).samples);
}

async function answer({ preset, part, block, reply }) {
  const design = { ...designOf(preset), ...part };
  const numbers = new Float64Array(AT.NUMBERS).fill(7);
  const served = serves(design, preset);
  if (served) fill(numbers, design, preset);
  const size = served ? sizeOf(design, preset) : 0;
  if (!reply) return { body: evaluationOf(design), served, size, numbers: [...numbers].map(told) };
  const arrays = block
    ? Object.fromEntries(Object.entries(block).map(([name, values]) => [name, Float64Array.from(values, heard)]))
    : await run(design, preset, size);
  const own = replyOf(arrays, numbers, design, { size, samples: arrays.t.length }, { reply, design });
  return { own, difference: own && differenceOf(own, reply) };
}

for await (const line of createInterface({ input: process.stdin }))
  console.log(JSON.stringify(await answer(JSON.parse(line)), (_, v) => (v instanceof Float32Array ? [...v] : v)));
