/**
 * Wires only: state to views, views to state, and the design to the server. What each part does is written in its
 * module.
 * @typedef {import('./types.js').State} State
 */
import { languageOf, loadWords, messageOf, say, translatePage } from './text/index.js';
import { isView, requestOf, Store } from './model/index.js';
import { backoff, getMethods, getPresets, Live } from './net/index.js';
import { byId, isolated, projectorWanted, readyToCopy, recall, Stats, Turns, watched } from './ui/index.js';
import { Address, LockedControls, PinKeeper } from './link/index.js';
import { Plots } from './plots/index.js';
import { SPlane } from './splane/index.js';
import { SceneSharing, SceneView } from './scene/index.js';
import {
  ExperimentPanel,
  FieldProblems,
  FindingsPanel,
  HeaderPanel,
  LoopsPanel,
  MetricsPanel,
  Notice,
  NumbersPanel,
  PinBar,
  PolesPanel,
  Remarks,
  ScenarioPanel,
  ViewSwitch,
} from './panels/index.js';

const language = languageOf(location.search, navigator.languages);
if (await loadWords(language)) translatePage(document, language);

const store = new Store();
const stats = new Stats();
const address = new Address(store);
const pins = new PinKeeper(store);

const scene = new SceneView(byId('scene'), store, {
  onTime: (t) => {
    plots.setTime(t);
    sharing.correct();
  },
  onTransport: (snapshot, cause) => sharing.run(snapshot, cause),
});
const sharing = new SceneSharing(store, scene);
const plots = new Plots(byId('plots'), store, { onSeek: (t) => scene.seek(t), onPeek: (t) => scene.peek(t) });
const plane = new SPlane(byId('splane'), store); // what the hand moves
const experiment = new ExperimentPanel(byId('scenario'), store);
/** @typedef {{render: (state: State) => void}} Part */
/** Parts of the page, and where each stands. @type {[Part, HTMLElement?][]} */
const parts = [
  [new HeaderPanel(byId('header'), store, address)],
  [{ render: (/** @type {State} */ state) => plane.renderReadout(state) }],
  [{ render: (/** @type {State} */ state) => plots.renderValues(state) }, byId('plots')],
  [new PolesPanel(byId('poles'), store), byId('poles')],
  [new LoopsPanel(byId('loops'), store), byId('loops')],
  [new ScenarioPanel(byId('scenario'), store), byId('scenario')],
  [experiment, byId('scenario')],
  [new NumbersPanel(byId('numbers'), store), byId('numbers')],
  [new MetricsPanel(byId('metrics')), byId('metrics')],
  [new PinBar(byId('pin-bar'), store), byId('pin-bar')],
  [new FieldProblems(document.body)],
  [scene],
  [new Notice(byId('notice'), store)],
  [new Remarks(document)],
  [new FindingsPanel(byId('strip'), store)], // it measures what it has written
  [{ render: publish }], // last, when all is shown
];
const views = { plane: drawn([plane]), figures: parts.map(drawn) };
const sides = new ViewSwitch(address);
/** @type {import('./clouds/index.js').Clouds|null} drawn in every frame, once it is loaded */ let clouds = null;
/** @type {import('./maps/index.js').Maps|null} */ let maps = null;
/** @type {import('./kernel/index.js').Designs|null} */ let designs = null;
/** Of the present design, whatever is looked at. */
let [drawClouds, drawFinder] = [(/** @type {State} */ _state) => {}, (/** @type {State} */ _state) => {}];
const turns = new Turns();
const locked = new LockedControls(document.body);

/** What was asked of the server. @type {Map<number, import('./types.js').Design>} */ const asked = new Map();
/** When the hand moved, by what came of it. @type {WeakMap<import('./types.js').Design, number|undefined>} */
const stamps = new WeakMap();
/** @type {import('./kernel/index.js').Own|null} the page's own numbers, once they are loaded */ let own = null;
let seq = 0;
let answered = false;

const live = new Live({
  onReply: (reply) => {
    if (!answered) furtherDown().catch(report);
    answered = true;
    const design = asked.get(reply.seq) ?? null;
    for (const old of asked.keys()) if (old <= reply.seq) asked.delete(old);
    store.set(own?.heard(reply, design) ?? { reply, answered: design, heard: design, problem: null });
  },
  onProblem: (problem) => store.set({ problem }),
  onStatus: (connection) => store.set({ connection }),
});
addEventListener('online', () => live.reconnect());
addEventListener('hashchange', () => labs() || address.navigated());
addEventListener('pagehide', () => address.flush());

