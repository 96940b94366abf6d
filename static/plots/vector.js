/**
 * A picture as SVG: what `paint` asks of a canvas is written down instead. One function draws both forms, so that they
 * show the same.
 */
import { paint, sizeOf } from './picture.js';

/** @typedef {import('./picture.js').Picture} Picture */
/** @typedef {[number, number, number, number, number, number]} Affine */
/** @typedef {(text: string, font: string) => number} WidthOf px */
const HALF_HEIGHT = 0.35; // em from the middle of letters to their foot: not all programs know of other anchors
const ANCHOR = { left: 'start', center: 'middle', right: 'end' };
const GAP = 12; // between pictures

const escaped = (/** @type {string} */ text) =>
  text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`).replace(/[^\P{Cc}\n\t]/gu, '');
const short = (/** @type {number} */ v) => String(Number(v.toFixed(2)));

/** As much of a canvas' context as pictures use. */
export class VectorContext {
  fillStyle = '#000';
  strokeStyle = '#000';
  lineWidth = 1;
  lineJoin = 'miter';
  lineCap = 'butt';
  globalAlpha = 1;
  font = '12px sans-serif';
  /** @type {'left'|'center'|'right'} */ textAlign = 'left';
  textBaseline = 'alphabetic';
  /** @type {string[]} */ parts = [];
  #path = '';
  /** @type {number[]} */ #dash = [];
  /** @type {Affine} */ #at = [1, 0, 0, 1, 0, 0];
  #clip = '';
  #clips = 0;
  /** @type {object[]} */ #kept = [];

  /** @param {string} id of the picture, which tells its clips from others' @param {WidthOf} widthOf */
  constructor(id, widthOf) {
    this.id = id;
    this.widthOf = widthOf;
  }

  save() {
    const { fillStyle, strokeStyle, lineWidth, lineJoin, lineCap, globalAlpha, font, textAlign, textBaseline } = this;
    const own = { fillStyle, strokeStyle, lineWidth, lineJoin, lineCap, globalAlpha, font, textAlign, textBaseline };
    this.#kept.push({ own, at: this.#at, clip: this.#clip, dash: this.#dash });
  }

  restore() {
    const kept = /** @type {{own: object, at: Affine, clip: string, dash: number[]}|undefined} */ (this.#kept.pop());
    if (!kept) return;
    Object.assign(this, kept.own);
    [this.#at, this.#clip, this.#dash] = [kept.at, kept.clip, kept.dash];
  }

  /** @param {number} x @param {number} y */
  translate(x, y) {
    const [a, b, c, d] = this.#at;
    this.#at = [a, b, c, d, ...this.#point(x, y)];
  }

  /** @param {number} angle */
  rotate(angle) {
    const [a, b, c, d, e, f] = this.#at;
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    this.#at = [a * cos + c * sin, b * cos + d * sin, c * cos - a * sin, d * cos - b * sin, e, f];
  }

  /** @param {number[]} dash */
  setLineDash(dash) {
    this.#dash = dash;
  }

  beginPath() {
    this.#path = '';
  }

  /** @param {number} x @param {number} y */
  moveTo(x, y) {
    this.#path += `M${this.#point(x, y).map(short).join(' ')}`;
  }

  /** @param {number} x @param {number} y */
  lineTo(x, y) {
    this.#path += `${this.#path ? 'L' : 'M'}${this.#point(x, y).map(short).join(' ')}`;
  }

  closePath() {
    this.#path += 'Z';
  }

  /** @param {number} x @param {number} y @param {number} width @param {number} height */
  rect(x, y, width, height) {
    this.moveTo(x, y);
    this.lineTo(x + width, y);
    this.lineTo(x + width, y + height);
    this.lineTo(x, y + height);
    this.closePath();
  }

  /** A whole circle. @param {number} x @param {number} y @param {number} r */
  arc(x, y, r) {
    this.moveTo(x - r, y);
    const turn = (/** @type {number} */ to) =>
      `A${short(r)} ${short(r)} 0 0 1 ${this.#point(to, y).map(short).join(' ')}`;
    this.#path += `${turn(x + r)}${turn(x - r)}Z`;
  }

  clip() {
    this.#clips += 1;
    const name = `${this.id}-clip-${this.#clips}`;
    this.parts.push(`<clipPath id="${name}"${this.#clip}><path d="${this.#path}"/></clipPath>`);
    this.#clip = ` clip-path="url(#${name})"`;
  }

  fill() {
    this.#draw(this.#path, `fill="${this.fillStyle}"${this.#alpha('fill')}`);
  }

  /** @param {number} x @param {number} y @param {number} width @param {number} height */
  fillRect(x, y, width, height) {
    const path = this.#path;
    this.#path = '';
    this.rect(x, y, width, height);
    this.fill();
    this.#path = path;
  }

  stroke() {
    const dash = this.#dash.length ? ` stroke-dasharray="${this.#dash.join(' ')}"` : '';
    const form = `stroke-linejoin="${this.lineJoin}" stroke-linecap="${this.lineCap}"`;
    const ink = `stroke="${this.strokeStyle}" stroke-width="${short(this.lineWidth)}"`;
    this.#draw(this.#path, `fill="none" ${ink} ${form}${dash}${this.#alpha('stroke')}`);
  }

  /** @param {string} text */
  measureText(text) {
    return { width: this.widthOf(text, this.font) };
  }

  /** @param {string} text @param {number} x @param {number} y */
  fillText(text, x, y) {
    const [, weight = '', size = '12', family = 'sans-serif'] = /^(\S+ )?([\d.]+)px (.+)$/.exec(this.font) ?? [];
    const foot = y + (this.textBaseline === 'middle' ? HALF_HEIGHT * Number(size) : 0);
    const [a, b, c, d] = this.#at;
    const [left, top] = this.#point(x, foot);
    const upright = a === 1 && b === 0;
    const place = upright
      ? `x="${short(left)}" y="${short(top)}"`
      : `transform="matrix(${[a, b, c, d, left, top].map(short).join(' ')})"`;
    const heavy = weight ? ` font-weight="${weight.trim()}"` : '';
    const style = `font-family="${escaped(family)}" font-size="${size}"${heavy}`;
    const anchor = `text-anchor="${ANCHOR[this.textAlign]}" fill="${this.fillStyle}"${this.#alpha('fill')}`;
    this.parts.push(`<text ${place} ${style} ${anchor}${this.#clip}>${escaped(text)}</text>`);
  }

  /** @param {string} path @param {string} how */
  #draw(path, how) {
    if (path) this.parts.push(`<path d="${path}" ${how}${this.#clip}/>`);
  }

  /** @param {'fill'|'stroke'} what */
  #alpha(what) {
    return this.globalAlpha < 1 ? ` ${what}-opacity="${this.globalAlpha}"` : '';
  }

  /** @param {number} x @param {number} y @returns {[number, number]} */
  #point(x, y) {
    const [a, b, c, d, e, f] = this.#at;
    return [a * x + c * y + e, b * x + d * y + f];
  }
}

