/**
 * Plants as links have them (plant/link_text.js: parts with `::` between them, each a name and what it holds), one told
 * by what differs from another. Pure.
 */

/** Plants that are kept at once: as many as curves can be told apart. */
export const MOST_PLANTS = 4;

/** Its parts by name. @param {string} text */
const partsOf = (text) =>
  new Map(
    text
      .split('::')
      .filter(Boolean)
      .map((part) => /** @type {[string, string]} */ ([part.split(':')[0], part])),
  );

/** Whether two say the same, in whatever order. @param {string} a @param {string} b */
export const samePlant = (a, b) =>
  a === b || [...partsOf(a).values()].sort().join() === [...partsOf(b).values()].sort().join();

/**
 * What differs from another plant: parts that are others, and names alone of those that are gone.
 * @param {string} plant @param {string} base
 */
export function plantDifference(plant, base) {
  const [own, old] = [partsOf(plant), partsOf(base)];
  const gone = [...old.keys()].filter((name) => !own.has(name));
  return [...gone, ...[...own].filter(([name, part]) => old.get(name) !== part).map(([, part]) => part)].join('::');
}

/** The plant of which that is the difference. @param {string} difference @param {string} base */
export function plantOf(difference, base) {
  const own = partsOf(base);
  for (const [name, part] of partsOf(difference)) part === name ? own.delete(name) : own.set(name, part);
  return [...own.values()].join('::');
}
