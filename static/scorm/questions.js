/**
 * Answers, marked on this page, as the server does it (heli2dof_core/labs/questions.py). The right ones are in the
 * package; those that are of the student's own design are read from its numbers. Pure.
 *
 * @typedef {Pick<import('../labs/shapes.js').Goal, 'figure'|'of'|'axis'|'motor'|'model'|'steps'>} AskedFigure  a figure
 *   of merit, as goals have it
 *
 * @typedef {object} RightChoice
 * @property {'choice'} kind
 * @property {number[]} answer  places from 1
 *
 * @typedef {object} RightNumber
 * @property {'number'} kind
 * @property {string} unit  in which it is asked for
 * @property {Record<string, number>} units  how many of it is one of each unit that may be typed
 * @property {number} [tolerance]  relative
 * @property {number} [absolute]  in `unit`, instead
 * @property {boolean} [either_sign]
 * @property {{name: string, indices: number[], figure?: AskedFigure, scale: number|'dB'}} [own]  what it is of the
 *   student's own design, and how many of `unit` is one of its SI unit
 *
 * @typedef {{kind: 'text'}} RightText
 * @typedef {RightChoice|RightNumber|RightText} Right
 * @typedef {string|number|(string|number)[]|null|undefined} Answer
 * @typedef {{met: boolean|null, value_text: string, message: string}} Outcome
 *
 * @typedef {object} Own  the student's own design
 * @property {import('../types.js').Reply|null} reply
 * @property {Record<string, unknown>} body
 * @property {(asked: AskedFigure, reply: import('../types.js').Reply) => number|undefined} figure  reads figures
 * @property {(body: Record<string, unknown>) => boolean} stable  whether another design's loop is
 */
import { say, t } from '../text/index.js';
import { splitAmount, typedUnit } from './amounts.js';
import { quantityOf } from './quantities.js';

/** @type {(met: boolean|null, value_text?: string, message?: string) => Outcome} */
const outcome = (met, value_text = '', message = '') => ({ met, value_text, message });
const none = () => outcome(false, '', t('No answer.'));

/** @param {Answer} answer */
const isNone = (answer) =>
  answer === null || answer === undefined || (typeof answer === 'string' && !answer.trim()) || String(answer) === '';

/** @param {RightChoice} right @param {Answer} answer @param {string[]} choices */
function ofChoice({ answer: wanted }, answer, choices) {
  const given = Array.isArray(answer) ? answer : String(answer).split(',');
  const chosen = new Set(given.map(Number));
  if ([...chosen].some((n) => !Number.isInteger(n) || n < 1 || n > choices.length))
    return outcome(false, '', t('There is no such choice.'));
  const met = chosen.size === wanted.length && wanted.every((n) => chosen.has(n));
  return outcome(
    met,
    [...chosen]
      .sort((a, b) => a - b)
      .map((n) => choices[n - 1])
      .join(', '),
  );
}

/**
 * The number in the question's unit, or what is wrong with it.
 * @param {RightNumber} right @param {Answer} answer @returns {number|string}
 */
function given({ unit, units }, answer) {
  if (typeof answer === 'number') return answer;
  const parts = typeof answer === 'string' ? splitAmount(answer) : null;
  if (!parts) return t('This is no number.');
  if (!parts.unit) return parts.value;
  const factor = [parts.unit, typedUnit(parts.unit)].map((own) => units[own]).find((own) => own !== undefined);
  if (factor !== undefined) return parts.value * factor;
  return unit ? say`The answer is asked for in ${unit}.` : t('The answer has no unit.');
}

/** @param {number} value @param {string} unit */
const told = (value, unit) => `${String(Number(value.toPrecision(6))).replace('-', '−')}${unit && ` ${unit}`}`;

/**
 * @param {RightNumber} right @param {Answer} answer
 * @param {number|null|undefined} known  the right answer on this rig; undefined: it is of the student's own design
 * @param {Own} own
 */
function ofNumber(right, answer, known, own) {
  const value = given(right, answer);
  if (typeof value === 'string') return outcome(false, String(answer).slice(0, 80), value);
  const text = told(value, right.unit);
  const wanted = (right.own && quantityOf(right.own, own)) ?? known;
  if (wanted === null || wanted === undefined)
    return outcome(false, text, t('On this design there is no such value: see that the loop is stable.'));
  const [a, b] = right.either_sign ? [Math.abs(value), Math.abs(wanted)] : [value, wanted];
  const room = right.absolute ?? (right.tolerance ?? 0) * Math.abs(wanted);
  return outcome(Math.abs(a - b) <= room * (1 + 1e-9) + 1e-12, text);
}

/**
 * Whether an answer is right; null where a person would have to say so.
 * @param {Right} right @param {Answer} answer
 * @param {Own & {choices?: string[], known?: number|null}} how  known: the right number on the student's rig, where
 *   it is not of their own design
 * @returns {Outcome}
 */
export function judgedAnswer(right, answer, { choices = [], known, ...own }) {
  if (isNone(answer)) return none();
  if (right.kind === 'choice') return ofChoice(right, answer, choices);
  if (right.kind === 'number') return ofNumber(right, answer, known, own);
  return outcome(null, String(answer), t('Nobody marks this here: compare it with what you have seen.'));
}
