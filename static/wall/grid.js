/**
 * The wall itself: a row for each student, a cell for each step, a mark for each goal. What stays as it is is not
 * touched, so that forty students who work cost next to nothing.
 * @typedef {import('./shapes.js').ClassRoom} ClassRoom
 * @typedef {import('./shapes.js').Student} Student
 * @typedef {import('./shapes.js').Step} Step
 * @typedef {{onOpen: (id: number) => void, onPoint: (id: number|null) => void}} Hands
 */
import { count, say, t } from '../text/index.js';
import { button, h, keepingFocus, setAttr, setText } from '../ui/index.js';
import { crowd, doneIn, goalText, marksIn, needOf, STUCK, toMark } from './state.js';
import { agoText, attemptsText, dateOf, maskOf, pointsText, scoreText, shareOf, timeText } from './words.js';

const MARKS = { met: 'met', missed: 'not met', open: 'not tried' };

/** One step of one student. */
class Cell {
  /** @param {Step} step */
  constructor(step) {
    this.step = step;
    this.marks = step.goals.map(() => h('span', { class: 'goal' }));
    this.tries = h('span', { class: 'tries', 'aria-hidden': 'true' });
    this.words = h('span', { class: 'sr' });
    this.node = h(
      'td',
      { role: 'cell' },
      h('span', { class: 'goals', 'aria-hidden': 'true' }, this.marks),
      this.tries,
      this.words,
    );
  }

  /** @param {Student} student */
  show(student) {
    const done = doneIn(student, this.step.name);
    const marks = marksIn(student, this.step);
    const here = student.step === this.step.name;
    for (const [k, mark] of marks.entries()) {
      setAttr(this.marks[k], 'class', `goal ${mark}`);
      setAttr(this.marks[k], 'title', `${goalText(this.step.goals[k])}: ${t(MARKS[mark])}`);
    }
    const through = marks.every((mark) => mark === 'met');
    // a step of questions alone is told by its points
    const told =
      done.attempts === 0 ? '' : marks.length === 0 ? pointsText(done.points) : through ? '' : `${done.attempts}×`;
    setText(this.tries, told);
    this.tries.classList.toggle('stuck', marks.length > 0 && !through && done.attempts >= STUCK);
    this.node.classList.toggle('here', here);
    const met = marks.filter((mark) => mark === 'met').length;
    setText(
      this.words,
      [
        done.attempts
          ? say`${met} of ${marks.length} goals met, ${pointsText(done.points)} points, ${attemptsText(done.attempts)}`
          : t('no attempt'),
        here ? t('is here now') : '',
      ]
        .filter(Boolean)
        .join('; '),
    );
    setAttr(
      this.node,
      'title',
      done.attempts
        ? say`${this.step.title}: ${scoreText(done.points, this.step.points)}, ${attemptsText(done.attempts)}`
        : this.step.title,
    );
  }
}

/** One student. */
class Row {
  /** @param {Student} student @param {readonly Step[]} steps @param {Hands} hands @param {boolean} masked */
  constructor({ id }, steps, hands, masked) {
    this.id = id;
    this.masked = masked;
    this.dot = h('span', { class: 'presence', 'aria-hidden': 'true' });
    this.name = masked
      ? h('span', { class: 'who' })
      : button({ class: 'who', 'data-testid': `student-${id}`, translate: 'no', onclick: () => hands.onOpen(id) });
    this.mark = h('span', { class: 'to-mark', role: 'img', hidden: true });
    this.cells = steps.map((step) => new Cell(step));
    this.points = h('span', { class: 'points' });
    this.share = h('span', { class: 'share' });
    this.seen = h('td', { role: 'cell', class: 'seen' });
    this.node = h(
      'tr',
      { role: 'row', 'data-id': id, class: masked ? null : 'openable' },
      h('th', { scope: 'row', role: 'rowheader' }, h('span', { class: 'named' }, this.dot, this.name, this.mark)),
      this.cells.map((cell) => cell.node),
      h('td', { role: 'cell', class: 'sum' }, this.points, ' ', this.share),
      this.seen,
    );
    this.node.addEventListener('pointerenter', () => hands.onPoint(id));
    this.node.addEventListener('pointerleave', () => hands.onPoint(null));
    this.node.addEventListener('focusin', () => hands.onPoint(id));
    this.node.addEventListener('focusout', () => hands.onPoint(null));
    if (!masked) this.node.addEventListener('click', (e) => e.target !== this.name && hands.onOpen(id));
  }

  /** @param {Student} student @param {readonly Step[]} steps @param {number} now ms */
  show(student, steps, now) {
    this.node.classList.toggle('online', student.online);
    const name = this.masked ? maskOf(student) : student.name;
    if (this.name.textContent !== name) this.name.textContent = name; // typed by a student: not asked of a catalogue
    if (!this.masked) this.name.title = [name, student.email, student.login].filter(Boolean).join(' · ');
    for (const cell of this.cells) cell.show(student);
    setText(this.points, pointsText(student.points));
    setText(this.share, shareOf(student.points, student.of));
    const waiting = this.masked ? 0 : toMark(student);
    this.mark.hidden = waiting === 0;
    setText(this.mark, `✎ ${waiting}`);
    for (const name of ['title', 'aria-label']) setAttr(this.mark, name, say`${waiting} to mark`);
    this.node.classList.toggle('stuck', needOf(student, steps) >= STUCK);
    this.tell(student, now);
  }

