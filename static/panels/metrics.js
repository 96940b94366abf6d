/** How well it does, in figures: one column for the step of each axis, from the nonlinear rig. */
import { h, setAttr, setText, symbol } from '../dom.js';
import { decibel, degrees, fixed, percent, seconds } from '../format.js';

/** @typedef {import('../types.js').Reply} Reply */
/** @typedef {'theta'|'psi'} Axis */

/** @param {number|undefined} v */
const volts = (v) => (v === undefined ? '–' : `${fixed(v, 1)} V`);

/** Peaks may be plain numbers or carry their share of saturation. @param {any} m @param {'V_p'|'V_y'} motor */
const motor = (m, motor) => (typeof m?.[motor] === 'object' ? m[motor] : { peak: undefined, saturated: undefined });

/** The peak, or the share of time at the limit. @param {any} m @param {'V_p'|'V_y'} name */
export function motorText(m, name) {
  const { peak, saturated } = motor(m, name);
  return saturated > 0 ? `at limit ${percent(saturated, saturated < 0.1 ? 1 : 0)}` : volts(peak);
}

/**
 * @typedef {{id: string, name: () => (Node|string)[], title: string, of: (m: any, axis: Axis, margin: any) => string, warn?: (m: any) => boolean}} Row
 * @type {Row[]}
 */
const ROWS = [
  { id: 'rise', name: () => ['Rise time'], title: '10 to 90 %', of: (m, a) => seconds(m?.[a]?.rise_time) },
  { id: 'settling', name: () => ['Settling time'], title: 'to within 2 %', of: (m, a) => seconds(m?.[a]?.settling_time) },
  { id: 'overshoot', name: () => ['Overshoot'], title: 'beyond the reference', of: (m, a) => (m?.[a]?.overshoot === undefined ? '–' : `${fixed(m[a].overshoot, 1)} %`) },
  { id: 'error', name: () => ['Error at the end'], title: 'reference minus the last value', of: (m, a) => degrees(m?.[a]?.steady_state_error, 2) },
  { id: 'coupling', name: () => ['Other axis moves'], title: 'largest deviation of the axis that is not stepped', of: (m) => degrees(m?.coupling_peak, 2) },
  { id: 'V_p', name: () => [symbol('V', 'p'), ' peak'], title: 'pitch motor, trim included; or the share of time at its limit', of: (m) => motorText(m, 'V_p'), warn: (m) => motor(m, 'V_p').saturated > 0 },
  { id: 'V_y', name: () => [symbol('V', 'y'), ' peak'], title: 'yaw motor, trim included; or the share of time at its limit', of: (m) => motorText(m, 'V_y'), warn: (m) => motor(m, 'V_y').saturated > 0 },
  { id: 'margin', name: () => ['Gain · phase margin'], title: 'at this axis’ own motor, everything else closed',
    of: (_m, _a, g) => (g?.gain_margin === undefined && g?.phase_margin === undefined ? '–' : `${g.gain_margin === undefined ? '∞' : decibel(g.gain_margin)} · ${degrees(g.phase_margin, 0)}`) },
  { id: 'delay', name: () => ['Delay margin'], title: 'the dead time that this motor would still bear', of: (_m, _a, g) => seconds(g?.delay_margin) },
];

/** The disk margin in words. @param {import('../types.js').Reply['sensitivity']} s */
const bothMotors = (s) => (s ? `both motors at once: gains × ${fixed(s.gain_low)} to ${s.gain_high === undefined ? '∞' : fixed(s.gain_high)}, phases ± ${degrees(s.phase, 0)} (disk margin ${fixed(s.disk_margin)}); sensitivity peak ${fixed(s.peak)}` : '');

export class MetricsPanel {
  /** @param {HTMLElement} root */
  constructor(root) {
    this.cells = ROWS.map((row) => ['theta', 'psi'].map((axis) => h('td', { 'data-testid': `metric-${row.id}-${axis}` })));
    root.append(h('table', { class: 'metrics', 'data-testid': 'metrics' },
      h('thead', {}, h('tr', {}, h('td'), h('th', { scope: 'col' }, h('span', { class: 'shape pitch', 'aria-hidden': 'true' }), 'pitch step'), h('th', { scope: 'col' }, h('span', { class: 'shape yaw', 'aria-hidden': 'true' }), 'yaw step'))),
      h('tbody', {}, ROWS.map((row, i) => h('tr', {}, h('th', { scope: 'row', title: row.title }, row.name()), this.cells[i])))));
  }

  /** @param {import('../types.js').State} state */
  render({ reply }) {
    if (!reply) return;
    const axes = /** @type {Axis[]} */ (['theta', 'psi']);
    axes.forEach((axis, j) => {
      const metrics = reply.axis_steps?.[axis]?.nonlinear.metrics;
      const margin = reply.margins?.[axis === 'theta' ? 'pitch' : 'yaw'];
      ROWS.forEach((row, i) => {
        setText(this.cells[i][j], row.of(metrics, axis, margin));
        if (row.id === 'margin') setAttr(this.cells[i][j], 'title', bothMotors(reply.sensitivity));
        this.cells[i][j].classList.toggle('warn', Boolean(metrics && row.warn?.(metrics)));
      });
    });
  }
}
