/**
 * What could not be taken from a link, in words. Pure.
 * @typedef {import('./permalink.js').Trouble} Trouble
 */

/** @param {Trouble[]} trouble */
export function troubleWords(trouble) {
  if (!trouble.length) return null;
  const parts =
    trouble
      .slice(0, 3)
      .map(({ part, why }) => `${part} (${why})`)
      .join('; ') + (trouble.length > 3 ? `; and ${trouble.length - 3} more` : '');
  return /^v\d+$/.test(trouble[0].part)
    ? `This link cannot be opened: ${trouble[0].why}.`
    : `Not taken from this link: ${parts}. The rest is restored.`;
}
