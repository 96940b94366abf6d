/**
 * Sheets of paper: one of each student with values, questions and answers, and one of the whole class. They are made
 * when they are printed, and are seen on paper alone (wall_sheets.css).
 * @typedef {import('./shapes.js').ClassRoom} ClassRoom
 * @typedef {import('./shapes.js').Whole} Whole
 * @typedef {import('./shapes.js').Student} Student
 * @typedef {import('./shapes.js').Notes} Notes
 */
import { say } from '../text/index.js';
import { byId, h, head } from '../ui/index.js';
import { doneIn, ordered } from './state.js';
import { goalsTable, NO_WORK, pointsOf, questionLine, withNotes } from './work.js';
import { attemptsText, dayText, pointsText, shareOf, studentsText, timeText, typed, scoreText } from './words.js';

/** @param {ClassRoom} room @param {Date} now */
const origin = (room, now) =>
  h(
    'p',
    { class: 'sheet-origin' },
    typed(room.title),
    ` · ${room.lab.title} · ${dayText(now.toISOString())} ${timeText(now.toISOString(), now)} · heli2dof`,
  );

/** @param {Pick<Student, 'email'|'login'>} student */
const identity = ({ email, login }) => [email, login].filter(Boolean).join(' · ');

/** One student's. @param {ClassRoom} room @param {Whole} whole @param {Notes|null} notes @param {Date} [now] */
export function studentSheet(room, whole, notes, now = new Date()) {
  const summary = room.students.find(({ id }) => id === whole.id);
  return h(
    'article',
    { class: 'sheet', 'data-testid': `sheet-${whole.id}` },
    origin(room, now),
    h('h1', {}, typed(whole.name)),
    h('p', {}, typed(identity(whole)), ' ', summary ? h('strong', {}, scoreText(summary.points, summary.of)) : null),
    withNotes(room.steps, notes).map((step, k) => {
      const work = whole.steps[step.name] ?? NO_WORK;
      const done = summary ? doneIn(summary, step.name) : null;
      return h(
        'section',
        {},
        h('h2', {}, `${k + 1} ${step.title}`),
        h(
          'p',
          { class: 'caption' },
          [
            attemptsText(work.attempts),
            done && work.attempts ? scoreText(done.points, step.points) : '',
            work.hints.length ? say`hints taken: ${work.hints.join(', ')}` : '',
          ]
            .filter(Boolean)
            .join(' · '),
        ),
        work.best?.goals.length ? goalsTable(work.best.goals, step.title) : null,
        step.questions.map((question) => questionLine(question, work, notes?.math ?? {})),
      );
    }),
  );
}

/** All students on one sheet: points for each step. @param {ClassRoom} room @param {Date} [now] */
export function classSheet(room, now = new Date()) {
  return h(
    'article',
    { class: 'sheet', 'data-testid': 'sheet-class' },
    origin(room, now),
    h('h1', {}, typed(room.title)),
    h('p', {}, studentsText(room.students.length)),
    h(
      'table',
      { class: 'told-table' },
      head(['Student', 'Email or login', ...room.steps.map((step, k) => `${k + 1} ${step.title}`), 'Points', 'Share']),
      h(
        'tbody',
        {},
        ordered(room, 'name').map((student) =>
          h(
            'tr',
            {},
            h('th', { scope: 'row' }, typed(student.name)),
            h('td', {}, typed(identity(student))),
            room.steps.map((step) => {
              const done = doneIn(student, step.name);
              return h('td', { class: 'value' }, done.attempts ? pointsOf(done.points, step.points) : '–');
            }),
            h('td', { class: 'value' }, pointsText(student.points)),
            h('td', { class: 'value' }, shareOf(student.points, student.of)),
          ),
        ),
      ),
    ),
  );
}

/** Hands sheets to the printer. @param {HTMLElement[]} sheets */
export function printSheets(sheets) {
  const place = byId('sheets');
  place.replaceChildren(...sheets);
  place.hidden = false;
  document.documentElement.classList.add('printing');
  addEventListener(
    'afterprint',
    () => {
      document.documentElement.classList.remove('printing');
      place.hidden = true;
      place.replaceChildren();
    },
    { once: true },
  );
  print();
}
