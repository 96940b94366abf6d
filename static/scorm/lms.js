/**
 * The learning management system (LMS) that has opened this page, by SCORM 1.2: it hands out an object `API` in a
 * window above this one, or in the window that opened it. All its values are text, and so is whether a call has worked.
 * Without one, or with one that refuses, the page goes on and nothing is kept. Pure, but for the windows it is given.
 *
 * @typedef {object} Api  of SCORM 1.2; "true" and "false" are words here
 * @property {(nothing: '') => string} LMSInitialize
 * @property {(nothing: '') => string} LMSFinish
 * @property {(element: string) => string} LMSGetValue
 * @property {(element: string, value: string) => string} LMSSetValue
 * @property {(nothing: '') => string} LMSCommit
 * @property {() => string} LMSGetLastError
 * @property {(code: string) => string} LMSGetErrorString
 *
 * @typedef {object} Frame  what is looked at in a window
 * @property {Api|null} [API]
 * @property {Frame|null} [parent]  itself, where none is above
 * @property {Frame|null} [opener]
 * @property {Frame|null} [top]
 *
 * @typedef {'incomplete'|'completed'|'passed'} Status
 */

/** So many windows above are looked at, as ADL's own search has it. */
const HIGHEST = 7;

/**
 * What a window of another site does not show is not there.
 * @template T
 * @param {() => T} look
 */
function seen(look) {
  try {
    return look() ?? null;
  } catch {
    return null;
  }
}

/** @param {Frame|null} frame @returns {Api|null} */
function apiFrom(frame) {
  for (let up = 0; frame && up <= HIGHEST; up++) {
    const here = frame;
    const found = seen(() => here.API);
    if (found) return found;
    const above = seen(() => here.parent);
    frame = above === here ? null : above;
  }
  return null;
}

/** In the windows above, then in those from which this one was opened. @param {Frame} frame @returns {Api|null} */
export const findApi = (frame) =>
  apiFrom(frame) ?? apiFrom(seen(() => frame.opener)) ?? apiFrom(seen(() => frame.top?.opener));

/**
 * A span of time as the standard writes it, HHHH:MM:SS.SS.
 * @param {number} ms
 */
export function timespan(ms) {
  const hundredths = Math.max(0, Math.round(ms / 10));
  const two = (/** @type {number} */ n) => String(n).padStart(2, '0');
  const hours = Math.min(9999, Math.floor(hundredths / 360_000));
  return (
    `${String(hours).padStart(4, '0')}:${two(Math.floor(hundredths / 6000) % 60)}:` +
    `${two(Math.floor(hundredths / 100) % 60)}.${two(hundredths % 100)}`
  );
}

export class Lms {
  #api;
  #began;
  #open = false;

  /**
   * @param {Api|null} api
   * @param {() => number} [now]  ms
   */
  constructor(api, now = () => performance.now()) {
    this.#api = api;
    this.now = now;
    this.#began = now();
    /** What the LMS has refused last, in its own words; empty: nothing. */
    this.trouble = '';
  }

  /** Whether there is one at all. */
  get found() {
    return this.#api !== null;
  }

  /** Whether a session is open, in which it can be told something. */
  get open() {
    return this.#open;
  }

  /**
   * Begins the session.
   * @returns {{id: string, name: string, suspended: string, status: string, kept: boolean}|null} who learns, what was
   *   kept when they left, and whether anything will be kept: not in a review. Null without an LMS
   */
  begin() {
    this.#open = this.#said(seen(() => this.#api?.LMSInitialize('')));
    if (!this.#open) return null;
    const status = this.#value('cmi.core.lesson_status');
    const mode = this.#value('cmi.core.lesson_mode'); // empty where an LMS does not know it
    return {
      id: this.#value('cmi.core.student_id'),
      name: this.#value('cmi.core.student_name'),
      suspended: this.#value('cmi.suspend_data'),
      status,
      kept: mode !== 'review' && mode !== 'browse',
    };
  }

  /**
   * Says how far the work is, and has it kept.
   * @param {{status: Status, score?: number, suspended: string}} how  score: 0 to 100; absent: nothing handed in yet
   * @returns {boolean} whether the LMS has taken all of it
   */
  tell({ status, score, suspended }) {
    if (!this.#open) return false;
    this.trouble = '';
    /** @type {[string, string][]} */
    const values = [
      ['cmi.suspend_data', suspended],
      ['cmi.core.lesson_status', status],
      // without it an LMS need not give back what was kept
      ['cmi.core.exit', 'suspend'],
    ];
    if (score !== undefined)
      values.push(
        ['cmi.core.score.min', '0'],
        ['cmi.core.score.max', '100'],
        ['cmi.core.score.raw', String(Math.round(10 * score) / 10)],
      );
    const taken = values.map(([element, value]) => this.#set(element, value)).every(Boolean);
    return this.#commit() && taken;
  }

  /** Ends the session; nothing can be told after that. */
  end() {
    if (!this.#open) return;
    this.#set('cmi.core.session_time', timespan(this.now() - this.#began));
    this.#commit();
    this.#open = false;
    this.#said(seen(() => this.#api?.LMSFinish('')));
  }

  #commit() {
    return this.#said(seen(() => this.#api?.LMSCommit('')));
  }

  /** @param {string} element @returns {string} empty where the LMS has none */
  #value(element) {
    return String(seen(() => this.#api?.LMSGetValue(element)) ?? '');
  }

  /** @param {string} element @param {string} value */
  #set(element, value) {
    return this.#said(
      seen(() => this.#api?.LMSSetValue(element, value)),
      element,
    );
  }

  /**
   * Whether a call has worked; one that throws, as where the LMS's window has gone, has not.
   * @param {unknown} answer  "true", in some LMSs true @param {string} [about]
   */
  #said(answer, about = '') {
    if (String(answer) === 'true') return true;
    const code = String(seen(() => this.#api?.LMSGetLastError()) ?? '');
    const words = seen(() => this.#api?.LMSGetErrorString(code)) || code;
    this.trouble = [about, words].filter(Boolean).join(': ');
    return false;
  }
}
