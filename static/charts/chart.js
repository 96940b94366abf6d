/**
 * What all charts over time or frequency share: frame, axes, the page's colours and size of type, the room that they
 * have, and reading values by the arrow keys. uPlot draws them; each says its lines, ranges and what lies beside them.
 * @typedef {uPlot.Series & {color: string, width: number}} Line color: its name in style.css
 * @typedef {Omit<uPlot.Axis, 'size'|'space'> & {size: number|(() => number), space?: number}} Axis px at the usual size
 *   of type
 * @typedef {import('../ui/dom.js').Child} Child
 */
import uPlot from '../vendor/uplot/uPlot.esm.js';
import { followsPage, h, pictureScale } from '../ui/index.js';

/** Dashes of what was measured, on the page and in pictures. */
export const RECORDED = [9, 3, 2, 3];
const THEMES = ['(prefers-color-scheme: dark)', '(prefers-contrast: more)'];

/** @type {Map<string, string>} */ const inks = new Map();
/** @type {uPlot[]} */ const charts = [];

/** A colour of the page as it is now. @param {string} name without its dashes @returns {string} */
export function ink(name) {
  const known = inks.get(name) || getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  inks.set(name, known);
  return known;
}

function followTheme() {
  inks.clear();
  for (const chart of charts) chart.redraw(false);
}

/** Pixels that grow with the size of type. @param {number} px @returns {() => number} */
export const scaled = (px) => () => px * pictureScale().type;

/**
 * @param {HTMLElement} body whose room it takes
 * @param {object} how
 * @param {Line[]} how.lines
 * @param {uPlot.AlignedData} how.data
 * @param {{x?: uPlot.Scale, y: uPlot.Scale}} how.scales
 * @param {[Axis, Axis]} how.axes
 * @param {number} [how.height] until the room is known
 * @param {uPlot.Padding} [how.padding]
 * @param {uPlot.Cursor} [how.cursor]
 * @param {uPlot.Hooks.Arrays} [how.hooks]
 * @param {string} [how.font] of the axes' numbers
 * @param {() => void} [how.onSize]
 */
export function makeChart(body, { lines, data, scales, axes, cursor, font = '11px', onSize, height = 160, ...more }) {
  if (!charts.length) for (const query of THEMES) matchMedia(query).addEventListener('change', followTheme);
  const stroke = (/** @type {string} */ name) => () => ink(name);
  const chart = followsPage(
    new uPlot(
      {
        width: 300,
        height,
        legend: { show: false },
        pxAlign: 0,
        series: [
          {},
          ...lines.map(({ color, ...line }) => ({ points: { show: false }, stroke: stroke(color), ...line })),
        ],
        scales: { ...scales, x: { time: false, ...scales.x } },
        axes: axes.map(({ size, space, grid, ...axis }, i) => ({
          stroke: stroke('muted'),
          font: `${font} system-ui, sans-serif`,
          ticks: { show: false },
          grid: { stroke: stroke('grid'), width: 1, ...grid },
          gap: 5,
          size: typeof size === 'number' ? scaled(size) : size,
          space: scaled(space ?? (i ? 30 : 50)), // uPlot's own
          ...axis,
        })),
        cursor: { y: false, points: { show: false }, ...cursor },
        ...more,
      },
      data,
      body,
    ),
  );
  charts.push(chart);
  new ResizeObserver(([entry]) => {
    const { width, height } = entry.contentRect;
    if (width > 60 && height > 40) chart.setSize({ width: Math.floor(width), height: Math.floor(height) });
    onSize?.();
  }).observe(body);
  return chart;
}

/** Where a chart is drawn, and what its keys do. @param {string} label @param {(e: KeyboardEvent) => void} onkeydown */
export const chartBody = (label, onkeydown) =>
  h('div', { class: 'plot-body', tabindex: 0, role: 'group', 'aria-label': label, onkeydown });

/**
 * A chart's figure, with a key of its lines and, beside each, the value that is read.
 * @param {Record<string, string>} attributes
 * @param {Child[]} head
 * @param {{kind: string, title?: string, name: Child|readonly Child[], value: HTMLElement}[]} keys
 * @param {HTMLElement} body
 */
export const readingFigure = (attributes, head, keys, body) =>
  h(
    'figure',
    attributes,
    h(
      'figcaption',
      {},
      head,
      keys.map(({ kind, title, name, value }) =>
        h(
          'span',
          { class: 'key', title },
          h('span', { class: `line ${kind}`, 'aria-hidden': 'true' }),
          h('span', {}, name),
          value,
        ),
      ),
    ),
    body,
  );

/**
 * Left and right move the cursor, from the middle where there is none.
 * @param {KeyboardEvent} e
 * @param {uPlot|null} chart
 * @param {number} step in samples; ten of them with Shift
 */
export function readByKeys(e, chart, step) {
  const way = { ArrowLeft: -1, ArrowRight: 1 }[e.key];
  if (!way || !chart || e.ctrlKey || e.metaKey || e.altKey) return;
  const { idx, left = -1 } = chart.cursor;
  const [over] = chart.data;
  const last = over.length - 1;
  const i =
    left < 0 || idx === null || idx === undefined
      ? Math.round(last / 2)
      : Math.max(0, Math.min(last, idx + way * step * (e.shiftKey ? 10 : 1)));
  chart.setCursor({ left: chart.valToPos(over[i], 'x'), top: 1 });
  e.preventDefault();
}

/** The index under the pointer, null where there is none. @param {uPlot} chart @returns {number|null} */
export const readIndex = ({ cursor: { idx, left = -1 } }) => (left < 0 ? null : (idx ?? null));
