/**
 * Where a map's values come from: the page's workers where its kernel serves, else the server. While something moves a
 * coarse map by one worker, so that the hand has a core for itself; when it rests the whole one by all.
 * @typedef {import('./types.d.ts').Asked} Asked
 * @typedef {import('./types.d.ts').Field} Field
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {{design: Design, preset: Preset, asked: Asked, spread: number}} Wanted
 * @typedef {ReturnType<typeof setTimeout>} Timer
 * @typedef {{busy: () => boolean, now: () => number, later: (act: () => void, ms: number) => Timer,
 *   cancel: (timer?: Timer) => void}} Hand
 * @typedef {import('./told.js').Told} Told
 */
import { AT, fill, serves, sizeOf, spreadsOf } from '../kernel/index.js';
import { ProblemError } from '../net/index.js';
import { messageOf } from '../text/index.js';
import { COLUMNS, fieldOf, refined, ROWS } from './grid.js';

/** So long after its last move the hand rests, ms. */
const REST_MS = 150;
/**
 * From one map to the next while something moves, ms: the valley is seen to move, and the hand has what it needs. More
 * where maps take long, so that a worker is busy for no more than half of the time and the page for a tenth.
 */
const [PACE_MS, SLOWEST_MS] = [60, 500];
const [OF_WORKER, OF_PAGE] = [2, 10];
/** From coarse to fine: of the plane; of smaller fields; of responses on many rigs each. */
const [PLANE, FIELD, RIGS_OF_EACH] = [
  [COLUMNS, ROWS],
  [65, 49],
  [33, 25],
].map(([columns, rows]) => ({
  columns,
  rows,
  ...refined(columns, rows, columns > 65 ? [8, 4, 2, 1] : columns > 33 ? [4, 2, 1] : [2, 1]),
}));
const RIGS = 40;
/** @type {Told} */ const QUIET = { computing: false, refused: '' };
/** @type {Told} */ const COMPUTING = { computing: true, refused: '' };
/** Coarser: the server computes for others, too, and its other methods take a hundred times as long. */
const OF_SERVER = /** @type {[number, number][]} */ ([
  [17, 13],
  [33, 25],
]);

/** @param {import('./types.d.ts').Span} span @param {number} share */
export const placeIn = ({ from, to, log }, share) => (log ? from * (to / from) ** share : from + share * (to - from));

/** @param {import('./types.d.ts').Span} span @param {number} v */
export const shareIn = ({ from, to, log }, v) =>
  log ? Math.log(v / from) / Math.log(to / from) : (v - from) / (to - from);

/**
 * Where the designs of a map differ in the kernel's numbers, and by what, in the order of its nodes.
 * @param {Asked} asked @param {{columns: number, rows: number}} size @param {Uint16Array} order
 */
export function changesOf({ move, real, domain }, { columns, rows }, order) {
  const own = move.startsWith('yaw') ? 1 : 0;
  const pair = move.endsWith('-pair');
  const at = pair ? [0, 1, 2, 3].map((k) => AT.POLES + 4 * own + k) : [0, 1].map((k) => AT.PI_GAINS + 2 * own + k);
  const values = new Float64Array(order.length * at.length);
  for (const [k, node] of order.entries()) {
    const x = placeIn(domain.x, (node % columns) / (columns - 1));
    const y = placeIn(domain.y, Math.floor(node / columns) / (rows - 1));
    values.set(!pair ? [x, y] : real ? [x, 0, y, 0] : [x, y, x, -y], k * at.length);
  }
  return { at, values };
}

/**
 * All but what the map moves: another place of the same pair is on the same map.
 * @param {Design} design @param {Asked} asked
 */
export function besides(design, { move }) {
  const own = move.startsWith('yaw') ? 1 : 0;
  if (move.endsWith('-pair')) return { ...design, poles: design.poles.filter((_, i) => i >> 1 !== own) };
  return { ...design, loops: { ...design.loops, [own ? 'yaw' : 'pitch']: null } };
}

export class MapFeed {
  #key = '';
  /** When something changed, and when it was asked for. */ #changed = -Infinity;
  #asked = -Infinity;
  #pace = PACE_MS;
  #ready = false;
  /** Whether a finer map of the same is to come. */ #coarse = false;
  /** @type {Wanted|null} */ #wanted = null;
  /** @type {import('../kernel/designs.js').Lane|null} */ #lane = null;
  /** @type {Timer|undefined} */ #rest;
  /** @type {Timer|undefined} */ #next;

  /**
   * @param {(field: Field|null, asked: Asked|null) => void} show  null: nothing is known
   * @param {(wanted: Wanted, size: [number, number]) => Promise<Field>} askServer
   * @param {Hand} hand
   * @param {boolean} [fine]  whether its picture is large
   * @param {(told: Told) => void} [tell]  what the server does; while it computes, what is shown is of what was before
   */
  constructor(show, askServer, hand, fine = false, tell = () => {}) {
    this.tell = tell;
    this.fine = fine;
    this.show = show;
    this.askServer = askServer;
    this.hand = hand;
  }

