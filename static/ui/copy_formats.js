/**
 * Matrices, poles and formulas as text for other programs, with all digits or with four: LaTeX, Python (NumPy, SymPy),
 * MATLAB, plain text. Pure.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {{name: string, note?: string, matrix: ArrayLike<number>[]}} MatrixItem
 * @typedef {{name: string, note?: string, poles: readonly Complex[]}} PolesItem
 * @typedef {{name: string, note?: string, latex?: string, sympy?: string, text?: string, definitions?: Record<string,
 *   string>}} FormulaItem sympy: as `sympify` reads it
 * @typedef {MatrixItem|PolesItem|FormulaItem} Item name: an identifier, as K or A_bar; note: what it is, with its units
 * @typedef {'LaTeX'|'Python'|'MATLAB'|'Text'} Format
 * @typedef {number|undefined} Digits significant ones; undefined: all that the number has
 */
import { complexIn } from '../text/index.js';

/** @type {Format[]} */
export const FORMATS = ['LaTeX', 'Python', 'MATLAB', 'Text'];

const FUNCTIONS = new Set(['sin', 'cos', 'tan', 'sqrt', 'exp', 'Matrix', 'Rational', 'Eq']);
const NAMED = /** @type {Record<string, string>} */ ({
  RGA: '\\mathrm{RGA}',
  A_bar: '\\bar{A}',
  G_0: '\\hat{G}(0)',
  poles: 'p',
  loop_poles: 'p_\\mathrm{loop}',
});

/** @param {string} name */
const latexName = (name) =>
  NAMED[name] ??
  (/^[A-Za-z]$/.test(name)
    ? name
    : /^([A-Za-z])_(\w+)$/.test(name)
      ? name.replace(/^([A-Za-z])_(\w+)$/, '$1_{$2}')
      : `\\mathrm{${name.replaceAll('_', '\\_')}}`);

/** Rounded millions have a power of ten, not zeros. @param {number} v */
const latexNumber = (v) =>
  (Math.abs(v) >= 1e6 && /000$/.test(String(v)) ? v.toExponential() : String(v)).replace(
    /e\+?(-?\d+)$/,
    ' \\times 10^{$1}',
  );

/** @param {Complex} p @param {(v: number) => string} number @param {string} unit */
const complexText = (p, number, unit) => complexIn(p, { number, minus: '-', unit });

/** Columns of equal width. @param {string[][]} cells */
function aligned(cells) {
  const widths = cells[0].map((_c, j) => Math.max(...cells.map((row) => row[j].length)));
  return cells.map((row) => row.map((cell, j) => cell.padStart(widths[j])));
}

/** A comment of one line. @param {{note?: string}} item @param {string} mark */
const noted = (item, mark) => (item.note ? `${mark} ${item.note}\n` : '');

/** @param {ArrayLike<number>[]} matrix @param {(v: number) => string} [number] */
const cellsOf = (matrix, number = String) => aligned(matrix.map((row) => Array.from(row, number)));

/** @type {Record<Format, (item: MatrixItem) => string>} */
const MATRIX = {
  LaTeX: ({ name, matrix }) =>
    `${latexName(name)} = \\begin{bmatrix}\n${cellsOf(matrix, latexNumber)
      .map((row) => `  ${row.join(' & ')}`)
      .join(' \\\\\n')}\n\\end{bmatrix}`,
  Python: (item) =>
    `import numpy as np\n\n${noted(item, '#')}${item.name} = np.array([\n${cellsOf(item.matrix)
      .map((row) => `    [${row.join(', ')}],`)
      .join('\n')}\n])`,
  MATLAB: (item) =>
    `${noted(item, '%')}${item.name} = [ ...\n${cellsOf(item.matrix)
      .map((row) => `    ${row.join(', ')}`)
      .join('; ...\n')} ...\n];`,
  Text: (item) =>
    `${item.name}${item.note ? `: ${item.note}` : ''}\n${cellsOf(item.matrix)
      .map((row) => row.join('  '))
      .join('\n')}`,
};

/** @type {Record<Format, (item: PolesItem) => string>} */
const POLES = {
  LaTeX: ({ name, poles }) =>
    `${latexName(name)} = \\{${poles.map((p) => complexText(p, latexNumber, '\\mathrm{j}')).join(',\\; ')}\\}`,
  Python: (item) =>
    `import numpy as np\n\n${noted(item, '#')}${item.name} = ` +
    `np.array([${item.poles.map((p) => complexText(p, String, 'j')).join(', ')}])`,
  MATLAB: (item) =>
    // spaced on both sides, a sign is one operator, not two entries
    `${noted(item, '%')}${item.name} = [${item.poles.map((p) => complexText(p, String, 'i')).join(', ')}];`,
  Text: (item) =>
    [`${item.name}${item.note ? `: ${item.note}` : ''}`, ...item.poles.map((p) => complexText(p, String, 'j'))].join(
      '\n',
    ),
};

