/** The sheet that students join by: large, for a projector; it needs no secret and tells none. */
import { count, say, t } from '../text/index.js';
import { button, copyText, h, setText } from '../ui/index.js';
import { aboutClass, reasonOf } from './calls.js';
import { hashOf, isOwnMachine, spoken, studentsPage } from './kept.js';
import { outcome } from './modal.js';
import { timeText } from './words.js';

/** @typedef {import('./shapes.js').ClassRoom} ClassRoom */

export class JoinSheet {
  /** @param {string} code @param {boolean} own whether this browser has the class' wall */
  constructor(code, own) {
    this.code = code;
    this.title = h('h2', { hidden: true, class: 'join-title', translate: 'no', 'data-testid': 'join-title' });
    this.state = h('p', { class: 'join-state', role: 'status' });
    this.told = outcome('join-told');
    const page = studentsPage(location.href);
    const link = studentsPage(location.href, `#class=${code}`);
    this.node = h(
      'section',
      { class: 'join panel', 'data-testid': 'join-sheet' },
      this.title,
      h(
        'ol',
        { class: 'join-steps' },
        h(
          'li',
          {},
          h('span', {}, 'Open'),
          h('strong', { class: 'join-address', translate: 'no', 'data-testid': 'join-address' }, spoken(page)),
        ),
        h(
          'li',
          {},
          h('span', {}, 'Press Labs, and enter the code'),
          h('strong', { class: 'join-code', translate: 'no', 'data-testid': 'join-code' }, code),
        ),
      ),
      this.state,
      isOwnMachine(location.href)
        ? h(
            'p',
            { class: 'warning', 'data-testid': 'own-machine' },
            'This address is of this machine alone. Open this page by the machine’s name or number in your network: ' +
              'students will reach it.',
          )
        : null,
      h(
        'div',
        { class: 'tools' },
        own
          ? h('a', { class: 'button', href: hashOf({ kind: 'wall', code }), 'data-testid': 'to-wall' }, 'To the wall')
          : null,
        button(
          {
            'data-testid': 'copy-join-link',
            onclick: async () => this.told.say((await copyText(link)) ? t('Copied.') : link),
          },
          'Copy the link for students',
        ),
      ),
      this.told.node,
    );
    this.#fetch();
  }

  async #fetch() {
    try {
      const { title, open, closes } = await aboutClass(this.code);
      this.#say(title, open, closes);
    } catch (error) {
      this.told.say(reasonOf(error), true);
    }
  }

  /** What the wall knows already. @param {ClassRoom} room */
  show({ title, open, closes, students }) {
    this.#say(title, open, closes, students.length);
  }

  /** @param {string} title @param {boolean} open @param {string|null} [closes] @param {number} [joined] */
  #say(title, open, closes, joined) {
    this.title.textContent = title; // typed by a person
    this.title.hidden = false;
    setText(
      this.state,
      [
        open ? (closes ? say`Open until ${timeText(closes)}.` : '') : t('This class is closed.'),
        joined === undefined
          ? ''
          : joined
            ? count(joined, '{0} has joined.', '{0} have joined.')
            : t('Nobody has joined yet.'),
      ]
        .filter(Boolean)
        .join(' '),
    );
  }
}
