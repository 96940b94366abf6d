/**
 * A flight on the page: a craft, its clock, and what has been recorded of it. It flies by animation frames, and tells
 * what it does by events:
 *
 *     change    its `state` is another
 *     frame     {rows, count, step, firstTick, time}: rows (ROW) that were flown just now, of ticks `step` s long
 *     takeover  a Takeover: another controller flies
 *     did       {tick, time, word, values}: something happened; it stands in the log
 *     cut       {tick, time}: it was rewound to there
 *     start, end
 *
 * @typedef {'idle'|'flying'|'frozen'|'replaying'|'ended'} Mode
 * @typedef {import('./craft.js').LogEvent} LogEvent
 * @typedef {import('./designs.js').Aboard} Aboard
 * @typedef {import('./designs.js').Body} Body
 * @typedef {import('./log.js').FlightLog} FlightLog
 * @typedef {import('./plan.js').Planned} Planned
 * @typedef {import('../types.js').Design} Design
 *
 * @typedef {object} FlightState
 * @property {Mode} mode
 * @property {number} time  s
 * @property {number} speed  share of the wall's that is asked for: 1 … 0.1
 * @property {number} slow  share of that which is reached; 1: all
 * @property {boolean} hands  whether the sticks are the motors' voltages
 * @property {boolean} past  whether it can be taken back
 * @property {string} why  it has ended, in words
 * @property {string} problem  why the newest design does not fly, in words; the one before flies on
 * @property {boolean} replay  whether it is the flight of a log that is shown
 * @property {number} apart  of a log that was flown to its end: how far its own states are, rad and rad/s
 * @property {string} task
 * @property {number} seed
 */
import { LOG, ROW } from '../kernel/index.js';
import { t } from '../text/index.js';
import { Clock } from './clock.js';
import { Course } from './course.js';
import { Craft } from './craft.js';
import { bodyOfFlight, Designs } from './designs.js';
import { DESIGN } from './events.js';
import { Follower } from './follow.js';
import { History } from './history.js';
import { logOf, readLog, scriptOf } from './log.js';
import { Plan } from './plan.js';

const { FLIGHT_ROW } = ROW;
/** Longest flight, s. */
export const LONGEST = 600;
/** Work of one frame, ms: where it takes longer, time slows. Ticks between two looks at that, and their work. */
const [BUDGET_MS, BATCH, LOOK_MS] = [12, 256, 4];
const SLOWEST = 0.1;

export class Flight extends EventTarget {
  /** null while idle. @type {Craft|null} */ craft = null;
  /** @type {Mode} */ #mode = 'idle';
  #clock = new Clock();
  #course = new Course();
  /** @type {History|null} */ #history = null;
  /** @type {import('./log.js').Script|null} */ #script = null;
  #plan = new Plan();
  /** With which it began. @type {Body|null} */ #body = null;
  #task = '';
  #why = '';
  #problem = '';
  #batch = BATCH;
  #apart = 0;
  /** Counts what was asked for: an answer that comes too late is dropped. */ #asked = 0;
  /** @type {Follower|null} */ #follower = null;
  /** Counts what ends a frame's flying: who hears of it may freeze it. */ #turn = 0;