/** The free names of an expression, in the order of appearance. @param {string} sympy @returns {string[]} */
export const namesIn = (sympy) =>
  [...new Set(sympy.match(/[A-Za-z_]\w*/g) ?? [])].filter((name) => !FUNCTIONS.has(name) && name !== 'pi');
/** @param {string} sympy */
const functionsIn = (sympy) =>
  [...new Set(sympy.match(/[A-Za-z_]\w*/g) ?? [])].filter((name) => FUNCTIONS.has(name) || name === 'pi').sort();

/** A name that the expression itself does not use. @param {FormulaItem} item */
const target = ({ name, sympy = '' }) => (namesIn(sympy).includes(name) ? `${name}_` : name);

/** @param {FormulaItem} item @param {string} mark @param {(sympy: string) => string} write */
function definitions({ sympy = '', definitions: all = {} }, mark, write) {
  const used = namesIn(sympy).filter((name) => all[name]);
  return used.map((name) => `${mark} ${name} = ${write(all[name])}\n`).join('');
}

/** The rows of `Matrix([[a, b], [c, d]])`. @param {string} sympy @returns {string[][]|undefined} */
function rowsOf(sympy) {
  const inner = /^Matrix\(\[(.*)\]\)$/s.exec(sympy)?.[1];
  if (inner === undefined) return undefined;
  /** @type {string[][]} */ const rows = [];
  let depth = 0;
  let entry = '';
  for (const c of inner) {
    if ('([{'.includes(c)) depth += 1;
    if (')]}'.includes(c)) depth -= 1;
    if (c === '[' && depth === 1) rows.push([]);
    else if (depth === 0 || (c === ',' && depth === 1)) {
      if (entry.trim()) rows[rows.length - 1]?.push(entry.trim());
      entry = '';
    } else entry += c;
  }
  return rows;
}

/** Powers and brackets are all in which both languages differ. @param {string} sympy @returns {string} */
function matlab(sympy) {
  const rows = rowsOf(sympy);
  if (rows) return `[${rows.map((row) => row.map(matlab).join(', ')).join('; ...\n    ')}]`;
  return sympy.replaceAll('**', '^');
}

/** @type {Record<Format, (item: FormulaItem) => string|undefined>} */
const FORMULA = {
  LaTeX: ({ name, latex }) => latex && (latex.includes('=') ? latex : `${latexName(name)} = ${latex}`),
  Python: (item) => {
    const { sympy } = item;
    if (!sympy) return undefined;
    const names = namesIn(sympy);
    const symbols = names.length ? `${names.join(', ')} = symbols("${names.join(' ')}")\n` : '';
    const imported = `from sympy import ${[...functionsIn(sympy), 'symbols'].join(', ')}\n\n`;
    return `${imported}${symbols}${definitions(item, '#', (s) => s)}${target(item)} = ${sympy}`;
  },
  MATLAB: (item) => {
    const { sympy } = item;
    if (!sympy) return undefined;
    const names = namesIn(sympy);
    const symbols = names.length ? `syms ${names.join(' ')}\n` : '';
    return `${symbols}${definitions(item, '%', matlab)}${target(item)} = ${matlab(sympy)};`;
  },
  Text: ({ name, sympy, text }) => text ?? (sympy && `${name} = ${sympy}`),
};

/** Rounded to so many significant digits. @param {number} v @param {number} digits */
const rounded = (v, digits) => Number(v.toPrecision(digits)) || 0;

/**
 * An item with rounded numbers, and a note that they are: who computes on with them should know. LaTeX has no note.
 * @param {MatrixItem|PolesItem} item
 * @param {number} digits
 * @returns {MatrixItem|PolesItem}
 */
function shortened(item, digits) {
  const note = `${item.note ? `${item.note}; ` : ''}rounded to ${digits} digits`;
  const short = (/** @type {number} */ v) => rounded(v, digits);
  if ('matrix' in item) return { ...item, note, matrix: item.matrix.map((row) => Array.from(row, short)) };
  return { ...item, note, poles: item.poles.map(({ re, im }) => ({ re: short(re), im: short(im) })) };
}

/**
 * @param {Item} item
 * @param {Format} format
 * @param {Digits} [digits]
 * @returns {string|undefined} undefined where the item has no such form
 */
export function textOf(item, format, digits) {
  if (!('matrix' in item) && !('poles' in item)) return FORMULA[format](item);
  const own = digits ? shortened(item, digits) : item;
  return 'matrix' in own ? MATRIX[format](own) : POLES[format](own);
}

/**
 * Several items as one text; what the parts share stands once.
 * @param {Item[]} items
 * @param {Format} format
 * @param {Digits} [digits]
 */
export function allOf(items, format, digits) {
  const parts = items.map((item) => textOf(item, format, digits)).filter((text) => text !== undefined);
  const head = 'import numpy as np\n\n';
  if (format !== 'Python' || parts.some((p) => !p.startsWith(head))) return parts.join('\n\n');
  return head + parts.map((p) => p.slice(head.length)).join('\n\n');
}
