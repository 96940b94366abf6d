/**
 * A system in a link, and as text of MATLAB. Pure.
 *
 * In a link: parts with `::` between them, each a name and its rows, entries with commas: `A:0,1:-k/m,-b/m::B:0:1/m`.
 * A letter's value is `.m:2`; `p` and `q` are the desired poles and the observer's, `by` the method, `Q`, `R` and `Qz`
 * the weights of a quadratic one, `x` the initial state. No blanks, and nothing that links must escape.
 * @typedef {Omit<import('./wish.js').Wish, 'poles'> & {rows: Record<string, string[][]>,
 *   letters: Record<string, number>, poles: import('../types.js').Complex[]|null}} Plant
 */
import { polesIn, polesWord } from './poles.js';

const MATRICES = ['A', 'B', 'C', 'D'];
const LISTS = ['Q', 'R', 'Qz', 'x'];
const LONGEST = 20_000;

/** @param {Plant} plant */
export function linkText({ rows, letters, poles, observer, method, weights, x0 }) {
  const parts = MATRICES.filter((name) => rows[name]).map(
    (name) => `${name}:${rows[name].map((row) => row.map((v) => v.replace(/\s+/g, '')).join()).join(':')}`,
  );
  for (const [name, value] of Object.entries(letters)) parts.push(`.${name}:${value}`);
  if (poles) parts.push(`p:${polesWord(poles)}`);
  if (observer) parts.push(`q:${polesWord(observer)}`);
  if (method !== 'full-rank') parts.push(`by:${method}`);
  if (weights) parts.push(`Q:${weights.states.join()}`, `R:${weights.inputs.join()}`);
  if (weights?.integrals) parts.push(`Qz:${weights.integrals.join()}`);
  if (x0) parts.push(`x:${x0.join()}`);
  return parts.join('::');
}

/** @param {string} text @returns {Plant|null} null where it is none */
export function plantIn(text) {
  if (text.length > LONGEST) return null;
  /** @type {Plant} */
  const plant = { rows: {}, letters: {}, poles: null, observer: null, method: 'full-rank', weights: null, x0: null };
  /** @type {Record<string, number[]>} */ const lists = {};
  for (const part of text.replaceAll(' ', '+').split('::')) {
    // some programs take a plus for a blank
    const [name, ...rest] = part.split(':');
    const first = rest[0] ?? '';
    if (MATRICES.includes(name)) plant.rows[name] = rest.map((row) => row.split(','));
    else if (name.startsWith('.') && Number.isFinite(Number(first))) plant.letters[name.slice(1)] = Number(first);
    else if (name === 'p') plant.poles = polesIn(first);
    else if (name === 'q') plant.observer = polesIn(first);
    else if (name === 'by') plant.method = first;
    else if (LISTS.includes(name)) {
      const values = first.split(',').map((v) => (v ? Number(v) : NaN));
      if (values.every(Number.isFinite)) lists[name] = values;
    }
  }
  const { Q, R, Qz, x = null } = lists;
  if (Q && R) plant.weights = { states: Q, inputs: R, ...(Qz && { integrals: Qz }) };
  plant.x0 = x;
  return plant.rows.A && plant.rows.B ? plant : null;
}

/** The system alone, with no wish. @param {Pick<Plant, 'rows'|'letters'>} plant */
export const systemText = ({ rows, letters }) =>
  linkText({ rows, letters, poles: null, observer: null, method: 'full-rank', weights: null, x0: null });

/** As it is typed into MATLAB. @param {Pick<Plant, 'rows'|'letters'>} plant */
export function matlabText({ rows, letters }) {
  const lines = MATRICES.filter((name) => rows[name]).map((name) => {
    const own = rows[name].map((row) => row.map((v) => v.replace(/\s+/g, '')).join(' '));
    const many = own.length > 1 && own.join('; ').length > 44;
    return `${name} = [${own.join(many ? '\n     ' : '; ')}];`;
  });
  const values = Object.entries(letters).map(([name, value]) => `${name} = ${value}`);
  return [...lines, ...(values.length ? [values.join(', ')] : [])].join('\n');
}

/**
 * The same text with another value of a letter; where it has none yet, at its end.
 * @param {string} text @param {string} name @param {number} value
 */
export function withLetter(text, name, value) {
  const given = new RegExp(`(^|[\\s,;])(${name}\\s*=\\s*)(?![=[])[^,;\\n%#]*`);
  if (given.test(text)) return text.replace(given, (_all, before, own) => `${before}${own}${value}`);
  return `${text.trimEnd()}\n${name} = ${value}\n`;
}

/** A matrix of numbers in MATLAB's words. @param {number[][]} rows */
export const matrixText = (rows) => `[${rows.map((row) => row.join(' ')).join('; ')}]`;
