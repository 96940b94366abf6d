// The page's kernel room under Python's eyes. Per line of stdin a JSON object with a preset and a part of a design; the
// answer is what the server would be asked, and the numbers that the kernel takes. Where the object has a block and a
// reply, as the kernel and the server make them of these, the answer is the page's own reply, and what differs.
import { createInterface } from 'node:readline';
import { differenceOf } from '../../static/kernel/compare.js';
import { AT } from '../../static/kernel/layout.js';
import { fill, serves, sizeOf } from '../../static/kernel/numbers.js';
import { replyOf } from '../../static/kernel/reply.js';
import { designOf, evaluationOf } from '../../static/model/index.js';

const UNUSUAL = { NaN, Infinity, '-Infinity': -Infinity };
const told = (v) => (Number.isFinite(v) ? v : String(v));
const heard = (v) => (typeof v === 'string' ? UNUSUAL[v] : v);

function answer({ preset, part, block, reply }) {
  const design = { ...designOf(preset), ...part };
  const numbers = new Float64Array(AT.NUMBERS).fill(7);
  const served = serves(design, preset);
  if (served) fill(numbers, design, preset);
  const size = served ? sizeOf(design, preset) : 0;
  if (!block) return { body: evaluationOf(design), served, size, numbers: [...numbers].map(told) };
  const arrays = Object.fromEntries(
    Object.entries(block).map(([name, values]) => [name, Float64Array.from(values, heard)]),
  );
  const own = replyOf(arrays, numbers, design, { size, samples: block.t.length }, { reply, design });
  return { own, difference: own && differenceOf(own, reply) };
}

for await (const line of createInterface({ input: process.stdin }))
  console.log(JSON.stringify(answer(JSON.parse(line)), (_, v) => (v instanceof Float32Array ? [...v] : v)));
