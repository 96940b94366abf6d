/**
 * What one pole means, written beside it: place, damping, frequency, settling time and overshoot alone; where the PI
 * loops take it; and how its axis' step settles.
 */
import { conjugates, fixed, say, seconds, t } from '../text/index.js';
import {
  AXES,
  axisOf,
  character,
  fourOf,
  guideWords,
  handlesOf,
  isAsked,
  isComplex,
  kindOf,
  numeralOf,
  pairAlone,
  partner,
  placesPoles,
} from '../model/index.js';
import { h, setText } from '../ui/index.js';
import { toPixel } from './math.js';

const NAMES = ['pitch', 'yaw'];

/** @typedef {Pick<import('../types.js').State, 'design'|'methods'|'reply'|'answered'|'requirements'|'view'|
 *   'motion'>} Known */

/** The figures of a motion in few words. @param {number|undefined} settling @param {number|undefined} overshoot */
const figures = (settling, overshoot) =>
  say`settles in ${seconds(settling)}${overshoot === undefined ? '' : say`, overshoot ${fixed(overshoot, 0)} %`}`;

/**
 * What a pole says by itself, and what becomes of it: where the PI loops take it, and how the axis' step settles then.
 * @param {Known} known
 * @param {number} index
 * @param {import('../types.js').Complex} [to] where the PI loops take it
 * @returns {string[]}
 */
export function readoutLines({ design, methods, reply, requirements, view, motion }, index, to) {
  const p = design && handlesOf(design)[index];
  if (!design || !p) return [];
  const pair = axisOf(index);
  const { wn, zeta, settling, overshoot } = character(p);
  const kind = kindOf(index);
  const two = kind !== 'rotor' && isComplex(fourOf(design, index), pair);
  const [first, second] = [index, partner(index)].sort().map(numeralOf);
  const own = [`${conjugates(two ? p : { re: p.re, im: 0 })} rad/s`, `ζ ${fixed(zeta)}   ωₙ ${fixed(wn)} rad/s`];
  if (kind === 'rotor') return [say`${NAMES[pair]} rotor pole ${numeralOf(index)}`, ...own.slice(0, 1)];
  if (kind === 'observer')
    return [
      two
        ? say`${NAMES[pair]} observer poles ${first}, ${second}`
        : say`${NAMES[pair]} observer pole ${numeralOf(index)}`,
      ...own,
      settling === undefined
        ? t('alone: grows, unstable')
        : say`errors of the estimate die away in ${seconds(settling)}`,
    ];
  const name = two ? say`${NAMES[pair]} poles ${first}, ${second}` : say`${NAMES[pair]} pole ${numeralOf(index)}`;
  if (!placesPoles({ design, methods })) return [name, ...own, t('not used: the method chooses its own poles')];
  const axis = AXES[pair];
  const metrics = reply?.axis_steps?.[axis]?.nonlinear.metrics?.[axis];
  const guide = isAsked(requirements) ? guideWords(p, requirements) : '';
  const pi = design?.outer === 'pi';
  const step = !metrics
    ? ''
    : reply?.stable === false
      ? t('unstable')
      : metrics.settling_time === undefined
        ? say`not settled, overshoot ${fixed(metrics.overshoot, 0)} %`
        : figures(metrics.settling_time, metrics.overshoot);
  return [
    name,
    ...own,
    settling === undefined ? t('alone: grows, unstable') : say`alone: ${figures(settling, overshoot)}`,
    pi && to ? say`with PI: goes to ${pairText(to)} rad/s` : '',
    // the first minute judges a step by where it ends, which need not be where it was asked to
    step && pairAlone({ view, motion }) === null ? (pi ? say`with PI: ${step}` : say`step: ${step}`) : '',
    guide && say`guide: alone ${guide} than asked`,
  ];
}

/** One of a conjugate pair stands for both. @param {import('../types.js').Complex} p */
const pairText = (p) => conjugates(Math.abs(p.im) > 1e-9 * Math.hypot(p.re, p.im) ? p : { re: p.re, im: 0 });

/**
 * @typedef {{x: number, y: number, width: number, height: number, unit: number}} At a pole in the plane, and the
 *   plane's size, CSS pixels; `unit`: those to one of the view's
 */

/**
 * Where the lines stand: above the pole, or below it where there is no room; all of them in the plane.
 * @param {At} at
 * @param {number} width of the lines
 * @param {number} height
 */
export function readoutPlace(at, width, height) {
  const [above, below] = [at.y - 26 * at.unit - height, at.y + 26 * at.unit];
  // beside the pole where neither has room
  const top = above >= 2 ? above : below + height <= at.height - 2 ? below : 2;
  return { left: Math.max(4, Math.min(at.x + 24 * at.unit, at.width - width - 4)), top };
}

export class Readout {
  #width = 190;
  #height = 110;
  /** @type {At|null} */ #at = null;
  /** @type {number|null} whose lines they are */ #told = null;

  constructor() {
    this.lines = Array.from({ length: 7 }, () => h('div'));
    this.node = h('div', { class: 'readout', hidden: true, 'data-testid': 'readout' }, this.lines);
    new ResizeObserver(([entry]) => {
      if (!entry.contentRect.width) return;
      [this.#width, this.#height] = [entry.borderBoxSize[0].inlineSize, entry.borderBoxSize[0].blockSize];
      this.#place();
    }).observe(this.node);
  }

  /**
   * @param {import('../types.js').State} state
   * @param {number|null} index of the pole in question
   * @param {import('./math.js').View} view
   * @param {number} unit CSS pixels to one of the view's
   * @param {import('../types.js').Complex} [to]
   */
  draw(state, index, view, unit, to) {
    const { design, dragging } = state;
    const p = design && index !== null ? handlesOf(design)[index] : undefined;
    this.node.hidden = !p;
    if (index === null || !p) return;
    if (!dragging || index !== this.#told) this.write(state, index, to);
    const [x, y] = toPixel(view, p).map((v) => v * unit);
    this.#at = { x, y, width: view.width * unit, height: view.height * unit, unit };
    this.#place();
  }

  #place() {
    if (!this.#at) return;
    const { left, top } = readoutPlace(this.#at, this.#width, this.#height);
    this.node.style.transform = `translate(${left}px, ${top}px)`;
  }

  /**
   * What is read, which changes oftener in a drag than it can be read.
   * @param {Known} known
   * @param {number|null} index
   * @param {import('../types.js').Complex} [to] where the PI loops take the pole
   */
  write(known, index, to) {
    if (index === null || !known.design) return;
    this.#told = index;
    const lines = readoutLines(known, index, to);
    this.lines.forEach((node, k) => setText(node, lines[k] ?? ''));
    const name = `readout ${NAMES[axisOf(index)]}`;
    if (this.node.className !== name) this.node.className = name;
  }
}