store.addEventListener('design', (event) => {
  const { design } = store.state;
  if (!design) return;
  const { stamp } = /** @type {CustomEvent} */ (event).detail;
  stamps.set(design, stamp);
  seq += 1;
  if (!own?.edited()) ask();
});

/** The present design. */
function ask() {
  const { design } = store.state;
  if (!design) return;
  asked.set(seq, design);
  live.send(requestOf(design, seq));
}

const lookers = [pins, address, locked].map((part) =>
  isolated((/** @type {State} */ state) => part.render(state), report),
); // they look at more than the state
const drawPlots = isolated((/** @type {State} */ state) => plots.render(state), report);

let scheduled = false;
store.addEventListener('change', schedule);

function schedule() {
  if (scheduled) return;
  scheduled = true;
  requestAnimationFrame(render);
}

function render() {
  const begin = performance.now();
  own?.frame();
  scheduled = false;
  const { state, shown } = store; // what is, and what is seen of it
  // each says again which of its controls can be used
  if (locked.release(state)) for (const view of [views.plane, ...views.figures]) view.forget();
  sides.render(state);
  if (state.view === 'explore') explore();
  drawClouds(state);
  drawFinder(state);
  views.plane(shown);
  const plotted = drawPlots(shown);
  turns.take(shown, views.figures, { busy: plotted === true, again: schedule });
  for (const always of lookers) always(state);
  if (!plotted) return;
  const now = performance.now();
  stats.drawn(now, state.answered ? stamps.get(state.answered) : undefined, now - begin);
  if (state.answered) stamps.delete(state.answered);
}

/**
 * A part that is drawn where what it reads has changed and its view is shown, and stops no other where it fails;
 * `forget` has it drawn in any case.
 * @param {[part: Part, root?: HTMLElement]} of
 */
function drawn([part, root]) {
  let draw = watched(part);
  return Object.assign(
    isolated((/** @type {State} */ state) => (root?.closest('.elsewhere') ? false : draw(state)), report),
    {
      forget: () => {
        draw = watched(part);
      },
    },
  );
}

/** Quietly, once for each part. @param {unknown} error */
function report(error) {
  console.error(error);
  const words = messageOf(error);
  queueMicrotask(() =>
    store.set({
      fault: say`A part of this page could not be drawn: ${words}. Everything else works.`,
    }),
  );
}

/** The first minute, fetched when it is wanted. */
async function explore() {
  if (explored) return;
  explored = true;
  const { Explore } = await fetched(() => import('./explore/index.js'));
  views.figures.unshift(drawn([new Explore(byId('explore'), store), byId('explore')]));
  schedule();
}
let explored = false;

/** Labs, where the address asks for one. */
const labs = (hash = location.hash) =>
  LAB.test(hash) &&
  (opened ??= fetched(() => Promise.all([import('./labs/index.js'), styles('labs')])).then(
    ([{ Labs }]) => new Labs(store, address),
  ))
    .then((own) => own.open(hash))
    .catch(report);
const LAB = /^#(labs\b|lab=|class=)/;
/** @type {Promise<import('./labs/index.js').Labs>|undefined} */ let opened;

const RETRIES = 24; // four minutes

/**
 * Rooms that are fetched after the first view: where the server has gone away meanwhile, again and again.
 * @template T
 * @param {() => Promise<T>} load
 * @returns {Promise<T>}
 */
async function fetched(load) {
  for (let attempt = 0; ; attempt++) {
    try {
      return await load();
    } catch (error) {
      if (attempt === RETRIES) throw error;
      await new Promise((again) => setTimeout(again, backoff(attempt, 500, 10_000)));
    }
  }
}

/** A sheet of rooms that come later, before those that may change what it says. @param {string} name */
function styles(name) {
  const link = Object.assign(document.createElement('link'), { rel: 'stylesheet', href: `static/css/${name}.css` });
  return new Promise((resolve, reject) => {
    link.onload = resolve;
    link.onerror = () => {
      link.remove();
      reject(new Error(`${link.href} could not be fetched`));
    };
    document.head.insertBefore(link, document.querySelector('link[href$="/sharing.css"]'));
  });
}

