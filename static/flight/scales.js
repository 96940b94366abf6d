/**
 * The vertical scales of a strip chart. A scale that follows its curves grows at once, so that nothing is off the
 * chart, and shrinks only where a narrower one would have done for a while: it does not breathe. Pure.
 * @typedef {{low: number, high: number}} Span
 *
 * @typedef {object} Ruler  how a scale is divided
 * @property {number} least  narrowest division
 * @property {readonly number[]} ladder  PLAIN, or widths before the last one is doubled
 * @property {boolean} [floating]  whether 0 need not be in the middle
 */

/** Divisions of a lane. */
export const DIVISIONS = 4;
/** So many times narrower must a scale be that is not about 0. */
const MUCH = 4;
/** How long a narrower scale must have been enough, s. */
const PATIENCE = 3;

/** Widths of a division that read well: 1, 2, 5 and their decimal multiples. */
export const PLAIN = [1, 2, 5];
/** For angles, °. */
export const ANGULAR = [5, 10, 15, 30, 45, 90, 180, 360];

/**
 * The narrowest span of four divisions in which all lies: about 0, or about another multiple of the division where that
 * shows much more.
 * @param {number} low @param {number} high
 * @param {Ruler} ruler
 * @returns {Span}
 */
export function spanOf(low, high, ruler) {
  const about = about0(Math.max(Math.abs(low), Math.abs(high)), ruler);
  if (!ruler.floating) return about;
  for (let i = 0; ; i++) {
    const half = (DIVISIONS / 2) * rung(i, ruler);
    if (MUCH * half > about.high) return about;
    const middle = rung(i, ruler) * Math.round((low + high) / 2 / rung(i, ruler));
    if (low >= middle - half && high <= middle + half) return { low: middle - half, high: middle + half };
  }
}

/** @param {number} most @param {Ruler} ruler @returns {Span} */
function about0(most, ruler) {
  for (let i = 0; ; i++) {
    const half = (DIVISIONS / 2) * rung(i, ruler);
    if (!(most > half)) return { low: -half, high: half };
  }
}

/** @param {number} i @param {Ruler} ruler */
function rung(i, { least, ladder }) {
  if (ladder !== PLAIN) {
    const [from, { length }] = [ladder.findIndex((own) => own >= least), ladder];
    return from + i < length ? ladder[from + i] : ladder[length - 1] * 2 ** (from + i - length + 1);
  }
  const decade = Math.floor(Math.log10(least) + 1e-9);
  const at = PLAIN.findIndex((own) => own * 10 ** decade >= least * (1 - 1e-9)) + i;
  return PLAIN[at % 3] * 10 ** (decade + Math.floor(at / 3));
}

export class Scale {
  /** @type {Span} */ span;
  #since = -1;

  /** @param {Ruler} ruler */
  constructor(ruler) {
    this.ruler = ruler;
    this.span = spanOf(0, 0, ruler);
  }

  /** As at first. */
  reset() {
    this.span = spanOf(0, 0, this.ruler);
    this.#since = -1;
  }

  /** Whether something lies beyond it. @param {number} low @param {number} high */
  exceeded(low, high) {
    return low < this.span.low || high > this.span.high;
  }

  /**
   * Has all that is seen lie within it.
   * @param {number} low @param {number} high  of what is seen; Infinity and −Infinity where nothing is
   * @param {number} time  s
   * @returns {boolean} whether it is another scale now
   */
  fit(low, high, time) {
    if (!(low <= high) || low === -Infinity || high === Infinity) return false;
    const { span } = this;
    const next = spanOf(low, high, this.ruler);
    if (this.exceeded(low, high)) return this.#become(next);
    if (!(next.high - next.low < span.high - span.low)) this.#since = -1;
    else if (this.#since < 0 || time < this.#since) this.#since = time;
    else if (time - this.#since >= PATIENCE) return this.#become(next);
    return false;
  }

  /** @param {Span} next */
  #become(next) {
    this.span = next;
    this.#since = -1;
    return true;
  }
}

/** How far a scale of voltages reaches, in limits of the motor. */
const LIMIT_AT = 1.2;

/** Of voltages, where the motor has a limit: it lies a little within. @param {number} limit  V @returns {Span} */
export const limited = (limit) => ({ low: -LIMIT_AT * limit, high: LIMIT_AT * limit });

/** Decimals with which a scale's divisions are written. @param {Span} span @param {number} [divisions] */
export function decimalsOf({ low, high }, divisions = DIVISIONS) {
  const step = (high - low) / divisions;
  for (let n = 0; n < 4; n++) if (Math.abs(step * 10 ** n - Math.round(step * 10 ** n)) < 1e-6) return n;
  return 4;
}
