/**
 * The symbols in a formula: how a sign of MathML is told from another, what it means where it stands, and what it is
 * worth now. Pure.
 *
 * @typedef {Pick<Element, 'localName'|'textContent'> & {children: ArrayLike<MathElement>, nextElementSibling:
 *   MathElement|null}} MathElement as much of an element as is looked at
 * @typedef {'rotors'|'observer'} Part of the derivation, where the paper's model ends
 * @typedef {import('../contract.js').Symbol & {chapters?: string[], part?: Part}} Term
 * @typedef {import('./walk.js').Walk} Walk
 * @typedef {{parameters: Record<string, number>, components: Record<string, number>, walk: Walk|null}} Now
 * @typedef {{text?: string, matrix?: number[][], of?: string}} Worth
 */
import { hides } from '../model/index.js';
import { complex } from '../text/index.js';
import { clean, figure } from './math.js';

const text = (/** @type {MathElement} */ e) => (e.textContent ?? '').replace(/\s/g, '');
const LETTERS = /^[\p{L}\p{M}]+$/u;

/**
 * The name of what an element writes, such as K_pp, θ˙ or λ_11; empty where it is no sign of its own.
 * @param {MathElement} e
 * @returns {string}
 */
export function signOf(e) {
  if (e.localName === 'mi' || e.localName === 'mtext') return LETTERS.test(text(e)) ? text(e) : '';
  const [base, second] = Array.from(e.children);
  if (!base || !second || !['msub', 'mover', 'msubsup'].includes(e.localName)) return '';
  const sign = signOf(base);
  if (!sign) return '';
  return e.localName === 'mover' ? sign + text(second) : `${sign}_${text(second)}`;
}

/**
 * Every symbol in a formula with what a finder says of it; an exponent is none, and neither are the parts of a symbol.
 * @template T
 * @param {MathElement} root
 * @param {(sign: string, applied: boolean) => T|undefined} find
 * @returns {{element: MathElement, term: T}[]}
 */
export function symbolsIn(root, find) {
  /** @type {{element: MathElement, term: T}[]} */ const found = [];
  const visit = (/** @type {MathElement} */ e, /** @type {MathElement|null} */ outer) => {
    const sign = signOf(e);
    const next = (outer ?? e).nextElementSibling;
    const term = sign ? find(sign, Boolean(next && text(next).startsWith('('))) : undefined;
    if (term) found.push({ element: e, term });
    else if (['msup', 'msub', 'mover', 'msubsup'].includes(e.localName)) visit(e.children[0], outer ?? e);
    else for (const child of Array.from(e.children)) visit(child, null);
  };
  visit(root, null);
  return found;
}

export class Glossary {
  /** @type {Map<string, Term>} */ #terms = new Map();

  /** @param {Term[]} terms @param {(mathml: string) => MathElement} parse the one symbol that a formula writes */
  constructor(terms, parse) {
    this.terms = terms;
    for (const term of terms) {
      const first = parse(term.mathml);
      const [found] = symbolsIn(first, (sign, applied) => ({ sign, applied }));
      if (!found) continue;
      for (const chapter of term.chapters?.length ? term.chapters : [''])
        this.#terms.set(
          `${chapter}/${found.term.sign}${found.term.applied || text(first).endsWith('(') ? '(' : ''}`,
          term,
        );
    }
  }

  /**
   * @param {string} sign
   * @param {boolean} applied whether a bracket follows
   * @param {string} chapter
   * @returns {Term|undefined}
   */
  find(sign, applied, chapter) {
    for (const key of applied ? [`${sign}(`, sign] : [sign]) {
      const term = this.#terms.get(`${chapter}/${key}`) ?? this.#terms.get(`/${key}`);
      if (term) return term;
    }
    return undefined;
  }
}

const SIGNALS = new Set([
  'theta',
  'psi',
  'theta_dot',
  'psi_dot',
  'theta_ddot',
  'psi_ddot',
  'V_p',
  'V_y',
  'x',
  'x_dot',
  'u',
  'v',
  'y',
  'q',
  'q_dot',
  'q_ddot',
  'forces',
  'thrust',
  'kinetic',
  'potential',
  'lagrangian',
  'coriolis',
  'gravity',
  'v_p',
  'v_y',
  'v_p_dot',
  'v_y_dot',
  'v_j',
  'x_hat',
  'e',
]);
const INERTIAS = { beta: (/** @type {Record<string, number>} */ p) => p.J_y + p.m * p.l ** 2 };

/** A matrix of the derivation by its name. @param {object} walk @param {string} name @returns {number[][]|undefined} */
function matrixIn(walk, name) {
  const found = /** @type {Record<string, unknown>} */ (walk)[name];
  return Array.isArray(found) ? found : undefined;
}

const number = (/** @type {number|undefined} */ v) => (v === undefined ? {} : { text: figure(v, 6) });
const PAIRS = { v_d: 'v_d', s_j: 's' };

