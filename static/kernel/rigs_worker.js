/**
 * The worker of rigs.js: it gets the compiled module, then tasks, and sends back clouds. It asks nobody for anything,
 * and so goes on without the server.
 * @typedef {import('./rigs.js').Told} Told
 * @typedef {import('./many.js').Task} Task
 * @typedef {import('./many.js').Cloud} Cloud
 */
import { ManyRigs } from './many.js';
import { instantiated } from './module.js';
import { Newest } from './newest.js';

/** @type {Newest<Task, Cloud>|null} */ let newest = null;

addEventListener('message', ({ data }) => {
  const { module, id, task } = /** @type {import('./rigs.js').Asked} */ (data);
  if (module) start(module).catch((problem) => tell({ problem: String(problem) }));
  else newest?.put(id, task);
});

/** @param {WebAssembly.Module} module */
async function start(module) {
  const rigs = new ManyRigs(await instantiated(module));
  newest = new Newest(
    (task) => rigs.cloud(task),
    (id, cloud, problem) => tell({ id, cloud, problem: problem === undefined ? undefined : String(problem) }),
    pause,
  );
  tell({ ready: true });
}

/** @param {Told} told */
function tell(told) {
  const { poles, t, envelopes } = told.cloud ?? {};
  const arrays = [poles, t, ...Object.values(envelopes ?? {}).flat()];
  const transfer = arrays.filter((own) => own instanceof Float64Array).map((own) => own.buffer);
  postMessage(told, { transfer });
}

const { port1, port2 } = new MessageChannel();

/** Shorter than any timer's. @returns {Promise<unknown>} */
function pause() {
  return new Promise((go) => {
    port1.onmessage = go;
    port2.postMessage(null);
  });
}
