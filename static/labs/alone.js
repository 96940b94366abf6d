/**
 * A lab alone, without a class: this browser keeps what was done, the server marks it and keeps nothing.
 * @typedef {import('./shapes.js').Desk} Desk
 * @typedef {import('./shapes.js').Lab} Lab
 * @typedef {import('./shapes.js').Kept} Kept
 * @typedef {import('./shapes.js').Standing} Standing
 */
import { call, fileOf } from '../net/index.js';
import { t } from '../text/index.js';
import { isForgetful, read, write } from './kept.js';

const SEEDS = 2 ** 31;

/** @param {string} name @param {string} [rest] */
const path = (name, rest = '') => `api/v1/labs/${encodeURIComponent(name)}${rest}`;

/** The labs of this server. @returns {Promise<import('./shapes.js').Listed[]>} */
export const getLabs = () => call('api/v1/labs');

/** @implements {Desk} */
export class AloneDesk {
  who = '';
  link = null;
  #tell = () => {};
  #gone = new AbortController();

  /** @param {string} name @returns {Promise<AloneDesk>} */
  static async open(name) {
    const kept = read(`lab.${name}`, { seed: Math.floor(Math.random() * SEEDS), at: '', steps: {} });
    const lab = await call(path(name, `?seed=${kept.seed}`));
    return new AloneDesk(lab, kept);
  }

  /**
   * @param {Lab & {rig?: import('../bodies/bodies.js').Body}} lab
   * @param {{seed: number, at: string, steps: Record<string, Kept>}} kept
   */
  constructor(lab, { seed, at, steps }) {
    this.lab = lab;
    this.rig = lab.rig ?? { preset: lab.preset };
    this.seed = seed;
    this.at = at;
    this.kept = steps;
    this.#save();
    const again = () => {
      this.#reread();
      this.#tell();
    };
    addEventListener('storage', again, { signal: this.#gone.signal });
  }

  /** @returns {Standing} */
  get standing() {
    if (!isForgetful()) return { kind: 'fine', words: '' };
    return {
      kind: 'waiting',
      words: t('This browser keeps nothing: its storage is full or switched off. Your work is gone with this page.'),
    };
  }

  /** Another tab may have been busy with the same lab. */
  #reread() {
    const { seed, steps } = read(`lab.${this.lab.name}`, { seed: this.seed, steps: this.kept });
    if (seed === this.seed) this.kept = steps;
  }

  #save() {
    write(`lab.${this.lab.name}`, { seed: this.seed, at: this.at, steps: this.kept });
  }

  /** @param {string} step @param {Kept} part */
  #keep(step, part) {
    this.#reread();
    this.kept = { ...this.kept, [step]: { ...this.kept[step], ...part } };
    this.#save();
  }

  /** @type {Desk['mark']} */
  async mark(step, design, answers, flight) {
    const { hints = [] } = this.kept[step] ?? {};
    const taken = hints.map((hint) => (typeof hint === 'number' ? hint : hint.hint));
    /** @type {import('./shapes.js').Marked} */
    const marked = await call(path(this.lab.name, '/mark'), {
      ...{ seed: this.seed, step, design, answers, hints: taken },
      ...(flight && { flight }),
    });
    this.#reread();
    const { best, attempts = 0 } = this.kept[step] ?? {};
    const better = !best || best.points < marked.points;
    this.#keep(step, { attempts: attempts + 1, best: better ? { ...marked, answers } : best });
    this.#tell();
    return marked;
  }

  /** @type {Desk['hint']} */
  async hint(step, hint) {
    /** @type {import('./shapes.js').HintText} */
    const text = await call(path(this.lab.name, `/steps/${encodeURIComponent(step)}/hints/${hint}`));
    this.#reread();
    const others = (this.kept[step]?.hints ?? []).filter((one) => (typeof one === 'number' ? one : one.hint) !== hint);
    this.#keep(step, { hints: [...others, { ...text, hint }] });
    this.#tell();
    return text;
  }

  /** @param {string} step */
  flightName(step) {
    return `flight.${this.lab.name}.${this.seed}.${step}`;
  }

  /** @type {Desk['keep']} */
  keep(step, design, answers) {
    this.at = step;
    this.#keep(step, { design, answers });
  }

  /** @param {string} step */
  recording(step) {
    return fileOf(path(this.lab.name, `/recording?${new URLSearchParams({ seed: String(this.seed), step })}`));
  }

  /** @param {() => void} told */
  onChange(told) {
    this.#tell = told;
  }

  leave() {
    this.#gone.abort();
  }
}
