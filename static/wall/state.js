/**
 * A class as it is now: the server's first word and what has changed since, and what follows for the wall: order, who
 * needs help, which goal holds the class up. Pure.
 * @typedef {import('./shapes.js').ClassRoom} ClassRoom
 * @typedef {import('./shapes.js').Student} Student
 * @typedef {import('./shapes.js').Done} Done
 * @typedef {import('./shapes.js').Step} Step
 * @typedef {'joined'|'name'|'points'|'help'} Order
 * @typedef {Partial<Omit<ClassRoom, 'students'>> & {students?: Student[], gone?: number[]}} Change
 */

/**
 * A class with a change: students are replaced whole, unknown ones are new, those that are gone leave.
 * @param {ClassRoom} room @param {Change} change @returns {ClassRoom}
 */
export function changed(room, { students = [], gone = [], ...rest }) {
  const fresh = new Map(students.map((student) => [student.id, student]));
  const kept = room.students.map((old) => {
    const now = fresh.get(old.id);
    fresh.delete(old.id);
    return now ?? old;
  });
  return {
    ...room,
    ...rest,
    students: [...kept, ...fresh.values()].filter(({ id }) => !gone.includes(id)),
  };
}

/** @type {Done} */
const NOTHING = { points: 0, of: 0, goals: [], attempts: 0, hints: 0, to_mark: 0 };

/** A goal in words, with what it asks, which is not broken. @param {Step['goals'][number]} goal */
export const goalText = ({ name, label = name, required_text: asked }) =>
  asked ? `${label} (${asked.replaceAll(' ', '\u00a0')})` : label;

/** What a student has done in a step. @param {Student} student @param {string} step @returns {Done} */
export const doneIn = (student, step) => (Object.hasOwn(student.steps, step) ? student.steps[step] : NOTHING);

/** @typedef {'met'|'missed'|'open'} Mark of a goal: met, tried and not met, not tried */

/** How a student stands to each goal of a step. @param {Student} student @param {Step} step @returns {Mark[]} */
export function marksIn(student, step) {
  const { goals, attempts } = doneIn(student, step.name);
  return step.goals.map((_goal, k) => (attempts === 0 ? 'open' : goals[k] ? 'met' : 'missed'));
}

/** @param {Student} student @param {Step} step */
const isThrough = (student, step) =>
  doneIn(student, step.name).attempts > 0 && marksIn(student, step).every((mark) => mark === 'met');

/** So many attempts without all goals met tell that somebody is stuck. */
export const STUCK = 3;

/**
 * How urgently somebody needs help: attempts in the step where they are, where not all of its goals are met yet.
 * @param {Student} student @param {readonly Step[]} steps @returns {number} 0: not at all
 */
export function needOf(student, steps) {
  const step = steps.find(({ name }) => name === student.step);
  if (!step || step.goals.length === 0 || isThrough(student, step)) return 0;
  return doneIn(student, step.name).attempts;
}

/** Answers of a student that wait for a person's mark. @param {Student} student */
export const toMark = (student) => Object.values(student.steps).reduce((sum, { to_mark: waiting }) => sum + waiting, 0);

/** @param {string} text */
const plain = (text) => text.normalize('NFKD').replace(/\p{M}/gu, '').toLowerCase();

/**
 * Whether a student is meant by what was typed: part of the name, address or login, or the number.
 * @param {Student} student @param {string} words
 */
function isMeant(student, words) {
  const wanted = plain(words.trim());
  if (!wanted) return true;
  return (
    String(student.number) === wanted ||
    [student.name, student.email, student.login].some((text) => text && plain(text).includes(wanted))
  );
}

/**
 * @param {ClassRoom} room @param {Order} order @param {string} [words] that a student's name must have
 * @returns {Student[]}
 */
export function ordered({ students, steps }, order, words = '') {
  const byNumber = (/** @type {Student} */ a, /** @type {Student} */ b) => a.number - b.number;
  const compare = {
    joined: byNumber,
    name: (/** @type {Student} */ a, /** @type {Student} */ b) => a.name.localeCompare(b.name) || byNumber(a, b),
    points: (/** @type {Student} */ a, /** @type {Student} */ b) => b.points - a.points || byNumber(a, b),
    help: (/** @type {Student} */ a, /** @type {Student} */ b) =>
      needOf(b, steps) - needOf(a, steps) || a.points - b.points || byNumber(a, b),
  }[order];
  return students.filter((student) => isMeant(student, words)).sort(compare);
}

/**
 * How a class stands to a goal.
 * @typedef {{step: Step, index: number, goal: number, label: string, tried: number, met: number, stuck: number}}
 *   Standing index: of the step; tried: how many have handed in; stuck: how many of these are in this step now and
 *   have not met the goal
 */

/** @param {ClassRoom} room @returns {Standing[]} all goals in the lab's order */
export function standings({ steps, students }) {
  return steps.flatMap((step, index) =>
    step.goals.map((of, goal) => {
      const those = students.filter((student) => doneIn(student, step.name).attempts > 0);
      const missing = those.filter((student) => doneIn(student, step.name).goals[goal] !== true);
      return {
        step,
        index,
        goal,
        label: goalText(of),
        tried: those.length,
        met: those.length - missing.length,
        stuck: missing.filter((student) => student.step === step.name).length,
      };
    }),
  );
}

/**
 * The goal that holds the class up: the one that most have tried in vain and are still at; of equals the one
 * that fewest have met, then the earliest.
 * @param {readonly Standing[]} all @returns {Standing|null} null where nobody is held up
 */
export const heldUp = (all) =>
  all.filter(({ stuck }) => stuck > 0).sort((a, b) => b.stuck - a.stuck || a.met / a.tried - b.met / b.tried)[0] ??
  null;

/** How many are in each step. @param {ClassRoom} room @returns {number[]} */
export const crowd = ({ steps, students }) =>
  steps.map(({ name }) => students.filter(({ step }) => step === name).length);

/**
 * The next answer that waits for a mark, beginning after a student; the first again after the last.
 * @param {ClassRoom} room @param {number|null} [after] a student's id
 * @returns {{id: number, step: string}|null}
 */
export function nextToMark({ students, steps }, after = null) {
  const at = students.findIndex(({ id }) => id === after);
  for (const student of [...students.slice(at + 1), ...students.slice(0, at + 1)])
    for (const { name } of steps) if (doneIn(student, name).to_mark > 0) return { id: student.id, step: name };
  return null;
}
