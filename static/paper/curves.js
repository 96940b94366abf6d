/** Figs. 4 and 5, drawn anew: four answers to a step of one radian, told apart by dashes as well as by colour. */
import { DEGREE, fixed, say } from '../text/index.js';
import { h, svg } from '../ui/index.js';
import { ink, makeChart, scaled } from '../charts/index.js';
import { drawNamedRules, drawShades, linesMenu } from '../plots/index.js';
import { rich } from './rich.js';
import { CURVES } from './words.js';

/** @typedef {import('./math.js').Curves} Curves */
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
  /** @param {() => number|undefined} stop the pitch stop of the rig of the manual, rad */
  constructor(stop) {
    this.stop = stop;
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
    const top = 5 * Math.ceil((DEGREE * Math.max(1, ...curves.flatMap((c) => c.angle))) / 5);
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
    makeChart(body, {
      lines: curves.map((c) => styleOf(c.name)),
      data: [t, ...lines.map(({ values }) => values)],
      height: 260,
      padding: [scaled(8), scaled(12), 0, 0],
      scales: { y: { range: () => [0, top] } },
      axes: [
        {
          size: 26,
          values: (_u, v) => v.map((s, i) => `${Number(s.toFixed(3))}${i === v.length - 1 ? ' s' : ''}`),
        },
        { size: 40, values: (_u, v) => v.map((d) => `${d}°`) },
      ],
      font: '12px',
      cursor: { show: false },
      hooks: {
        drawAxes: [(u) => drawShades(u, rules, ink)],
        draw: [(u) => drawNamedRules(u, rules, ink, 1)],
      },
    });
    return figure;
  }
}
