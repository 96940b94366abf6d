/** What one pole means, written beside it: place, damping, frequency, settling time, overshoot, and whether it meets the requirements. */
import { h, setText } from './dom.js';
import { fixed, seconds } from './format.js';
import { character, isComplex, pairOf, partner } from './poles.js';
import { readoutWords } from './requirements.js';
import { bounds, toPixel } from './splane_math.js';

const NAMES = ['pitch', 'yaw'];

/** @param {readonly import('./types.js').Complex[]} poles @param {number} index @param {import('./types.js').Requirements} requirements @returns {string[]} */
export function readoutLines(poles, index, requirements) {
  const p = poles[index];
  const pair = pairOf(index);
  const { wn, zeta, settling, overshoot } = character(p);
  const two = isComplex(poles, pair);
  const first = Math.min(index, partner(index)) + 1;
  return [
    two ? `${NAMES[pair]} poles ${first}, ${first + 1}` : `${NAMES[pair]} pole ${index + 1}`,
    two ? `${fixed(p.re)} \u00b1 ${fixed(Math.abs(p.im))}j rad/s` : `${fixed(p.re)} rad/s`,
    `ζ ${fixed(zeta)}   ωₙ ${fixed(wn)} rad/s`,
    settling === undefined ? 'grows: unstable' : `settles in ${seconds(settling)}${overshoot === undefined ? '' : `, overshoot ${fixed(overshoot, 0)} %`}`,
    readoutWords(p, requirements),
  ];
}

/**
 * Where the lines stand: above the pole, in the uppermost quarter below it; to its right as far as the picture reaches.
 * @param {import('./splane_math.js').View} view @param {import('./types.js').Complex} p @param {number} unit CSS pixels to one of the view's @param {number} width of the lines
 * @returns {{left: number, edge: number, below: boolean}} CSS pixels; the edge is the one towards the pole
 */
export function readoutPlace(view, p, unit, width) {
  const [x, y] = toPixel(view, p).map((v) => v * unit);
  const b = bounds(view);
  const below = p.im > (b.top + b.bottom) / 2 + (b.top - b.bottom) / 4;
  const left = Math.max(4, Math.min(x + 24 * unit, view.width * unit - width - 4));
  return { left, edge: y + (below ? 26 : -26) * unit, below };
}

export class Readout {
  #width = 190;
  /** @type {number|null} whose lines they are */ #told = null;

  constructor() {
    this.lines = [0, 1, 2, 3, 4].map(() => h('div'));
    this.node = h('div', { class: 'readout', hidden: true, 'data-testid': 'readout' }, this.lines);
    new ResizeObserver(([entry]) => {
      if (entry.contentRect.width) this.#width = entry.borderBoxSize[0].inlineSize;
    }).observe(this.node);
  }

  /** @param {import('./types.js').State} state @param {number|null} index of the pole in question @param {import('./splane_math.js').View} view @param {number} unit CSS pixels to one of the view's */
  draw({ design, requirements, dragging }, index, view, unit) {
    this.node.hidden = index === null || !design;
    if (index === null || !design) return;
    if (!dragging || index !== this.#told) this.write({ design, requirements }, index);
    const { left, edge, below } = readoutPlace(view, design.poles[index], unit, this.#width);
    this.node.style.transform = `translate(${left}px, ${edge}px) translateY(${below ? '0' : '-100%'})`;
  }

  /** What is read, which changes oftener in a drag than it can be read. @param {Pick<import('./types.js').State, 'design'|'requirements'>} state @param {number|null} index */
  write({ design, requirements }, index) {
    if (index === null || !design) return;
    this.#told = index;
    const lines = readoutLines(design.poles, index, requirements);
    lines.forEach((line, k) => setText(this.lines[k], line));
    const name = `readout ${NAMES[pairOf(index)]}${lines[4].startsWith('✕') ? ' missed' : ''}`;
    if (this.node.className !== name) this.node.className = name;
  }
}
