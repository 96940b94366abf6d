/**
 * A lab in a class: the server keeps and marks. Where it cannot be reached, or the class is closed, this browser keeps
 * what is done, and sends it when it can.
 * @typedef {import('./shapes.js').Desk} Desk
 * @typedef {import('./shapes.js').Lab} Lab
 * @typedef {import('./shapes.js').Kept} Kept
 * @typedef {import('./shapes.js').Marked} Marked
 * @typedef {import('./shapes.js').Standing} Standing
 * @typedef {import('./shapes.js').Answers} Answers
 * @typedef {import('../bodies/bodies.js').Body} Body
 * @typedef {{student: string, id: number, name: string, rig: Body, lab: Lab, steps: Record<string, Kept>,
 *   step?: string|null, open: boolean, closed_at?: string|null}} Joined
 * @typedef {import('../contract.js').ClassAbout} About
 * @typedef {{step: string, design: Body, answers: Answers, seq: number, sent: boolean}} Draft
 */
import { count, say, t } from '../text/index.js';
import { call, fileOf, ProblemError } from '../net/index.js';
import { isForgetful, newId, read, write } from './kept.js';
import { Outbox } from './outbox.js';

const DRAFT_MS = 3000;
const HEAL_MS = 20_000;
const CALM_MS = 60_000;
const AWAY = 'away';

/** @param {string} code @param {string} [rest] */
const path = (code, rest = '') => `api/v1/classes/${encodeURIComponent(code)}${rest}`;

/** What anybody may know of a class. @param {string} code @returns {Promise<About>} */
export const aboutClass = (code) => call(path(code, '/about'));

/** Whoever this browser knows in a class. @param {string} code @returns {{student: string, name: string}|null} */
export const known = (code) => read(`class.${code}`, null);
/** Nobody is known here any more. What waits to be sent stays. @param {string} code */
export const forget = (code) => write(`class.${code}`, null);
/** @param {string} code @param {string} student a secret @param {string} [name] */
export const remembered = (code, student, name = '') => write(`class.${code}`, { student, name });

/**
 * What a refusal means.
 * @param {unknown} error
 * @returns {Standing['kind']|'refused'}
 */
export function meaning(error) {
  if (!(error instanceof ProblemError)) return AWAY;
  const { status = 0, code } = error.problem;
  if (code === 'class_closed') return 'closed';
  if (status === 401 || status === 403 || status === 404 || status === 410) return 'gone';
  return status === 429 || status === 408 || status >= 500 ? AWAY : 'refused';
}

/** @param {import('./outbox.js').Attempt} attempt @returns {Promise<Marked>} */
const handIn = ({ code, ...attempt }) =>
  call(path(code, '/attempts'), attempt).catch((error) => {
    throw meaning(error) === 'refused' ? Object.assign(error, { final: true }) : error;
  });

/** When, in words. @param {string|null|undefined} time */
function clock(time) {
  const date = new Date(time ?? NaN);
  if (Number.isNaN(date.getTime())) return '';
  const today = date.toDateString() === new Date().toDateString();
  return today
    ? date.toLocaleTimeString([], { timeStyle: 'short' })
    : date.toLocaleString([], { dateStyle: 'medium', timeStyle: 'short' });
}

/** @implements {Desk} */
export class ClassDesk {
  /** @type {Standing['kind']} */ #kind = 'fine';
  /** @type {string|null|undefined} */ #closed;
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #drafting;
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #polling;
  #gone = new AbortController();
  #tell = () => {};
  /** @type {import('./shapes.js').Arrived} */ #arrived = () => {};
  outbox = new Outbox(handIn);

  /**
   * Who is known by a secret, where they left off; or somebody who joins.
   * @param {string} code
   * @param {{student: string} | {name: string, email?: string, login?: string}} who
   */
  static async open(code, who) {
    const id = newId(); // where the answer is lost and the page asks again, nobody joins twice
    const body = 'student' in who ? who : { ...who, id };
    const ask = () => call(path(code, '/join'), body);
    return new ClassDesk(
      code,
      await ask().catch((error) => (meaning(error) === AWAY && 'id' in body ? ask() : Promise.reject(error))),
    );
  }

