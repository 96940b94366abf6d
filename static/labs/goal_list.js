/**
 * The goals of a step: what is required, and how far the design is, by the page's own numbers while the hand moves, by
 * the server's once it was handed in.
 * @typedef {import('./shapes.js').Goal} Goal
 * @typedef {import('./shapes.js').Marked} Marked
 */
import { count, t } from '../text/index.js';
import { h, setAttr, setText } from '../ui/index.js';
import { judgedFlight } from './flights.js';
import { judged, pointsText } from './goals.js';

const SIGNS = { met: '✓', missed: '○', unknown: '?' };
const SPOKEN = { met: 'met', missed: 'not met yet', unknown: 'checked when you hand in' };

/** @param {boolean|null|undefined} met @returns {keyof typeof SIGNS} */
const kindOf = (met) => (met === true ? 'met' : met === false ? 'missed' : 'unknown');

export class GoalList {
  /** @type {({goal: Goal} & Record<'node'|'sign'|'spoken'|'value'|'more'|'tick', HTMLElement>)[]} */ #rows = [];

  constructor() {
    this.list = h('ul', {});
    /** The same in short, in sight while the sheet is small. */
    this.ticker = h('p', { class: 'lab-ticker', 'aria-hidden': 'true', 'data-testid': 'lab-ticker' });
    this.node = h('section', { class: 'lab-goals', 'aria-label': 'Goals' }, h('h4', {}, 'Goals'), this.list);
  }

  /** @param {Goal[]} goals */
  show(goals) {
    this.#rows = goals.map((goal) => {
      const sign = h('span', { class: 'lab-sign', 'aria-hidden': 'true' });
      const spoken = h('span', { class: 'sr' });
      const value = h('span', { class: 'lab-value', translate: 'no' });
      const more = h('span', { class: 'lab-message' });
      const node = h(
        'li',
        { 'data-testid': `lab-goal-${goal.name}` },
        sign,
        h('span', { class: 'lab-label', translate: 'no' }, goal.label),
        spoken,
        h(
          'span',
          { class: 'lab-limits' },
          value,
          h('span', { class: 'lab-required', translate: 'no' }, goal.required_text),
        ),
        h(
          'span',
          { class: 'lab-worth' },
          count(goal.points, '{0} point', '{0} points').replace(/^\S+/, pointsText(goal.points)),
        ),
        more,
      );
      const tick = h('span', { translate: 'no' });
      return { goal, node, sign, spoken, value, more, tick };
    });
    this.ticker.replaceChildren(...this.#rows.map(({ tick }) => tick));
    this.list.replaceChildren(...this.#rows.map(({ node }) => node));
    this.node.hidden = !goals.length;
  }

  /**
   * @param {Pick<import('../types.js').State, 'reply'|'design'>} state
   * @param {Marked|null} told of this very design
   * @param {import('./flights.js').Flown|null} [flown] its best flight
   */
  render(state, told, flown = null) {
    for (const { goal, node, sign, spoken, value, more, tick } of this.#rows) {
      const verdict = told?.goals.find(({ name }) => name === goal.name);
      const isFlight = goal.kind === 'flight';
      const own = () =>
        !isFlight
          ? judged(goal, state)
          : flown
            ? judgedFlight(goal, flown.values)
            : { met: false, text: t('not flown') };
      const { met, text } = verdict ? { met: verdict.met, text: verdict.value_text ?? '' } : own();
      const kind = kindOf(met);
      if (node.dataset.kind !== kind) node.dataset.kind = kind;
      setText(sign, SIGNS[kind]);
      setText(spoken, `, ${t(SPOKEN[kind])}: `);
      if (value.textContent !== text) value.textContent = text;
      const short = `${SIGNS[kind]} ${text} ${goal.required_text}`;
      if (tick.textContent !== short) tick.textContent = short;
      if (tick.dataset.kind !== kind) tick.dataset.kind = kind;
      setAttr(value, 'title', verdict ? 'as the server marked it' : kind === 'unknown' ? SPOKEN.unknown : '');
      const message = verdict?.message ?? (kind === 'unknown' && !verdict ? t(SPOKEN.unknown) : '');
      if (more.textContent !== message) more.textContent = message;
    }
  }
}