  /**
   * What computes; until then nothing does.
   * @param {import('../kernel/index.js').Designs|null} designs  null: the server alone
   */
  take(designs) {
    this.#lane = designs && designs.lane();
    this.#ready = true;
    this.#key = '';
  }

  /** @param {Wanted|null} asked */
  render(asked) {
    const wanted = this.#ready ? asked : null;
    const key = wanted ? JSON.stringify([wanted.asked, wanted.spread, besides(wanted.design, wanted.asked)]) : '';
    if (key === this.#key) return;
    const first = !this.#wanted || !wanted || this.#wanted.asked.measure.name !== wanted.asked.measure.name;
    this.#key = key;
    this.#wanted = wanted;
    this.hand.cancel(this.#rest);
    if (!wanted) {
      this.#lane?.forget();
      this.show(null, null);
      this.tell(QUIET);
      return;
    }
    if (first) this.show(null, null); // what is there says something else
    this.tell(this.#isServed ? QUIET : COMPUTING);
    const now = this.hand.now();
    const moving = this.hand.busy() || now - this.#changed < REST_MS;
    this.#changed = now;
    if (!moving) return this.#ask(false);
    this.#rest = this.hand.later(() => this.#ask(false), REST_MS);
    const wait = this.#asked + this.#pace - now;
    if (wait <= 0) this.#ask(true);
    else this.#next ??= this.hand.later(() => this.#ask(true), wait);
    return undefined;
  }

  /** Asks for the same once more. */
  again() {
    if (!this.#wanted) return;
    this.#key = '';
    this.render(this.#wanted);
  }

  /** Whether the page's own workers compute what is wanted. */
  get #isServed() {
    return Boolean(this.#wanted && this.#lane?.designs.works && serves(this.#wanted.design, this.#wanted.preset));
  }

  /** @param {boolean} moving */
  #ask(moving) {
    this.hand.cancel(this.#next);
    this.#next = undefined;
    if (!this.#wanted) return;
    this.#asked = this.hand.now();
    this.#coarse = moving;
    if (this.#isServed) this.#compute(moving);
    else if (!moving) this.#fromServer();
  }

  /** @param {boolean} moving */
  #compute(moving) {
    const { design, preset, asked, spread } = /** @type {Wanted} */ (this.#wanted);
    const numbers = new Float64Array(AT.NUMBERS);
    fill(numbers, design, preset);
    const ofRigs = asked.measure.name === 'share_within_limits';
    const how = ofRigs ? RIGS_OF_EACH : this.fine ? PLANE : FIELD;
    const count = moving ? how.stops[ofRigs ? 0 : 1] : how.order.length;
    const measures = [asked.measure, ...asked.limits.map(({ measure }) => measure)];
    const task = {
      ...changesOf(asked, how, how.order.subarray(0, count)),
      numbers,
      size: sizeOf(design, preset),
      measures,
      rigs: ofRigs ? { count: RIGS, spreads: spreadsOf(design, preset, spread) } : undefined,
      stops: moving ? how.stops.slice(1) : how.stops,
      workers: moving ? 1 : undefined,
    };
    const key = this.#key;
    this.#lane?.ask(task, (found) => {
      if (key !== this.#key && !found) return;
      const field = found && fieldOf(how, how, found, measures.length);
      if (field && moving) this.#showAtPace({ ...field, domain: asked.domain }, asked);
      else if (field) this.show({ ...field, domain: asked.domain }, asked);
      else if (!this.#coarse) this.#fromServer();
    });
  }

  /** @param {Field} field @param {Asked} asked */
  #showAtPace(field, asked) {
    const begin = this.hand.now();
    this.show(field, asked);
    const own = this.hand.now() - begin;
    this.#pace = Math.min(
      SLOWEST_MS,
      Math.max(this.fine ? PACE_MS : 2 * PACE_MS, OF_WORKER * (begin - this.#asked), OF_PAGE * own),
    );
  }

  async #fromServer() {
    const [key, wanted] = [this.#key, this.#wanted];
    this.#lane?.forget();
    this.tell(COMPUTING);
    for (const size of OF_SERVER) {
      if (key !== this.#key || !wanted) return;
      let [away, refused] = [false, ''];
      const field = await this.askServer(wanted, size).catch((error) => {
        away = !(error instanceof ProblemError) || error.problem.status === 503;
        refused = messageOf(error);
        return null;
      });
      if (key !== this.#key) return;
      if (away) this.#key = ''; // it is asked for again: with the next change, or once the server is back
      if (!field && size !== OF_SERVER[0]) return; // what is there is coarse, and right
      this.show(field, field && wanted.asked);
      this.tell({ computing: false, refused });
      if (!field) return;
    }
  }
}
