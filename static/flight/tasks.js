/**
 * Tasks in the air: one is chosen, flown, and scored as it goes on; what it asks flies along as a ghost, and so do the
 * design alone and one's best flight. A task that was flown to its end is told by the document's event "flown".
 * @typedef {import('../types.js').State} State
 * @typedef {import('../kernel/flight_tasks.js').Task} Task
 * @typedef {import('./scoring.js').Rig} Rig
 * @typedef {import('./beside.js').Trace} Trace
 * @typedef {{value: number, stars: number, trace: Trace}} Best
 * @typedef {object} Flown  what is flown, and with what it began: the page's design may be another by now
 * @property {Task} task
 * @property {Rig} rig
 * @property {import('./designs.js').Aboard} aboard
 * @property {number} seed
 * @property {number[]} gusts  when the task's own come, s
 * @typedef {{store: import('../model/store.js').Store, feed: import('./scene_feed.js').SceneFeed}} Page
 */
import { designFrom } from '../bodies/index.js';
import { BY_AXIS, FLIGHT, TASKS } from '../kernel/index.js';
import { textOf } from '../model/index.js';
import { degrees, fixed, say, t } from '../text/index.js';
import { check, h, recall, remember, setText } from '../ui/index.js';
import { Alone, EVERY, traceAt } from './beside.js';
import { hover } from './plan.js';
import { askedAt, planOf, rigOf, Scoring } from './scoring.js';

/** Between two times that figures are written, ms. */
const WRITES = 250;
const STARS = ['', '★', '★★', '★★★'];
/** Ghosts: their nodes under /ghosts, what is written at them, and the style sheet's colour of each. */
const GHOSTS = /** @type {const} */ ({
  asked: { slot: 'linear', label: 'asked', color: '--good' },
  alone: { slot: '0', label: 'design alone', color: '--pin-0' },
  best: { slot: 'recorded', label: 'your best', color: '--recorded' },
});
/** @typedef {keyof typeof GHOSTS} Ghost */
/** @typedef {Record<Ghost, import('../scene/pose.js').Color>} Inks */
/** Words of what a task alone may do to the rig. */
const HELP = ['gust', 'push', 'hung', 'thrust', 'stuck'];

export class Tasks {
  /** @type {Flown|null} */ #flown = null;
  /** @type {Scoring|null} */ #scoring = null;
  /** @type {Alone|null} */ #alone = null;
  /** @type {Best|null} */ #best = null;
  /** @type {Trace} */ #trace = { every: EVERY, theta: [], psi: [] };
  /** Why nothing is kept of it, in words. */ #practice = '';
  /** The ghosts', as the style sheet had them last. */ #colors = /** @type {Inks} */ ({});
  #told = -Infinity;
  /** What is asked now, θ and ψ, rad; null without a task. @type {readonly [number, number]|null} */ asks = null;
  /** A lab's. @type {string|null} */ #locked = null;

