/**
 * The pseudo-locale `?lang=qps-ploc`: marks every text that is looked up, so that what is not can be seen; a third
 * longer, as many languages are.
 */
const VOWELS = { a: 'å', e: 'é', i: 'î', o: 'ö', u: 'ü', A: 'Å', E: 'É', I: 'Î', O: 'Ö', U: 'Ü' };

const FIGURE = /(?<![A-Za-z₀-₉ₙ/-])\d+\.\d|\d{2,}(?! [%°])/; // of a measurement; not 2 %, nor a citation's

/**
 * @param {string} text values in braces stay
 * @returns {string|undefined} undefined where figures stand in it: no catalogue has all of those, such a sentence is
 *   for `say`
 */
export function pseudo(text) {
  if (text.startsWith('⟦')) return text; // looked up before
  if (FIGURE.test(text.replace(/\{\d\}|\(.*\)/g, ''))) return undefined;
  const accented = text.replace(/[aeiouAEIOU]/g, (c) => VOWELS[/** @type {keyof typeof VOWELS} */ (c)]);
  return `⟦${accented}${'·'.repeat(Math.round(text.length / 3))}⟧`;
}

export default { get: pseudo };
