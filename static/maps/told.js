/**
 * What the server does for the maps: that it computes, or why it does not, with a way to ask again. It stands over the
 * plane and takes no room, so that the plane, and with it what is asked, stays as it is.
 * @typedef {{computing: boolean, refused: string}} Told  refused: in words, empty where it is not
 */
import { say, t } from '../text/index.js';
import { button, h, setText } from '../ui/index.js';

/** Of several maps: one refusal is told before that others are computed. @param {Iterable<Told>} all @returns {Told} */
export function together(all) {
  const each = [...all];
  return {
    computing: each.some(({ computing }) => computing),
    refused: each.find(({ refused }) => refused)?.refused ?? '',
  };
}

/** @param {Told} told @returns {string} */
export const wordsOf = ({ computing, refused }) =>
  refused ? say`No map: ${refused}` : computing ? t('Map: computing on the server…') : '';

export class Teller {
  /** @type {Map<string, Told>} */ #of = new Map();

  /** @param {() => void} again */
  constructor(again) {
    this.words = h('span', { role: 'status', 'data-testid': 'map-state' });
    this.again = button({ 'data-testid': 'map-again', hidden: true, onclick: again }, 'Try again');
    this.node = h('div', { class: 'map-told' }, this.words, this.again);
  }

  /** @param {string} which  map @param {Told} told */
  put(which, told) {
    this.#of.set(which, told);
    const all = together(this.#of.values());
    setText(this.words, wordsOf(all));
    this.again.hidden = !all.refused;
  }
}
