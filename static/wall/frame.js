/**
 * What stands around the wall: the class' name and code, who is there, the tools, the order, what the marks mean.
 * @typedef {import('./state.js').Order} Order
 */
import { say, t } from '../text/index.js';
import { button, copyText, h, recall, remember } from '../ui/index.js';
import { hashOf, spoken, studentsPage } from './kept.js';
import { actButton, outcome } from './modal.js';

const ORDER = 'wall-order';
const ORDERS = /** @type {[Order, string][]} */ ([
  ['joined', 'as they joined'],
  ['name', 'by name'],
  ['points', 'by points'],
  ['help', 'who needs help first'],
]);

/** @typedef {'render'|'mark'|'results'|'notes'|'manage'} Act */

/** What to do with the secret link as long as nobody is there; it is not shown, since a projector may be on. */
function keepLink(/** @type {() => string} */ link) {
  const told = outcome('keep-told');
  return h(
    'div',
    { class: 'keep' },
    h('p', {}, 'Only this browser knows the way back here. Keep your secret link: whoever has it sees everything.'),
    actButton(
      { 'data-testid': 'keep-link' },
      'Copy your secret link',
      async () =>
        (await copyText(link())) ? told.say(t('Copied.')) : told.say(t('Press “Class…”; it is shown there.'), true),
      () => {},
    ),
    told.node,
  );
}

export class Frame {
  /**
   * @param {{code: string, masked: boolean}} of masked: for the projector, without names
   * @param {Record<Act, () => void> & {link: () => string}} acts
   * @param {HTMLElement} grid @param {HTMLElement[]} side
   */
  constructor({ code, masked }, acts, grid, side) {
    this.title = h('h2', { class: 'class-title', translate: 'no', 'data-testid': 'title' });
    this.facts = h('p', { class: 'caption wall-facts', 'data-testid': 'facts' });
    this.search = h('input', {
      type: 'search',
      'data-testid': 'search',
      'aria-label': 'Find a student',
      placeholder: 'Find a student',
    });
    this.search.addEventListener('input', acts.render);
    const kept = recall(ORDER);
    this.order = h(
      'select',
      { 'data-testid': 'order', onchange: () => (remember(ORDER, this.order.value), acts.render()) },
      ORDERS.filter(([value]) => !masked || value !== 'name').map(([value, words]) =>
        h('option', { value, selected: value === kept }, words),
      ),
    );
    this.marking = button({ hidden: true, 'data-testid': 'to-mark', onclick: acts.mark });
    const tool = (/** @type {string} */ testid, /** @type {string} */ label, /** @type {() => void} */ act) =>
      button({ 'data-testid': testid, onclick: act }, label);
    const to = (/** @type {'wall'|'projector'|'join'} */ kind, /** @type {string} */ label) =>
      h('a', { class: 'button', href: hashOf({ kind, code }), 'data-testid': `to-${kind}` }, label);
    this.tools = h(
      'div',
      { class: 'tools' },
      this.marking,
      to('join', 'Join sheet'),
      masked ? to('wall', 'With names') : to('projector', 'Without names'),
      masked
        ? []
        : [
            tool('results-open', 'Results…', acts.results),
            tool('notes-open', 'Lab’s notes…', acts.notes),
            tool('manage-open', 'Class…', acts.manage),
          ],
    );
    this.nobody = h(
      'div',
      { class: 'empty', hidden: true, 'data-testid': 'nobody' },
      h(
        'p',
        {},
        say`Nobody has joined yet. Students open ${spoken(studentsPage(location.href))} and enter the code ${code}.`,
      ),
      masked ? null : keepLink(acts.link),
    );
    this.key = h(
      'p',
      { class: 'caption legend-marks' },
      h('span', { class: 'goal met', 'aria-hidden': 'true' }),
      h('span', {}, 'met'),
      h('span', { class: 'goal missed', 'aria-hidden': 'true' }),
      h('span', {}, 'tried'),
      h('span', { class: 'goal open', 'aria-hidden': 'true' }),
      h('span', {}, 'not yet'),
      h('span', { class: 'tries', 'aria-hidden': 'true' }, '3×'),
      h('span', {}, 'attempts'),
      h('span', { class: 'here-sample', 'aria-hidden': 'true' }),
      h('span', {}, 'is there'),
    );
    this.node = h(
      'div',
      { class: 'wall', hidden: true },
      h(
        'div',
        { class: 'wall-head' },
        h(
          'div',
          { class: 'wall-names' },
          this.title,
          h('span', { class: 'code', translate: 'no', title: 'The code by which students join' }, code),
          this.facts,
        ),
        this.tools,
      ),
      h(
        'div',
        { class: 'wall-body' },
        h(
          'section',
          { class: 'panel students-panel', 'aria-label': 'Students' },
          h(
            'div',
            { class: 'grid-tools' },
            masked ? null : this.search,
            h('label', { class: 'select' }, h('span', {}, 'Order'), this.order),
            this.key,
          ),
          grid,
          this.nobody,
        ),
        h('div', { class: 'wall-side' }, side),
      ),
    );
  }

  /** @returns {Order} */
  get wanted() {
    return /** @type {Order} */ (this.order.value);
  }
}
