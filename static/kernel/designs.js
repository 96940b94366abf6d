/**
 * Many designs at once, computed in workers: maps, tracks and searches of the page say which numbers of a design
 * differ, and are told figures. Each of them has a lane: of what it asks the newest holds, and lanes take turns.
 *
 *     const lane = designs.lane();
 *     const measures = [{ name: 'disk_margin' }];
 *     lane.ask({ numbers, size, at: [AT.PI_GAINS], values: gains, measures }, (found) => …);
 *
 * Tasks are dealt out in parts of a few milliseconds, so that a newer one never waits for long; but not before the
 * older one has told something, since a hand that never rests is to be followed, too.
 * @typedef {import('./design_rows.js').Part} Part
 * @typedef {import('./design_rows.js').Values} Values
 * @typedef {Values & {done: number}} Found  done: so many of the first designs are known; what stands behind them may
 *   still change. Its arrays are filled further while the task goes on
 * @typedef {Part & {stops?: readonly number[], workers?: number}} Task  stops: numbers of designs at which it is told
 *   what is known, in between the last; workers: that take part, at most
 * @typedef {(found: Found|null) => void} Then  null: it cannot be computed here
 * @typedef {{module: WebAssembly.Module, id?: undefined, part?: undefined} | {id: number, part: Part,
 *   module?: undefined}} Sent
 * @typedef {{ready?: true, id?: number, found?: Values, ms?: number, problem?: string}} Told
 */

/** Of a part, ms. */
const PART_MS = 4;
/** Parts that a worker has at hand, so that it need not wait for the page between two. */
const AT_HAND = 2;
/** Designs in a part, at most. */
const LARGEST = 512;
/** Workers, at most; each has a compiled module and memory of its own. */
const MOST = 2;

/**
 * @param {WebAssembly.Module} module
 * @param {() => Worker} [open]
 * @param {number} [cores]
 * @returns {Promise<Designs>} rejects where there can be no such worker
 */
export async function loadDesigns(
  module,
  open = () => new Worker(new URL('./designs_worker.js', import.meta.url), { type: 'module' }),
  cores = navigator.hardwareConcurrency,
) {
  const workers = Array.from({ length: Math.max(1, Math.min(MOST, cores)) }, open);
  const ready = workers.map(
    (worker) =>
      new Promise((resolve, reject) => {
        worker.onmessage = ({ data: { problem } }) => (problem ? reject(new Error(problem)) : resolve(null));
        worker.onerror = (event) => {
          event.preventDefault(); // told by who asked
          reject(new Error(event.message || 'the worker could not be loaded'));
        };
        worker.postMessage(/** @type {Sent} */ ({ module }));
      }),
  );
  try {
    await Promise.all(ready);
  } catch (problem) {
    for (const worker of workers) worker.terminate();
    throw problem;
  }
  return new Designs(workers);
}

/** A task on its way: what was dealt out, and what came back. */
class Course {
  /** Of the first designs, those that were dealt out. */ dealt = 0;
  /** Of the first designs, those that are known. */ #known = 0;
  /** What is known beyond, by where it begins. @type {Map<number, number>} */ #beyond = new Map();

  /** @param {Task} task @param {Then} then */
  constructor(task, then) {
    this.task = task;
    this.then = then;
    this.count = task.at.length ? task.values.length / task.at.length : 1;
    this.stops = [...(task.stops ?? []).filter((n) => n > 0 && n < this.count), this.count];
    /** @type {Found} */
    this.found = {
      values: new Float64Array(this.count * task.measures.length),
      stable: new Uint8Array(this.count),
      abscissa: new Float64Array(this.count).fill(NaN),
      poles: new Float64Array(task.poles ? 2 * this.count * task.size : 0),
      done: 0,
    };
  }

  /** The next part. @param {number} most designs in it @returns {{from: number, part: Part}} */
  deal(most) {
    const from = this.dealt;
    const stop = this.stops.find((n) => n > from) ?? this.count;
    this.dealt = Math.min(stop, from + most);
    const { numbers, size, at, values, measures, rigs, unstable, poles } = this.task;
    const own = values.slice(from * at.length, this.dealt * at.length);
    return { from, part: { numbers, size, at, values: own, measures, rigs, unstable, poles } };
  }

