/**
 * How large type and lines are on canvases: style.css and views.css say it as `--picture-type` (rem) and
 * `--picture-lines`, so that charts grow with the page, be it for a reader's setting, a very large window or a lecture
 * hall. Every chart is registered here once and then follows.
 */
const TYPE = 11; // px, as charts are made
const REM = 10; // px, at the browser's usual setting

/** @typedef {{type: number, line: number}} Scale  factors of what the charts are made with */
/** @typedef {import('../vendor/uplot/uPlot.esm.js').default} Chart */
/** @typedef {Record<string, {min: number, max: number}>} Ranges  the scales of a chart that is drawn */
/** @typedef {[string, number, number]} Font  as uPlot keeps it: the canvas' font, its size there, in CSS pixels */
/** @typedef {{chart: Chart, widths: number[], fonts: number[]}} Kept  a chart and its sizes at first */

/** @type {Scale|null} */ let present = null;
/** @type {Kept[]} */ const all = [];

/**
 * @param {{fontSize: string, getPropertyValue: (name: string) => string}} style of the root element
 * @returns {Scale}
 */
export function scaleOf(style) {
  const rem = Number.parseFloat(style.fontSize);
  return {
    type: (rem * Number(style.getPropertyValue('--picture-type'))) / TYPE,
    line: (rem / REM) * Number(style.getPropertyValue('--picture-lines')),
  };
}

/** The page's present scale. @returns {Scale} */
export function pictureScale() {
  if (!present) {
    present = scaleOf(getComputedStyle(document.documentElement));
    addEventListener('resize', rescale);
  }
  return present;
}

/** CSS pixels to one of a drawing that is laid out for the usual setting. */
export const drawingUnit = () => Number.parseFloat(getComputedStyle(document.documentElement).fontSize) / REM;

/** To be called when what the stylesheets say may have changed. */
export function rescale() {
  const next = scaleOf(getComputedStyle(document.documentElement));
  if (present && next.type === present.type && next.line === present.line) return;
  present = next;
  for (const kept of all) {
    apply(kept, next);
    kept.chart.redraw(true, true);
  }
}

/** @param {Kept} kept @param {Scale} scale */
function apply({ chart, widths, fonts }, { type, line }) {
  chart.series.slice(1).forEach((series, i) => (series.width = widths[i] * line));
  fontsOf(chart).forEach((font, i) => {
    font[2] = fonts[i] * type;
    font[1] = Math.round(font[2] * devicePixelRatio);
    font[0] = font[0].replace(/[\d.]+px/, `${font[1]}px`);
  });
}

/** @param {Chart} chart */
const fontsOf = (chart) => chart.axes.map(({ font }) => /** @type {Font} */ (/** @type {unknown} */ (font)));

/** Has a chart of uPlot's follow the page. @param {Chart} chart */
export function followsPage(chart) {
  const kept = {
    chart,
    widths: chart.series.slice(1).map((s) => s.width ?? 1),
    fonts: fontsOf(chart).map((font) => font[2]),
  };
  all.push(kept);
  apply(kept, pictureScale()); // in time for its first drawing, which uPlot puts off to the end of this task
  return chart;
}
