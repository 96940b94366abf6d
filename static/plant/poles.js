/**
 * Poles of any number, closed under conjugation: moved one by one, written and read. Pure.
 * @typedef {import('../types.js').Complex} Complex
 */
import { complexIn, inField, parseComplex, parseNumber } from '../text/index.js';
import { meets, tidy } from '../model/index.js';

const SAME = 1e-9;

/**
 * Where the conjugate of a pole stands; itself where it is real.
 * @param {readonly Complex[]} poles @param {number} i
 */
export function conjugateOf(poles, i) {
  const p = poles[i];
  if (p.im === 0) return i;
  const size = Math.hypot(p.re, p.im);
  // of several equal pairs the first conjugate that no earlier equal pole has
  const equal = (/** @type {Complex} */ q, /** @type {number} */ sign) =>
    Math.hypot(q.re - p.re, q.im - sign * p.im) <= SAME * size;
  const before = poles.slice(0, i).filter((q) => equal(q, 1)).length;
  const partners = [...poles.keys()].filter((j) => equal(poles[j], -1));
  return partners[before] ?? i;
}

/**
 * Which real pole goes along with one that leaves the axis; itself where there is none.
 * @param {readonly Complex[]} poles @param {number} i @param {number} to
 */
function companion(poles, i, to) {
  const from = poles[i].re;
  const real = [...poles.keys()].filter((k) => k !== i && poles[k].im === 0);
  const met = real.filter((k) => meets(poles[k].re, from, to));
  const near = met.length ? from : to;
  const far = (/** @type {number} */ k) => Math.abs(poles[k].re - near);
  return (met.length ? met : real).sort((a, b) => far(a) - far(b))[0] ?? i;
}

/**
 * A pole goes somewhere, and its conjugate with it. A complex pair that comes near the real axis turns real; a real
 * pole that leaves the axis takes a real one with it: the first that it meets on its way, else the nearest to where it
 * leaves.
 * @param {readonly Complex[]} poles
 * @param {number} i
 * @param {Complex} to
 * @param {number} snap how near the axis is on it
 * @returns {Complex[]}
 */
export function moved(poles, i, to, snap) {
  const next = poles.map((p) => ({ ...p }));
  const at = { re: tidy(to.re), im: tidy(to.im) };
  let j = conjugateOf(poles, i);
  if (j === i && Math.abs(at.im) > snap) j = companion(poles, i, at.re);
  if (j === i) next[i] = { re: at.re, im: 0 };
  else if (Math.abs(at.im) <= snap) {
    next[i] = { re: at.re, im: 0 };
    next[j] = { re: at.re, im: 0 };
  } else {
    next[i] = at;
    next[j] = { re: at.re, im: -at.im };
  }
  return next;
}

const short = (/** @type {number} */ v) => inField(Number(v.toPrecision(6)));

/** In one line; a pair as ±. @param {readonly Complex[]} poles */
export const polesLine = (poles) =>
  poles
    .filter((p, i) => p.im === 0 || i < conjugateOf(poles, i))
    .map((p) => complexIn(p.im ? { re: p.re, im: Math.abs(p.im) } : p, { number: short, plus: '±', minus: '±' }))
    .join(', ');

/** As programs write them. @param {readonly Complex[]} poles */
export const polesWord = (poles) => poles.map((p) => complexIn(p, { number: String, minus: '-', gap: '' })).join(',');

/**
 * Poles as people type them, between commas or semicolons: -1, -2±3j, -4+1j, -4-1j. A complex one that stands alone
 * brings its conjugate.
 * @param {string} text
 * @returns {Complex[]|null} null where one is none
 */
export function polesIn(text) {
  /** @type {Complex[]} */ const found = [];
  for (const word of text.replace(/^[[({]|[\])}]$/g, '').split(/[,;\n]+/)) {
    if (!word.trim()) continue;
    const real = parseNumber(word);
    const p = Number.isFinite(real) ? { re: real, im: 0 } : parseComplex(word);
    if (!p) return null;
    if (p.im === 0) found.push({ re: p.re, im: 0 });
    else if (/±|\+-/.test(word)) found.push(p, { re: p.re, im: -p.im });
    else {
      const open = found.findIndex((q, k) => q.re === p.re && q.im === -p.im && conjugateOf(found, k) === k);
      found.splice(open < 0 ? found.length : open + 1, 0, p);
    }
  }
  for (let i = found.length - 1; i >= 0; i--)
    if (found[i].im && conjugateOf(found, i) === i) found.splice(i + 1, 0, { re: found[i].re, im: -found[i].im });
  return found;
}

/**
 * A first proposal: as fast as the system itself, all real, none twice.
 * @param {readonly Complex[]} open the poles of the system
 * @param {number} [factor]
 * @returns {Complex[]}
 */
export function proposal(open, factor = 1) {
  const sizes = open.map((p) => Math.hypot(p.re, p.im)).filter((v) => v > 1e-6);
  const middle = sizes.length ? Math.exp(sizes.reduce((sum, v) => sum + Math.log(v), 0) / sizes.length) : 1;
  const n = open.length;
  return open.map((_, i) => ({
    re: -Number((factor * middle * (0.75 + (n > 1 ? (1.25 * i) / (n - 1) : 0.25))).toPrecision(2)),
    im: 0,
  }));
}
