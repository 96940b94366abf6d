/** What is derived of a structure, by the gain and the model that it is derived for. */
import { getSymbolic } from '../net/index.js';

/** @typedef {{coupling: string, lead: string, shifted: boolean}} Member shifted: its shift c is a letter */
const queryOf = (/** @type {Member} */ { coupling, lead, shifted }) => ({
  coupling,
  lead,
  ...(shifted && { shifted: 'true' }),
});

/** The paper's four states. @param {Member} member @returns {Promise<import('../contract.js').Symbolic>} */
export const ofPaper = (member) => getSymbolic(queryOf(member));

/** Six states. @param {Member} member @returns {Promise<import('../contract.js').SymbolicRotors>} */
export const ofRotors = (member) => getSymbolic({ ...queryOf(member), model: 'rotors' });

/** The observer. @param {Member} member @returns {Promise<import('../contract.js').SymbolicObserver>} */
export const ofObserver = (member) => getSymbolic({ ...queryOf(member), what: 'L' });
