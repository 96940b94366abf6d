/** How a map looks: its colours by the page's own, light or dark, and by which way is better. */
import { css, ramp } from './colors.js';
import { CHOICES, levelText } from './choices.js';

/** By how much lightness a line stands out from its band, and a label from where it stands. */
const [LINE, INK] = [0.17, 0.5];

/**
 * @param {string} name  of what is shown
 * @param {number[]} levels
 * @param {{dark: boolean, page: string, danger: string, warn: string, muted: string, font: string, type: number}} page
 * @param {number[]} [scale]  those of them that part colours; beyond it the outermost colours go on
 * @returns {import('./picture.js').Look}
 */
export function lookOf(name, levels, page, scale = levels) {
  const key = `${name} ${levels} ${page.dark} ${page.type} ${scale}`;
  if (made.size > MOST) made.clear();
  const look = made.get(key) ?? makeLook(name, levels, page, scale);
  made.set(key, look);
  return look;
}

/** @type {Map<string, import('./picture.js').Look>} */ const made = new Map();
const MOST = 20;

/**
 * @param {string} name @param {number[]} levels @param {Parameters<typeof lookOf>[2]} page @param {number[]} scale
 * @returns {import('./picture.js').Look}
 */
function makeLook(name, levels, page, scale) {
  const colors = ramp(scale.length + 1, page.dark);
  if (CHOICES[name].higher) colors.reverse();
  // a band lies between two levels: its colour is told by how many of the scale's lie below it
  const bands = [-Infinity, ...levels].map((low) => colors[scale.filter((v) => v <= low).length]);
  /** @param {import('./colors.js').Oklab} color @param {number} by @returns {import('./colors.js').Oklab} */
  const away = ([L, a, b], by) => [L > 0.55 ? Math.max(0.12, L - by) : Math.min(0.98, L + by), a, b];
  return {
    ...page,
    bands: bands.map(css),
    lines: levels.map((_, k) => css(away(bands[k + 1], LINE))),
    inks: levels.map((_, k) => css(away(bands[k], INK))),
    label: (level) => levelText(level, levels),
  };
}

/** @type {ReturnType<typeof pageLook>|null} */ let kept = null;

/**
 * What the page's own colours are now; asked for once, as styles are slow to read.
 * @param {Element} node @param {number} type px
 */
export function lookOfPage(node, type) {
  if (!kept) matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => (kept = null), { once: true });
  kept ??= pageLook(node, type);
  return kept.type === type ? kept : { ...kept, type };
}

/** @param {Element} node @param {number} type px */
function pageLook(node, type) {
  const style = getComputedStyle(node);
  const of = (/** @type {string} */ name) => style.getPropertyValue(name).trim();
  return {
    dark: matchMedia('(prefers-color-scheme: dark)').matches,
    page: of('--panel'),
    danger: of('--danger'),
    warn: of('--warn'),
    muted: of('--muted'),
    font: style.fontFamily,
    type,
  };
}

/** On paper. */
export const PAPER = {
  dark: false,
  page: '#ffffff',
  danger: '#b3261e',
  warn: '#8a5a00',
  muted: '#566570',
  font: 'system-ui, sans-serif',
  type: 12,
};