/**
 * What a symbol is worth in a part beyond the paper's model; nothing where it is what it is elsewhere.
 * @param {string} name
 * @param {Walk} walk
 * @param {Part} part
 * @returns {Worth|undefined}
 */
function worthBeyond(name, walk, part) {
  if (walk.refused !== undefined) return undefined;
  const at = (/** @type {number[][]|undefined} */ m, /** @type {RegExpExecArray} */ [, i, j]) =>
    number(m?.[Number(i) - 1]?.[Number(j) - 1]);
  if (part === 'observer') {
    const { observer } = walk;
    const entry = /^l_(\d)(\d)$/.exec(name);
    if (entry) return at(observer?.L, entry);
    const pole = /^q_(\d)$/.exec(name);
    if (pole) return observer ? { text: complex((observer.asked ?? observer.poles)[Number(pole[1]) - 1], 3) } : {};
    if (name === 'L') return observer ? { matrix: clean(observer.L) } : {};
    if (name === 'C') return { text: 'the first two rows of the identity' };
  }
  const { names, K, rotor_poles: thirds } = walk.rotors;
  if (part === 'observer') return /^nu_[py]$/.test(name) ? number(names[name]) : undefined;
  const entry = /^k_(\d)(\d)$/.exec(name);
  if (entry) return at(K, entry);
  if (name === 'p_5' || name === 'p_6') return number(thirds[name === 'p_5' ? 0 : 1]);
  if (name in PAIRS) {
    const own = PAIRS[/** @type {keyof typeof PAIRS} */ (name)];
    const both = [names[`${own}_p`], names[`${own}_y`]];
    return names.s_p || names.s_y
      ? { text: both.map((v) => figure(v)).join(', ') }
      : { text: 'both curves are linear' };
  }
  if (name in names) return number(names[name]);
  return /^(h|d)_/.test(name) ? {} : undefined;
}

/** A walk through the derivation, but for what a lab's step keeps back. @param {Walk|null} walk
 * @param {Partial<import('../types.js').State>} state @returns {Walk|null} */
export const toldOf = (walk, state) =>
  walk?.refused === undefined && walk && hides(state, 'rga') ? { ...walk, rga: undefined } : walk;

/**
 * What a symbol is worth on the present rig.
 * @param {string} name
 * @param {Now} now
 * @param {Part} [part] of the derivation in which it stands, beyond the paper's model
 * @returns {Worth}
 */
export function worthOf(name, { parameters, components, walk }, part) {
  const beyond = part && walk && worthBeyond(name, walk, part);
  if (beyond) return beyond;
  if (name in parameters) return number(parameters[name]);
  if (name in components) return number(components[name]);
  if (name === 'beta') return number(INERTIAS.beta(parameters));
  const asked = walk?.asked;
  if (name === 'c') return typeof asked?.shift === 'number' ? number(asked.shift) : {};
  if (name === 'theta_0') return number(asked?.operating_point?.theta);
  const pole = /^p_(\d)$/.exec(name);
  if (pole) return asked ? { text: complex(asked.poles[Number(pole[1]) - 1], 3) } : {};
  if (asked && (name === 'kp' || name === 'ti'))
    return { text: `${figure(asked.loops.pitch[name])}, ${figure(asked.loops.yaw[name])}` };
  if (SIGNALS.has(name)) return { text: 'varies in time' };
  if (name === 's') return { text: 'any complex number' };
  if (!walk || walk.refused !== undefined) return {};
  const cell = /^(A|B)_(\d)(\d)$/.exec(name);
  if (cell) return number(matrixIn(walk, cell[1])?.[Number(cell[2]) - 1]?.[Number(cell[3]) - 1]);
  if (walk.constants[name] !== undefined) return number(walk.constants[name]);
  if (walk.coefficients?.[name] !== undefined) return number(walk.coefficients[name]);
  const entry = /^(k|lambda|sigma)_(\d)(\d)?$/.exec(name);
  if (entry?.[1] === 'sigma') return number(walk.controllability_indices[Number(entry[2]) - 1]);
  if (entry) return number((entry[1] === 'k' ? walk.K : walk.rga)?.[Number(entry[2]) - 1]?.[Number(entry[3]) - 1]);
  if (name === 'trim') return { text: `${figure(walk.trim.V_p)}, ${figure(walk.trim.V_y)}` };
  if (name === 'd_1' || name === 'd_2') return walk.coefficients ? { text: polynomial(walk.coefficients, name) } : {};
  if (name === 'G') return walk.G_0 ? { matrix: clean(walk.G_0), of: 'at s = 0' } : {};
  const matrix = matrixIn(walk, name);
  return matrix ? { matrix: clean(matrix) } : {};
}

/** @param {Record<string, number>} coefficients @param {string} name */
function polynomial(coefficients, name) {
  const signed = (/** @type {number} */ v, /** @type {string} */ power) =>
    `${v < 0 ? '−' : '+'} ${figure(Math.abs(v))}${power}`;
  return `s² ${signed(coefficients[`${name}1`], ' s')} ${signed(coefficients[`${name}0`], '')}`;
}