  /** @param {string} code @param {Joined} joined */
  constructor(code, { student, id, name, rig, lab, steps, step, open, closed_at }) {
    this.code = code;
    this.student = student;
    this.lab = lab;
    this.rig = rig;
    this.kept = steps;
    this.at = step ?? '';
    this.who = name;
    this.draftName = `draft.${code}.${id}`;
    remembered(code, student, this.who);
    this.#resume();
    this.#hears({ open, closed_at });
    const { signal } = this.#gone;
    addEventListener('online', () => this.heal(), { signal });
    addEventListener('storage', () => this.#tell(), { signal }); // another tab of this student
    addEventListener('pagehide', () => this.#send(), { signal });
    this.heal(); // what an earlier visit could not send
  }

  /** What this browser could not send before it was closed is newer than what the server knows. */
  #resume() {
    const draft = read(this.draftName, /** @type {Draft|null} */ (null));
    if (!draft || draft.sent || !this.lab.steps.some(({ name }) => name === draft.step)) return;
    this.at = draft.step;
    this.kept = {
      ...this.kept,
      [draft.step]: { ...this.kept[draft.step], design: draft.design, answers: draft.answers },
    };
  }

  get link() {
    const { origin, pathname } = location;
    return `${origin}${pathname}#class=${this.code}&me=${this.student}`;
  }

  /** @returns {Standing} */
  get standing() {
    const waiting = this.#mine.length;
    const kept = waiting ? ` ${count(waiting, '{0} attempt waits here.', '{0} attempts wait here.')}` : '';
    const since = clock(this.#closed);
    switch (this.#kind) {
      case 'closed':
        return {
          kind: 'closed',
          words:
            (since ? say`This class is closed since ${since}.` : t('This class is closed.')) +
            ` ${t('Go on as practice: what you hand in stays here, and is sent if it opens again.')}${kept}`,
        };
      case 'gone':
        return {
          kind: 'gone',
          words: t(
            'This class does not know you any more: it was deleted, or your link renewed. Ask your instructor for a ' +
              'new link. Your design stays here.',
          ),
        };
      case AWAY:
        return {
          kind: AWAY,
          words: `${t(
            isForgetful()
              ? 'No connection, and this browser keeps nothing. Leave this page open until your work is sent.'
              : 'No connection. Your work is kept in this browser, and sent when it returns.',
          )}${kept}`,
        };
      default:
        if (isForgetful())
          return {
            kind: 'waiting',
            words: t('This browser keeps nothing. Copy your link: it is the way back to your work.') + kept,
          };
        return waiting ? { kind: 'waiting', words: kept.trim() } : { kind: 'fine', words: '' };
    }
  }

  get #mine() {
    return this.outbox.waiting.filter((attempt) => this.#isMine(attempt));
  }

  /** @param {import('./outbox.js').Attempt} attempt */
  #isMine = ({ code, student }) => code === this.code && student === this.student;

  /** @param {unknown} [error] undefined: all is well */
  #stand(error) {
    const kind = error === undefined ? 'fine' : meaning(error);
    this.#kind = kind === 'refused' ? 'fine' : kind;
    if (error instanceof ProblemError && kind === 'closed') {
      const { closed_at } = /** @type {{closed_at?: string}} */ (error.problem);
      this.#closed = closed_at ?? this.#closed;
    }
    this.#poll();
    this.#tell();
  }

  /** @param {{open: boolean, closed_at?: string|null}} state of the class */
  #hears({ open, closed_at }) {
    this.#kind = open ? 'fine' : 'closed';
    this.#closed = open ? undefined : closed_at;
    this.#poll();
  }

