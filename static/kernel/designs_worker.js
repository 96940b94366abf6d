/**
 * A worker of designs.js: it gets the compiled module, then parts of tasks, and sends back what it finds of each. It
 * asks nobody for anything, and so goes on without the server.
 * @typedef {import('./designs.js').Told} Told
 */
import { DesignRows } from './design_rows.js';
import { instantiated } from './module.js';

/** @type {DesignRows|null} */ let rows = null;

addEventListener('message', async ({ data }) => {
  const { module, id = 0, part } = /** @type {import('./designs.js').Sent} */ (data);
  try {
    if (module) {
      rows = new DesignRows(await instantiated(module));
      postMessage(/** @type {Told} */ ({ ready: true }));
    } else if (part && rows) {
      const begin = performance.now();
      const found = rows.run(part);
      const transfer = Object.values(found).map(({ buffer }) => buffer);
      postMessage(/** @type {Told} */ ({ id, found, ms: performance.now() - begin }), { transfer });
    }
  } catch (problem) {
    postMessage(/** @type {Told} */ ({ id, problem: String(problem) }));
  }
});
