/**
 * All of one student, in a dialog: every attempt with its values, answers, marks by hand, the way into the design, a
 * new personal link. It follows the class: what changes meanwhile is shown, and what is being written stays.
 * @typedef {import('./shapes.js').ClassRoom} ClassRoom
 * @typedef {import('./shapes.js').Whole} Whole
 * @typedef {import('./shapes.js').Work} Work
 * @typedef {import('./shapes.js').Step} Step
 */
import { say, t } from '../text/index.js';
import { button, copyText, h, keepingFocus } from '../ui/index.js';
import { reasonOf } from './calls.js';
import { designLinks } from './designs.js';
import { markForm } from './marking.js';
import { actButton, linkField, openModal, outcome } from './modal.js';
import { studentsPage } from './kept.js';
import {
  attemptDetails,
  goalsTable,
  handMark,
  isByHand,
  newestAnswer,
  NO_WORK,
  questionLine,
  withNotes,
} from './work.js';
import { agoText, attemptsText, timeText, typed, scoreText } from './words.js';

/**
 * @typedef {object} Around what the dialog asks of the wall
 * @property {() => ClassRoom} room
 * @property {import('./calls.js').ClassCalls} calls
 * @property {() => Promise<import('./shapes.js').Notes>} notes
 * @property {() => number} now the server's time, ms
 * @property {(id: number, by: 1|-1) => number|null} beside  the student before or after in the wall's order
 * @property {(id: number) => {id: number, step: string}|null} nextToMark
 * @property {(whole: Whole, notes: import('./shapes.js').Notes|null) => void} print
 * @property {() => void} onClose
 */

export class StudentDialog {
  /** @type {Whole|null} */ #whole = null;
  /** @type {Map<string, HTMLElement>} forms that are being filled in, by step and question */ #forms = new Map();
  /** @type {Map<string, boolean>} attempts that were opened or closed by hand */ #unfolded = new Map();
  /** @type {import('./designs.js').LinkOf|null} */ #linkOf = null;
  /** @type {import('./shapes.js').Notes|null} */ #notes = null;
  #asked = 0;

  /** @param {number} id @param {Around} around */
  constructor(id, around) {
    this.id = id;
    this.around = around;
    this.modal = openModal('student', t('Student'), { kind: 'large', onClose: around.onClose });
    this.told = outcome('student-told');
    this.content = h('div', { 'data-testid': 'student-content' });
    this.modal.body.append(this.told.node, this.content);
    this.#prepare();
    this.goTo(id);
  }

