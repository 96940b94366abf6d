/** The derivation in numbers for a design, asked for once and shared by all that show it. */
import { ProblemError, walkThrough } from '../net/index.js';

/**
 * The reply of POST walkthrough with the body that was `asked`, or why it was `refused`.
 * @typedef {import('../contract.js').Walkthrough} Walkthrough
 * @typedef {ReturnType<typeof import('../model/store.js').bodyOf>} Body
 * @typedef {Walkthrough & {asked: Body, refused?: undefined}} Answer
 * @typedef {Answer|({asked: Body, refused: string} & Partial<Record<keyof Walkthrough, undefined>>)} Walk
 */
let key = '';
/** @type {Promise<Walk>|undefined} */ let last;

/** A refusal is an answer too: it is told beside the formulas. @param {Body} body @returns {Promise<Walk>} */
async function ask(body) {
  try {
    return { ...(await walkThrough(body)), asked: body };
  } catch (error) {
    if (!(error instanceof ProblemError)) throw error;
    return { asked: body, refused: [error.message, error.problem.hint].filter(Boolean).join(' ') };
  }
}

/** @param {Body} body @returns {Promise<Walk>} */
export function walk(body) {
  const wanted = JSON.stringify(body);
  if (last && wanted === key) return last;
  key = wanted;
  const answer = (last = ask(body));
  answer.catch(() => {
    if (last === answer) last = undefined;
  }); // a lost connection is no answer
  return answer;
}
