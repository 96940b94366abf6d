/** Strokes, arrows, boxes and symbols that the paper's figures are drawn with; colours come from paper.css. */
import { svg } from '../ui/index.js';

/** @param {string} points like "10,20 30,40" @param {string} [kind] */
export const wire = (points, kind = '') => svg('polyline', { class: `wire ${kind}`, points });

/** A line with a head at its end. @param {string} points @param {string} [kind] */
export function arrow(points, kind = '') {
  const numbers = points
    .trim()
    .split(/[\s,]+/)
    .map(Number);
  const [x0, y0, x, y] = numbers.slice(-4);
  const [dx, dy] = [(x - x0) / Math.hypot(x - x0, y - y0), (y - y0) / Math.hypot(x - x0, y - y0)];
  const head = [
    [x, y],
    [x - 9 * dx - 3.6 * dy, y - 9 * dy + 3.6 * dx],
    [x - 9 * dx + 3.6 * dy, y - 9 * dy - 3.6 * dx],
  ];
  return svg(
    'g',
    { class: `arrow ${kind}` },
    wire([...numbers.slice(0, -2), x - 5 * dx, y - 5 * dy].join(' ')),
    svg('polygon', { class: 'head', points: head.join(' ') }),
  );
}

/** Letters as a font for mathematics slants them; a drawing's text is no MathML. @param {string} text */
export const slanted = (text) =>
  text
    .normalize('NFD')
    .replace(/[A-Za-zα-ω]/g, (c) =>
      c === 'h' ? 'ℎ' : String.fromCodePoint(c.charCodeAt(0) + (c < '[' ? 0x1d3f3 : c < '{' ? 0x1d3ed : 0x1d34b)),
    );

/**
 * Mathematics: italic base, small subscript.
 * @param {number} x
 * @param {number} y
 * @param {string} base
 * @param {string} [sub]
 * @param {{kind?: string, anchor?: string}} [how]
 */
export const math = (x, y, base, sub, { kind = '', anchor = 'middle' } = {}) =>
  svg(
    'text',
    { class: `math ${kind}`, x, y, 'text-anchor': anchor },
    slanted(base),
    ...(sub ? [svg('tspan', { class: 'sub', dy: 4 }, sub.length > 1 ? sub : slanted(sub))] : []),
  );

/** @param {number} x @param {number} y @param {string} text @param {{kind?: string, anchor?: string}} [how] */
export const words = (x, y, text, { kind = '', anchor = 'middle' } = {}) =>
  svg('text', { class: `words ${kind}`, x, y, 'text-anchor': anchor }, text);

/** A point where signals are added. @param {number} x @param {number} y */
export const sum = (x, y) =>
  svg(
    'g',
    { class: 'sum' },
    svg('circle', { cx: x, cy: y, r: 11 }),
    svg('path', { d: `M ${x - 5} ${y} h 10 M ${x} ${y - 5} v 10` }),
  );

/** @param {number} x @param {number} y */
export const node = (x, y) => svg('circle', { class: 'node', cx: x, cy: y, r: 2.8 });

/**
 * A direction out of the page (dot) or into it (cross).
 * @param {number} x
 * @param {number} y
 * @param {boolean} out
 * @param {string} kind
 */
export const through = (x, y, out, kind) =>
  svg(
    'g',
    { class: `through ${kind}` },
    svg('circle', { cx: x, cy: y, r: 9 }),
    out
      ? svg('circle', { class: 'point', cx: x, cy: y, r: 2.6 })
      : svg('path', { d: `M ${x - 6} ${y - 6} l 12 12 M ${x + 6} ${y - 6} l -12 12` }),
  );

/** A measured length with ticks at its ends. @param {number[]} a @param {number[]} b */
export function dimension([x1, y1], [x2, y2]) {
  const length = Math.hypot(x2 - x1, y2 - y1);
  const [nx, ny] = [(-5 * (y2 - y1)) / length, (5 * (x2 - x1)) / length];
  return svg('path', {
    class: 'dimension',
    d:
      `M ${x1} ${y1} L ${x2} ${y2} M ${x1 - nx} ${y1 - ny} L ${x1 + nx} ${y1 + ny} M ${x2 - nx} ${y2 - ny} L ` +
      `${x2 + nx} ${y2 + ny}`,
  });
}

/**
 * @param {string} id
 * @param {number} width
 * @param {number} height
 * @param {string} title
 * @param {string} description
 * @param {...(import('../ui/dom.js').Child|readonly import('../ui/dom.js').Child[])} children
 */
export const drawing = (id, width, height, title, description, ...children) =>
  svg(
    'svg',
    {
      class: 'drawing',
      viewBox: `0 0 ${width} ${height}`,
      role: 'img',
      'aria-labelledby': `${id}-title ${id}-desc`,
      'data-testid': id,
    },
    svg('title', { id: `${id}-title` }, title),
    svg('desc', { id: `${id}-desc` }, description),
    ...children,
  );
