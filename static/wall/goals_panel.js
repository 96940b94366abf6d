/** How the class stands to each goal, as bars, and which one holds it up. */
import { count, say, t } from '../text/index.js';
import { h, setAttr, setText, svg } from '../ui/index.js';
import { crowd, heldUp, standings } from './state.js';
import { shareOf } from './words.js';

/** @typedef {import('./shapes.js').ClassRoom} ClassRoom */
/** @typedef {{node: HTMLElement, bar: SVGRectElement, share: HTMLElement}} Line */

export class GoalsPanel {
  /** @type {Line[]} */ #lines = [];
  /** @type {HTMLElement[]} */ #crowds = [];
  /** @type {string} */ #made = '';

  constructor() {
    this.worst = h('p', { class: 'held-up', 'data-testid': 'held-up' });
    this.list = h('ol', { class: 'steps-list' });
    this.summary = h(
      'section',
      { class: 'panel', 'aria-labelledby': 'held-title' },
      h('h2', { id: 'held-title' }, 'What holds the class up'),
      this.worst,
    );
    this.node = h(
      'section',
      { class: 'panel stand', 'aria-labelledby': 'stand-title' },
      h('h2', { id: 'stand-title' }, 'Goals met, of those who tried'),
      this.list,
    );
  }

  /** @param {ClassRoom} room */
  show(room) {
    const all = standings(room);
    const made = JSON.stringify(room.steps);
    if (made !== this.#made) this.#begin(room, all);
    this.#made = made;
    const worst = heldUp(all);
    setText(
      this.worst,
      worst
        ? [
            say`Step ${worst.index + 1}, “${worst.label}”:`,
            count(worst.stuck, '{0} student is at it in vain;', '{0} students are at it in vain;'),
            say`${shareOf(worst.met, worst.tried)} of all who tried have met it.`,
          ].join(' ')
        : t('Nothing at present: nobody is at a goal that was tried in vain.'),
    );
    for (const [k, n] of crowd(room).entries()) setText(this.#crowds[k], n ? say`${n} here` : '');
    for (const [k, standing] of all.entries()) {
      const { node, bar, share } = this.#lines[k];
      setAttr(bar, 'width', standing.tried ? (100 * standing.met) / standing.tried : 0);
      setText(share, shareOf(standing.met, standing.tried));
      setAttr(node, 'title', standing.tried ? say`${standing.met} of ${standing.tried} who tried` : t('not tried'));
      node.classList.toggle('worst', worst !== null && worst.step === standing.step && worst.goal === standing.goal);
    }
  }

  /** @param {ClassRoom} room @param {ReturnType<typeof standings>} all */
  #begin({ steps }, all) {
    this.#lines = all.map(({ label }) => {
      const bar = svg('rect', { height: 4, width: 0, class: 'bar-met' });
      const share = h('span', { class: 'share' });
      const drawing = svg(
        'svg',
        { class: 'bar', viewBox: '0 0 100 4', preserveAspectRatio: 'none', 'aria-hidden': 'true' },
        svg('rect', { width: 100, height: 4, class: 'bar-all' }),
        bar,
      );
      return { node: h('li', {}, h('span', { class: 'label' }, label), drawing, share), bar, share };
    });
    this.#crowds = steps.map(() => h('span', { class: 'crowd' }));
    this.list.replaceChildren(
      ...steps.map((step, k) =>
        h(
          'li',
          {},
          h('h3', {}, h('span', {}, `${k + 1} ${step.title}`), this.#crowds[k]),
          h(
            'ul',
            {},
            this.#lines.filter((_line, i) => all[i].step === step).map(({ node }) => node),
          ),
        ),
      ),
    );
  }
}
