/**
 * How long to wait before a lost connection is tried again: ever longer, and for each page a little different, so that
 * a class does not come back at one moment. Pure.
 * @param {number} attempt from 0 @param {number} first @param {number} longest ms
 */
export const backoff = (attempt, first, longest) =>
  Math.min(longest, first * 2 ** attempt) * (0.75 + Math.random() / 2);
