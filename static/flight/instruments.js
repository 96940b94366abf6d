/**
 * The instruments of the view Fly: strip chart, dials, lamps and sound, fed by the flight's events and moved on once
 * per animation frame. What acts on the rig is marked on the chart here; changes of the design mark those who know
 * which parts changed.
 * @typedef {import('./flight.js').Flight} Flight
 * @typedef {import('./course.js').Rows} Rows
 */
import { t } from '../text/index.js';
import { h } from '../ui/index.js';
import { Horizon } from './horizon.js';
import { Lamps } from './lamps.js';
import { Sound } from './sound.js';
import { Strip } from './strip.js';

/** How far back the last row is looked for, s. */
const NOW = 0.1;

/**
 * What a word of the log is called on the chart, and of which kind its mark is; null: it has none.
 * @param {string} word @param {readonly number[]} values
 * @returns {[title: string, kind: string]|null}
 */
export function markOf(word, values) {
  const on = values.some((value) => value !== 0);
  if (word === 'gust') return [t('Gust'), 'gust'];
  if (word === 'push') return [t('Push'), 'push'];
  if (word === 'hands') return [on ? t('Hands on') : t('Hands off'), 'hands'];
  if (word === 'hung') return [on ? t('Mass hung on') : t('Mass taken off'), 'fault'];
  if (word === 'stuck') return [on ? t('Encoder sticks') : t('Encoder free'), 'fault'];
  if (word === 'thrust') return [values.every((v) => v === 1) ? t('Full thrust') : t('Thrust changed'), 'fault'];
  return null;
}

export class Instruments {
  horizon = new Horizon();
  lamps = new Lamps();
  sound = new Sound();
  /** To lie over the scene. */
  over = h('div', { class: 'fly-instruments', 'data-views': 'fly' }, this.horizon.node, this.lamps.node);
  /** Where the chart has its room. */
  chart = h('div', { class: 'fly-chart', 'data-testid': 'fly-chart' });
  #strip = new Strip(this.chart);
  #now = 0;

  /** @param {Flight} flight */
  constructor(flight) {
    this.flight = flight;
    const on = (/** @type {string} */ type, /** @type {(detail: never) => void} */ act) =>
      flight.addEventListener(type, (e) => act(/** @type {never} */ (/** @type {CustomEvent} */ (e).detail)));
    on('start', () => this.#start());
    on('change', () => this.#changed());
    on('frame', (/** @type {Rows} */ flown) => this.#put(flown));
    on('cut', (/** @type {{time: number}} */ { time }) => this.#cut(time));
    on('did', (/** @type {{time: number, word: string, values: number[]}} */ { time, word, values }) => {
      const mark = markOf(word, values);
      if (mark) this.#strip.mark(time, ...mark);
    });
  }

  #start() {
    this.look(null);
    this.#strip.clear();
    this.lamps.clear();
  }

  /** Nothing is to be heard where time stands still, also in a view that is not seen any more. */
  #changed() {
    const { mode } = this.flight.state;
    if (mode !== 'flying' && mode !== 'replaying') this.sound.hush();
  }

  #bounds() {
    const { craft } = this.flight;
    if (!craft) return;
    this.#strip.limits = this.lamps.limits = craft.limits;
    this.horizon.travel = craft.travel;
  }

  /** @param {Rows} flown */
  #put({ rows, count, step, time }) {
    this.#bounds();
    this.#strip.put(rows, count, step, time);
    this.horizon.put(rows, count);
    this.lamps.put(rows, count);
    this.sound.put(rows, count, this.#now);
  }

  /** @param {number} time  s */
  #cut(time) {
    const { rows, count } = this.flight.lastRows(NOW);
    this.look(null);
    this.#bounds();
    this.#strip.cut(time);
    this.#strip.read(rows, count);
    this.horizon.put(rows, count);
    this.lamps.clear();
  }

  /** Something that no word of the log tells. @param {number} time  s @param {string} title @param {string} [kind] */
  mark(time, title, kind) {
    this.#strip.mark(time, title, kind);
  }

  /**
   * How the rig stands before it flies.
   * @param {number} theta @param {number} psi  rad @param {{theta: number, psi: number}} wish
   */
  rest(theta, psi, wish) {
    this.horizon.rest(theta, psi, wish);
  }

  /**
   * A moment of the past is looked at; null: the present.
   * @param {{time: number, rows: Float64Array, at: number}|null} moment  at: where its row begins
   */
  look(moment) {
    this.#strip.look(moment && moment.time);
    if (moment) this.horizon.look(moment.rows, moment.at);
  }

  /** Once per animation frame, behind what flies. @param {number} now  ms */
  render(now) {
    this.#now = now;
    this.#strip.render(now);
    this.horizon.render(now);
    this.lamps.render(now, this.flight.state, this.flight.craft);
    this.sound.render(now);
  }
}