  /** @param {number} from @param {Values} part @returns {boolean} whether there is something to tell */
  take(from, part) {
    const { found } = this;
    found.values.set(part.values, from * this.task.measures.length);
    found.stable.set(part.stable, from);
    found.abscissa.set(part.abscissa, from);
    if (this.task.poles) found.poles.set(part.poles, 2 * from * this.task.size);
    this.#beyond.set(from, from + part.stable.length);
    for (let to = this.#beyond.get(this.#known); to !== undefined; to = this.#beyond.get(to)) this.#known = to;
    const stop = this.stops.findLast((n) => n <= this.#known) ?? 0;
    const news = stop > found.done;
    found.done = Math.max(stop, found.done);
    return news;
  }

  get isOver() {
    return this.found.done === this.count;
  }
}

/** Of one who asks. */
export class Lane {
  /** @type {Course|null} */ course = null;
  /** @type {Course|null} */ #next = null;
  /** How long a design takes, ms. */ cost = 0.2;

  /** @param {Designs} designs */
  constructor(designs) {
    this.designs = designs;
  }

  /**
   * Asks for designs; what was asked before is told no further, but for its beginning where nothing of it was told.
   * @param {Task} task its arrays are not to be changed any more @param {Then} then
   */
  ask(task, then) {
    const course = new Course(task, then);
    if (this.course && !this.course.found.done) this.#next = course;
    else this.course = course;
    this.designs.deal();
  }

  /** Nobody waits any more. */
  forget() {
    this.course = this.#next = null;
  }

  /** What was told may make room for the newer task. @param {Course} course */
  told(course) {
    if (course !== this.course) return; // who was told has asked again, or forgotten
    if (this.#next) [this.course, this.#next] = [this.#next, null];
    else if (course.isOver) this.course = null;
  }

  /** The workers have failed. */
  fail() {
    const waiting = [this.course, this.#next];
    this.forget();
    for (const course of waiting) course?.then(null);
  }
}

export class Designs {
  #id = 0;
  /** @type {Set<Lane>} in the order of their turns */ #lanes = new Set();
  /** What each worker has at hand. @type {Map<Worker, Map<number, {lane: Lane, course: Course, from: number}>>} */
  #hands;

  /** @param {Worker[]} workers which are ready */
  constructor(workers) {
    this.#hands = new Map(workers.map((worker) => [worker, new Map()]));
    for (const worker of workers) {
      worker.onmessage = ({ data }) => this.#hear(worker, data);
      worker.onerror = (event) => {
        event.preventDefault();
        this.#fail(event.message);
      };
    }
  }

  /** Whether anything is computed here; once a worker has failed, none is asked again. */
  get works() {
    return this.#hands.size > 0;
  }

  /** For one who asks. */
  lane() {
    const lane = new Lane(this);
    this.#lanes.add(lane);
    return lane;
  }

  /** Gives idle workers something to do. */
  deal() {
    if (!this.works) for (const lane of this.#lanes) lane.fail();
    for (let depth = 1; depth <= AT_HAND; depth++)
      for (const [worker, hand] of this.#hands) while (hand.size < depth && this.#give(worker, hand));
  }

  /** @param {Worker} worker @param {Map<number, {lane: Lane, course: Course, from: number}>} hand */
  #give(worker, hand) {
    for (const lane of this.#lanes) {
      const { course } = lane;
      if (!course || course.dealt === course.count || !this.#mayJoin(worker, course)) continue;
      const share = Math.ceil(course.stops[0] / this.#hands.size); // the first picture is everybody's
      const most = Math.max(1, Math.min(LARGEST, share, Math.round(PART_MS / lane.cost)));
      const { from, part } = course.deal(most);
      hand.set(++this.#id, { lane, course, from });
      worker.postMessage(/** @type {Sent} */ ({ id: this.#id, part }));
      this.#lanes.delete(lane); // the others' turn
      this.#lanes.add(lane);
      return true;
    }
    return false;
  }

  /** @param {Worker} worker @param {Course} course */
  #mayJoin(worker, course) {
    const { workers: most = Infinity } = course.task;
    const busy = [...this.#hands].filter(
      ([other, hand]) => other !== worker && [...hand.values()].some((own) => own.course === course),
    );
    return busy.length < most;
  }

  /** @param {Worker} worker @param {Told} told */
  #hear(worker, { id = 0, found, ms = 0, problem }) {
    if (problem) return this.#fail(problem);
    const hand = this.#hands.get(worker);
    const own = hand?.get(id);
    if (!hand || !own || !found) return;
    hand.delete(id);
    const { lane, course, from } = own;
    lane.cost = Math.max(1e-3, ms / found.stable.length);
    const news = course.take(from, found) && lane.course === course;
    if (news) lane.told(course); // before who is told asks again
    this.deal();
    if (news) course.then(course.found);
  }

  /** @param {string} message */
  #fail(message) {
    console.warn(message);
    for (const worker of this.#hands.keys()) worker.terminate();
    this.#hands.clear();
    for (const lane of this.#lanes) lane.fail();
  }
}
