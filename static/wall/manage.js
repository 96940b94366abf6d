/** What an instructor does with a whole class: results to take away, close, reopen, the secret link, delete. */
import { say, t } from '../text/index.js';
import { button, copyText, h, saveFile } from '../ui/index.js';
import { reasonOf } from './calls.js';
import { keep, keptClass, secretLink } from './kept.js';
import { actButton, labelled, linkField, openModal, outcome } from './modal.js';
import { classSheet, printSheets, studentSheet } from './sheets.js';
import { dateOf, dayText, forTimeField, timeText, typed } from './words.js';

/** @typedef {import('./shapes.js').ClassRoom} ClassRoom */
/** @typedef {{room: () => ClassRoom, calls: import('./calls.js').ClassCalls, onGone: () => void,
 *   notes: () => Promise<import('./shapes.js').Notes>}} Around */

const FILES = /** @type {const} */ ([
  ['plain', 'CSV, one column a step', 'csv'],
  ['moodle', 'CSV for Moodle’s grade import', 'csv'],
  ['canvas', 'CSV for Canvas’ gradebook', 'csv'],
  ['json', 'All that is kept, as JSON', 'json'],
]);

/** Files and sheets of the results. @param {Around} around */
export function openResults({ room, calls, notes }) {
  const modal = openModal('results', t('Results'));
  const told = outcome('results-told');
  const fail = (/** @type {unknown} */ error) => told.say(reasonOf(error), true);
  const file = (/** @type {typeof FILES[number]} */ [kind, label, end]) =>
    actButton(
      { 'data-testid': `file-${kind}` },
      label,
      async () => {
        saveFile(`class-${room().code}-${kind}.${end}`, await calls.file(kind));
        told.say(t('Saved among your downloads.'));
      },
      fail,
    );
  modal.body.append(
    h('h3', {}, 'Files'),
    h('div', { class: 'stack' }, FILES.map(file)),
    h('h3', {}, 'On paper'),
    h(
      'div',
      { class: 'stack' },
      button(
        { 'data-testid': 'print-class', onclick: () => printSheets([classSheet(room())]) },
        'The class on one sheet',
      ),
      actButton(
        { 'data-testid': 'print-all' },
        'A sheet of each student',
        async () => {
          const [{ students }, lab] = await Promise.all([calls.all(), notes()]);
          const names = (/** @type {string} */ a, /** @type {string} */ b) => a.localeCompare(b);
          printSheets(
            students.toSorted((a, b) => names(a.name, b.name)).map((whole) => studentSheet(room(), whole, lab)),
          );
        },
        fail,
      ),
    ),
    told.node,
  );
}

/** @param {ClassRoom} room */
function stateText({ open, closes }) {
  if (!open) return t('Closed: what students do now is practice. What they hand in counts if you reopen the class.');
  return closes ? say`Open until ${timeText(closes)}.` : t('Open, until you close it.');
}

/** @param {Around} around */
function closing({ room, calls }) {
  const told = outcome('closing-told');
  const state = h('p', { 'data-testid': 'class-state' });
  const when = h('input', { type: 'datetime-local', 'data-testid': 'closes' });
  const fail = (/** @type {unknown} */ error) => told.say(reasonOf(error), true);
  const act = (/** @type {string} */ testid, /** @type {string} */ label, /** @type {() => Promise<unknown>} */ f) =>
    actButton({ 'data-testid': testid }, label, f, fail);
  const close = act('close-class', 'Close now', async () => calls.change({ open: false }));
  const reopen = act('reopen-class', 'Reopen', async () => calls.change({ open: true, closes: null }));
  const at = act('close-at', 'Close at this time', async () => {
    const date = dateOf(when.value);
    if (!date) return told.say(t('Choose a day and a time.'), true);
    await calls.change({ open: true, closes: date.toISOString() });
    told.say('');
  });
  const form = h('div', { class: 'row wrap' }, labelled('Closes at', when), at);
  const show = () => {
    const { open, closes } = room();
    state.textContent = stateText(room());
    close.hidden = !open;
    reopen.hidden = open && !closes;
    reopen.textContent = open ? t('Do not close by itself') : t('Reopen');
    if (document.activeElement !== when) when.value = forTimeField(dateOf(closes) ?? new Date(Date.now() + 3.6e6));
  };
  show();
  return {
    show,
    node: h(
      'section',
      {},
      h('h3', {}, 'Open or closed'),
      state,
      h('div', { class: 'row' }, close, reopen),
      form,
      told.node,
    ),
  };
}

