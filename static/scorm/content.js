/**
 * What `heli2dof lab scorm` has put into the package, at its root, as modules: servers of courses that refuse to send
 * .json or .wasm send those.
 * @typedef {object} Content
 * @property {import('../labs/shapes.js').Lab} lab  as students see it, without what is left out
 * @property {{title: string, why: string}[]} left_out  steps that need a server
 * @property {number} pass  share of the points from which it is passed
 * @property {import('../types.js').Preset[]} presets  that of the lab
 * @property {import('../types.js').Method[]} methods
 * @property {Record<string, import('../labs/shapes.js').HintText[]>} hints  by step
 * @property {Record<string, Record<string, import('./questions.js').Right>>} answers  by step and question
 * @property {Record<string, Record<string, string>>} clouds  by step and goal, the factors of its rigs (goal_clouds.js)
 * @property {{rig: import('../bodies/bodies.js').Body, right: Record<string, Record<string, number>>}[]} rigs  of
 *   students, and the numbers that are right on each
 */

/** @param {string} base  address of the page @returns {Promise<Content>} */
export const contentOf = async (base) => (await import(new URL('content.js', base).href)).default;

/** The compiled kernels, which stand there as text. @param {string} base @returns {Promise<Uint8Array<ArrayBuffer>>} */
export async function kernelOf(base) {
  /** @type {{default: string}} */
  const { default: text } = await import(new URL('kernels.js', base).href);
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}
