/**
 * Two conjugate-closed pairs of poles, and the ways to edit them that keep them so. Pure.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {import('../types.js').Poles} Poles
 */
import { allowed } from './rig.js';

export const LIMIT = allowed('poles').max;

/** @param {number} index 0…3 @returns {number} the other pole of its pair */
export const partner = (index) => index ^ 1;

/** @param {number} index @returns {0|1} 0 pitch, 1 yaw */
export const pairOf = (index) => (index < 2 ? 0 : 1);

/** @param {readonly Complex[]} poles @param {0|1} pair */
export const isComplex = (poles, pair) => Math.abs(poles[2 * pair].im) > 0;

/** @param {number} v */
const clamp = (v) => Math.max(-LIMIT, Math.min(LIMIT, Number.isFinite(v) ? v : 0));

/** Rounds away the noise of pixels, so that numbers read well and compare equal. @param {number} v */
export const tidy = (v) => {
  const r = Math.round(v * 1e6) / 1e6;
  return r === 0 ? 0 : r;
};

/** @param {readonly Complex[]} poles @param {0|1} pair @param {Complex} a @param {Complex} b @returns {Poles} */
function withPair(poles, pair, a, b) {
  const next = /** @type {Poles} */ (poles.slice());
  next[2 * pair] = { re: tidy(clamp(a.re)), im: tidy(clamp(a.im)) };
  next[2 * pair + 1] = { re: tidy(clamp(b.re)), im: tidy(clamp(b.im)) };
  return next;
}

/**
 * Sets one pole of a complex pair; its conjugate follows.
 * @param {readonly Complex[]} poles
 * @param {number} index
 * @param {Complex} to
 */
export function setComplex(poles, index, to) {
  const conjugate = { re: to.re, im: -to.im };
  const [a, b] = index % 2 === 0 ? [to, conjugate] : [conjugate, to];
  return withPair(poles, pairOf(index), a, b);
}

/** Sets one pole of a real pair. @param {readonly Complex[]} poles @param {number} index @param {number} re */
export function setReal(poles, index, re) {
  const moved = { re, im: 0 };
  const other = { re: poles[partner(index)].re, im: 0 };
  const [a, b] = index % 2 === 0 ? [moved, other] : [other, moved];
  return withPair(poles, pairOf(index), a, b);
}

/**
 * Whether a pole on the real axis has met another on its way, as it stands there now or has passed it since: a quick
 * hand goes far from one event to the next.
 * @param {number} other where the other stands @param {number} from @param {number} to
 * @param {number} [within] how near is met
 */
export const meets = (other, from, to, within = 0) =>
  Math.abs(to - other) <= within || (from - other) * (to - other) <= 0;

/**
 * One step of a drag. A complex pair follows the pointer and turns into a double real pole within `snap` of the axis; a
 * real pole slides along the axis and, once it has met its partner (within `meet`, or passed it), leaves the axis
 * together with it.
 * `together` remembers within one gesture that the pair moves as one.
 * @param {readonly Complex[]} poles
 * @param {number} index
 * @param {Complex} to
 * @param {{snap: number, meet: number, together: boolean}} how
 * @returns {{poles: Poles, together: boolean}}
 */
export function drag(poles, index, to, { snap, meet, together }) {
  const pair = pairOf(index);
  const onAxis = Math.abs(to.im) <= snap;
  if (together || isComplex(poles, pair)) {
    return { poles: setComplex(poles, index, onAxis ? { re: to.re, im: 0 } : to), together: true };
  }
  const met = meets(poles[partner(index)].re, poles[index].re, to.re, meet);
  if (met && !onAxis) return { poles: setComplex(poles, index, to), together: true };
  return { poles: setReal(poles, index, to.re), together: false };
}

/**
 * One press of a key. Up and down leave the axis only where the pair has met: there is no other way a real pair can
 * turn complex. So that it can meet, a pole that would step onto its partner, or over it, stops there.
 * @param {readonly Complex[]} poles @param {number} index @param {Complex} by
 * @returns {Poles}
 */
export function nudge(poles, index, by) {
  const here = poles[index];
  const to = { re: here.re + by.re, im: here.im + by.im };
  if (isComplex(poles, pairOf(index))) {
    const crosses = Math.sign(to.im) !== Math.sign(here.im) || Math.abs(to.im) < Math.abs(by.im) / 2;
    return setComplex(poles, index, by.im !== 0 && crosses ? { re: to.re, im: 0 } : to);
  }
  const other = poles[partner(index)].re;
  if (by.im !== 0 && here.re === other) return setComplex(poles, index, to);
  const [before, after] = [here.re - other, to.re - other];
  if (before !== 0 && (before * after <= 0 || Math.abs(after) < Math.abs(by.re) / 2))
    return setReal(poles, index, other);
  return by.re === 0 ? /** @type {Poles} */ (poles.slice()) : setReal(poles, index, to.re);
}

/**
 * Turns a pair real or complex while it stays about where it is, and never across the imaginary axis.
 * @param {readonly Complex[]} poles @param {0|1} pair @param {boolean} complex
 * @returns {Poles}
 */
export function setMode(poles, pair, complex) {
  const [a, b] = [poles[2 * pair], poles[2 * pair + 1]];
  if (complex === isComplex(poles, pair)) return /** @type {Poles} */ (poles.slice());
  const mean = (a.re + b.re) / 2;
  if (complex) {
    const im = Math.max(Math.abs(a.re - b.re) / 2, Math.abs(mean) / 4, 0.1);
    return setComplex(poles, 2 * pair, { re: mean, im: Number(im.toPrecision(3)) });
  }
  const d = Math.min(Math.abs(a.im), Math.abs(mean) / 2);
  return withPair(poles, pair, { re: mean - d, im: 0 }, { re: mean + d, im: 0 });
}

/** What a pole says about its motion. @param {Complex} p */
export function character(p) {
  const wn = Math.hypot(p.re, p.im);
  const zeta = wn > 0 ? -p.re / wn : 1;
  const settling = p.re < 0 ? 4 / -p.re : undefined;
  const overshoot = p.re < 0 && p.im !== 0 ? 100 * Math.exp((Math.PI * p.re) / Math.abs(p.im)) : undefined;
  return { wn, zeta, settling, overshoot };
}

/** @param {unknown} poles @returns {Poles} poles from outside, made exact conjugates */
export function fromWire(poles) {
  const list = /** @type {(Complex|number)[]} */ (poles).map((p) =>
    typeof p === 'number' ? { re: p, im: 0 } : { re: p.re, im: p.im },
  );
  return /** @type {Poles} */ (list);
}
