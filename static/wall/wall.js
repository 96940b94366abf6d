/**
 * The living wall of one class: who is where, which goals are met, what holds the class up. It follows the server's
 * events; for the projector it knows no names.
 * @typedef {import('./shapes.js').ClassRoom} ClassRoom
 * @typedef {import('./shapes.js').Student} Student
 */
import { say, t } from '../text/index.js';
import { setText } from '../ui/index.js';
import { ClassCalls, isGone, reasonOf, statusOf } from './calls.js';
import { Frame } from './frame.js';
import { GoalsPanel } from './goals_panel.js';
import { Grid, presenceText } from './grid.js';
import { forget, keep, secretLink } from './kept.js';
import { openManage, openNotes, openResults } from './manage.js';
import { PolesPlane } from './plane.js';
import { printSheets, studentSheet } from './sheets.js';
import { changed, nextToMark, ordered, toMark } from './state.js';
import { Feed } from './stream.js';
import { StudentDialog } from './student.js';
import { dateOf, maskOf, timeText } from './words.js';

const MINUTE = 60_000;

export class Wall {
  /** @type {ClassRoom|null} */ room = null;
  /** @type {Student[]} in the order that is shown */ #shown = [];
  /** @type {StudentDialog|null} */ #dialog = null;
  /** @type {ReturnType<typeof openManage>|null} */ #manage = null;
  /** @type {Promise<import('./shapes.js').Notes>|null} */ #notes = null;
  #skew = 0;
  #heardAt = '–';
  #scheduled = false;