/** The page's own numbers; where a browser cannot have them, the server goes on alone. */
async function computeHere() {
  const { compiled, instantiated, loadDesigns, loadRigs, MODULE, Own, Updates } = await fetched(
    () => import('./kernel/index.js'),
  );
  const module = await compiled(await fetched(() => fetch(MODULE)));
  own = new Own(store, new Updates(await instantiated(module)), ask).watch(window);
  document.documentElement.dataset.kernel = 'ready';
  clouds?.take(await fetched(() => loadRigs(module)));
  document.documentElement.dataset.rigs = 'ready';
  designs = await fetched(() => loadDesigns(module));
  maps?.take(designs);
  document.documentElement.dataset.designs = 'ready';
}

/** Panels that the first view does not need, fetched when it is there. */
async function furtherDown() {
  const [{ LagPaths, MeasuredPart, RotorPoles }, { Clouds }, { Optimal }, { Maps }] = await fetched(() =>
    Promise.all([
      import('./machine/index.js'),
      import('./clouds/index.js'),
      import('./optimal/index.js'),
      import('./maps/index.js'),
      ...['compare', 'optimal', 'maps'].map(styles),
      readyToCopy(),
    ]),
  );
  clouds = new Clouds(plane, store);
  maps = new Maps(plane, byId('loops'), store);
  const each = [clouds, maps].map((part) => drawn([part]));
  drawClouds = (state) => each.forEach((draw) => draw(state)); // the cloud first: its worker computes meanwhile
  views.figures.unshift(
    drawn([new RotorPoles(byId('poles'), store), byId('poles')]),
    drawn([new MeasuredPart(experiment.body, store), byId('scenario')]),
    drawn([new LagPaths(plane, store)]),
    drawn([new Optimal(plane, byId('poles'), store)]),
  );
  schedule();
  computeHere().catch((why) => {
    console.warn(why);
    maps?.take(null);
  });
  const { further } = await fetched(() => import('./further/index.js'));
  const reply = (/** @type {import('./types.js').Design} */ design) => own?.replyTo(design);
  const pool = () => designs;
  const page = { store, address, plane, plots, reply, pool, scene, sharing };
  const finder = await further(page, { fetched, styles, show });
  drawFinder = drawn([finder, byId('find')]);
  schedule();
}

/** Parts that have come. @param {[Part, HTMLElement?][]} late */
function show(late) {
  views.figures.unshift(...late.map(drawn));
  schedule();
}

/** The design and its key results in one attribute, for tests and scripts. @param {State} state */
function publish(state) {
  const { design, reply, problem, connection, motion, dragging, locks, notice, preview, pins: pinned } = state;
  document.documentElement.dataset.state = JSON.stringify({
    ...design,
    connection,
    motion,
    dragging,
    preview: preview !== null,
    seq,
    answered: reply?.seq ?? null,
    settled: reply?.seq === seq && !problem,
    local: state.heard !== state.answered,
    differences: state.differences,
    K: reply?.gains.K ?? null,
    rga: reply?.rga?.rga ?? null,
    stable: reply?.stable ?? null,
    lagMargin: reply?.lag_margin ?? null,
    observerPoles: reply?.observer?.poles ?? null,
    loopPoles: reply?.loop_poles ?? null,
    findings: reply?.findings?.map((f) => f.code) ?? [],
    problem: problem?.code ?? null,
    locks,
    notice,
    view: state.view,
    pins: pinned.map(({ name, reply: own }) => ({ name, K: own?.gains.K ?? null })),
  });
}

/** The figures for scripts: `heli2dofStats.summary()`, `heli2dofStats.reset()`. */
/** @type {Window & {heli2dofStats?: typeof stats}} */ (window).heli2dofStats = stats;

/** Without a link: at a first visit and in a lecture the first minute, later the view that was left. */
function firstView() {
  const last = recall('view');
  return isView(last) && !projectorWanted(location.search, null) ? last : 'explore';
}

async function start() {
  for (let delay = 300; ; delay = Math.min(2 * delay, 5000)) {
    try {
      const [presets, methods] = await Promise.all([getPresets(), getMethods()]);
      store.set({ presets, methods });
      const { hash } = location;
      if (LAB.test(hash)) address.hold(hash.replace(/&(me|view)=.*/, ''));
      address.open(firstView());
      pins.open();
      labs(hash);
      return;
    } catch {
      store.set({ connection: 'lost' });
      await new Promise((resolve) => setTimeout(resolve, delay));
    }
  }
}
start();