  /** What passes by itself. @param {Student} student @param {number} now ms */
  tell(student, now) {
    setText(this.seen, student.online ? t('here') : agoText(student.last_seen ?? student.joined, now));
    if (dateOf(student.last_seen)) setAttr(this.seen, 'title', say`Last seen ${timeText(student.last_seen)}`);
  }
}

export class Grid {
  /** @type {Map<number, Row>} */ #rows = new Map();
  /** @type {Map<number, Student>} what each row shows */ #shown = new Map();
  /** @type {readonly Step[]|null} */ #steps = null;
  #masked = false;
  /** @type {HTMLElement[]} */ #crowds = [];
  /** @type {number|null} */ #pointed = null;

  /** @param {Hands} hands */
  constructor(hands) {
    this.hands = hands;
    this.head = h('thead', { role: 'rowgroup' });
    this.body = h('tbody', { role: 'rowgroup', 'data-testid': 'wall-rows' });
    this.table = h(
      'table',
      { class: 'wall-grid', role: 'table', 'data-testid': 'wall' },
      h('caption', { class: 'sr' }, 'Students, and how they stand to the goals of each step'),
      this.head,
      this.body,
    );
    this.none = h(
      'p',
      { class: 'empty', hidden: true, 'data-testid': 'nobody-found' },
      'Nobody of that name is in this class.',
    );
    this.node = h('div', { class: 'grid-frame' }, this.table, this.none);
  }

  /**
   * @param {ClassRoom} room @param {Student[]} students those to be shown, in this order
   * @param {{masked: boolean, now: number}} how now: the server's time, ms
   */
  show(room, students, { masked, now }) {
    if (JSON.stringify(room.steps) !== JSON.stringify(this.#steps) || masked !== this.#masked)
      this.#begin(room, masked);
    for (const [k, n] of crowd(room).entries()) setText(this.#crowds[k], n ? say`${n} here` : '');
    const steps = room.steps;
    for (const student of students) {
      let row = this.#rows.get(student.id);
      if (!row) this.#rows.set(student.id, (row = new Row(student, steps, this.hands, masked)));
      if (this.#shown.get(student.id) === student) continue;
      row.show(student, steps, now);
      this.#shown.set(student.id, student);
    }
    this.#drop(room);
    const nodes = students.map(({ id }) => /** @type {Row} */ (this.#rows.get(id)).node);
    const same = nodes.length === this.body.children.length && nodes.every((node, k) => this.body.children[k] === node);
    if (!same) keepingFocus(this.body, () => this.body.replaceChildren(...nodes));
    this.none.hidden = nodes.length > 0 || room.students.length === 0;
    this.table.hidden = room.students.length === 0;
  }

  /** Says again how long ago each was seen. @param {number} now ms */
  tick(now) {
    for (const [id, row] of this.#rows) {
      const student = this.#shown.get(id);
      if (student) row.tell(student, now);
    }
  }

  /** Emphasizes a row. @param {number|null} id */
  point(id) {
    if (this.#pointed) this.#rows.get(this.#pointed)?.node.classList.remove('pointed');
    this.#pointed = id;
    if (id) this.#rows.get(id)?.node.classList.add('pointed');
  }

  /** @param {ClassRoom} room @param {boolean} masked */
  #begin({ steps }, masked) {
    this.#steps = steps;
    this.#masked = masked;
    this.#rows.clear();
    this.#shown.clear();
    this.#crowds = steps.map(() => h('span', { class: 'crowd' }));
    const column = (/** @type {Record<string, unknown>} */ attributes, /** @type {(Node|string)[]} */ ...words) =>
      h('th', { scope: 'col', role: 'columnheader', ...attributes }, ...words);
    const row = h(
      'tr',
      { role: 'row' },
      column({ class: 'students' }, 'Student'),
      steps.map((step, k) =>
        column(
          { title: say`Step ${k + 1}: ${step.title}`, class: 'step-head' },
          h('span', { class: 'step-title' }, h('b', {}, `${k + 1}`), ' ', step.title),
          this.#crowds[k],
        ),
      ),
      column({ class: 'sum' }, 'Points'),
      column({ class: 'seen' }, 'Seen'),
    );
    this.head.replaceChildren(row);
    this.table.dataset.steps = String(steps.length);
  }

  /** @param {ClassRoom} room */
  #drop({ students }) {
    const there = new Set(students.map(({ id }) => id));
    for (const id of [...this.#rows.keys()]) if (!there.has(id)) (this.#rows.delete(id), this.#shown.delete(id));
  }
}

/** How many there are, are here and are done. @param {ClassRoom} room */
export function presenceText({ students, steps }) {
  const here = students.filter(({ online }) => online).length;
  const goals = steps.filter((step) => step.goals.length > 0);
  const through = students.filter((student) =>
    goals.every((step) => marksIn(student, step).every((mark) => mark === 'met')),
  ).length;
  return [
    count(students.length, '{0} student', '{0} students'),
    say`${here} here`,
    goals.length ? say`${through} with all goals` : '',
  ]
    .filter(Boolean)
    .join(' · ');
}
