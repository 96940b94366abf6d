/** A row or column of numbers, as people type it. Pure. */
import { parseNumber, say } from '../text/index.js';

/**
 * With blanks, commas or semicolons between them: `1 0 0 0`, `[1; 0; 0; 0]`, `x0 = [1, 0]';`, `np.array([[1], [0]])`.
 * @param {string} text
 * @returns {number[]|null} null where one is no finite number
 */
export function numbersIn(text) {
  const bare = text
    .replace(/^\s*\w+\s*=/, '')
    .replace(/\b(?:np|numpy)\.\w+|\.?['’]|\.T\b/g, ' ')
    .replace(/[[\](){}]/g, ' ');
  const found = bare
    .split(/[\s;,]+/)
    .filter(Boolean)
    .map(parseNumber);
  return found.every(Number.isFinite) ? found : null;
}

/**
 * How a field reads so many of them.
 * @param {() => number} many @param {{least?: number, most?: number}} [range] of each
 * @returns {(text: string) => number[]|string} the numbers, or what is wrong
 */
export const reader =
  (many, { least = -1e12, most = 1e12 } = {}) =>
  (text) => {
    const found = numbersIn(text);
    if (!found) return say`Write numbers with blanks between them.`;
    if (found.length !== many()) return say`These are ${found.length} numbers, and ${many()} are wanted.`;
    if (found.every((v) => v >= least && v <= most)) return found;
    return least < 0 ? say`Numbers within ±10¹² are wanted.` : say`Numbers from ${least} to 10¹² are wanted.`;
  };