  /** @param {import('./flight.js').Flight} flight @param {Page} page */
  constructor(flight, { store, feed }) {
    this.flight = flight;
    this.store = store;
    this.feed = feed;
    this.select = h(
      'select',
      { 'data-testid': 'fly-task', 'aria-label': t('Task'), onchange: () => this.#chosen() },
      h('option', { value: '' }, t('Free flight')),
      TASKS.map(({ name, title }) => h('option', { value: name }, t(title))),
    );
    this.words = h('p', { class: 'task-words' });
    this.beside = check({ title: 'As a ghost: the task as the design flies it alone' }, t('design alone'));
    this.mine = check({ title: 'As a ghost: the best flight of this task on this rig' }, t('my best'));
    this.mine.box.checked = true;
    this.left = h('progress', { max: 1, value: 0, 'aria-label': t('Time of the task'), hidden: true });
    this.asked = h('p', { class: 'task-asked', translate: 'no', 'data-testid': 'task-asked' });
    this.figures = h('dl', { class: 'task-figures', 'data-testid': 'task-figures' });
    this.result = h('p', { class: 'task-result', role: 'status', 'data-testid': 'task-result' });
    this.ghosts = h('div', { class: 'task-ghosts' }, this.beside.node, this.mine.node);
    this.node = h(
      'section',
      { class: 'tasks', 'aria-label': t('Tasks in the air') },
      h('div', { class: 'row' }, h('label', { class: 'select' }, t('Task'), ' ', this.select)),
      this.words,
      this.ghosts,
      this.left,
      this.asked,
      this.figures,
      this.result,
    );
    flight.addEventListener('start', () => this.#started());
    flight.addEventListener('frame', (e) => this.#fly(/** @type {CustomEvent} */ (e).detail));
    flight.addEventListener('did', (e) => this.#did(/** @type {CustomEvent} */ (e).detail));
    flight.addEventListener('cut', () => this.#cut());
    flight.addEventListener('end', () => this.#ended());
    this.#chosen();
  }

  /** @returns {Task|null} */
  get chosen() {
    return TASKS.find(({ name }) => name === this.select.value) ?? null;
  }

  #chosen() {
    const task = this.chosen;
    // a lab has goals of its own
    setText(this.words, task ? [t(task.words), this.#locked ? '' : limitsOf(task)].join(' ').trim() : '');
    this.ghosts.hidden = !task;
    const best = task && this.#kept(task);
    setText(this.result, best ? say`Your best: ${textOf(FLIGHT[task.figure], best.value)} ${STARS[best.stars]}` : '');
    if (!this.#flown) this.#clear();
  }

  /** Takes off, with the task that is chosen. */
  start() {
    const task = this.chosen;
    const { design } = this.store.state;
    if (!task || !design) return this.flight.start({ plan: design ? [hover(design)] : [] });
    const rig = rigOf(design, this.store.preset ?? undefined);
    const seed = this.store.state.task?.flight?.seed ?? Math.floor(Math.random() * 2 ** 16);
    const still = { ...design, scenario: { ...design.scenario, reference: { theta: rig.theta0, psi: 0 } } };
    delete still.scenario.initial;
    const begin = [hover(still)];
    if (this.store.state.task?.flight?.hands === 'on') begin.push({ time: 0, event: () => ['hands', 1] });
    const plan = [...begin, ...planOf(task, rig, seed)];
    return this.flight.start({ task: task.name, seed, plan, design: still });
  }

  #started() {
    const { state, craft } = this.flight;
    const task = state.replay ? null : (TASKS.find(({ name }) => name === state.task) ?? null);
    this.#flown = null;
    this.#clear();
    if (!task || !craft) return;
    const [{ aboard }, { seed }, { presets }] = [craft, state, this.store.state];
    const design = designFrom(aboard.body, presets);
    const preset = presets.find(({ name }) => name === design.preset);
    const rig = rigOf(design, preset);
    this.#flown = { task, rig, aboard, seed, gusts: planOf(task, rig, seed).map(({ time }) => time) };
    this.#best = this.#kept(task);
    this.#trace = { every: EVERY, theta: [], psi: [] };
    this.#practice = '';
    this.#score(this.#flown);
    setText(this.result, '');
  }

  /** From here on. @param {Flown} flown */
  #score({ task, rig, aboard, seed }) {
    this.#scoring = new Scoring(task, rig);
    this.#alone = new Alone(this.flight.designs.flights, aboard, task, rig, seed);
  }

  #clear() {
    [this.#scoring, this.#alone, this.asks] = [null, null, null];
    this.feed.ghosts = [];
    this.left.hidden = true;
    setText(this.asked, '');
    this.figures.replaceChildren();
  }

  /** @param {import('./course.js').Rows} rows */
  #fly(rows) {
    const [flown, scoring] = [this.#flown, this.#scoring];
    const { craft, state } = this.flight;
    if (!flown || !scoring || !craft || scoring.done) return;
    scoring.put(rows, craft.hands);
    if (state.speed < 1 || state.mode === 'frozen') this.#practice ||= t('It was slowed, so it does not count.');
    while (this.#trace.theta.length * EVERY <= craft.time) {
      this.#trace.theta.push(rounded(craft.theta));
      this.#trace.psi.push(rounded(craft.psi));
    }
    this.#show(flown, scoring, craft.time);
    if (scoring.done) this.#done(flown.task, scoring);
  }

  /** @param {Flown} flown @param {Scoring} scoring @param {number} time */
  #show({ task, rig }, scoring, time) {
    const now = performance.now();
    const writes = now - this.#told >= WRITES || scoring.done;
    if (writes) this.#colors = this.#inks();
    const asked = (this.asks = askedAt(task, time, rig, scoring.mark));
    const alone = this.beside.box.checked && this.#alone ? this.#alone.to(time) : null;
    const best = this.mine.box.checked && this.#best ? traceAt(this.#best.trace, time) : null;
    this.feed.ghosts = [
      this.#ghost('asked', asked),
      ...(alone ? [this.#ghost('alone', alone)] : []),
      ...(best ? [this.#ghost('best', best)] : []),
    ];
    this.left.hidden = false;
    this.left.value = Math.min(time / task.duration, 1);
    if (!writes) return;
    this.#told = now;
    setText(
      this.asked,
      say`asked: θ ${degrees(asked[0])}, ψ ${degrees(asked[1])}; ${fixed(task.duration - time, 0)} s left`,
    );
    const { values, stars } = scoring;
    this.figures.replaceChildren(
      ...task.figures.flatMap((name) => figureRows(name, values[name], name === task.figure ? STARS[stars] : '')),
    );
  }

  /** @param {Task} task @param {Scoring} scoring */
  #done(task, scoring) {
    const { values, stars } = scoring;
    const value = values[task.figure];
    const told =
      typeof value === 'number' ? `${textOf(FLIGHT[task.figure], value)} ${STARS[stars]}`.trim() : t('not reached');
    this.flight.end(this.#practice ? say`Practice: ${told}.` : say`${t(task.title)}: ${told}.`);
    const log = this.flight.log();
    if (this.#practice) {
      setText(this.result, say`Practice: ${told}. ${this.#practice}`);
      return;
    }
    const before = this.#best;
    const better = typeof value === 'number' && stars > 0 && (!before || value < before.value);
    if (better) remember(this.#name(task), JSON.stringify({ value, stars, trace: this.#trace }));
    setText(this.result, better && before ? say`${told}: your best so far.` : told);
    document.dispatchEvent(new CustomEvent('flown', { detail: { log, values } }));
  }

  /**
   * What a task does not have makes it practice, as the server would say (flight/task_flights.py).
   * @param {{time: number, word: string, values: unknown[]}} event
   */
  #did({ time, word, values }) {
    const { craft } = this.flight;
    if (!this.#flown || !craft) return;
    const { gusts, aboard } = this.#flown;
    const own = word === 'gust' && gusts.some((at) => Math.abs(time - at) < 2 * craft.step);
    if (HELP.includes(word) && !own) this.#practice ||= t('Something else acted on the rig, so it does not count.');
    if (word === 'design' && rigText(values[0]) !== rigText(aboard.body))
      this.#practice ||= t('The rig was changed, so it does not count.');
  }

  #cut() {
    const { craft } = this.flight;
    if (!this.#flown || !craft) return;
    this.#practice ||= t('It was rewound, so it does not count.');
    this.#score(this.#flown);
    this.#trace.theta.length = this.#trace.psi.length = Math.floor(craft.time / EVERY);
  }

  #ended() {
    if (this.#scoring && !this.#scoring.done) setText(this.result, t('Ended before the task was.'));
    this.#flown = this.asks = null;
    this.feed.ghosts = [];
  }

  /** @param {Ghost} name @param {readonly [number, number]} where  θ and ψ, rad */
  #ghost(name, [theta, psi]) {
    const { slot, label } = GHOSTS[name];
    return { slot, label: t(label), color: this.#colors[name], theta, psi };
  }

  /** Colours of the ghosts now. @returns {Inks} */
  #inks() {
    const style = getComputedStyle(document.documentElement);
    const all = Object.entries(GHOSTS).map(([name, { color }]) => [
      name,
      this.feed.colorOf(style.getPropertyValue(color).trim()),
    ]);
    return /** @type {Inks} */ (Object.fromEntries(all));
  }

  /** Under which name the best of a task is kept. @param {Task} task */
  #name = (task) => `flight.${task.name}.${this.store.state.design?.preset ?? ''}`;

  /** @param {Task} task @returns {Best|null} */
  #kept(task) {
    try {
      const best = JSON.parse(recall(this.#name(task)) ?? 'null');
      return best && Number.isFinite(best.value) && best.trace?.theta?.length ? best : null;
    } catch {
      return null;
    }
  }

  /** A lab's step may ask for a task. @param {Pick<State, 'task'>} state */
  render({ task }) {
    const name = task?.flight?.task ?? null;
    if (name === this.#locked) return;
    this.#locked = name;
    this.select.disabled = name !== null;
    this.select.value = name ?? '';
    this.#chosen();
  }
}

/** What of a design is the rig's, as text. @param {unknown} body  as a log has it */
function rigText(body) {
  const { parameters, limits, rotors, friction, scenario } = /** @type {import('./designs.js').Body} */ (body);
  const { saturation = true, travel_stops = true, noise, digital } = scenario ?? {};
  return JSON.stringify([parameters, limits, rotors, friction, saturation, travel_stops, noise, digital?.noise]);
}

/** What brings how many stars. @param {Task} task */
const limitsOf = ({ figure, stars }) =>
  say`${[1, 2, 3].map((n) => `${STARS[n]} ≤ ${textOf(FLIGHT[figure], stars[n - 1])}`).join(', ')}.`;

const rounded = (/** @type {number} */ v) => Math.round(v * 1e4) / 1e4;

/**
 * @param {import('../kernel/flight_tasks.js').Name} name @param {import('./scoring.js').Values[string]|undefined} value
 * @param {string} stars
 */
function figureRows(name, value, stars) {
  const figure = FLIGHT[name];
  const own = BY_AXIS.includes(name) && typeof value === 'object' ? [value.theta, value.psi] : [value];
  const text = own.map((v) => textOf(figure, typeof v === 'number' ? v : undefined)).join(' · ');
  return [
    h('dt', { title: figure.meaning ?? '' }, t(figure.short ?? figure.head ?? name)),
    h('dd', { translate: 'no' }, text, stars && h('span', { class: 'stars' }, ` ${stars}`)),
  ];
}
