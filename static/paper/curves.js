/** Figs. 4 and 5, drawn anew: four answers to a step of one radian, told apart by dashes as well as by colour. */
import uPlot from '../vendor/uplot/uPlot.esm.js';
import { DEGREE, fixed, say } from '../text/index.js';
import { followsPage, h, pictureScale, svg } from '../ui/index.js';
import { drawLabel, drawRule, linesMenu } from '../plots/index.js';
import { rich } from './rich.js';
import { CURVES } from './words.js';

/** @typedef {import('./math.js').Curves} Curves @typedef {import('../plots/rules.js').Rule} Rule */
const FONT = '12px system-ui, sans-serif';
/**
 * The first is drawn broad, since others lie upon it.
 * @type {Record<string, {color: string, width: number, dash: number[]}>}
 */
const LINES = {
  corrected: { color: 'halo-strong', width: 7, dash: [] },
  printed: { color: 'pitch', width: 2, dash: [9, 5] },
  manual: { color: 'yaw', width: 2.2, dash: [2, 4] },
  limited: { color: 'ink', width: 1.8, dash: [] },
};
/**
 * How the saved picture draws them, on white.
 * @type {Record<string, {kind: import('../plots/export.js').Kind, linear?: boolean}>}
 */
const SAVED = {
  corrected: { kind: 'played' },
  printed: { kind: 'pitch', linear: true },
  manual: { kind: 'yaw', linear: true },
  limited: { kind: 'yaw' },
};
const styleOf = (/** @type {string} */ name) => LINES[name] ?? LINES.limited;

export class PaperCurves {
  /** @type {Record<string, string>} */ #colors = {};
  /** @type {uPlot[]} */ #charts = [];

  /** @param {() => number|undefined} stop the pitch stop of the rig of the manual, rad */
  constructor(stop) {
    this.stop = stop;
    this.#readColors();
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      this.#readColors();
      for (const chart of this.#charts) chart.redraw(false);
    });
  }

  #readColors() {
    const style = getComputedStyle(document.getElementById('paper') ?? document.documentElement);
    for (const name of ['pitch', 'yaw', 'panel', 'ink', 'muted', 'grid', 'halo-strong', 'danger', 'limit-fill'])
      this.#colors[name] = style.getPropertyValue(`--${name}`).trim();
  }

  /** @param {Curves} figure */
  draw({ number, output, t, curves }) {
    const greek = output === 'theta' ? 'θ' : 'ψ';
    const stop = output === 'theta' ? this.stop() : undefined;
    const body = h('div', { class: 'plot-body' });
    const legend = h(
      'ul',
      { class: 'legend' },
      curves.map((c) => {
        const { width, dash } = styleOf(c.name);
        return h(
          'li',
          {},
          svg(
            'svg',
            { class: `sample ${c.name}`, viewBox: '0 0 34 8', 'aria-hidden': 'true' },
            svg('line', {
              x1: 1,
              y1: 4,
              x2: 33,
              y2: 4,
              'stroke-width': width,
              'stroke-dasharray': dash.join(' ') || undefined,
            }),
          ),
          h('span', {}, rich(c.title)),
        );
      }),
    );
    const said = stop === undefined ? '' : ` The rig’s stop is at ${fixed(stop * DEGREE, 1)}°.`;
    const figure = h(
      'figure',
      {
        class: 'curves',
        'data-testid': `fig-${number}-plot`,
        'aria-label': `${greek} in degrees over time in seconds, for a step of 1 rad`,
      },
      legend,
      body,
      h('figcaption', {}, `${greek} in degrees over seconds. ${CURVES}${said}`),
    );
    const lines = curves.map((c) => ({
      name: c.title,
      ...(SAVED[c.name] ?? SAVED.limited),
      t,
      values: c.angle.map((v) => v * DEGREE),
    }));
    const color = (/** @type {string} */ name) => () => this.#colors[name];
    const top = 5 * Math.ceil((DEGREE * Math.max(1, ...curves.flatMap((c) => c.angle))) / 5);
    const axis = (/** @type {uPlot.Axis} */ more) => ({
      stroke: color('muted'),
      font: FONT,
      grid: { stroke: color('grid'), width: 1 },
      ticks: { show: false },
      gap: 5,
      ...more,
    });
    const rules = [
      { value: DEGREE, label: say`reference 1 rad = ${fixed(DEGREE, 1)}°`, danger: false },
      ...(stop === undefined
        ? []
        : [{ value: stop * DEGREE, label: say`stop ${fixed(stop * DEGREE, 1)}°`, danger: true }]),
    ];
    legend.after(
      linesMenu(`fig-${number}`, `Fig. ${number}`, output === 'theta' ? 'theta' : 'psi', lines, {
        x: [0, t[t.length - 1]],
        y: [0, top],
        rules,
        subtitle: `Fig. ${number} of the paper, drawn anew`,
      }),
    );
    const chart = followsPage(
      new uPlot(
        {
          width: 300,
          height: 260,
          legend: { show: false },
          cursor: { show: false },
          padding: [() => 8 * pictureScale().type, () => 12 * pictureScale().type, 0, 0],
          series: [
            {},
            ...curves.map((c) => ({
              stroke: color(styleOf(c.name).color),
              width: styleOf(c.name).width,
              dash: styleOf(c.name).dash,
              points: { show: false },
            })),
          ],
          scales: { x: { time: false }, y: { range: () => [0, top] } },
          axes: [
            axis({
              space: () => 50 * pictureScale().type,
              size: () => 26 * pictureScale().type,
              values: (_u, v) => v.map((s, i) => `${Number(s.toFixed(3))}${i === v.length - 1 ? ' s' : ''}`),
            }),
            axis({
              space: () => 30 * pictureScale().type,
              size: () => 40 * pictureScale().type,
              values: (_u, v) => v.map((d) => `${d}°`),
            }),
          ],
          hooks: {
            drawAxes: [(u) => this.#under(u, rules)],
            draw: [(u) => this.#over(u, rules)],
          },
        },
        [t, ...curves.map((c) => c.angle.map((v) => v * DEGREE))],
        body,
      ),
    );
    this.#charts.push(chart);
    new ResizeObserver(([entry]) => {
      const { width, height } = entry.contentRect;
      if (width > 60) chart.setSize({ width: Math.floor(width), height: Math.floor(height) });
    }).observe(body);
    return figure;
  }

  /** What lies beyond the stop, under the curves. @param {uPlot} u @param {Rule[]} rules */
  #under(u, rules) {
    for (const { value } of rules.filter((r) => r.danger)) {
      u.ctx.fillStyle = this.#colors['limit-fill'];
      u.ctx.fillRect(u.bbox.left, u.bbox.top, u.bbox.width, Math.round(u.valToPos(value, 'y', true)) - u.bbox.top);
    }
  }

  /** The reference and the stop, and what they are called. @param {uPlot} u @param {Rule[]} rules */
  #over(u, rules) {
    u.ctx.save();
    for (const { value, label, danger } of rules) {
      const y = Math.round(u.valToPos(value, 'y', true));
      drawRule(u, y, this.#colors[danger ? 'danger' : 'ink'], danger ? [] : [1, 5]);
      drawLabel(u, y, label, 1, this.#colors[danger ? 'danger' : 'ink'], this.#colors.panel);
    }
    u.ctx.restore();
  }
}
