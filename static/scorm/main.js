/**
 * Wires only, of the page in a SCORM package: the instrument of main.js without a server, beside one lab. Every number
 * is the kernel's; what is told goes to the LMS.
 * @typedef {import('../types.js').State} State
 */
import { languageOf, loadWords, messageOf, say, t, translatePage } from '../text/index.js';
import { Store } from '../model/index.js';
import { byId, h, isolated, Turns, watched } from '../ui/index.js';
import { LockedControls } from '../link/index.js';
import { compiled, instantiated, loadRigs, Updates } from '../kernel/index.js';
import { draughtsman, Plots } from '../plots/index.js';
import { SPlane } from '../splane/index.js';
import {
  ExperimentPanel,
  FieldProblems,
  FindingsPanel,
  LoopsPanel,
  MetricsPanel,
  Notice,
  NumbersPanel,
  PolesPanel,
  ScenarioPanel,
} from '../panels/index.js';
import { MeasuredPart, RotorPoles } from '../machine/index.js';
import { Clouds } from '../clouds/index.js';
import { LabPanel, Sheet } from '../labs/index.js';
import { Alone } from './alone.js';
import { contentOf, kernelOf } from './content.js';
import { Header } from './header.js';
import { PackageDesk } from './desk.js';
import { GoalClouds } from './goal_clouds.js';
import { findApi, Lms } from './lms.js';

const language = languageOf(location.search, navigator.languages);
if (await loadWords(language)) translatePage(document, language);

const store = new Store();
const module = await compiled(await kernelOf(document.baseURI));
const alone = new Alone(store, new Updates(await instantiated(module)));
const content = await contentOf(document.baseURI);
store.set({ presets: content.presets, methods: content.methods, connection: 'lost' }); // there is no server
const goalClouds = new GoalClouds(content.presets, () => loadRigs(module));
const desk = new PackageDesk(
  content,
  new Lms(findApi(window)),
  (design) => alone.answer(design),
  (design, drawn) => goalClouds.of(design, drawn),
);

const plots = new Plots(byId('plots'), store, { onSeek: () => {}, onPeek: () => {} });
const plane = new SPlane(byId('splane'), store);
const clouds = new Clouds(plane, store);
const experiment = new ExperimentPanel(byId('scenario'), store);
const locked = new LockedControls(document.body);
const header = new Header(byId('header'), store, content);

/** @typedef {{render: (state: State) => void}} Part */
/** @type {Part[]} */
const panels = [
  { render: (state) => plane.renderReadout(state) },
  { render: (state) => plots.renderValues(state) },
  header,
  new PolesPanel(byId('poles'), store),
  new RotorPoles(byId('poles'), store),
  new LoopsPanel(byId('loops'), store),
  new ScenarioPanel(byId('scenario'), store),
  experiment,
  new MeasuredPart(experiment.body, store),
  new NumbersPanel(byId('numbers'), store),
  new MetricsPanel(byId('metrics')),
  new FieldProblems(document.body),
  new Notice(byId('notice'), store),
  new FindingsPanel(byId('strip'), store), // it measures what it has written
  { render: publish },
];
const views = { plane: [clouds, plane].map(drawn), others: panels.map(drawn) };
const drawPlots = isolated((/** @type {State} */ state) => plots.render(state), report);
const keepLocked = isolated((/** @type {State} */ state) => locked.render(state), report);
const turns = new Turns();

let scheduled = false;
store.addEventListener('change', schedule);

function schedule() {
  if (scheduled) return;
  scheduled = true;
  requestAnimationFrame(render);
}

function render() {
  alone.frame();
  scheduled = false;
  const { state } = store;
  if (locked.release(state)) for (const view of [...views.plane, ...views.others]) view.forget();
  for (const view of views.plane) view(state);
  turns.take(state, views.others, { busy: drawPlots(state) === true, again: schedule });
  keepLocked(state);
}

/** A part that is drawn where what it reads has changed, and stops no other where it fails. @param {Part} part */
function drawn(part) {
  let draw = watched(part);
  const forget = () => {
    draw = watched(part);
  };
  return Object.assign(
    isolated((/** @type {State} */ state) => draw(state), report),
    { forget },
  );
}

/** @param {unknown} error */
function report(error) {
  console.error(error);
  const words = messageOf(error);
  queueMicrotask(() => store.set({ fault: say`A part of this page could not be drawn: ${words}. The rest works.` }));
}

/** The design and its key results in one attribute, for tests and scripts. @param {State} state */
function publish({ design, reply, answered, problem, dragging, locks }) {
  document.documentElement.dataset.state = JSON.stringify({
    poles: design?.poles,
    K: reply?.gains.K ?? null,
    stable: reply?.stable ?? null,
    settled: answered === design || problem !== null,
    problem: problem?.code ?? null,
    dragging,
    locks,
  });
}

document.documentElement.dataset.view = 'design';
document.documentElement.classList.add('lab-on');
const played = document.querySelector('.legend .key:has(.halo)'); // there is no scene that plays it
if (played) {
  played.lastChild?.replaceWith(t('both steps'));
  played.setAttribute('title', t('nonlinear rig, both references stepped at once'));
}
const gone = content.left_out.map(({ title }) => title).join(', ');
if (gone) document.querySelector('.left-out')?.append(' ', say`So are these steps of the lab: ${gone}.`);
const lab = h('div', { class: 'lab' });
const sheet = new Sheet(h('div', { class: 'lab-body' }, lab));
document.body.insertBefore(sheet.node, document.querySelector('.instrument'));
sheet.show();
const panel = new LabPanel(lab, store, desk);
panel.handIn.title = t('Ctrl+Enter: this page marks the design and your answers; the best attempt counts');
addEventListener('pagehide', () => desk.leave());
document.addEventListener('visibilitychange', () => document.hidden && desk.rest()); // phones tell no more than that
addEventListener('pageshow', (event) => event.persisted && location.reload()); // the LMS's session has ended
draughtsman();
loadRigs(module).then((rigs) => clouds.take(rigs), console.warn);
