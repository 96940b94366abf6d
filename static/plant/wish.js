/**
 * What is wanted of a system, and how the server is asked for it. Pure.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {import('../contract.js').SystemRead} SystemRead
 * @typedef {{states: number[], inputs: number[], integrals?: number[]}} Weights
 * @typedef {{poles: Complex[], observer: Complex[]|null, method: string, weights: Weights|null,
 *   x0: number[]|null}} Wish  null: no observer; ones; 1 for the first state
 */
import { nameOf } from '../model/index.js';
import { proposal } from './poles.js';

/** @type {Wish} */
export const NO_WISH = { poles: [], observer: null, method: 'full-rank', weights: null, x0: null };

/** In few words. @param {{name: string, title?: string}} method */
export const methodName = ({ name, title }) => nameOf({ method: name, title });

/** @param {SystemRead} read */
export const sizesOf = ({ matrices: { A, B, C } }) => ({
  n: A.values.length,
  p: B.values[0].length,
  q: C ? C.values.length : 0,
});

/**
 * A wish for a system that has just been read: what fits it stays; what its text says goes first, unless it is opened
 * with a wish of its own.
 * @param {SystemRead} read @param {Wish} wish @param {boolean} opened
 * @returns {Wish}
 */
export function fitting(read, wish, opened) {
  const { n, p, q } = sizesOf(read);
  const own = (/** @type {Complex[]|null} */ poles) => (poles?.length === n ? poles : null);
  const [mine, asked] = [own(wish.poles), read.poles ?? null];
  const watching = opened && wish.poles.length ? null : (read.observer_poles ?? null);
  return {
    ...wish,
    poles: (opened ? (mine ?? asked) : (asked ?? mine)) ?? proposal(read.analysis.poles),
    observer: q ? (watching ?? own(wish.observer)) : null,
    weights: weightsFor(wish.weights, n, p, q),
    x0: wish.x0?.length === n ? wish.x0 : null,
  };
}

/** @param {Weights|null} weights @param {number} n @param {number} p @param {number} q @returns {Weights|null} */
function weightsFor(weights, n, p, q) {
  if (weights?.states.length !== n || weights.inputs.length !== p) return null;
  const { states, inputs, integrals } = weights;
  return integrals?.length === q ? weights : { states, inputs };
}

/** A system as calls take it. @param {SystemRead} read @param {Wish} wish @param {boolean} [exactly] */
export function bodyOf({ matrices }, { poles, method, observer, weights, x0 }, exactly = true) {
  const { A, B, C, D } = matrices;
  return /** @satisfies {import('../contract.js').SystemDesignRequest} */ ({
    A: A.values,
    B: B.values,
    ...(C && { C: C.values }),
    ...(D && { D: D.values }),
    poles,
    method: /** @type {import('../contract.js').SystemDesignRequest['method']} */ (method),
    exactly,
    ...(observer && { observer_poles: observer }),
    ...(weights && { weights }),
    ...(x0 && { x0 }),
  });
}
