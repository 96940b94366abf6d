/**
 * Random numbers by their place, not by their turn: a counter, mixed by the finalizer of MurmurHash3 (A. Appleby). What
 * is drawn never depends on what was drawn before, so that the same rigs stand under every design: while
 * a hand moves, each dot of a cloud moves with it, and none jumps. Pure.
 */

/** Odd, and far from any pattern: 2³² over the golden ratio, so that neighbours in counting begin far apart. */
const STEP = 0x9e3779b9;

/** Each bit of what comes depends on all of what goes in, and no two inputs have one output. @param {number} x */
export function mixed(x) {
  let h = x ^ (x >>> 16);
  h = Math.imul(h, 0x85ebca6b);
  h ^= h >>> 13;
  h = Math.imul(h, 0xc2b2ae35);
  return (h ^ (h >>> 16)) >>> 0;
}

/**
 * Uniform between −1 and 1, both excluded.
 * @param {number} index  which of its stream @param {number} stream  each is independent of all others
 */
export const uniform = (index, stream) =>
  (2 * mixed(Math.imul(index + 1, STEP) + mixed(Math.imul(stream + 1, STEP))) + 1) / 2 ** 32 - 1;

/**
 * By which rigs differ from the nominal one.
 * @param {Float64Array} factors  to be filled, row by row a rig
 * @param {ArrayLike<number>} spreads  half widths, a column each @param {number} least  share that a parameter keeps
 */
export function fillFactors(factors, spreads, least) {
  const columns = spreads.length;
  for (let i = 0; i < factors.length; i++) {
    const column = i % columns;
    factors[i] = Math.max(1 + spreads[column] * uniform((i - column) / columns, column), least);
  }
}
