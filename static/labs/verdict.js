/**
 * What was handed in, in points: of the step, and at the end of all.
 * @typedef {import('./shapes.js').Marked} Marked
 * @typedef {import('./shapes.js').Kept} Kept
 */
import { count, say, t } from '../text/index.js';
import { h, keepingFocus } from '../ui/index.js';
import { pointsText } from './goals.js';

/**
 * What of a step is reached, as the desk has marked it.
 * @param {Kept|undefined} kept @param {import('./shapes.js').Step} step
 */
export function progressOf(kept, step) {
  const best = kept?.best;
  const hand = (kept?.hand ?? []).reduce((sum, { points }) => sum + points, 0);
  const told = best ? [...best.goals, ...best.questions] : [];
  const done = Boolean(best) && told.every(({ met }) => met !== false);
  return { points: (best?.points ?? 0) + hand, of: step.points, done, tried: Boolean(best) };
}

/**
 * What is said of an attempt that could not be sent at once, for as long as it waits.
 * @param {import('./shapes.js').Standing} standing @returns {string} empty: it has been sent
 */
export function lateText({ kind }) {
  if (kind === 'fine') return '';
  return kind === 'closed'
    ? t('Kept here: it is handed in if the class opens again.')
    : t('Kept here: it is handed in as soon as it can be.');
}

/**
 * Why a step's points are fewer than its ticks promise: hints that were taken, answers that a person marks.
 * @param {Marked} marked
 * @param {Kept|undefined} kept
 * @param {boolean} byHand whether anybody marks answers in words
 * @returns {string[]}
 */
export function whyFewer({ cost = 0, questions }, kept, byHand) {
  const hand = new Set((kept?.hand ?? []).map(({ question }) => question));
  const waiting = questions
    .filter(({ name, met, value_text }) => byHand && (met ?? null) === null && value_text?.trim() && !hand.has(name))
    .reduce((sum, { of }) => sum + of, 0);
  const told = (/** @type {number} */ n, /** @type {string} */ one, /** @type {string} */ many) =>
    n ? count(n, one, many).replace(String(n), pointsText(n)) : '';
  return [
    told(cost, 'Hints that you took cost {0} point.', 'Hints that you took cost {0} points.'),
    told(
      waiting,
      '{0} point more may come: your instructor marks an answer.',
      '{0} points more may come: your instructor marks an answer.',
    ),
  ].filter(Boolean);
}

export class Verdict {
  #words = '';

  constructor() {
    this.node = h('div', { class: 'lab-verdict', role: 'status', 'data-testid': 'lab-verdict' });
  }

  /** Told once. @param {HTMLElement[]} lines */
  #say(lines) {
    const words = lines.map((line) => line.textContent).join('\n');
    if (words === this.#words) return;
    this.#words = words;
    keepingFocus(this.node, () => this.node.replaceChildren(...lines));
  }

  /**
   * @param {Marked|null} told of this very design
   * @param {Kept|undefined} kept
   * @param {{trouble: string, late: string, byHand: boolean}} more
   */
  step(told, kept, { trouble, late, byHand }) {
    const best = kept?.best;
    const hand = (kept?.hand ?? []).reduce((sum, { points: given }) => sum + given, 0);
    const points = (/** @type {Marked} */ marked, given = 0) =>
      say`${pointsText(marked.points + given)} of ${pointsText(marked.of)} points`;
    const shown = told ?? best;
    this.#say(
      [
        trouble && h('p', { class: 'lab-trouble' }, trouble),
        late && h('p', { class: 'lab-late' }, late),
        told && h('p', { class: 'lab-result' }, say`Handed in: ${points(told)}.`),
        ...(shown ? whyFewer(shown, kept, byHand) : []).map((why) => h('p', {}, why)),
        told?.ignored?.length &&
          h('p', {}, say`Fixed in this step, and not taken from your design: ${told.ignored.join(', ')}.`),
        best &&
          h(
            'p',
            { class: 'lab-best', 'data-testid': 'lab-best' },
            say`Best: ${points(best, hand)}, ${count(kept?.attempts ?? 1, '{0} attempt', '{0} attempts')}.`,
          ),
      ].filter((node) => node instanceof HTMLElement),
    );
  }

  /** @param {import('./shapes.js').Desk} desk @param {ReturnType<typeof progressOf>[]} steps @param {number} sum */
  end({ lab, who }, steps, sum) {
    const open = lab.steps.filter((_, i) => !steps[i].done).map(({ title }) => title);
    const byHand = lab.steps.some(({ questions }) => questions.some(({ kind }) => kind === 'text'));
    const lines = [
      say`You have ${pointsText(sum)} of ${pointsText(lab.points)} points.`,
      open.length ? say`Still open: ${open.join(', ')}.` : t('Every goal is met.'),
      byHand && who ? t('Answers in words are marked by your instructor.') : '',
    ];
    this.#say(lines.filter(Boolean).map((line) => h('p', { 'data-testid': 'lab-end' }, line)));
  }
}
