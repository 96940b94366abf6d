/** Times, shares and students as the wall says them. */
import { count, fixed, say, t } from '../text/index.js';
import { h } from '../ui/index.js';

/** @typedef {import('./shapes.js').Student} Student */

/** Untrusted text: put in as text, and asked of no catalogue. @param {string} text @param {string} [kind] a class */
export function typed(text, kind) {
  const node = h('span', { class: kind, translate: 'no' });
  node.textContent = text;
  return node;
}

/** @param {number} part @param {number} of @returns {string} a share; a dash of nothing */
export const shareOf = (part, of) => (of > 0 ? `${fixed((100 * part) / of, 0)} %` : '–');

/** Points without needless decimals. @param {number} v */
export const pointsText = (v) => fixed(v, Number.isInteger(v) ? 0 : Number.isInteger(10 * v) ? 1 : 2);

/** With the share. @param {number} points @param {number} of */
export const scoreText = (points, of) =>
  say`${pointsText(points)} of ${pointsText(of)} points (${shareOf(points, of)})`;

/** @param {string|null|undefined} iso @returns {Date|null} */
export function dateOf(iso) {
  const date = new Date(iso ?? NaN);
  return Number.isNaN(date.getTime()) ? null : date;
}

/** @param {Date} a @param {Date} b */
const sameDay = (a, b) => a.toDateString() === b.toDateString();

/** The time of day, with the day where it is another. @param {string|null|undefined} iso @param {Date} [now] */
export function timeText(iso, now = new Date()) {
  const date = dateOf(iso);
  if (!date) return '–';
  const time = date.toLocaleTimeString([], { hour: '2-digit', minute: '2-digit' });
  return sameDay(date, now) ? time : `${date.toLocaleDateString([], { day: 'numeric', month: 'short' })} ${time}`;
}

/** @param {string|null|undefined} iso */
export const dayText = (iso) =>
  dateOf(iso)?.toLocaleDateString([], { day: 'numeric', month: 'long', year: 'numeric' }) ?? '–';

/** How long ago, in minutes, hours or days. @param {string|null|undefined} iso @param {number} now ms */
export function agoText(iso, now) {
  const date = dateOf(iso);
  if (!date) return '–';
  const minutes = Math.max(0, Math.floor((now - date.getTime()) / 60_000));
  if (minutes < 1) return t('just now');
  if (minutes < 120) return say`${minutes} min ago`;
  const hours = Math.floor(minutes / 60);
  return hours < 48 ? say`${hours} h ago` : say`${Math.floor(hours / 24)} days ago`;
}

/** A moment as a field of date and time has it, in this browser's own time. @param {Date} date */
export function forTimeField(date) {
  const local = new Date(date.getTime() - 60_000 * date.getTimezoneOffset());
  return local.toISOString().slice(0, 16);
}

/** What a student is called where names must not be seen. @param {Student} student */
export const maskOf = ({ number }) => say`Student ${number}`;

/** @param {number} n */
export const studentsText = (n) => count(n, '{0} student', '{0} students');

/** @param {number} n */
export const attemptsText = (n) => count(n, '{0} attempt', '{0} attempts');
