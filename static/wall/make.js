/**
 * A new class in three clicks: a lab, its title, the sheet that students join by. And the classes that this browser
 * knows already.
 * @typedef {import('./shapes.js').LabCard} LabCard
 */
import { say, t } from '../text/index.js';
import { button, h } from '../ui/index.js';
import { getLabs, makeClass, reasonOf, statusOf } from './calls.js';
import { forget, hashOf, keep, keptClasses } from './kept.js';
import { actButton, labelled, outcome } from './modal.js';
import { dateOf, dayText, pointsText, typed } from './words.js';

/** What a class is called until somebody says otherwise. @param {LabCard} lab @param {Date} now */
export const titleFor = ({ title }, now) =>
  `${title}, ${now.toLocaleDateString([], { day: 'numeric', month: 'short', year: 'numeric' })}`;

export class Maker {
  /** @type {LabCard|null} */ #lab = null;

  /** @param {(code: string) => void} onMade */
  constructor(onMade) {
    this.onMade = onMade;
    this.cards = h('div', { class: 'cards', role: 'radiogroup', 'aria-labelledby': 'labs-title' });
    this.told = outcome('make-told');
    this.title = h('input', { maxlength: 100, required: true, autocomplete: 'off', 'data-testid': 'class-title' });
    this.operator = h('input', { type: 'password', autocomplete: 'off', 'data-testid': 'operator-key' });
    this.asksOperator = labelled('The key of this server’s operator', this.operator);
    this.asksOperator.hidden = true;
    this.make = actButton(
      { type: 'submit', class: 'primary', 'data-testid': 'make-class' },
      'Make the class',
      () => this.#make(),
      (error) => this.#refused(error),
    );
    this.form = h(
      'form',
      { class: 'make-form panel', hidden: true, onsubmit: (/** @type {Event} */ e) => e.preventDefault() },
      labelled('Title, for you and your students', this.title),
      this.asksOperator,
      this.make,
    );
    this.known = h('section', { class: 'panel known', 'aria-labelledby': 'known-title' });
    this.node = h(
      'div',
      { class: 'maker' },
      h(
        'section',
        { class: 'panel', 'aria-labelledby': 'labs-title' },
        h('h2', { id: 'labs-title' }, 'A new class: choose a lab'),
        h(
          'p',
          { class: 'caption wrap' },
          'Every student gets a rig of their own and the whole instrument. The server marks; you see it live.',
        ),
        this.cards,
        this.form,
        this.told.node,
      ),
      this.known,
    );
    this.#showKnown();
    this.#fetch();
  }

  async #fetch() {
    try {
      const labs = await getLabs();
      this.told.say(labs.length ? '' : t('This server has no labs.'));
      this.cards.replaceChildren(...labs.map((lab) => this.#card(lab)));
    } catch (error) {
      this.told.say(reasonOf(error), true);
      this.cards.replaceChildren(button({ 'data-testid': 'labs-again', onclick: () => this.#fetch() }, 'Try again'));
    }
  }

  /** @param {LabCard} lab */
  #card(lab) {
    const facts = [
      lab.minutes ? say`${lab.minutes} min` : '',
      say`${pointsText(lab.points)} points`,
      lab.source === 'own' ? t('your own') : '',
    ];
    return h(
      'label',
      { class: 'card lab' },
      h('input', {
        type: 'radio',
        name: 'lab',
        value: lab.name,
        'data-testid': `lab-${lab.name}`,
        onchange: () => this.#choose(lab),
      }),
      h('span', { class: 'lab-title' }, lab.number ? h('b', {}, `${lab.number} `) : null, lab.title),
      h('span', { class: 'caption' }, facts.filter(Boolean).join(' · ')),
      lab.summary ? h('span', { class: 'lab-summary' }, lab.summary) : null,
    );
  }

  /** @param {LabCard} lab */
  #choose(lab) {
    this.#lab = lab;
    this.form.hidden = false;
    this.told.say('');
    this.title.value = titleFor(lab, new Date());
    this.form.scrollIntoView({ block: 'nearest' });
  }

  async #make() {
    const title = this.title.value.trim();
    if (!this.#lab) return;
    if (!title) {
      this.told.say(t('Give the class a title.'), true);
      return this.title.focus();
    }
    const { code, instructor, ends } = await makeClass({ lab: this.#lab.name, title }, this.operator.value.trim());
    keep({ code, key: instructor, title, ends });
    this.onMade(code);
  }

  /** @param {unknown} error */
  #refused(error) {
    if (statusOf(error) === 401) {
      this.asksOperator.hidden = false;
      this.operator.focus();
    }
    this.told.say(reasonOf(error), true);
  }

  #showKnown() {
    const all = keptClasses();
    this.known.hidden = all.length === 0;
    this.known.replaceChildren(
      h('h2', { id: 'known-title' }, 'Your classes on this browser'),
      h(
        'ul',
        { class: 'known-list' },
        all.map(({ code, title, ends }) =>
          h(
            'li',
            {},
            h('a', { href: hashOf({ kind: 'wall', code }), 'data-testid': `known-${code}` }, typed(title || code)),
            h('span', { class: 'caption', translate: 'no' }, code),
            dateOf(ends) ? h('span', { class: 'caption' }, say`kept until ${dayText(ends)}`) : null,
            button(
              {
                class: 'quiet',
                title: 'Takes the link out of this browser; the class itself stays',
                'aria-label': say`Forget ${title || code}`,
                'data-testid': `forget-${code}`,
                onclick: () => this.#forget(code),
              },
              'Forget',
            ),
          ),
        ),
      ),
    );
  }

  /** @param {string} code */
  #forget(code) {
    if (!confirm(t('Without its link nobody comes back to this class. Forget the link?'))) return;
    forget(code);
    this.#showKnown();
  }
}
