/**
 * The hints of a step: what one costs is said before, what was taken stays.
 * @typedef {import('./shapes.js').Kept} Kept
 * @typedef {import('./shapes.js').HintText} HintText
 */
import { count, say, t } from '../text/index.js';
import { button, h, keepingFocus } from '../ui/index.js';
import { markdown } from '../markdown/index.js';
import { pointsText } from './goals.js';

/** What it costs. @param {number} cost */
const price = (cost) =>
  cost ? count(cost, 'costs {0} point', 'costs {0} points').replace(String(cost), pointsText(cost)) : t('free');

export class Hints {
  /** @type {import('./shapes.js').Step['hints']} */ #hints = [];
  #key = '';

  /** @param {(n: number) => void} take  a hint by its number, from 1 */
  constructor(take) {
    this.take = take;
    this.node = h('section', { class: 'lab-hints', 'aria-label': 'Hints' });
  }

  /** @param {import('./shapes.js').Step['hints']} hints */
  show(hints) {
    this.#hints = hints;
    this.#key = '';
  }

  /** @param {NonNullable<Kept['hints']>} taken */
  render(taken) {
    const key = JSON.stringify(taken);
    if (key === this.#key) return;
    this.#key = key;
    /** @type {Map<number, HintText|null>} */
    const known = new Map(taken.map((one) => (typeof one === 'number' ? [one, null] : [one.hint, one])));
    keepingFocus(this.node, () =>
      this.node.replaceChildren(...this.#hints.map((hint, i) => this.#hint(hint, i + 1, known))),
    );
  }

  /** @param {{cost: number, text?: string}} hint @param {number} n @param {Map<number, HintText|null>} known */
  #hint({ cost }, n, known) {
    const text = known.get(n);
    if (text)
      return h(
        'div',
        { class: 'lab-hint', 'data-testid': `lab-hint-${n}-text`, tabindex: -1 },
        h('strong', {}, say`Hint ${n}`, ' '),
        markdown(text.text, text.math, 4),
      );
    const paid = known.has(n) ? t('taken') : price(cost);
    return button({ 'data-testid': `lab-hint-${n}`, onclick: () => this.take(n) }, say`Hint ${n} (${paid})`);
  }
}