  /**
   * @param {import('../model/store.js').Store} store  whose design flies
   * @param {import('../kernel/index.js').Flights} flights
   * @param {{ask?: import('./designs.js').Ask, now?: () => number}} [how]  ask: the server for a design's numbers
   */
  constructor(store, flights, { ask, now = () => performance.now() } = {}) {
    super();
    this.store = store;
    this.designs = new Designs(flights, () => store.state.presets, ask);
    this.now = now;
    store.addEventListener('design', () => this.#edited());
  }

  /** @returns {FlightState} */
  get state() {
    return {
      ...{ mode: this.#mode, time: this.craft?.time ?? 0, speed: this.#clock.speed, slow: this.#clock.slow },
      ...{ hands: this.craft?.hands ?? false, past: this.#ownRig, why: this.#why },
      ...{ problem: this.#problem, replay: this.#script !== null, apart: this.#apart },
      ...{ task: this.#task, seed: this.craft?.seed ?? 0 },
    };
  }

  /** @param {string} type @param {unknown} [detail] */
  #tell(type, detail) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }

  /** @param {Mode} mode @param {string} [why] */
  #become(mode, why = '') {
    const before = this.#mode;
    [this.#mode, this.#why] = [mode, why];
    this.#clock.hold();
    this.#turn += 1;
    if (mode === 'ended' && before !== 'ended') this.#tell('end', { why });
    this.#tell('change');
  }

  /**
   * The page's design takes off, at rest where its experiment begins.
   * @param {{task?: string, seed?: number, plan?: Planned[], design?: Design|null}} [how]  plan: what a task has in
   *   store; design: with which it begins instead of the page's, whose changes it follows
   * @returns {Promise<boolean>} whether it flies: at once where the page's kernel knows the design
   */
  async start({ task = '', seed = Math.floor(Math.random() * 2 ** 32), plan = [], design } = {}) {
    const before = this.store.state.design;
    const first = design ?? before;
    if (!first) return false;
    const asked = ++this.#asked;
    const body = bodyOfFlight(first, this.designs.presets());
    const own = this.designs.here(body) ?? (await this.designs.of(body));
    if (asked !== this.#asked) return false;
    this.#begin(new Craft(this.designs.flights, own, seed), body, task);
    this.#plan = new Plan(plan);
    this.#become('flying');
    this.#tell('start', { task, seed });
    if (this.store.state.design !== before) this.#edited();
    return true;
  }

  /** @param {Craft} craft @param {Body} body @param {string} task */
  #begin(craft, body, task) {
    this.craft = craft;
    this.#follower?.forget(); // what it waits for is none of this flight's
    [this.#body, this.#task, this.#script, this.#plan] = [body, task, null, new Plan()];
    [this.#course, this.#history] = [new Course(), new History(craft)];
    this.#follower = new Follower(this.designs, body);
    [this.#problem, this.#apart] = ['', 0];
  }

  freeze() {
    if (this.#mode === 'flying' || this.#mode === 'replaying') this.#become('frozen');
  }

  go() {
    if (this.#mode === 'frozen') this.#become(this.#script ? 'replaying' : 'flying');
  }

  toggle() {
    if (this.#mode === 'frozen') this.go();
    else this.freeze();
  }

  /** So many ticks, one sample of the controller by default; it is frozen then. @param {number} [ticks] */
  step(ticks = this.craft?.ticksPerSample ?? 1) {
    if (!this.craft || !this.#isOn) return;
    this.freeze();
    const end = this.craft.tick + ticks;
    this.#advance((craft) => end - craft.tick, Infinity);
    this.#tell('change');
  }

  /** The page is out of sight: time goes on from where it is, with the next frame. */
  hold() {
    this.#clock.hold();
  }

  /** Slow motion. @param {number} speed  share of the wall's: 1 … 0.1 */
  setSpeed(speed) {
    this.#clock.speed = Math.min(Math.max(speed, SLOWEST), 1);
    this.#clock.hold();
    this.#tell('change');
  }

  /** @param {string} [why]  in words */
  end(why = '') {
    this.#asked += 1;
    this.#follower?.forget();
    if (this.craft && this.#mode !== 'ended') this.#become('ended', why);
  }

  /** Whether something can be done to it. */
  get #isOn() {
    return this.#mode !== 'idle' && this.#mode !== 'ended';
  }

  /**
   * Something happens now: a word of the log (kernel's WORDS), angles in rad, V, N·m.
   * @param {string} word @param {...number} values
   * @returns {boolean} whether it does: only while it flies, or is frozen
   */
  do(word, ...values) {
    if (!this.craft || !this.#isOn || this.#script) return false;
    if (this.craft.events.length >= LOG.MOST_EVENTS) {
      this.end(t('More has happened than a flight can keep.'));
      return false;
    }
    this.craft.do(word, ...values);
    this.#told(this.craft.events.slice(-1));
    if (word === 'hands') this.#tell('change');
    return true;
  }

  /** @param {LogEvent[]} events that were done */
  #told(events) {
    for (const [tick, word, ...values] of events) this.#tell('did', { tick, time: this.craft?.time, word, values });
  }

  /** Whether the page's rig is the one that flies. */
  get #ownRig() {
    const { design, presets } = this.store.state;
    return this.craft !== null && design?.preset === (this.#body?.preset ?? presets[0]?.name);
  }

  /** The page's design is another. */
  #edited() {
    if (!this.#isOn) return;
    if (!this.#ownRig) this.end(t('Another rig was chosen.'));
    else if (!this.#script) this.#follower?.edited(this.store.state.design);
  }

  /** The newest design flies on. */
  #redesign() {
    if (!this.craft || this.#script) return;
    this.#follower?.next(
      this.#mode === 'flying' ? this.craft.time : Infinity,
      (next) => this.#isOn && this.#change(next),
      ({ message }) => this.#judged(message),
    );
  }

  /** @param {string} problem  of the newest design */
  #judged(problem) {
    if (problem === this.#problem) return;
    this.#problem = problem;
    this.#tell('change');
  }

  /** @param {Aboard} next */
  #change(next) {
    const { craft } = this;
    if (!craft) return;
    const { length } = craft.events;
    if (length >= LOG.MOST_DESIGNS && craft.events.filter(([, word]) => word === DESIGN).length >= LOG.MOST_DESIGNS)
      return this.end(t('More has happened than a flight can keep.'));
    craft.change(next);
    this.#told(craft.events.slice(-1));
    this.#judged('');
  }

  /** Once in an animation frame. @param {number} now  its time, ms */
  frame(now) {
    const { craft } = this;
    if (!craft || (this.#mode !== 'flying' && this.#mode !== 'replaying')) return;
    const before = craft.time;
    const due = this.#clock.due(now, before);
    const whole = this.#advance((own) => Math.round((due - own.time) / own.step), BUDGET_MS);
    if (!whole) this.#clock.anchor(now, craft.time);
    const share = whole || due <= before ? 1 : (craft.time - before) / (due - before);
    if (this.#clock.paced(share)) this.#tell('change');
  }

  /**
   * Flies on, from event to event.
   * @param {(craft: Craft) => number} left  ticks that are still due
   * @param {number} budget  ms
   * @returns {boolean} false: there was no time for all
   */
  #advance(left, budget) {
    const begin = this.now();
    this.#redesign();
    for (const turn = this.#turn; this.craft && this.#isOn && turn === this.#turn;) {
      const { craft } = this;
      if (this.#script || left(craft) > 0) this.#act(craft); // a task at a tick that is flown at once
      if (turn !== this.#turn) break;
      const next = this.#until(craft);
      let ticks = Math.min(left(craft), next - craft.tick, this.#batch);
      if (!(ticks > 0)) {
        if (next <= craft.tick) this.#over(craft);
        return true;
      }
      const now = this.now();
      if (now - begin > budget) return false;
      const known = craft.takeovers.length;
      if (craft.waiting) ticks = this.#settled(craft, left);
      const [tick, time, step] = [craft.tick, craft.time, craft.step];
      const rows = craft.fly(ticks).slice(); // those who hear of it may fly others
      if (this.now() - now > LOOK_MS) this.#batch = Math.max(this.#batch >> 1, 1);
      else if (ticks === this.#batch) this.#batch = Math.min(2 * ticks, BATCH);
      this.#recorded(craft, rows, { step, firstTick: tick, time }, known);
      if (craft.ended && turn === this.#turn) this.end(craft.ended);
    }
    return true;
  }

  /**
   * What waits takes over; ticks may be of another length then, and what comes next at another.
   * @param {Craft} craft @param {(craft: Craft) => number} left
   */
  #settled(craft, left) {
    craft.settle(); // and a tick at least is flown before anybody hears of it
    const ticks = Math.max(Math.min(left(craft), this.#until(craft) - craft.tick, this.#batch), 1);
    return craft.waiting ? Math.min(ticks, craft.untilSample) : ticks;
  }

  /**
   * @param {Craft} craft @param {Float64Array} rows @param {{step: number, firstTick: number, time: number}} of
   * @param {number} known  takeovers before
   */
  #recorded(craft, rows, of, known) {
    this.#course.put(rows, of.step, of.firstTick, of.time);
    this.#history?.flown(craft);
    for (const own of craft.takeovers.slice(known)) this.#tell('takeover', own);
    this.#tell('frame', { rows, count: rows.length / FLIGHT_ROW, ...of });
  }

  /** What a log or a task says of this tick. @param {Craft} craft */
  #act(craft) {
    if (this.#script) this.#told(this.#script.act(craft));
    else for (let next; (next = this.#plan.take(craft));) this.do(...next);
  }

  /** The tick to which nothing happens. @param {Craft} craft */
  #until(craft) {
    if (this.#script) return this.#script.until(craft);
    const last = craft.tick + Math.max(Math.round((LONGEST - craft.time) / craft.step), 0);
    return Math.min(last, this.#plan.until(craft), LOG.MOST_TICKS);
  }

  /** Nothing is left to fly. @param {Craft} craft */
  #over(craft) {
    if (!this.#script) return this.end(t('A flight lasts ten minutes at most.'));
    this.#apart = this.#script.apart(craft);
    const same = this.#apart <= LOG.AGREED;
    return this.end(
      same ? t('This was the whole flight.') : t('This was the whole flight, but not as its log has it.'),
    );
  }

  /**
   * Back in time; what came after has not happened, but in the flight of a log. One that has ended is frozen there.
   * @param {number} seconds
   */
  rewind(seconds) {
    const { craft } = this;
    if (!craft || !this.#history || !this.#ownRig) return;
    this.#history.back(craft, Math.max(craft.time - seconds, 0), this.designs);
    const { tick, time } = craft;
    this.#plan.cut(tick);
    this.#course.cut(tick);
    this.#follower?.flies(craft.next.body, this.store.state.design); // though an older one did then
    this.#tell('cut', { tick, time });
    this.#become(this.#mode === 'ended' ? 'frozen' : this.#mode);
  }

  /**
   * Shows the flight of a log.
   * @param {FlightLog|string} log  JSON, or its text
   * @param {() => void} [begins]  right before it does
   * @returns {Promise<boolean>} whether it is shown; throws a LogError where it is none, or was changed
   */
  async replay(log, begins = () => {}) {
    const own = readLog(log);
    const asked = ++this.#asked;
    const script = await scriptOf(own, this.designs);
    if (asked !== this.#asked) return false;
    begins();
    this.#begin(script.begun(), own.design, own.task);
    this.#script = script;
    this.#become('replaying');
    this.#tell('start', { task: own.task, seed: own.seed });
    return true;
  }

  /** Null before its first tick. @returns {FlightLog|null} */
  log() {
    if (this.#script) return this.#script.log;
    return this.craft && this.#body && logOf(this.craft, this.#body, this.#task);
  }

  /** What was flown last. @param {number} seconds  60 at most @returns {import('./course.js').Rows} copies */
  lastRows(seconds) {
    return this.#course.last(seconds);
  }
}
