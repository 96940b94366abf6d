/**
 * What the feedback acts on: the true states, rates from filters, or an observer's estimate, and how noisy the angles
 * are. A part of the experiment's options.
 */
import { DEGREE, polesText, say, significant, t } from '../text/index.js';
import {
  allowed,
  lags,
  observerPoles,
  placesObserver,
  presetOf,
  QUANTITIES,
  SENSITIVITY,
  STANDARD,
  STRUCTURES,
  textOf,
  withNoise,
  withObserverPoles,
  withOption,
} from '../model/index.js';
import { Choice, designField, h, Matrix, setText, symbol } from '../ui/index.js';
import { PairEditor } from '../panels/index.js';

/** @typedef {import('../types.js').Design} Design */
/** @typedef {import('../types.js').Observer} Observer */

const AXES = /** @type {const} */ (['theta', 'psi']);
const STATES = ['θ', 'ψ', 'θ̇', 'ψ̇'];
/** How far a density's slider goes from the usual one, either way. */
const DECADES = 1e3;
const standard = (/** @type {string} */ name) => QUANTITIES[`observer.${name}`]?.standard;
const coupled = STRUCTURES.map(([key, name]) => /** @type {const} */ ([key.replace('full-rank/', ''), name]));

/** @param {Design} d @param {Partial<Observer>} part @returns {Design} */
const withObserver = (d, part) => ({ ...d, observer: { poles: observerPoles(d), ...d.observer, ...part } });

/** @type {import('../panels/poles.js').Four} */
const FOUR = {
  field: 'observer.poles',
  testid: 'observer-',
  letter: 'q',
  whose: 'observer ',
  of: observerPoles,
  put: withObserverPoles,
};

export class MeasuredPart {
  /** @param {HTMLElement} body of the experiment's options @param {import('../model/store.js').Store} store */
  constructor(body, store) {
    this.measured = new Choice({
      label: 'What the feedback acts on',
      testid: 'measured',
      options: [
        ['states', 'true states', 'as if all were measured'],
        [
          'filtered',
          'filtered rates',
          say`measured angles, and rates from second-order filters of ${20} Hz, as the rig’s`,
        ],
        ['observer', 'observer', 'states estimated from the measured angles and the voltages'],
      ],
      onChange: (measured) =>
        store.edit((d) => {
          const next = { ...d, scenario: withOption(d.scenario, { measured }) };
          return measured === 'observer' ? withObserver(next, {}) : next;
        }),
    });
    for (const input of this.measured.inputs) input.dataset.field = 'scenario.measured';
    this.noise = AXES.map((axis) =>
      designField(
        store,
        `noise-${axis}`,
        (d, v) => ({ ...d, scenario: withNoise(d.scenario, axis, Number((v / DEGREE).toPrecision(10))) }),
        {
          label: `noise on the measured ${axis === 'theta' ? 'pitch' : 'yaw'} angle, standard deviation in degrees`,
          mark: symbol(axis === 'theta' ? 'θ' : 'ψ'),
          unit: '°',
          field: `scenario.noise.${axis}`,
          ...allowed(`scenario.noise.${axis}`, DEGREE),
        },
      ),
    );
    this.method = new Choice({
      label: 'Observer',
      testid: 'observer-method',
      options: [
        ['full-rank', 'placed', 'its four poles q are where you put them: the same algorithm on (Aᵀ, Cᵀ)'],
        ['kalman', 'Kalman filter', 'the best for white noise of these densities'],
      ],
      onChange: (method) => store.edit((d) => withObserver(d, { method: /** @type {Observer['method']} */ (method) })),
    });
    for (const input of this.method.inputs) input.dataset.field = 'observer.method';
    this.pairs = /** @type {const} */ ([0, 1]).map((pair) => new PairEditor(pair, store, FOUR));
    this.coupling = h(
      'select',
      {
        'data-testid': 'observer-coupling',
        'data-field': 'observer.coupling',
        onchange: () => {
          const [coupling, lead = 'pitch'] = this.coupling.value.split('/');
          store.edit((d) =>
            withObserver(d, {
              coupling: /** @type {Observer['coupling']} */ (coupling),
              lead: /** @type {Observer['lead']} */ (lead),
            }),
          );
        },
      },
      coupled.map(([value, name]) => h('option', { value }, name)),
    );
    const density = (
      /** @type {'voltage_noise'|'angle_noise'} */ name,
      /** @type {string} */ text,
      /** @type {string} */ mark,
    ) =>
      designField(store, `observer-${name}`, (d, v) => withObserver(d, { [name]: v }), {
        label: `${text}, ${QUANTITIES[`observer.${name}`]?.unit}`,
        mark,
        slider: { min: Number(standard(name)) / DECADES, max: Number(standard(name)) * DECADES, log: true },
        unit: QUANTITIES[`observer.${name}`]?.unit,
        field: `observer.${name}`,
        ...allowed(`observer.${name}`),
      });
    this.densities = {
      voltage_noise: density('voltage_noise', 'process noise, on the voltages', 'process (voltages)'),
      angle_noise: density('angle_noise', 'measurement noise, on the angles', 'measurement (angles)'),
    };
    this.placed = h(
      'div',
      { class: 'observer-placed' },
      this.pairs.map((pair) => pair.node),
      h('label', { class: 'select' }, 'errors of the estimate', this.coupling),
    );
    this.ratio = h('p', { class: 'aside', 'data-testid': 'kalman-words' });
    this.kalman = h(
      'div',
      { class: 'kalman' },
      h('span', { class: 'caption' }, 'White noise that the filter expects'),
      Object.values(this.densities).map((field) => field.node),
      this.ratio,
    );
    this.gain = new Matrix(
      'l-matrix',
      h('b', {}, 'L'),
      STATES.map((name) => symbol(name)),
      [symbol('θ'), symbol('ψ')],
      (i, j) => `${i < 2 ? '1/s' : '1/s²'}, correction of ${STATES[i]} by the error of ${STATES[j]}`,
      { name: 'L', note: "x_hat' = A x_hat + B u + L (y - C x_hat), y = [theta, psi] in rad" },
    );
    this.words = h('p', { class: 'aside', 'data-testid': 'separation' });
    this.observer = h(
      'div',
      { class: 'observer', 'data-testid': 'observer' },
      h('div', { class: 'row' }, this.method.node),
      this.placed,
      this.kalman,
      this.gain.node,
      this.words,
    );
    this.node = h(
      'fieldset',
      { 'aria-label': 'What is measured' },
      h(
        'div',
        { class: 'row' },
        h('span', { class: 'caption', 'aria-hidden': 'true' }, 'Feedback of'),
        this.measured.node,
      ),
      h(
        'div',
        { class: 'row' },
        h('span', { class: 'caption', title: 'white noise, one value per sample' }, 'Noise on the angles'),
        this.noise.map((field) => field.node),
      ),
      this.observer,
    );
    body.lastElementChild?.before(this.node);
  }

