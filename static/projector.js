/** Projector mode: large type and thick lines for a lecture hall. `?projector` in the address asks for it, the button is remembered. */
import { recall, remember } from './memory.js';

const MEMORY = 'projector';
const PLOT_TYPE = 11; // px, as plots.js sets it
const LARGE = '(min-width: 1600px) and (min-height: 900px)'; // as projector.css has it
const LINES = 1.7;

/** @param {string} search of the address @param {string|null} kept what was remembered */
export function projectorWanted(search, kept) {
  const asked = new URLSearchParams(search).get(MEMORY);
  return asked === null ? kept === 'on' : asked !== 'false' && asked !== '0';
}

/** The address without it, so that a reload does not bring back what has been switched off. @param {string} search */
export function withoutProjector(search) {
  const rest = search.replace(/^\?/, '').split('&').filter((part) => part && part.split('=')[0] !== MEMORY).join('&');
  return rest ? `?${rest}` : '';
}

export class Projector {
  /** @type {WeakMap<object, number>} */ #own = new WeakMap();
  on = false;

  /** @param {{scale: number, plots: {chart: any}[]}} plots */
  constructor(plots) {
    this.plots = plots;
    if (projectorWanted(location.search, recall(MEMORY))) this.#apply(true);
    matchMedia(LARGE).addEventListener('change', () => this.on && this.#apply(true));
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
    const type = on ? Number.parseFloat(getComputedStyle(document.documentElement).fontSize) / PLOT_TYPE : 1; // as large as the page's
    this.plots.scale = type;
    for (const { chart } of this.plots.plots) {
      for (const series of chart.series.slice(1)) series.width = this.#size(series, series.width) * (on ? LINES : 1);
      for (const { font } of chart.axes) { // as uPlot keeps it: the canvas' font, its size there, its size in CSS pixels
        const size = this.#size(font, font[2]) * type;
        font[1] = Math.round(size * devicePixelRatio);
        font[0] = font[0].replace(/[\d.]+px/, `${font[1]}px`);
        font[2] = size;
      }
      chart.redraw(true, true);
    }
  }

  /** What it was at first. @param {object} of @param {number} present */
  #size(of, present) {
    const own = this.#own.get(of) ?? present;
    this.#own.set(of, own);
    return own;
  }
}
