/** Patience with a server that is busy: what was handed in counts once it is answered, however late. */
import { t } from '../text/index.js';

const PATIENCE_MS = 30_000;

/**
 * An answer, or after a while an error that says so.
 * @template T
 * @param {Promise<T>} answer
 * @returns {Promise<T>}
 */
export function soon(answer) {
  /** @type {ReturnType<typeof setTimeout>|undefined} */ let timer;
  /** @type {Promise<never>} */
  const late = new Promise((_, refuse) => {
    const words = t('The server is busy and has not answered yet. What you handed in counts once it has: try again.');
    timer = setTimeout(() => refuse(new Error(words)), PATIENCE_MS);
  });
  return Promise.race([answer, late]).finally(() => clearTimeout(timer));
}