  /** @param {import('../types.js').State} state */
  render({ design, reply, presets }) {
    if (!design) return;
    const { measured, noise } = { ...STANDARD, ...design.scenario };
    this.measured.set(String(measured));
    this.noise.forEach((field, i) => field.set(Number(((noise?.[AXES[i]] ?? 0) * DEGREE).toPrecision(10))));
    this.observer.hidden = measured !== 'observer';
    if (this.observer.hidden) return;
    const { method = standard('method'), coupling = standard('coupling'), lead } = design.observer ?? {};
    const poles = observerPoles(design);
    const reach = Math.max(...poles.map((p) => Math.hypot(p.re, p.im))) * 1.5;
    this.method.set(String(method));
    this.placed.hidden = !placesObserver(design);
    this.kalman.hidden = placesObserver(design);
    for (const pair of this.pairs) pair.render(poles, reach);
    this.coupling.value = coupling === 'triangular' ? `${coupling}/${lead ?? 'pitch'}` : String(coupling);
    for (const name of /** @type {const} */ (['voltage_noise', 'angle_noise']))
      this.densities[name].set(Number(design.observer?.[name] ?? standard(name)));
    const own = this.kalman.hidden ? undefined : reply?.observer?.poles;
    setText(
      this.ratio,
      own ? say`Its poles: ${polesText(own)} rad/s. More process noise, or less on the angles, makes it faster.` : '',
    );
    this.gain.render(reply?.observer?.L, (v) => significant(v, 4));
    const margin = textOf(SENSITIVITY.disk, reply?.sensitivity?.disk_margin);
    const unknown = lags(design, presetOf({ presets, design })) && !design.place_rotors;
    const separation = unknown
      ? 'The observer does not know that the rotors lag: the loop’s poles are neither the placed ones nor its own.'
      : 'Separation: the loop’s poles are the placed ones, which PI moves on, and the observer’s own.';
    setText(
      this.words,
      `${t(separation)} ${say`Margins are not promised (Doyle, 1978): here the disk margin is ${margin}.`}`,
    );
  }
}
