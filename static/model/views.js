/**
 * The views of the page: sides from which one design is seen. A new one stands here, gets its place in index.html, and
 * has its own address. Pure.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').View} View
 */

/**
 * Title, the key that follows G, what it is for, and beginnings of the names of places within it.
 * @type {Record<View, {title: string, key: string, about: string, places: string[]}>}
 */
export const VIEWS = {
  explore: { title: 'Explore', key: 'E', about: 'The first minute: six things to try', places: [] },
  design: { title: 'Design', key: 'D', about: 'The whole instrument', places: [] },
  fly: { title: 'Fly', key: 'Y', about: 'Fly it by hand, with the design that you have made', places: ['flight'] },
  find: { title: 'Find', key: 'F', about: 'Say what a design shall do, and have it found', places: [] },
  compare: { title: 'Compare', key: 'C', about: 'Methods and pinned designs side by side', places: ['pins'] },
  rig: {
    title: 'Rig',
    key: 'R',
    about: 'Parameters, rotors, recordings of a real rig',
    places: ['own-rigs', 'recordings'],
  },
  plant: { title: 'Plant', key: 'P', about: 'Any plant: your own A, B and C', places: [] },
  derivation: {
    title: 'Derivation',
    key: 'M',
    about: 'Formulas, and the paper step by step',
    places: ['formulas', 'paper', 'eq', 'fig', 'table', 'erratum', 'beyond'],
  },
};

/** @type {View} links without a view are of a time when there was but this one */
export const STANDARD_VIEW = 'design';

/** @param {string|null|undefined} name @returns {name is View} */
export const isView = (name) => name !== null && name !== undefined && Object.hasOwn(VIEWS, name);

/**
 * The view that shows a place on the page, by the place's name.
 * @param {string|null} [place]
 * @returns {View|undefined}
 */
export function viewOfPlace(place) {
  if (!place) return undefined;
  if (isView(place)) return place;
  const names = /** @type {View[]} */ (Object.keys(VIEWS));
  return names.find((name) => VIEWS[name].places.some((own) => place === own || place.startsWith(`${own}-`)));
}

/** Views that are read beside a small s-plane. @param {View} view */
export const isRead = (view) => view !== 'explore' && view !== 'design';

/**
 * The pair that is shown alone, where the other axis is left aside; null: both are there.
 * @param {Pick<State, 'view'|'motion'>} state
 * @returns {0|1|null}
 */
export const pairAlone = ({ view, motion }) => (view === 'explore' ? (motion === 'psi' ? 1 : 0) : null);
