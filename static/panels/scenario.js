/**
 * What is asked of the rig: where it rests, how far it steps and how long one watches; and what the plots' lines mean.
 */
import { DEGREE } from '../text/index.js';
import { allowed } from '../model/index.js';
import { designField, h, symbol } from '../ui/index.js';

/** @typedef {import('../types.js').Axis} Axis */

export class ScenarioPanel {
  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.theta = this.#step('theta', 'pitch step', 'θ');
    this.psi = this.#step('psi', 'yaw step', 'ψ');
    this.duration = designField(store, 'duration', (d, v) => ({ ...d, scenario: { ...d.scenario, duration: v } }), {
      label: 'duration in seconds',
      mark: 'over',
      unit: 's',
      field: 'scenario.duration',
      min: 0.1,
      max: 60,
      positive: true,
    });
    this.theta0 = designField(store, 'theta0', (d, v) => ({ ...d, theta0: v / DEGREE }), {
      label: 'operating point in degrees',
      mark: h(
        'span',
        { title: 'operating point: the pitch angle at which the rig rests and is linearized' },
        'From ',
        symbol('θ', '0'),
      ),
      unit: '°',
      field: 'operating_point.theta',
      ...allowed('operating_point.theta', DEGREE),
    });
    this.linear = h('input', {
      type: 'checkbox',
      'data-testid': 'show-linear',
      onchange: () => store.set({ showLinear: this.linear.checked }),
    });
    this.marks = h('input', {
      type: 'checkbox',
      'data-testid': 'show-marks',
      onchange: () => store.set({ showMarks: this.marks.checked }),
    });
    const key = (/** @type {string} */ kind, /** @type {string} */ text, /** @type {string} */ title) =>
      h('span', { class: 'key', title }, h('span', { class: `line ${kind}`, 'aria-hidden': 'true' }), text);
    root.append(
      h(
        'div',
        { class: 'row steps' },
        this.theta0.node,
        h('span', { class: 'caption' }, 'to'),
        this.theta.node,
        this.psi.node,
        this.duration.node,
      ),
      h(
        'div',
        { class: 'row legend', 'data-testid': 'legend' },
        key('pitch solid', 'pitch step', 'nonlinear rig, pitch reference stepped alone'),
        key('yaw solid', 'yaw step', 'nonlinear rig, yaw reference stepped alone'),
        key('halo', 'in 3D', 'the motion that the 3D view shows'),
        h(
          'label',
          {
            class: 'key',
            title:
              'The linear model has no voltage limits. Its voltages are deviations from the trim; the trim is ' +
              'added here, so that both models share one scale.',
          },
          this.linear,
          h('span', { class: 'line pitch dashed', 'aria-hidden': 'true' }),
          h('span', { class: 'line yaw dotted', 'aria-hidden': 'true' }),
          'linear',
        ),
        h(
          'label',
          {
            class: 'key',
            title:
              'Rise, peak and settling on each curve, and the largest motion of the other axis. Point at a mark to ' +
              'read it; click it to move the time there.',
          },
          this.marks,
          h('span', { class: 'mark-sample', 'aria-hidden': 'true' }),
          'marks',
        ),
      ),
    );
  }

  /** @param {Axis} axis @param {string} label @param {string} mark */
  #step(axis, label, mark) {
    return designField(
      this.store,
      `step-${axis}`,
      (d, v) => ({ ...d, scenario: { ...d.scenario, reference: { ...d.scenario.reference, [axis]: v / DEGREE } } }),
      {
        label: `${label} in degrees`,
        mark: symbol(mark),
        unit: '°',
        field: `scenario.reference.${axis}`,
        min: -360,
        max: 360,
      },
    );
  }

  /** @param {import('../types.js').State} state */
  render({ design, showLinear, showMarks }) {
    if (!design) return;
    const { reference, duration } = design.scenario;
    const degrees = (/** @type {number} */ v) => Math.round(v * DEGREE * 1e4) / 1e4;
    this.theta0.set(degrees(design.theta0));
    this.theta.set(degrees(reference.theta));
    this.psi.set(degrees(reference.psi));
    this.duration.set(duration);
    this.linear.checked = showLinear;
    this.marks.checked = showMarks;
  }
}
