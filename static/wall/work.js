/**
 * What a student has done in one step, to be read: the goals with values, every attempt, what was answered.
 * @typedef {import('./shapes.js').Step} Step
 * @typedef {import('./shapes.js').Question} Question
 * @typedef {import('./shapes.js').Work} Work
 * @typedef {import('./shapes.js').Told} Told
 * @typedef {import('./shapes.js').Attempt} Attempt
 * @typedef {import('./shapes.js').HandMark} HandMark
 * @typedef {import('./shapes.js').Notes} Notes
 * @typedef {Record<string, string>} Formulas  MathML by LaTeX
 */
import { count, say, t, typographic } from '../text/index.js';
import { h, head, wide } from '../ui/index.js';
import { markdownLine } from '../markdown/index.js';
import { pointsText, scoreText, timeText, typed } from './words.js';

const VERDICTS = { true: ['met', '✓'], false: ['missed', '×'], undefined: ['by-hand', '?'] };
const SPOKEN = { true: 'met', false: 'not met', undefined: 'marked by hand' };

/** @param {boolean|null} [met] */
const verdict = (met) => {
  const key = /** @type {'true'|'false'|'undefined'} */ (String(met ?? undefined));
  const [kind, sign] = VERDICTS[key];
  return h(
    'span',
    { class: `verdict-mark ${kind}` },
    h('span', { 'aria-hidden': 'true' }, sign),
    h('span', { class: 'sr' }, SPOKEN[key]),
  );
};

/** @param {number} points @param {number} of */
export const pointsOf = (points, of) => say`${pointsText(points)} of ${pointsText(of)}`;

/** @param {readonly Told[]} goals @param {string} label for those who hear it */
export function goalsTable(goals, label) {
  return wide(
    label,
    h(
      'table',
      { class: 'told-table' },
      head(['Goal', 'Asked', 'Value', h('th', { scope: 'col' }, h('span', { class: 'sr' }, 'Met')), 'Points']),
      h(
        'tbody',
        {},
        goals.map((goal) =>
          h(
            'tr',
            {},
            h('th', { scope: 'row' }, goal.label, goal.message ? h('small', {}, goal.message) : null),
            h('td', {}, goal.required_text ?? ''),
            h('td', { class: 'value' }, goal.value_text ?? '–'),
            h('td', {}, verdict(goal.met)),
            h('td', { class: 'value' }, pointsOf(goal.points, goal.of)),
          ),
        ),
      ),
    ),
  );
}

/**
 * What was answered: a text as the student wrote it, all else as the server read it.
 * @param {unknown} answer @param {Question} question @param {Told|undefined} told @returns {Node}
 */
export function answerOf(answer, { kind, choices }, told) {
  if (answer === undefined || answer === null || answer === '') return h('em', {}, 'no answer');
  const read =
    kind === 'text' ? undefined : (told?.value_text ?? (kind === 'choice' ? choices?.[Number(answer) - 1] : undefined));
  const given = typeof answer === 'number' ? typographic(String(answer)) : String(answer);
  return typed(read || given, 'answer');
}

/** @type {Work} of who has not begun */
export const NO_WORK = { attempts: 0, hints: [], hand: [] };

/** The answer that counts: the newest that is there. @param {Work} work @param {string} question */
export function newestAnswer({ tries = [], draft }, question) {
  for (const { answers } of [...tries].reverse())
    if (answers?.[question] !== undefined && answers[question] !== '') return answers[question];
  return tries.length === 0 ? draft?.answers?.[question] : undefined;
}

/** @param {Work} work @param {string} question @returns {HandMark|undefined} */
export const handMark = ({ hand }, question) => hand.findLast((mark) => mark.question === question);

/**
 * Steps whose questions have what the lab says of them beyond the wall's.
 * @param {Step[]} steps @param {Notes|null} notes @returns {Step[]}
 */
export const withNotes = (steps, notes) =>
  steps.map((step) => {
    const known = notes?.steps?.find(({ name }) => name === step.name)?.questions ?? [];
    const questions = step.questions.map((own) => ({ ...known.find(({ name }) => name === own.name), ...own }));
    return { ...step, questions };
  });

/** Whether a person has to mark it. @param {Question} question */
export const isByHand = ({ by_hand, kind }) => by_hand ?? kind === 'text';

/**
 * An attempt, closed at first: points and time; open, all values and answers.
 * @param {Attempt} attempt @param {number} number @param {Step} step
 * @param {{open: boolean, link: Node|null, math: Formulas, onToggle: (open: boolean) => void}} how
 */
export function attemptDetails(attempt, number, step, { open, link, math, onToggle }) {
  const { result } = attempt;
  const answers = step.questions.filter(({ name }) => attempt.answers?.[name] !== undefined);
  const node = h(
    'details',
    { class: 'attempt', open, 'data-testid': `attempt-${attempt.id}`, ontoggle: () => onToggle(node.open) },
    h(
      'summary',
      {},
      h('span', {}, say`Attempt ${number}`),
      h('span', { class: 'caption' }, timeText(attempt.handed_at ?? attempt.at)),
      h('span', {}, scoreText(attempt.points, attempt.of)),
      h(
        'span',
        { class: 'goals' },
        result.goals.map((goal) =>
          h('span', { class: `goal ${goal.met ? 'met' : 'missed'}`, title: goal.label, 'aria-hidden': 'true' }),
        ),
      ),
      result.stable !== false ? null : h('strong', { class: 'unstable-word' }, 'unstable'),
    ),
    goalsTable(result.goals, say`Values of attempt ${number}`),
    answers.length
      ? h(
          'dl',
          { class: 'answers' },
          answers
            .map((question) => [
              h('dt', {}, ...markdownLine(question.text, math)),
              h(
                'dd',
                {},
                answerOf(
                  attempt.answers?.[question.name],
                  question,
                  result.questions.find(({ name }) => name === question.name),
                ),
                ' ',
                ...result.questions
                  .filter(({ name, met }) => name === question.name && typeof met === 'boolean')
                  .map(({ met }) => verdict(met)),
              ),
            ])
            .flat(),
        )
      : null,
    link ? h('p', {}, link) : null,
  );
  return node;
}

/**
 * A question with the answer that counts and how it was judged: the best attempt's; of a text, which a person marks,
 * the newest.
 * @param {Question} question @param {Work} work @param {Formulas} math
 */
export function questionLine(question, work, math) {
  const told = work.best?.questions.find(({ name }) => name === question.name);
  const mark = handMark(work, question.name);
  const byHand = isByHand(question);
  const of = question.points || told?.of || 0;
  const given = mark?.points ?? told?.points;
  const judged = !of ? '' : given === undefined ? count(of, '{0} point', '{0} points') : scoreText(given, of);
  const counts = byHand || !told ? newestAnswer(work, question.name) : (told.value_text ?? null);
  return h(
    'div',
    { class: 'question' },
    h('p', { class: 'question-text' }, ...markdownLine(question.text, math)),
    h(
      'p',
      {},
      answerOf(counts, question, told),
      ' ',
      told && typeof told.met === 'boolean' && !byHand ? verdict(told.met) : null,
      h('span', { class: 'caption' }, byHand && !mark && counts !== undefined ? t('not marked yet') : judged),
    ),
    mark?.comment ? h('p', { class: 'comment' }, h('b', {}, 'Comment'), ': ', typed(mark.comment)) : null,
  );
}
