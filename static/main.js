/** Wires only: state to views, views to state, and the design to the server. What each part does is written in its module. */
import { getMethods, getPresets, Live } from './api.js';
import { CloudFeed } from './cloud.js';
import { byId } from './dom.js';
import { Plots } from './plots.js';
import { SceneView } from './scene_view.js';
import { SPlane } from './splane.js';
import { Stats } from './stats.js';
import { designOf, requestOf, Store } from './store.js';
import { ComparePanel } from './panels/compare.js';
import { ExperimentPanel } from './panels/experiment.js';
import { FieldProblems } from './panels/problems.js';
import { FindingsPanel } from './panels/findings.js';
import { FormulasPanel } from './panels/formulas.js';
import { HeaderPanel } from './panels/header.js';
import { LoopsPanel } from './panels/loops.js';
import { MetricsPanel } from './panels/metrics.js';
import { NumbersPanel } from './panels/numbers.js';
import { PaperPanel } from './panels/paper.js';
import { PolesPanel } from './panels/poles.js';
import { ScenarioPanel } from './panels/scenario.js';

const store = new Store();
const stats = new Stats();

const scene = new SceneView(byId('scene'), store, { onTime: (t) => plots.setTime(t) });
const plots = new Plots(byId('plots'), store, { onSeek: (t) => scene.seek(t) });
const views = [
  new HeaderPanel(byId('header'), store), new FindingsPanel(byId('strip')), new SPlane(byId('splane'), store), new PolesPanel(byId('poles'), store),
  new LoopsPanel(byId('loops'), store), new ScenarioPanel(byId('scenario'), store), new ExperimentPanel(byId('scenario'), store), new NumbersPanel(byId('numbers'), store), new MetricsPanel(byId('metrics')),
  new ComparePanel(byId('compare'), store), new FormulasPanel(byId('formulas'), store), new PaperPanel(byId('paper'), store), new FieldProblems(document.body), scene, new CloudFeed(store),
];

/** @type {Map<number, number|undefined>} */
const stamps = new Map();
let seq = 0;

const live = new Live({
  onReply: (reply) => store.set({ reply, problem: null }),
  onProblem: (problem) => store.set({ problem }),
  onStatus: (connection) => store.set({ connection }),
});
addEventListener('online', () => live.reconnect());

store.addEventListener('design', (event) => {
  const { design } = store.state;
  if (!design) return;
  seq += 1;
  stamps.set(seq, /** @type {CustomEvent} */ (event).detail.stamp);
  live.send(requestOf(design, seq));
});

let scheduled = false;
store.addEventListener('change', () => {
  if (scheduled) return;
  scheduled = true;
  requestAnimationFrame(render);
});

function render() {
  scheduled = false;
  const begin = performance.now();
  const { state } = store;
  for (const view of views) view.render(state);
  if (plots.render(state)) {
    const now = performance.now();
    const answered = state.reply?.seq ?? 0;
    stats.drawn(now, stamps.get(answered), now - begin);
    for (const old of stamps.keys()) if (old <= answered) stamps.delete(old);
  }
  publish();
}

/** The design and its key results in one attribute, for tests and scripts. */
function publish() {
  const { design, reply, problem, connection, motion, dragging } = store.state;
  const { latencies: _all, ...latency } = stats.summary();
  document.documentElement.dataset.state = JSON.stringify({
    ...design, connection, motion, dragging, seq, answered: reply?.seq ?? null, settled: reply?.seq === seq && !problem,
    K: reply?.gains.K ?? null, rga: reply?.rga?.rga ?? null, stable: reply?.stable ?? null, loopPoles: reply?.loop_poles ?? null,
    findings: reply?.findings?.map((f) => f.code) ?? [], problem: problem?.code ?? null, latency,
  });
}

/** The figures for scripts: `heli2dofStats.summary()`, `heli2dofStats.reset()`. */
/** @type {any} */ (window).heli2dofStats = stats;

async function start() {
  for (let delay = 300; ; delay = Math.min(2 * delay, 5000)) {
    try {
      const [presets, methods] = await Promise.all([getPresets(), getMethods()]);
      store.set({ presets, methods });
      store.load(designOf(presets[0]));
      return;
    } catch {
      store.set({ connection: 'lost' });
      await new Promise((resolve) => setTimeout(resolve, delay));
    }
  }
}
start();