  /** What makes links of designs, and what the lab says of its questions; the next change asks again where it fails. */
  async #prepare() {
    const [linkOf, notes] = await Promise.allSettled([designLinks(), this.around.notes()]);
    if (linkOf.status === 'fulfilled') this.#linkOf = linkOf.value;
    if (notes.status === 'fulfilled') this.#notes = notes.value;
    this.#render();
  }

  /** Shows another student. @param {number} id @param {string} [step] brought into view */
  async goTo(id, step) {
    if (id !== this.id) this.#whole = null;
    this.id = id;
    this.#forms.clear();
    this.#unfolded.clear();
    await this.refresh();
    const section = step && this.content.querySelector(`[data-step="${CSS.escape(step)}"]`);
    if (section) section.querySelector('.mark-form')?.scrollIntoView({ block: 'center' });
  }

  /** Asks for what is kept now. */
  async refresh() {
    const asked = ++this.#asked;
    try {
      const whole = await this.around.calls.student(this.id);
      if (asked !== this.#asked) return;
      this.#whole = whole;
      this.told.say('');
    } catch (error) {
      if (asked !== this.#asked) return;
      this.told.say(reasonOf(error), true);
    }
    if (this.#linkOf && this.#notes) this.#render();
    else await this.#prepare();
  }

  #render() {
    const whole = this.#whole;
    if (!whole) return;
    this.modal.title(typed(whole.name));
    keepingFocus(this.content, () =>
      this.content.replaceChildren(
        this.#about(whole),
        this.#tools(whole),
        ...withNotes(this.around.room().steps, this.#notes).map((step, k) => this.#step(step, k, whole)),
      ),
    );
  }

  /** @param {Whole} whole */
  #about(whole) {
    const { steps, students } = this.around.room();
    const row = students.find(({ id }) => id === whole.id);
    const at = steps.findIndex(({ name }) => name === row?.step);
    /** @type {[string, Node|string|null][]} */
    const facts = [
      ['Points', row ? scoreText(row.points, row.of) : null],
      ['Where', at < 0 ? t('not begun') : `${at + 1} ${steps[at].title}`],
      ['Seen', row?.online ? t('here now') : agoText(row?.last_seen ?? whole.last_seen, this.around.now())],
      ['Joined', timeText(whole.joined)],
      ['Email', whole.email ? typed(whole.email) : null],
      ['Login', whole.login ? typed(whole.login) : null],
    ];
    return h(
      'dl',
      { class: 'facts' },
      facts.flatMap(([name, value]) => (value === null ? [] : [h('div', {}, h('dt', {}, name), h('dd', {}, value))])),
    );
  }

  /** @param {Whole} whole */
  #tools(whole) {
    const { beside, nextToMark, print } = this.around;
    const walk = (/** @type {string} */ testid, /** @type {string} */ label, /** @type {1|-1} */ by) => {
      const other = beside(this.id, by);
      return button(
        { 'data-testid': testid, disabled: other === null, onclick: () => other && this.goTo(other) },
        label,
      );
    };
    const next = nextToMark(this.id);
    const newest = this.#newest(whole);
    return h(
      'div',
      { class: 'tools' },
      newest ? this.#designLink(newest, 'Open the newest design', 'open-newest', 'primary') : null,
      button({ 'data-testid': 'print-student', onclick: () => print(whole, this.#notes) }, 'Print this sheet'),
      button({ 'data-testid': 'new-link', onclick: () => this.#newLink(whole) }, 'New personal link…'),
      button({ 'data-testid': 'remove-student', class: 'danger', onclick: () => this.#remove(whole) }, 'Remove…'),
      h(
        'span',
        { class: 'walk' },
        walk('student-before', '‹ Before', -1),
        walk('student-after', 'After ›', 1),
        next
          ? button({ 'data-testid': 'next-to-mark', onclick: () => this.goTo(next.id, next.step) }, 'Next to mark')
          : null,
      ),
    );
  }

  /** The design that was changed last: a draft or an attempt. @param {Whole} whole */
  #newest(whole) {
    /** @type {{at: string, design?: import('./shapes.js').Body}[]} */
    const all = Object.values(whole.steps).flatMap(({ tries = [], draft }) => [...tries, ...(draft ? [draft] : [])]);
    return all.filter(({ design }) => design).sort((a, b) => Date.parse(b.at) - Date.parse(a.at))[0]?.design;
  }

  /**
   * @param {import('./shapes.js').Body|undefined} design @param {string} label @param {string} testid
   * @param {string} [kind]
   */
  #designLink(design, label, testid, kind = '') {
    if (!this.#linkOf || !design) return null;
    return h(
      'a',
      { class: `button ${kind}`, href: this.#linkOf(design), target: '_blank', rel: 'noopener', 'data-testid': testid },
      label,
    );
  }

  /** @param {Step} step @param {number} k @param {Whole} whole */
  #step(step, k, whole) {
    const work = whole.steps[step.name] ?? NO_WORK;
    const { tries = [], best, draft, hints } = work;
    const math = this.#notes?.math ?? {};
    const score = this.around.room().students.find(({ id }) => id === this.id)?.steps[step.name];
    return h(
      'section',
      { class: 'step-work', 'data-step': step.name, 'data-testid': `work-${step.name}` },
      h(
        'h3',
        {},
        `${k + 1} ${step.title} `,
        h(
          'span',
          { class: 'caption' },
          tries.length && score ? scoreText(score.points, score.of) : t('no attempt yet'),
        ),
      ),
      best && best.goals.length
        ? goalsTable(best.goals, say`Goals of “${step.title}”, as the best attempt meets them`)
        : null,
      step.questions.map((question) => this.#question(question, step, work)),
      hints.length ? h('p', { class: 'caption' }, say`Hints taken: ${hints.join(', ')}`) : null,
      draft
        ? h(
            'p',
            { class: 'caption' },
            say`Last changed ${timeText(draft.at)}. `,
            this.#designLink(draft.design, 'Open the draft', `draft-${step.name}`),
          )
        : null,
      tries.length ? h('p', { class: 'caption' }, attemptsText(tries.length)) : null,
      tries
        .map((attempt, i) =>
          attemptDetails(attempt, i + 1, step, {
            open: this.#unfolded.get(attempt.id) ?? false,
            link: this.#designLink(attempt.design, say`Open the design of attempt ${i + 1}`, `open-${attempt.id}`),
            math,
            onToggle: (open) => this.#unfolded.set(attempt.id, open),
          }),
        )
        .reverse(),
    );
  }

  /** @param {import('./shapes.js').Question} question @param {Step} step @param {Work} work */
  #question(question, step, work) {
    const line = questionLine(question, work, this.#notes?.math ?? {});
    const mark = handMark(work, question.name);
    if (!isByHand(question) || (newestAnswer(work, question.name) === undefined && !mark)) return line;
    const key = `${step.name}/${question.name}`;
    let form = this.#forms.get(key);
    if (!form) {
      form = markForm({
        testid: `mark-${step.name}-${question.name}`,
        most: question.points ?? 0,
        mark,
        sample: question.sample,
        save: async (points, comment) => {
          await this.around.calls.mark(this.id, { step: step.name, question: question.name, points, comment });
          await this.refresh();
        },
      });
      this.#forms.set(key, form);
    }
    return h('div', {}, line, form);
  }

  /** @param {Whole} whole */
  #newLink(whole) {
    const modal = openModal('new-link-dialog', t('A new personal link'));
    const told = outcome('new-link-told');
    const make = actButton(
      { class: 'primary', 'data-testid': 'new-link-make' },
      'Make a new link',
      async () => {
        const { student } = await this.around.calls.newLink(this.id);
        const link = studentsPage(location.href, `#class=${this.around.room().code}&me=${encodeURIComponent(student)}`);
        make.replaceWith(linkField('new-link-field', 'The link. It is shown only now.', link, copyText));
      },
      (error) => told.say(reasonOf(error), true),
    );
    modal.body.append(
      h(
        'p',
        {},
        typed(whole.name),
        t(': the link that this student has now ends at once, on every machine. All work stays.'),
      ),
      make,
      told.node,
    );
  }

  /** @param {Whole} whole */
  #remove(whole) {
    const modal = openModal('remove-student-dialog', t('Remove a student'));
    const told = outcome('remove-student-told');
    modal.body.append(
      h('p', {}, typed(whole.name), t(': all attempts, answers and marks are deleted for good.')),
      actButton(
        { class: 'danger', 'data-testid': 'remove-student-yes' },
        'Delete for good',
        async () => {
          await this.around.calls.removeStudent(this.id);
          modal.close();
          this.modal.close();
        },
        (error) => told.say(reasonOf(error), true),
      ),
      told.node,
    );
  }
}
