/**
 * The view Fly: the page's design flies the rig in real time, by hand. Here its parts are put together, and moved on
 * once per animation frame; what each does is written in its module.
 * @typedef {import('../types.js').State} State
 *
 * @typedef {object} Page  what it is a part of
 * @property {import('../model/store.js').Store} store
 * @property {import('../link/address.js').Address} address
 * @property {import('../scene/view.js').SceneView} scene
 * @property {import('../scene/sharing.js').SceneSharing} sharing
 * @property {import('./scene_feed.js').SceneParts['poses']} poses
 * @property {import('./scene_feed.js').SceneParts['ghosts']} ghosts
 * @property {import('../kernel/index.js').Flights} flights
 */
import { getRigViews } from '../net/index.js';
import { messageOf } from '../text/index.js';
import { designFrom } from '../bodies/index.js';
import { button, h, setText } from '../ui/index.js';
import { changedParts, changeOf, changeWords, joined } from './changes.js';
import { Flight } from './flight.js';
import { Instruments } from './instruments.js';
import { Hands } from './hands.js';
import { PLACE } from './link_text.js';
import { sampleNow, sampleOf, SceneFeed } from './scene_feed.js';
import { FlightShare } from './share.js';
import { Tasks } from './tasks.js';
import { FlightBar } from './transport.js';
import { Watched } from './watched.js';

/** Of changes in the air that are told in words. */
const TOLD = 3;
/** Between two controllers of one gesture, s of flight. */
const TOGETHER = 2;

export class FlyView {
  #request = 0;
  /** Whether the view is seen. */ #seen = false;
  /** The design that flies. @type {import('../types.js').Design|null} */ #flown = null;
  /**
   * The newest change, which may go on.
   * @type {{change: import('./changes.js').Change, step: number, line: HTMLElement}|null}
   */
  #change = null;
  /** The link's flight that was opened. @type {string|null} */ #opened = null;
  #starting = false;
  /** What a hand can hold of each rig. @type {Record<string, import('./ray.js').Shape>} */ #shapes = {};

