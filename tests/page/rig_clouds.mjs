// The page's clouds under Python's eyes. Per line of stdin a JSON object: a preset, a part of a design, how uncertain
// its rigs are, how many of them, and the motion. The answer is what the server would be asked, by what factors these
// rigs differ, and the page's cloud of them: null where its kernel does not serve, or does not find the design.
import { readFileSync } from 'node:fs';
import { createInterface } from 'node:readline';
import { ManyRigs } from '../../static/kernel/many.js';
import { FACTORS, RIGS } from '../../static/kernel/layout.js';
import { compiled, instantiated, MODULE } from '../../static/kernel/module.js';
import { fillFactors } from '../../static/kernel/random.js';
import { loadRigs } from '../../static/kernel/rigs.js';
import { cloudRequest, uncertain } from '../../static/clouds/feed.js';
import { designOf } from '../../static/model/index.js';

const many = new ManyRigs(await instantiated(await compiled(readFileSync(MODULE))));

/** What a worker does, here and now. */
const worker = {
  postMessage({ id, task }) {
    const told = (data) => queueMicrotask(() => worker.onmessage({ data }));
    worker.task = task;
    if (task) told({ id, cloud: [...many.cloud(task)].at(-1) ?? null });
    else told({ ready: true });
  },
};
const rigs = await loadRigs(null, () => worker);

async function answer({ preset, part, spread, count, motion = 'both' }) {
  const design = { ...designOf(preset), ...part };
  const {
    uncertainty,
    samples: _count,
    ...body
  } = cloudRequest(design, spread, motion, uncertain(design, preset), count);
  const asked = { ...design, scenario: body.scenario };
  if (!rigs.serves(asked, preset)) return { body, uncertainty, factors: null, cloud: null };
  const cloud = await new Promise((told) => rigs.ask(asked, preset, uncertainty, count, told));
  const factors = new Float64Array(FACTORS * count);
  fillFactors(factors, worker.task.spreads, RIGS.LEAST);
  return { body, uncertainty, factors, cloud };
}

for await (const line of createInterface({ input: process.stdin }))
  console.log(
    JSON.stringify(await answer(JSON.parse(line)), (_, v) =>
      v instanceof Float64Array ? Array.from(v, (x) => (Number.isFinite(x) ? x : String(x))) : v,
    ),
  );
