/**
 * The server's calls about classes. Secrets travel in headers, never in an address.
 * @typedef {import('./shapes.js').Whole} Whole
 * @typedef {import('./shapes.js').Notes} Notes
 * @typedef {import('./shapes.js').LabCard} LabCard
 * @typedef {import('./shapes.js').About} About
 */
import { ProblemError } from '../net/index.js';
import { messageOf, t } from '../text/index.js';

/** Where no server answers. */
export class Unreached extends Error {}

/**
 * @param {string} path below api/v1/
 * @param {{method?: string, body?: unknown, headers?: Record<string, string>, signal?: AbortSignal}} [how]
 * @returns {Promise<Response>} a good one
 */
async function ask(path, { method, body, headers = {}, signal } = {}) {
  let response;
  try {
    response = await fetch(new URL(`api/v1/${path}`, document.baseURI), {
      method: method ?? (body === undefined ? 'GET' : 'POST'),
      headers: body === undefined ? headers : { 'Content-Type': 'application/json', ...headers },
      body: body === undefined ? undefined : JSON.stringify(body),
      cache: 'no-store',
      signal,
    });
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new Unreached(t('No connection to the server. Nothing was changed. Try again.'));
  }
  if (response.ok) return response;
  const told = await response.json().catch(() => ({}));
  throw new ProblemError({ title: response.statusText, status: response.status, ...told });
}

/** @template T @param {Response} response @returns {Promise<T>} */
async function jsonOf(response) {
  try {
    const text = await response.text();
    return JSON.parse(text);
  } catch {
    throw new Unreached(t('The connection broke off. Try again.'));
  }
}

/** @param {unknown} error @returns {number|undefined} the status with which the server refused */
export const statusOf = (error) => (error instanceof ProblemError ? error.problem.status : undefined);

/** What went wrong and what to do. @param {unknown} error */
export const reasonOf = (error) =>
  error instanceof ProblemError ? [error.message, error.problem.hint].filter(Boolean).join(' ') : messageOf(error);

/** Whether the server knows no such class, or not any more. @param {unknown} error */
export const isGone = (error) => error instanceof ProblemError && error.problem.code === 'unknown_class';

/** @returns {Promise<LabCard[]>} in the course's order */
export const getLabs = async () => jsonOf(await ask('labs'));

/**
 * @param {{lab: string, title: string, closes?: string}} wanted
 * @param {string} [operator] the key that a server may ask for
 * @returns {Promise<{code: string, instructor: string, ends: string}>}
 */
export const makeClass = async (wanted, operator) =>
  jsonOf(await ask('classes', { body: wanted, headers: operator ? { 'Heli2dof-Operator': operator } : {} }));

/** @param {string} code @returns {Promise<About>} */
export const aboutClass = async (code) => jsonOf(await ask(`classes/${encodeURIComponent(code)}/about`));

/** A class, with the instructor's secret. */
export class ClassCalls {
  /** @param {string} code @param {string} key */
  constructor(code, key) {
    this.code = code;
    this.key = key;
    /** Whether the key is about to be another. */ this.rotating = false;
  }

  /** @param {string} rest @param {Parameters<typeof ask>[1]} [how] */
  #ask(rest, how = {}) {
    const path = `classes/${encodeURIComponent(this.code)}${rest}`;
    return ask(path, { ...how, headers: { 'Heli2dof-Secret': this.key, ...how.headers } });
  }

  /** @param {number} id @param {string} [rest] */
  #of(id, rest = '') {
    return `/students/${id}${rest}`;
  }

  /** The class as events. @param {AbortSignal} signal */
  events(signal) {
    return this.#ask('/events', { signal, headers: { Accept: 'text/event-stream' } });
  }

  /** @param {number} id @returns {Promise<Whole>} */
  async student(id) {
    return jsonOf(await this.#ask(this.#of(id)));
  }

  /** @param {number} id @param {{step: string, question: string, points: number, comment: string}} mark */
  async mark(id, mark) {
    await this.#ask(this.#of(id, '/marks'), { body: mark });
  }

  /** A new personal link; the one before ends. @param {number} id @returns {Promise<{student: string}>} */
  async newLink(id) {
    return jsonOf(await this.#ask(this.#of(id, '/link'), { method: 'POST' }));
  }

  /** @param {{open?: boolean, closes?: string|null, title?: string}} change */
  async change(change) {
    await this.#ask('', { method: 'PATCH', body: change });
  }

  /** Takes a new secret of the instructor's; the one before ends. */
  async rotate() {
    this.rotating = true;
    try {
      /** @type {{instructor: string}} */
      const { instructor } = await jsonOf(await this.#ask('/instructor', { method: 'POST' }));
      this.key = instructor;
    } finally {
      this.rotating = false;
    }
  }

  /** The lab with what only its instructor may see. @returns {Promise<Notes>} */
  async lab() {
    return jsonOf(await this.#ask('/lab'));
  }

  /** Everything. @returns {Promise<{students: Whole[]}>} */
  async all() {
    return jsonOf(await this.#ask('/export'));
  }

  /** As a file. @param {'plain'|'moodle'|'canvas'|'json'} kind @returns {Promise<Blob>} */
  async file(kind) {
    const response = await this.#ask(kind === 'json' ? '/export' : `?format=csv&for=${kind}`);
    try {
      return await response.blob();
    } catch {
      throw new Unreached(t('The connection broke off. Try again.'));
    }
  }

  async remove() {
    await this.#ask('', { method: 'DELETE' });
  }

  /** @param {number} id */
  async removeStudent(id) {
    await this.#ask(this.#of(id), { method: 'DELETE' });
  }
}