/** @param {Around} around */
function naming({ room, calls }) {
  const told = outcome('title-told');
  const title = h('input', { maxlength: 100, value: room().title, 'data-testid': 'new-title', translate: 'no' });
  const save = actButton(
    { 'data-testid': 'save-title' },
    'Save',
    async () => {
      if (!title.value.trim()) return told.say(t('Give the class a title.'), true);
      await calls.change({ title: title.value.trim() });
      told.say(t('Saved.'));
    },
    (error) => told.say(reasonOf(error), true),
  );
  return h('section', {}, h('h3', {}, 'Title'), h('div', { class: 'row' }, labelled('Title', title), save), told.node);
}

/** @param {Around} around */
function secret({ room, calls }) {
  const told = outcome('secret-told');
  const of = () => secretLink(location.href, { code: calls.code, key: calls.key });
  const place = h('div', {}, linkField('instructor-link', 'Your link', of(), copyText));
  return h(
    'section',
    {},
    h('h3', {}, 'Your secret link'),
    h(
      'p',
      {},
      'It opens this wall on another machine. Whoever has it can read, mark and delete everything; nobody else can.',
    ),
    place,
    actButton(
      { 'data-testid': 'rotate' },
      'Make a new one; this one ends',
      async () => {
        await calls.rotate();
        const { key } = calls;
        keep({ ...(keptClass(calls.code) ?? { title: room().title, ends: room().ends }), code: calls.code, key });
        place.replaceChildren(linkField('instructor-link', 'Your link', of(), copyText));
        told.say(t('The old link has ended, everywhere.'));
      },
      (error) => told.say(reasonOf(error), true),
    ),
    told.node,
  );
}

/** @param {Around} around */
function deleting({ room, calls, onGone }) {
  const told = outcome('delete-told');
  const typedTitle = h('input', { autocomplete: 'off', 'data-testid': 'delete-title' });
  const yes = actButton(
    { class: 'danger', 'data-testid': 'delete-class', disabled: true },
    'Delete the class',
    async () => {
      await calls.remove();
      onGone();
    },
    (error) => told.say(reasonOf(error), true),
  );
  const right = () => typedTitle.value.trim() === room().title.trim();
  typedTitle.addEventListener('input', () => (yes.disabled = !right()));
  return h(
    'section',
    { class: 'danger-zone' },
    h('h3', {}, 'Delete'),
    h(
      'p',
      {},
      say`Deletes all students with all their work, for good. By itself this happens on ${dayText(room().ends)}.`,
    ),
    h('p', {}, h('span', {}, 'To delete it, type its title: '), typed(room().title, 'title-to-type')),
    h('div', { class: 'row wrap' }, labelled('Its title', typedTitle), yes),
    told.node,
  );
}

/** @param {Around} around @returns {{show: () => void, close: () => void}} */
export function openManage(around) {
  const modal = openModal('manage', t('This class'));
  const times = closing(around);
  modal.body.append(times.node, naming(around), secret(around), deleting(around));
  return { show: times.show, close: modal.close };
}

/** The instructor's own text of the lab. @param {Around} around */
export async function openNotes({ room, notes }) {
  const modal = openModal('notes', say`${room().lab.title}: for the instructor`, { kind: 'large' });
  const told = outcome('notes-told');
  modal.body.append(told.node);
  told.say(t('Fetching…'));
  try {
    const [lab, { markdown }] = await Promise.all([notes(), import('../markdown/index.js')]);
    const { instructor, math } = lab;
    told.say(instructor ? '' : t('This lab has no text for the instructor.'));
    modal.body.append(
      h('div', { class: 'prose', 'data-testid': 'notes-text' }, markdown(instructor ?? '', math ?? {})),
    );
  } catch (error) {
    told.say(reasonOf(error), true);
  }
}
