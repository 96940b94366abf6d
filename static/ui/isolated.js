/** One view that fails must not stop the others: it is told of once, and tried again with the next state. Pure. */

/**
 * @template {unknown[]} A
 * @param {(...args: A) => unknown} act @param {(error: unknown) => void} report called for the first failure alone
 * @returns {(...args: A) => unknown} undefined where it failed
 */
export function isolated(act, report) {
  let told = false;
  return (...args) => {
    try {
      return act(...args);
    } catch (error) {
      if (!told) report(error);
      told = true;
      return undefined;
    }
  };
}
