/**
 * A student's work as one text that an LMS keeps, `cmi.suspend_data`: SCORM 1.2 has room for 4096 letters. A design is
 * told by what differs from its step's start, as links do. Where that is too long, what is left out first is the middle
 * of long answers, then designs of other steps; points and what is met stay. Pure.
 *
 * @typedef {Record<string, unknown>} Body  a design as requests have it
 * @typedef {object} StepKept
 * @property {Body} [design]  the newest
 * @property {Record<string, string|number|number[]>} [answers]
 * @property {number[]} [hints]  those seen, from 0
 * @property {number} [attempts]
 * @property {number} [points]  of the best attempt
 * @property {(boolean|null)[]} [met]  its goals, then its questions; null: marked by hand
 *
 * @typedef {object} Work
 * @property {number} rig  which of the package's rigs
 * @property {string} at  name of the step where the student is
 * @property {Record<string, StepKept>} steps
 *
 * @typedef {(step: string, designs: Record<string, Body>) => Body|undefined} Starts  what a step starts with, by the
 *   designs of the steps before; undefined: it is no step of this lab
 */
import { differences, leafOf, polesLink, polesOf, setLeaf } from '../link/index.js';

/** Letters that the standard has room for. */
export const MOST = 4096;
const VERSION = 1;
/** Letters of an answer that are kept, in turn, until all has room. */
const ANSWERS = [Infinity, 400, 120, 40];
const MET = { true: '1', false: '0', null: '-' };

/** @typedef {{re: number, im: number}} Complex */
/** Poles as links have them. @param {Body} body */
function compact(body) {
  const { poles, observer, ...rest } = body;
  const flat = (/** @type {unknown} */ some) =>
    Array.isArray(some)
      ? polesLink(some.map((p) => (typeof p === 'number' ? { re: p, im: 0 } : /** @type {Complex} */ (p))))
      : undefined;
  const watched = /** @type {Body|undefined} */ (observer);
  return { ...rest, p: flat(poles), ...(watched && { observer: { ...watched, poles: flat(watched.poles) } }) };
}

/** @param {Body} body @param {Body} start */
const told = (body, start) =>
  differences(compact(body), compact(start))
    .map(([path, text]) => `${path}=${text}`)
    .join('&');

/** @param {string} text @param {Body} start @returns {Body} */
function read(text, start) {
  const body = structuredClone(start);
  for (const part of text.split('&').filter(Boolean)) {
    const at = part.indexOf('=');
    const [path, value] = [part.slice(0, at), part.slice(at + 1)];
    const poles = /(^p|\.poles)$/.test(path) ? polesOf(value.replace(/^"|"$/g, '')) : undefined;
    if (path === 'p') {
      if (poles) body.poles = poles;
    } else setLeaf(body, path, poles ?? leafOf(value));
  }
  return body;
}

/** @param {string} text @param {number} most */
const shortened = (text, most) =>
  text.length <= most ? text : `${text.slice(0, Math.ceil(most / 2))} … ${text.slice(-Math.floor(most / 2))}`;

/** @param {Record<string, string|number|number[]>} answers @param {number} most */
const short = (answers, most) =>
  Object.fromEntries(Object.entries(answers).map(([k, v]) => [k, typeof v === 'string' ? shortened(v, most) : v]));

/**
 * @param {Work} work @param {Starts} starts @param {number} most  of an answer's letters
 * @param {boolean} all  the designs of all steps
 */
function written({ rig, at, steps }, starts, most, all) {
  /** @type {Record<string, Body>} */ const designs = {};
  const kept = Object.entries(steps).map(([name, { design, answers = {}, hints = [], attempts, points, met }]) => {
    const start = starts(name, designs);
    const own = all || name === at ? design : undefined;
    if (own) designs[name] = own; // what is not kept is no start of what comes back
    return [
      name,
      {
        ...(own && start && { d: told(own, start) }),
        ...(Object.keys(answers).length && { a: short(answers, most) }),
        ...(hints.length && { h: hints }),
        ...(attempts && { n: attempts }),
        ...(points !== undefined && { p: points }),
        ...(met && { m: met.map((one) => MET[/** @type {'true'|'false'|'null'} */ (String(one))]).join('') }),
      },
    ];
  });
  return JSON.stringify({ v: VERSION, r: rig, at, s: Object.fromEntries(kept) });
}

/**
 * @param {Work} work  its steps in the lab's order @param {Starts} starts
 * @returns {{text: string, whole: boolean}}  whole: nothing was left out
 */
export function suspend(work, starts) {
  for (const all of [true, false])
    for (const most of ANSWERS) {
      const text = written(work, starts, most, all);
      if (text.length <= MOST) return { text, whole: all && most === Infinity };
    }
  const bare = Object.fromEntries(Object.entries(work.steps).map(([name, own]) => [name, { ...own, answers: {} }]));
  return { text: written({ ...work, steps: bare }, starts, 0, false).slice(0, MOST), whole: false };
}

/**
 * @param {string} text @param {Starts} starts
 * @returns {Work|null} null where it is none of ours; steps that the lab no longer has are left out
 */
export function resume(text, starts) {
  try {
    const { v, r, at, s } = JSON.parse(text);
    if (v !== VERSION || !Number.isInteger(r) || typeof at !== 'string') return null;
    /** @type {Work['steps']} */ const steps = {};
    /** @type {Record<string, Body>} */ const designs = {};
    for (const [name, { d, a, h, n, p, m }] of Object.entries(s)) {
      const start = starts(name, designs);
      if (!start) continue;
      const design = typeof d === 'string' ? read(d, start) : undefined;
      if (design) designs[name] = design;
      steps[name] = {
        ...(design && { design }),
        ...(a && { answers: a }),
        ...(h && { hints: h }),
        ...(n && { attempts: n }),
        ...(p !== undefined && { points: p }),
        ...(m && { met: [...m].map((one) => (one === '-' ? null : one === '1')) }),
      };
    }
    return { rig: r, at, steps };
  } catch {
    return null; // of another page, or cut by an LMS
  }
}
