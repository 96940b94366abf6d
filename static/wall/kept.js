/**
 * The classes that this browser has the instructor's link of, and what an address of this page says. The secret stands
 * in an address for a moment only: it is kept here and taken out of what a projector would show.
 * @typedef {import('./shapes.js').Known} Known
 */
import { recall, remember } from '../ui/index.js';

const MEMORY = 'classes';
const CODE = /^[A-Z0-9]{4,12}$/;

/** @param {unknown} v @returns {v is Known} */
const isKnown = (v) => {
  const of = /** @type {Record<string, unknown>} */ (v ?? {});
  return typeof of.code === 'string' && CODE.test(of.code) && typeof of.key === 'string' && of.key !== '';
};

/** What was kept, as far as it can be read; the newest first. @param {string|null} text @returns {Known[]} */
export function readKept(text) {
  try {
    const all = JSON.parse(text ?? '[]');
    return Array.isArray(all)
      ? all
          .filter(isKnown)
          .map(({ code, key, title, ends }) => ({ code, key, title: String(title ?? ''), ends: String(ends ?? '') }))
      : [];
  } catch {
    return [];
  }
}

/** @returns {Known[]} */
export const keptClasses = () => readKept(recall(MEMORY));

/** @param {string} code @returns {Known|undefined} */
export const keptClass = (code) => keptClasses().find((one) => one.code === code);

/** As what is known newest. @param {Known} one */
export function keep(one) {
  remember(MEMORY, JSON.stringify([one, ...keptClasses().filter(({ code }) => code !== one.code)].slice(0, 200)));
}

/** @param {string} code */
export function forget(code) {
  remember(MEMORY, JSON.stringify(keptClasses().filter((one) => one.code !== code)));
}

/**
 * What an address leads to: nothing in it: a new class; a class' wall, with names or for the projector; its join sheet.
 * @typedef {{kind: 'new'}|{kind: 'wall'|'projector'|'join', code: string, key?: string}} Place
 */

/** @param {string} hash @returns {Place} */
export function placeOf(hash) {
  const asked = new URLSearchParams(hash.replace(/^#/, ''));
  const code = (asked.get('class') ?? '').trim().toUpperCase();
  if (!CODE.test(code)) return { kind: 'new' };
  const view = asked.get('view');
  const kind = view === 'join' || view === 'projector' ? view : 'wall';
  const key = asked.get('key');
  return key ? { kind, code, key } : { kind, code };
}

/** The address' fragment of a place, without any secret. @param {Place} place */
export const hashOf = (place) =>
  place.kind === 'new' ? '#' : `#class=${place.code}${place.kind === 'wall' ? '' : `&view=${place.kind}`}`;

/** The instructor's secret link. @param {string} page this page's address @param {{code: string, key: string}} of */
export const secretLink = (page, { code, key }) =>
  new URL(`#class=${code}&key=${encodeURIComponent(key)}`, page.replace(/#.*/s, '')).href;

/** Where students go: the page beside this one. @param {string} page this page's address @param {string} [hash] */
export const studentsPage = (page, hash = '') => new URL(`./${hash}`, page.replace(/[?#].*/s, '')).href;

/** An address as one says it: without what browsers add by themselves. @param {string} address */
export const spoken = (address) => address.replace(/^http:\/\//, '').replace(/\/$/, '');

/** Whether an address is of this machine alone, so that no student reaches it. @param {string} page */
export const isOwnMachine = (page) => /^(localhost|127\.[\d.]+|\[::1\])$/.test(new URL(page).hostname);
