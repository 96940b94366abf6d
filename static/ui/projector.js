/**
 * Projector mode: large type and thick lines for a lecture hall. `?projector` in the address asks for it, the button is
 * remembered.
 */
import { recall, remember } from './memory.js';
import { rescale } from './picture_scale.js';

const MEMORY = 'projector';

/** @param {string} search of the address @param {string|null} kept what was remembered */
export function projectorWanted(search, kept) {
  const asked = new URLSearchParams(search).get(MEMORY);
  return asked === null ? kept === 'on' : asked !== 'false' && asked !== '0';
}

/** The address without it, so that a reload does not bring back what has been switched off. @param {string} search */
export function withoutProjector(search) {
  const rest = search
    .replace(/^\?/, '')
    .split('&')
    .filter((part) => part && part.split('=')[0] !== MEMORY)
    .join('&');
  return rest ? `?${rest}` : '';
}

export class Projector {
  on = false;

  constructor() {
    if (projectorWanted(location.search, recall(MEMORY))) this.#apply(true);
  }

  /** @returns {boolean} whether it is on now */
  toggle() {
    this.#apply(!this.on);
    remember(MEMORY, this.on ? 'on' : 'off');
    const search = withoutProjector(location.search);
    if (search !== location.search) history.replaceState(history.state, '', location.pathname + search + location.hash);
    return this.on;
  }

  /** @param {boolean} on */
  #apply(on) {
    this.on = on;
    document.documentElement.classList.toggle('projector', on);
    rescale();
  }
}
