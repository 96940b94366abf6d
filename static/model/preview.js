/**
 * A design under the pointer, shown in place of the present one, which stays what it is: the state as it is drawn.
 * Pure.
 * @typedef {import('../types.js').State} State
 */

/**
 * Poles, curves and figures are of one design or of the other, never mixed; and nothing is asked for it, as during a
 * drag.
 * @param {State} state @returns {State} the state itself where no numbers are there to be previewed
 */
export function shownOf(state) {
  const { preview } = state;
  if (!preview?.reply) return state;
  const { design, reply, heard } = preview;
  return { ...state, design, reply, answered: design, heard, problem: null, cloud: null, dragging: true };
}