  /** Looks again after a while: soon where something is amiss. */
  #poll() {
    clearTimeout(this.#polling);
    if (this.#gone.signal.aborted) return;
    this.#polling = setTimeout(() => this.heal(), this.#kind === 'fine' ? CALM_MS : HEAL_MS);
  }

  /** Asks how things stand, and sends what waits. */
  async heal() {
    try {
      /** @type {Joined} */ const mine = await call(path(this.code, '/mine'), undefined, 'GET', this.student);
      if (this.#gone.signal.aborted) return;
      for (const [step, { best, hand, attempts }] of Object.entries(mine.steps ?? {}))
        this.#keep(step, { best, hand, attempts });
      this.#hears(mine);
      this.#tell();
    } catch (error) {
      this.#stand(error);
      return;
    }
    if (this.#kind !== 'fine') return;
    const why = await this.#flush((...late) => this.#arrived(...late));
    if (why !== undefined) this.#stand(why);
    this.#send();
  }

  /** @param {string} step @param {Kept} part */
  #keep(step, part) {
    const said = Object.fromEntries(Object.entries(part).filter(([, v]) => v !== undefined && v !== null));
    this.kept = { ...this.kept, [step]: { ...this.kept[step], ...said } };
  }

  /** @param {string} step @param {Marked} marked */
  #took(step, marked) {
    const { best = marked } = marked;
    this.#keep(step, { best, attempts: (this.kept[step]?.attempts ?? 0) + 1 });
    this.#tell();
  }

  /** @param {(attempt: import('./outbox.js').Attempt, marked: Marked|null, error?: unknown) => void} told */
  #flush(told) {
    return this.outbox.flush(this.#isMine, (attempt, marked, error) => {
      if (marked) this.#took(attempt.step, marked);
      told(attempt, marked, error);
    });
  }

  /** @type {Desk['mark']} */
  async mark(step, design, answers, flight) {
    const { code, student } = this;
    const at = new Date().toISOString();
    const attempt = { id: newId(), code, student, step, design, answers, at, ...(flight && { flight }) };
    this.outbox.put(attempt);
    /** @type {Marked|null} */ let own = null;
    /** @type {unknown} */ let refused;
    const why = await this.#flush(({ id }, marked, error) => {
      if (id === attempt.id) [own, refused] = [marked, error];
    });
    this.#stand(why);
    if (refused) throw refused;
    if (own || why !== undefined) return own;
    own = await handIn(attempt); // another tab has sent it: the same id has the same answer
    this.#took(step, own);
    return own;
  }

  /** @param {string} step */
  flightName(step) {
    return `flight.${this.draftName}.${step}`;
  }

  /** @type {Desk['hint']} */
  async hint(step, hint) {
    /** @type {import('./shapes.js').HintText} */
    const text = await call(path(this.code, '/hints'), { student: this.student, step, hint });
    const { hints = [] } = this.kept[step] ?? {};
    const others = hints.filter((one) => (typeof one === 'number' ? one : one.hint) !== hint);
    this.#keep(step, { hints: [...others, { ...text, hint }] });
    this.#tell();
    return text;
  }

  /** @type {Desk['keep']} */
  keep(step, design, answers) {
    this.at = step;
    this.#keep(step, { design, answers });
    write(this.draftName, /** @type {Draft} */ ({ step, design, answers, seq: Date.now(), sent: false }));
    this.#drafting ??= setTimeout(() => this.#send(), DRAFT_MS);
  }

  /** Where the student is, to the server; what cannot be sent stays for the next time. */
  async #send() {
    clearTimeout(this.#drafting);
    this.#drafting = undefined;
    const draft = read(this.draftName, /** @type {Draft|null} */ (null));
    if (!draft || draft.sent) return;
    const { sent: _sent, ...said } = draft;
    try {
      await call(path(this.code, '/draft'), { student: this.student, ...said }, 'PUT');
      const now = read(this.draftName, /** @type {Draft|null} */ (null));
      if (now?.seq === draft.seq) write(this.draftName, { ...draft, sent: true });
      if (this.#kind === AWAY) this.heal();
    } catch (error) {
      if (meaning(error) !== 'refused') this.#stand(error);
    }
  }

  /** @param {string} step */
  recording(step) {
    return fileOf(path(this.code, `/recording?${new URLSearchParams({ step })}`), undefined, this.student);
  }

  /** @type {Desk['onChange']} */
  onChange(told, arrived) {
    this.#tell = told;
    this.#arrived = arrived;
  }

  leave() {
    this.#send();
    this.#gone.abort();
    clearTimeout(this.#polling);
    this.#tell = () => {};
    this.#arrived = () => {};
  }
}
