/**
 * Renders a view only when something that it read last time has changed: most of the page stays as it is while one pole
 * moves. Pure.
 * @typedef {import('../types.js').State} State
 * @typedef {{render: (state: State) => void}} View
 */

/**
 * A view must read the state from what it is given, not from the store: only that is noted.
 * @param {View} view @returns {(state: State) => boolean} renders where needed and tells whether it did
 */
export function watched(view) {
  /** @type {Map<string|symbol, unknown>|null} */ let seen = null;
  /** @type {State|null} */ let last = null;
  return (state) => {
    if (state === last) return false;
    last = state;
    if (seen && [...seen].every(([name, value]) => state[/** @type {keyof State} */ (name)] === value)) return false;
    /** @type {Map<string|symbol, unknown>} */ const reads = new Map();
    seen = reads;
    view.render(
      new Proxy(state, {
        get(target, name) {
          const value = target[/** @type {keyof State} */ (name)];
          reads.set(name, value);
          return value;
        },
      }),
    );
    return true;
  };
}
