/**
 * Gamepads, as browsers give them: none is told of before a person has pressed something on it; in Chromium what
 * getGamepads gives is a snapshot, in Firefox it lives, so it is asked once per frame, and what was pressed is kept
 * here. A page in a frame that may not ask gets an error, and one over plain HTTP may have no such function at all.
 * @typedef {import('./keys.js').Act} Act
 * @typedef {import('./keys.js').Demand} Demand
 * @typedef {{id: string, index: number, connected: boolean, mapping: string, axes: readonly number[],
 *   buttons: readonly {pressed: boolean}[]}} Device
 * @typedef {object} PadReading
 * @property {string} name as the browser names it, without its numbers
 * @property {boolean} known whether its layout is the standard one
 * @property {Demand} sticks set points' rates: the left stick
 * @property {Demand} volts the left stick's y for pitch, the right one's x for yaw
 * @property {Act[]} acts what was pressed since it was read last
 */

/** What an axis must leave before it acts. */
export const DEAD = 0.12;
/** An axis that moves by less than this writes nothing: its noise is about ±0.004. */
const QUIET = 0.015;
const FINEST = 0.01;

/** A, B, X, Y of the standard layout. @type {Act[]} */
const BUTTONS = ['toggle', 'gust', 'hands', 'rewind'];
const [LEFT_X, LEFT_Y, RIGHT_X] = [0, 1, 2];

/** An axis without its dead middle, whole at its end. @param {number} v */
export function beyondDead(v) {
  const size = Math.min(Math.abs(v), 1);
  return size <= DEAD || !Number.isFinite(v) ? 0 : Math.sign(v) * ((size - DEAD) / (1 - DEAD));
}

/**
 * Where an axis is said to be: where it was, unless it has moved by more than noise or is back in the middle.
 * @param {number} now @param {number} before
 */
export function steadied(now, before) {
  if (now === 0 || Math.abs(now) === 1) return now;
  return Math.abs(now - before) < QUIET ? before : Math.round(now / FINEST) * FINEST;
}

export class Gamepads {
  /** The pad in use, by its place. */ #index = -1;
  /** Which of its buttons were down. @type {boolean[]} */ #down = [];
  /** Where its axes were said to be. @type {number[]} */ #axes = [];
  /**
   * Which have been in the middle since it came: an axis that rests elsewhere is no stick, or is held.
   * @type {boolean[]}
   */
  #free = [];

  /** @param {{getGamepads?: () => readonly (Device|null)[]}} browser */
  constructor(browser) {
    this.browser = browser;
  }

  /** What the pad says now; null where there is none. @returns {PadReading|null} */
  read() {
    const pad = this.#pad();
    if (!pad) {
      this.#index = -1;
      return null;
    }
    const known = pad.mapping === 'standard';
    const down = pad.buttons.map((button) => button.pressed);
    const first = pad.index !== this.#index;
    // the press by which a person makes it known asks for nothing
    const acts = first ? [] : BUTTONS.filter((_, k) => down[k] && !this.#down[k]);
    if (first) [this.#axes, this.#free] = [[], []];
    [this.#index, this.#down] = [pad.index, down];
    const [x, y, right] = [LEFT_X, LEFT_Y, RIGHT_X].map((k) => this.#axis(pad.axes, k));
    return {
      name: pad.id.replace(/\s*\([^)]*(?:vendor|product)[^)]*\)\s*$/i, '').replace(/^[\da-f]{4}-[\da-f]{4}-/i, ''),
      known,
      sticks: { pitch: -y || 0, yaw: x },
      // of a layout that nobody knows the third axis may be anything
      volts: { pitch: -y || 0, yaw: known ? right : x },
      acts,
    };
  }

  /** The one in use, else one whose layout is known, else any with a stick. @returns {Device|undefined} */
  #pad() {
    let all;
    try {
      all = this.browser.getGamepads?.() ?? [];
    } catch {
      return undefined; // a frame whose page does not allow it
    }
    const there = [...all].filter((pad) => pad !== null && pad.connected && pad.axes.length >= 2);
    const pads = /** @type {Device[]} */ (there);
    return (
      pads.find((pad) => pad.index === this.#index) ?? pads.find(({ mapping }) => mapping === 'standard') ?? pads[0]
    );
  }

  /** @param {readonly number[]} axes @param {number} k */
  #axis(axes, k) {
    const now = beyondDead(axes[k] ?? 0);
    this.#free[k] ||= now === 0;
    return (this.#axes[k] = this.#free[k] ? steadied(now, this.#axes[k] ?? 0) : 0);
  }
}
