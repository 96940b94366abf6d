/**
 * Many rigs under one controller by the kernel `run_rigs`, part by part: first the poles of all, which are quick, then
 * responses, the first rigs' before all others'. Pure.
 * @typedef {import('./module.js').Kernels} Kernels
 * @typedef {Record<string, Block>} Arrays  by the kernel's names
 * @typedef {object} Task
 * @property {Float64Array} numbers  of the nominal design, as numbers.js fills them
 * @property {number} size  states of its loop
 * @property {ArrayLike<number>} spreads  half widths, in the order of the kernel's factors
 * @property {number} rigs
 * @property {Float64Array} [drawn]  by which they differ, in the kernel's order; else drawn here
 * @typedef {import('../types.js').Cloud} Cloud
 */
import { AT, FACTORS, FIGURES, OUTCOMES, RIGS } from './layout.js';
import { Block } from './module.js';
import { bandsOf } from './percentiles.js';
import { fillFactors } from './random.js';
import { many } from './shapes.js';
import { arrays, Updates } from './updates.js';

/** Rigs whose responses are shown first. */
export const FEW = 200;
/** Of a part, ms: so long a newer design may have to wait. */
const PART_MS = 8;
/** Of responses, ms, after which fewer than that are shown. */
const SOON_MS = 40;
const SAMPLES = 2; // the nominal rig's own response is not asked for

export class ManyRigs {
  #updates;
  /** @type {Map<string, {factors: Block, poles: Arrays, whole: Arrays}>} */ #ready = new Map();
  /** How long a rig takes, ms, by what of it is computed. @type {WeakMap<Arrays, number>} */ #costs = new WeakMap();

  /** @param {Kernels} kernels @param {() => number} [now] */
  constructor(kernels, now = () => performance.now()) {
    this.kernels = kernels;
    this.now = now;
    this.#updates = new Updates(kernels);
  }

  /**
   * The cloud; who stops asking stops the work.
   * @param {Task} task
   * @returns {Generator<Cloud|null>} null after a part that tells nothing new; none at all where the kernel does not
   *   find the nominal design
   */
  *cloud({ numbers, size, spreads, rigs, drawn }) {
    this.#updates.numbers.set(numbers);
    this.#updates.numbers[AT.EACH_AXIS] = 0;
    const { outcome, figures } = this.#updates.update(size, SAMPLES);
    if (outcome[0] !== OUTCOMES.DONE) return;
    const order = figures[FIGURES.CONNECTED];
    const { factors, poles, whole } = this.#roomFor(size, rigs);
    if (drawn) factors.floats.set(drawn);
    else fillFactors(factors.floats, spreads, RIGS.LEAST);
    whole.times.floats.set(timesOf(numbers[AT.DURATION]));
    yield* this.#run(poles, size, 0, rigs);
    const first = yield* this.#run(whole, size, 0, Math.min(FEW, rigs), this.now() + SOON_MS);
    yield cloudOf(poles, whole, size, order, first);
    if (first === rigs) return;
    yield* this.#run(whole, size, first, rigs);
    yield cloudOf(poles, whole, size, order, rigs);
  }

  /**
   * Rigs from one to another; stops at least one rig later where it is late.
   * @param {Arrays} own @param {number} size @param {number} from @param {number} to @param {number} [late]
   * @returns {Generator<null, number>} returns how far it came
   */
  *#run(own, size, from, to, late = Infinity) {
    const room = { ...this.#updates.values(size, SAMPLES), ...own };
    for (let at = from; at < to;) {
      const cost = this.#costs.get(own) ?? 0.1;
      const end = Math.min(to, at + Math.max(1, Math.floor(PART_MS / cost)));
      const part = Object.fromEntries(BY_RIG.map((name) => [name, rows(own[name], at, end)]));
      const begin = this.now();
      this.kernels.bound('run_rigs', { ...room, ...part, rtol: RIGS.RTOL })();
      this.#costs.set(own, Math.max((this.now() - begin) / (end - at), 1e-4));
      at = end;
      if (this.now() > late) return at;
      if (at < to) yield null;
    }
    return to;
  }

  /** @param {number} size @param {number} rigs */
  #roomFor(size, rigs) {
    const key = `${size} ${rigs}`;
    const made = this.#ready.get(key) ?? this.#made(size, rigs);
    this.#ready.set(key, made);
    return made;
  }

  /** @param {number} size @param {number} rigs */
  #made(size, rigs) {
    const factors = this.kernels.array('f64', rigs, FACTORS);
    const of = (/** @type {number} */ times) =>
      /** @type {Arrays} */ ({ ...Object.fromEntries(arrays(this.kernels, many(size, rigs, times))), factors });
    return { factors, poles: of(1), whole: of(RIGS.TIMES) }; // over one time nothing is integrated
  }
}

/** What has a row for each rig. */
const BY_RIG = ['factors', 'rig_poles', 'angles', 'stable', 'within'];

/** @param {Block} block @param {number} from @param {number} to */
function rows({ memory, at, type, shape: [all, ...others], items }, from, to) {
  const bytes = (type === 'c128' ? 16 : 8) * (items / all);
  return new Block(memory, at + from * bytes, type, [to - from, ...others]);
}

/** @param {number} duration */
const timesOf = (duration) => Float64Array.from({ length: RIGS.TIMES }, (_, k) => (duration * k) / (RIGS.TIMES - 1));

/** @param {Float64Array} verdicts @param {number} rigs */
const share = (verdicts, rigs) => verdicts.subarray(0, rigs).reduce((sum, v) => sum + v, 0) / rigs;

/**
 * What is known of them, in memory of its own.
 * @param {Arrays} poles @param {Arrays} whole @param {number} size @param {number} order
 * @param {number} judged  how many responses there are
 * @returns {Cloud}
 */
function cloudOf({ rig_poles, stable }, { times, angles, within }, size, order, judged) {
  const done = stable.items;
  const all = rig_poles.floats;
  const kept = new Float64Array(2 * order * done);
  for (let i = 0; i < done; i++) kept.set(all.subarray(2 * size * i, 2 * (size * i + order)), 2 * order * i);
  const bands = bandsOf(angles.floats, judged, times.items, RIGS.PERCENTILES);
  return {
    done,
    judged,
    poles: kept,
    t: bands ? times.floats.slice() : new Float64Array(),
    envelopes: { theta: bands?.[0] ?? [], psi: bands?.[1] ?? [] },
    share_stable: share(stable.floats, done),
    share_within_limits: share(within.floats, judged),
  };
}