/**
 * Pictures below one another.
 * @param {Picture[]} pictures
 * @param {WidthOf} widthOf
 * @returns {string}
 */
export function svgOf(pictures, widthOf) {
  let [width, height] = [0, 0];
  const drawn = pictures.map((picture, i) => {
    const [own, high] = sizeOf(picture);
    const context = new VectorContext(`plot-${i + 1}`, widthOf);
    paint(/** @type {CanvasRenderingContext2D} */ (/** @type {unknown} */ (context)), picture);
    const top = height && height + GAP;
    [width, height] = [Math.max(width, own), top + high];
    const name = `<title>${escaped(picture.title)}</title>`;
    return `<g transform="translate(0 ${top})">${name}\n${context.parts.join('\n')}\n</g>`;
  });
  const size = `width="${width}" height="${height}" viewBox="0 0 ${width} ${height}"`;
  return `<svg xmlns="http://www.w3.org/2000/svg" ${size}>\n${drawn.join('\n')}\n</svg>\n`;
}

/** How wide text is in a font, by a canvas. @returns {WidthOf} */
export function measuring() {
  const context = document.createElement('canvas').getContext('2d');
  return (text, font) => {
    if (!context) return 0.55 * 12 * text.length;
    context.font = font;
    return context.measureText(text).width;
  };
}
