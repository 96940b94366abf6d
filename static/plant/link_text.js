/**
 * A system in a link, and as text of MATLAB. Pure.
 *
 * In a link: parts with `::` between them, each a name and its rows, entries with commas: `A:0,1:-k/m,-b/m::B:0:1/m`.
 * A letter's value is `.m:2`; `p` and `q` are the desired poles and the observer's, `by` the method, `Q` and `R` the
 * weights of a quadratic one. No blanks, and nothing that links must escape.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {{rows: Record<string, string[][]>, letters: Record<string, number>, poles: Complex[]|null,
 *   observer: Complex[]|null, method: string, weights: {states: number[], inputs: number[]}|null}} Plant
 */
import { polesIn, polesWord } from './poles.js';

const MATRICES = ['A', 'B', 'C', 'D'];
const LONGEST = 4000;

/** @param {Plant} plant */
export function linkText({ rows, letters, poles, observer, method, weights }) {
  const parts = MATRICES.filter((name) => rows[name]).map(
    (name) => `${name}:${rows[name].map((row) => row.map((v) => v.replace(/\s+/g, '')).join()).join(':')}`,
  );
  for (const [name, value] of Object.entries(letters)) parts.push(`.${name}:${value}`);
  if (poles) parts.push(`p:${polesWord(poles)}`);
  if (observer) parts.push(`q:${polesWord(observer)}`);
  if (method !== 'full-rank') parts.push(`by:${method}`);
  if (weights) parts.push(`Q:${weights.states.join()}`, `R:${weights.inputs.join()}`);
  return parts.join('::');
}

/** @param {string} text @returns {Plant|null} null where it is none */
export function plantIn(text) {
  if (text.length > LONGEST) return null;
  /** @type {Plant} */
  const plant = { rows: {}, letters: {}, poles: null, observer: null, method: 'full-rank', weights: null };
  /** @type {Record<string, number[]>} */ const weights = {};
  for (const part of text.replaceAll(' ', '+').split('::')) {
    // some programs take a plus for a blank
    const [name, ...rest] = part.split(':');
    const first = rest[0] ?? '';
    if (MATRICES.includes(name)) plant.rows[name] = rest.map((row) => row.split(','));
    else if (name.startsWith('.') && Number.isFinite(Number(first))) plant.letters[name.slice(1)] = Number(first);
    else if (name === 'p') plant.poles = polesIn(first);
    else if (name === 'q') plant.observer = polesIn(first);
    else if (name === 'by') plant.method = first;
    else if (name === 'Q' || name === 'R') weights[name] = first.split(',').map(Number);
  }
  if (weights.Q?.every(Number.isFinite) && weights.R?.every(Number.isFinite))
    plant.weights = { states: weights.Q, inputs: weights.R };
  return plant.rows.A && plant.rows.B ? plant : null;
}

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