  /**
   * @param {{code: string, key: string, masked: boolean, tell: (words: string, bad?: boolean) => void,
   *   onChange: (room: ClassRoom) => void, onGone: (words: string) => void}} of
   */
  constructor(of) {
    this.of = of;
    this.calls = new ClassCalls(of.code, of.key);
    const hands = {
      onOpen: (/** @type {number} */ id) => this.open(id),
      onPoint: (/** @type {number|null} */ id) => this.#point(id),
    };
    this.grid = new Grid(hands);
    this.goals = new GoalsPanel();
    this.plane = new PolesPlane(hands);
    const around = {
      room: () => /** @type {ClassRoom} */ (this.room),
      calls: this.calls,
      onGone: () => this.#gone(t('The class is deleted.')),
      notes: () => this.notes(),
    };
    const acts = {
      render: () => this.#schedule(),
      mark: () => this.#mark(),
      results: () => openResults(around),
      notes: () => void openNotes(around),
      link: () => secretLink(location.href, this.calls),
      manage: () => void (this.#manage = openManage(around)),
    };
    this.frame = new Frame(of, acts, this.grid.node, [this.goals.summary, this.plane.node, this.goals.node]);
    this.node = this.frame.node;
    this.feed = new Feed({
      open: (signal) => this.calls.events(signal),
      onEvent: (event) => this.#heard(event.event, event.data),
      onStatus: (connected) => this.#status(connected),
      onRefused: (error) => this.#refused(error),
    });
    this.ticking = setInterval(() => this.grid.tick(this.now), MINUTE / 2);
    this.feed.start();
  }

  /** The server's time, ms. */
  get now() {
    return Date.now() + this.#skew;
  }

  /** What the lab says to its instructor; where it could not be fetched, the next call tries again. */
  notes() {
    this.#notes ??= this.calls.lab().catch((error) => {
      this.#notes = null;
      throw error;
    });
    return this.#notes;
  }

  stop() {
    clearInterval(this.ticking);
    this.feed.stop();
    this.#dialog?.modal.close();
    this.#manage?.close();
  }

  /** @param {string} event @param {string} data */
  #heard(event, data) {
    if (event === 'deleted') return this.#gone(t('The class is deleted.'));
    if (event === 'stale') return this.#status(false);
    if (event !== 'class' && event !== 'change') return;
    this.#status(true);
    this.#heardAt = timeText(new Date().toISOString());
    const told = JSON.parse(data);
    const before = this.room;
    if (event === 'change' && !before) return;
    this.room = event === 'class' ? told : changed(/** @type {ClassRoom} */ (before), told);
    const at = dateOf(told.at);
    if (at) this.#skew = at.getTime() - Date.now();
    const id = this.#dialog?.id;
    const mine = (/** @type {ClassRoom|null} */ room) => room?.students.find((student) => student.id === id);
    if (id && JSON.stringify(mine(before)?.steps) !== JSON.stringify(mine(this.room)?.steps)) this.#dialog?.refresh();
    this.#schedule();
  }

  #schedule() {
    if (this.#scheduled) return;
    this.#scheduled = true;
    requestAnimationFrame(() => {
      this.#scheduled = false;
      if (this.room) this.#render(this.room);
    });
  }

  /** @param {ClassRoom} room */
  #render(room) {
    const { masked, code } = this.of;
    const { frame } = this;
    const first = this.node.hidden;
    this.node.hidden = false;
    frame.title.textContent = room.title;
    setText(frame.facts, say`${this.#stateText(room)} · ${presenceText(room)}`);
    this.#shown = ordered(room, frame.wanted, masked ? '' : frame.search.value);
    this.grid.show(room, this.#shown, { masked, now: this.now });
    frame.nobody.hidden = room.students.length > 0;
    this.goals.show(room);
    this.plane.show(room.students, (student) => (masked ? maskOf(student) : student.name));
    const waiting = room.students.reduce((sum, student) => sum + toMark(student), 0);
    frame.marking.hidden = masked || waiting === 0;
    setText(frame.marking, say`${waiting} to mark`);
    this.#manage?.show();
    if (first) keep({ code, key: this.calls.key, title: room.title, ends: room.ends });
    this.of.onChange(room);
  }

  /** @param {ClassRoom} room */
  #stateText({ open, closes, lab, minutes, students }) {
    const began = students
      .map(({ joined }) => dateOf(joined)?.getTime() ?? Infinity)
      .reduce((a, b) => Math.min(a, b), Infinity);
    const since = Number.isFinite(began) ? Math.max(0, Math.floor((this.now - began) / MINUTE)) : null;
    return [
      lab.title,
      minutes ? (since === null || since > 240 ? say`${minutes} min` : say`minute ${since + 1} of ${minutes}`) : '',
      open ? (closes ? say`open until ${timeText(closes)}` : t('open')) : t('closed'),
    ]
      .filter(Boolean)
      .join(' · ');
  }

  /** @param {number|null} id */
  #point(id) {
    this.grid.point(id);
    this.plane.point(id);
  }

  /** @param {number} id @param {string} [step] */
  open(id, step) {
    if (this.of.masked) return;
    if (this.#dialog) return this.#dialog.goTo(id, step);
    const dialog = new StudentDialog(id, {
      room: () => /** @type {ClassRoom} */ (this.room),
      calls: this.calls,
      now: () => this.now,
      beside: (from, by) => this.#shown[this.#shown.findIndex((student) => student.id === from) + by]?.id ?? null,
      nextToMark: (after) => (this.room ? nextToMark(this.room, after) : null),
      notes: () => this.notes(),
      print: (whole, notes) => this.room && printSheets([studentSheet(this.room, whole, notes)]),
      onClose: () => (this.#dialog = null),
    });
    this.#dialog = dialog;
    if (step) dialog.goTo(id, step);
  }

  #mark() {
    const next = this.room && nextToMark(this.room);
    if (next) this.open(next.id, next.step);
  }

  /** @param {boolean} connected */
  #status(connected) {
    this.node.classList.toggle('stale', !connected);
    const since = this.room
      ? say`No connection to the server. This is the wall of ${this.#heardAt}; it goes on by itself.`
      : t('No connection to the server. The page tries again by itself.');
    this.of.tell(connected ? '' : since, !connected);
  }

  /** @param {unknown} error @returns {boolean} whether it is final */
  #refused(error) {
    const status = statusOf(error);
    if (isGone(error)) {
      this.#gone(t('There is no class with this code. It may have ended, or was deleted.'));
      return true;
    }
    if (this.calls.rotating || (status !== 401 && status !== 403)) return false;
    this.of.onGone(reasonOf(error));
    return true;
  }

  /** @param {string} words */
  #gone(words) {
    forget(this.of.code);
    this.of.onGone(words);
  }
}