  /** @param {HTMLElement} root @param {Page} page */
  constructor(root, { store, address, scene, sharing, poses, ghosts, flights }) {
    this.store = store;
    this.address = address;
    this.scene = scene;
    this.flight = new Flight(store, flights);
    this.feed = new SceneFeed(scene, { poses, ghosts });
    this.tasks = new Tasks(this.flight, { store, feed: this.feed });
    this.hands = new Hands(this.flight, {
      store,
      frame: scene.webgl ? scene.frame : null,
      shape: () => this.#shapes[store.preset?.rig ?? ''] ?? null,
      seen: () => this.#seen,
      restart: () => this.start(),
    });
    this.hands.weather.node.open = matchMedia('(min-width: 1180px) and (min-height: 780px)').matches; // there is room
    this.watched = new Watched(sharing);
    sharing.hub.onSticks = (sticks) => this.hands.demand('partner', sticks);
    this.share = new FlightShare(this.flight, store);
    this.instruments = new Instruments(this.flight);
    this.bar = new FlightBar(this.flight, {
      again: () => this.start(),
      look: (rows, at, time) => {
        this.feed.show(sampleOf(rows, at), this.#limits);
        this.instruments.look({ time, rows, at });
      },
    });
    this.begin = button(
      { class: 'primary fly', title: 'Take off (R)', 'data-testid': 'fly', onclick: () => this.start() },
      'Fly',
    );
    this.again = button({ 'data-testid': 'fly-replay', hidden: true, onclick: () => this.#replay() }, 'Replay');
    this.why = h('p', { class: 'fly-why', role: 'status', 'data-testid': 'fly-why' });
    this.words = h(
      'div',
      { class: 'first-words' },
      h(
        'p',
        {},
        'Arrow keys or sticks move the set points, and your design follows. “Hands on” (H) takes it away: ' +
          'then they are the motors’ voltages.',
      ),
      h('p', {}, 'Drag poles while it flies. R takes off, Space freezes, Backspace goes back 5 s, K shows all keys.'),
    );
    this.card = h(
      'div',
      { class: 'fly-card', 'data-views': 'fly' },
      this.why,
      h('div', { class: 'row' }, this.begin, this.again),
      this.words,
    );
    this.changes = h('ul', { class: 'fly-changes', 'aria-label': 'Changes in the air', 'data-testid': 'fly-changes' });
    this.problem = h('p', { class: 'status failure', role: 'alert', hidden: true, 'data-testid': 'fly-problem' });
    const { chart, lamps, over, sound } = this.instruments;
    this.side = h(
      'div',
      { class: 'fly-side' },
      this.tasks.node,
      this.hands.node,
      this.changes,
      this.hands.weather.node,
      h('div', { class: 'fly-tools' }, sound.node, this.share.node),
    );
    root.append(this.bar.node, h('div', { class: 'fly-strip panel' }, this.problem, chart), this.side);
    const stage = scene.frame.parentElement ?? scene.notice.parentElement;
    stage?.append(over, this.card);
    scene.frame.after(this.hands.overlay); // below what is written over the scene
    const lay = () => (wide.matches ? this.side.prepend(lamps.node) : over.append(lamps.node));
    const wide = matchMedia('(min-width: 760px)');
    wide.addEventListener('change', lay);
    lay();
    this.#listen();
  }

  /** What flies now, which may be another than the page's. */
  get #aboard() {
    const { craft } = this.flight;
    return craft && designFrom(craft.aboard.body, this.store.state.presets);
  }

  /** @returns {import('../scene/pose.js').Limits} */
  get #limits() {
    const { craft } = this.flight;
    if (!craft) return this.store.state.reply?.limits ?? {};
    const [V_p, V_y] = craft.limits;
    const { travel } = craft;
    return { V_p, V_y, ...(Number.isFinite(travel) && { theta: travel }) };
  }

  #listen() {
    const on = (/** @type {string} */ type, /** @type {(detail: never) => void} */ act) =>
      this.flight.addEventListener(type, (e) => act(/** @type {never} */ (/** @type {CustomEvent} */ (e).detail)));
    on('change', () => this.#changed());
    on('start', () => this.#started());
    on('end', () => this.#ended());
    on('frame', (/** @type {import('./course.js').Rows} */ flown) => this.feed.turn(flown));
    on('takeover', (/** @type {import('./craft.js').Takeover} */ takeover) => this.#takeover(takeover));
    on('cut', (/** @type {{time: number}} */ { time }) => this.#cut(time));
    addEventListener('hashchange', () => this.#linked());
    document.addEventListener('visibilitychange', () => document.hidden && this.flight.hold());
    document.addEventListener('keydown', (e) => this.#key(e));
  }

  /** Space and Enter start, where nothing else takes them. @param {KeyboardEvent} e */
  #key(e) {
    const { mode } = this.flight.state;
    const free = e.target === document.body || e.target === document.documentElement;
    if (!this.#seen || !free || (mode !== 'idle' && mode !== 'ended') || !/^( |Enter)$/.test(e.key)) return;
    if (e.ctrlKey || e.metaKey || e.altKey || e.repeat || e.defaultPrevented) return;
    e.preventDefault();
    this.start();
  }

  async start() {
    if (this.#starting) return;
    this.#starting = true;
    this.begin.disabled = true;
    this.#refused('');
    try {
      await this.tasks.start();
    } catch (error) {
      this.#refused(messageOf(error));
    } finally {
      this.#starting = this.begin.disabled = false;
    }
  }

  #replay() {
    const log = this.flight.log();
    if (!log) return;
    // the page's design stays, unless it is of another rig
    const shown = this.flight.state.past ? this.flight.replay(log) : this.share.show(log);
    shown.catch((error) => this.#refused(messageOf(error)));
  }

  /** @param {string} words */
  #refused(words) {
    this.problem.hidden = !words;
    setText(this.problem, words);
  }

  #started() {
    this.#flown = this.#aboard;
    this.#change = null;
    this.changes.replaceChildren();
    if (this.card.contains(document.activeElement)) this.bar.hold.focus({ preventScroll: true });
  }

  #ended() {
    this.#change = null;
  }

  #changed() {
    const { mode, why, problem, replay } = this.flight.state;
    const waits = mode === 'idle' || mode === 'ended';
    this.card.hidden = !waits;
    this.again.hidden = mode !== 'ended';
    this.words.hidden = mode !== 'idle';
    setText(this.begin, mode === 'idle' ? 'Fly' : replay ? 'Fly it yourself' : 'Fly again');
    setText(this.why, mode === 'ended' ? why : '');
    this.#refused(problem);
    this.bar.render();
  }

  /** Another controller flies. @param {import('./craft.js').Takeover} takeover */
  #takeover(takeover) {
    const before = this.#flown;
    this.#flown = this.#aboard;
    const parts = before && this.#flown ? changedParts(before, this.#flown) : [];
    const next = changeOf(takeover, parts);
    const goesOn =
      this.#change && parts.length && this.#change.step === this.store.step && near(this.#change.change, takeover);
    if (this.#change && goesOn) {
      this.#change.change = joined(this.#change.change, next);
    } else {
      const line = h('li');
      this.changes.prepend(line);
      while (this.changes.children.length > TOLD) this.changes.lastElementChild?.remove();
      this.#change = { change: next, step: this.store.step, line };
    }
    const { change, line } = this.#change;
    setText(line, changeWords(change));
    if (change.parts.length) this.instruments.mark(takeover.time, change.parts.join(', '), 'design');
  }

  /** What came after has not happened. @param {number} time */
  #cut(time) {
    this.#flown = this.#aboard;
    if (this.#change && this.#change.change.to >= time) this.#change = null;
  }

  /** The flight that the address names. */
  #linked() {
    const { place } = this.address;
    if (!place?.startsWith(PLACE) || place === this.#opened) return;
    this.#opened = place;
    this.share.fromLink(place).then((why) => why && this.#refused(why));
  }

  /** @param {State} state */
  render({ view, design, presets, task }) {
    this.tasks.render({ task });
    const seen = view === 'fly';
    if (seen !== this.#seen) this.#show(seen);
    if (!seen || !design || !presets.length) return;
    this.#linked();
    if (!this.flight.craft) this.#rest();
  }

  /** Where the rig stands before it flies. */
  #rest() {
    const { design } = this.store.state;
    if (!design) return;
    const { initial } = design.scenario;
    const [theta, psi] = [initial?.theta ?? design.theta0, initial?.psi ?? 0];
    const reference = { theta, psi }; // as it takes off (plan.js)
    this.feed.show({ theta, psi, V_p: 0, V_y: 0, thrust: [0, 0], reference }, this.#limits);
    this.instruments.rest(theta, psi, reference);
  }

  /** @param {boolean} seen */
  #show(seen) {
    this.#seen = seen;
    cancelAnimationFrame(this.#request);
    if (seen) {
      this.#shaped();
      this.#changed();
      this.#request = requestAnimationFrame(this.#tick);
    } else {
      this.flight.freeze();
      this.feed.leave();
      this.watched.leave();
    }
  }

  /** Asks once for the rigs' shapes; without them hands push by keys alone. */
  async #shaped() {
    if (Object.keys(this.#shapes).length > 0) return;
    const told = await getRigViews().catch(() => ({}));
    this.#shapes = /** @type {Record<string, import('./ray.js').Shape>} */ (told);
  }

  /** @param {number} now ms */
  #tick = (now) => {
    this.#request = requestAnimationFrame(this.#tick);
    this.hands.before(now);
    this.flight.frame(now);
    if (!this.bar.looks) this.instruments.look(null);
    this.instruments.horizon.asked(this.tasks.asks);
    this.instruments.render(now);
    const { craft } = this.flight;
    if (!craft) return;
    const { mode, speed, slow } = this.flight.state;
    this.bar.tick();
    if (this.bar.looks) return;
    const sample = sampleNow(craft);
    this.feed.show(sample, this.#limits);
    this.hands.after();
    this.watched.put(sample, craft.time, now, mode === 'flying' || mode === 'replaying' ? speed * slow : 0);
  };
}

/** Whether it goes on what came before. @param {{to: number}} change @param {{time: number}} next */
const near = ({ to }, { time }) => time >= to && time - to < TOGETHER;
