// A package's page under Python's eyes. The first line of stdin is a package's content; each further one an attempt,
// {"rig", "step", "body", "answers", "hints"}. The answer is what the page hands in, what it marks of that, and what it
// would have an LMS keep.
import { readFileSync } from 'node:fs';
import { createInterface } from 'node:readline';
import { ManyRigs } from '../../static/kernel/many.js';
import { compiled, instantiated, MODULE } from '../../static/kernel/module.js';
import { fill, serves, sizeOf } from '../../static/kernel/numbers.js';
import { AT } from '../../static/kernel/layout.js';
import { Updates } from '../../static/kernel/updates.js';
import { bodyFrom, designFrom } from '../../static/bodies/index.js';
import { Store } from '../../static/model/index.js';
import { Alone } from '../../static/scorm/alone.js';
import { PackageDesk } from '../../static/scorm/desk.js';
import { GoalClouds } from '../../static/scorm/goal_clouds.js';
import { Lms } from '../../static/scorm/lms.js';

const module = await compiled(readFileSync(MODULE));
const many = new ManyRigs(await instantiated(module));
/** As the worker does it. */
const rigs = {
  serves,
  ask(design, preset, _spreads, count, then, drawn) {
    const numbers = new Float64Array(AT.NUMBERS);
    fill(numbers, design, preset);
    const task = { numbers, size: sizeOf(design, preset), rigs: count, spreads: [], drawn };
    for (const cloud of many.cloud(task)) if (cloud) then(cloud);
  },
};

/** An LMS in which this has been kept. */
function lmsWith(values) {
  const api = Object.fromEntries(['Initialize', 'Commit', 'Finish'].map((name) => [`LMS${name}`, () => 'true']));
  api.LMSGetValue = (element) => values[element] ?? '';
  api.LMSSetValue = (element, value) => ((values[element] = value), 'true');
  return new Lms({ ...api, LMSGetLastError: () => '0', LMSGetErrorString: () => '' }, () => 0);
}

let content;
const store = new Store();
const alone = new Alone(store, new Updates(await instantiated(module)));
for await (const line of createInterface({ input: process.stdin })) {
  if (!content) {
    content = JSON.parse(line);
    store.set({ presets: content.presets });
    continue;
  }
  const { rig, step, body: given, answers, hints } = JSON.parse(line);
  const body = bodyFrom(designFrom(given, content.presets));
  const values = { 'cmi.suspend_data': JSON.stringify({ v: 1, r: rig, at: step, s: {} }) };
  const clouds = new GoalClouds(content.presets, async () => rigs);
  const desk = new PackageDesk(
    content,
    lmsWith(values),
    (design) => alone.answer(design),
    (design, drawn) => clouds.of(design, drawn),
  );
  for (const hint of hints) await desk.hint(step, hint);
  const marked = await desk.mark(step, body, answers);
  desk.leave();
  console.log(JSON.stringify({ marked, values, rig: desk.place, body }));
}
