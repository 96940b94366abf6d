/** The parts of the experiment's options, each with its fields and what they change. */
import { DEGREE, inField } from '../text/index.js';
import {
  allowed,
  DIGITAL,
  ENCODERS,
  STANDARD,
  withDigital,
  withDisturbance,
  withEncoder,
  withOption,
  withStart,
} from '../model/index.js';
import { check, Choice, h, designField, setText, symbol } from '../ui/index.js';

/**
 * @typedef {import('../types.js').Scenario} Scenario
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Finding} Finding
 * @typedef {import('../types.js').Axis} Axis
 */
const AXES = /** @type {Axis[]} */ (['theta', 'psi']);
const GREEK = { theta: 'θ', psi: 'ψ' };
const AXIS_NAMES = { theta: 'pitch', psi: 'yaw' };
const TOLERANCES = /** @type {[number, string][]} */ ([
  [1e-3, '10⁻³'],
  [1e-5, '10⁻⁵'],
  [1e-8, '10⁻⁸'],
  [1e-11, '10⁻¹¹'],
]);

/** Without what a change of units leaves in the last digits. @param {number} v */
const tidy = (v) => Number(v.toPrecision(10));

/** Makes fields that change the scenario. */
export class ScenarioFields {
  /** @param {import('../model/store.js').Store} store */
  constructor(store) {
    this.store = store;
  }

  /** @param {(s: Scenario) => Scenario} change */
  edit(change) {
    this.store.edit((d) => ({ ...d, scenario: change(d.scenario) }));
  }

  /**
   * A number; `scale` from the contract's unit to the one shown. Emptied, an optional field changes to undefined.
   * @param {{id: string, label: string, mark: Node|string, unit?: string, field: string, min: number, max: number,
   *   scale?: number, positive?: boolean, integer?: boolean, optional?: boolean,
   *   change: (s: Scenario, v: number|undefined) => Scenario}} options
   */
  number({ id, scale = 1, change, ...rest }) {
    const part = (/** @type {Scenario} */ s, /** @type {number} */ v) =>
      change(s, Number.isNaN(v) ? undefined : tidy(v / scale));
    return designField(this.store, `experiment-${id}`, (d, v) => ({ ...d, scenario: part(d.scenario, v) }), rest);
  }

  /**
   * @param {string} id
   * @param {string} text
   * @param {string} title
   * @param {(s: Scenario, on: boolean) => Scenario} change
   * @param {string} [field]
   */
  check(id, text, title, change, field) {
    const { box, node } = check(
      {
        title,
        'data-testid': `experiment-${id}`,
        'data-field': field,
        onchange: () => this.edit((s) => change(s, box.checked)),
      },
      text,
    );
    return { input: box, node };
  }
}

/** Where the rig is let go. */
export class StartPart {
  /** @param {ScenarioFields} fields @param {Node} close what closes the whole */
  constructor(fields, close) {
    this.angles = AXES.map((axis) =>
      fields.number({
        id: `start-${axis}`,
        label: `${AXIS_NAMES[axis]} angle at the start in degrees, empty: at rest`,
        mark: symbol(GREEK[axis]),
        unit: '°',
        field: `scenario.initial.${axis}`,
        min: axis === 'theta' ? -90 : -360,
        max: axis === 'theta' ? 90 : 360,
        scale: DEGREE,
        optional: true,
        change: (s, v) => withStart(s, axis, v),
      }),
    );
    this.node = h(
      'div',
      { class: 'row' },
      h(
        'span',
        { class: 'caption', title: 'where the rig is let go, at rest; empty: where it rests anyway' },
        'Starts at',
      ),
      this.angles.map((f) => f.node),
      close,
    );
  }

  /** @param {Design} design */
  render({ scenario, theta0 }) {
    this.angles.forEach((field, i) => {
      const angle = scenario.initial?.[AXES[i]];
      const rest = tidy((i ? 0 : theta0) * DEGREE);
      field.set(angle === undefined ? NaN : tidy(angle * DEGREE));
      field.setBlank(inField(rest), rest);
    });
  }
}

/** What limits the motors and the rig, and what the integrals do meanwhile. */
export class LimitsPart {
  /** @param {ScenarioFields} fields */
  constructor(fields) {
    this.saturation = fields.check(
      'saturation',
      'voltage limits',
      'the motors get no more than their limits',
      (s, on) => withOption(s, { saturation: on }),
      'scenario.saturation',
    );
    this.stops = fields.check(
      'stops',
      'travel stops',
      'pitch ends at its mechanical stops, without rebound',
      (s, on) => withOption(s, { travel_stops: on }),
      'scenario.travel_stops',
    );
    this.trim = fields.check(
      'trim',
      'trim feed-forward',
      'the constant voltages that hold the rig are added; without them it sags until the integrals have found them',
      (s, on) => withOption(s, { trim_feedforward: on }),
      'scenario.trim_feedforward',
    );
    this.windup = new Choice({
      label: 'Anti-windup',
      testid: 'experiment-windup',
      onChange: (v) => fields.edit((s) => withOption(s, { anti_windup: v })),
      options: [
        ['none', 'none', 'the integrals go on while a motor is at its limit'],
        ['clamping', 'clamping', 'the integral that pushes a motor beyond its limit stands still'],
        [
          'back-calculation',
          'back-calculation',
          'the integrals follow what the limits leave of the voltages, with the tracking time (Åström and ' +
            'Hägglund, Advanced PID Control, 2006, section 3.5)',
        ],
      ],
    });
    this.tracking = fields.number({
      id: 'tracking',
      label: 'tracking time of back-calculation in milliseconds, empty: the integral time',
      unit: 'ms',
      field: 'scenario.tracking_time',
      ...allowed('scenario.tracking_time', 1000),
      scale: 1000,
      positive: true,
      optional: true,
      mark: h(
        'span',
        { title: 'how fast the integrals let go; empty: each loop’s own integral time' },
        'tracking time ',
        symbol('T', 't'),
      ),
      change: (s, v) => withOption(s, { tracking_time: v }),
    });
    this.node = h(
      'fieldset',
      { 'aria-label': 'Limits' },
      h('div', { class: 'row' }, this.saturation.node, this.stops.node, this.trim.node),
      h(
        'div',
        { class: 'row' },
        h('span', { class: 'caption', 'aria-hidden': 'true' }, 'Anti-windup'),
        this.windup.node,
        this.tracking.node,
      ),
    );
  }

  /**
   * @param {Design} design
   * @param {{hasStops: boolean, own: boolean}} rig  whether pitch has stops, and whether the method brings integral
   *   action, which has no T_i
   */
  render({ scenario, outer, loops }, { hasStops, own }) {
    const { saturation, anti_windup, travel_stops, trim_feedforward } = { ...STANDARD, ...scenario };
    this.saturation.input.checked = saturation;
    this.stops.input.checked = travel_stops;
    this.stops.input.disabled = !hasStops;
    this.trim.input.checked = trim_feedforward;
    const idle = !saturation || (outer === 'none' && !own);
    this.windup.set(anti_windup);
    this.windup.disable(idle);
    this.tracking.node.hidden = anti_windup !== 'back-calculation';
    this.tracking.disable(idle);
    this.tracking.set(scenario.tracking_time === undefined ? NaN : tidy(1000 * scenario.tracking_time));
    const [first, second] = [tidy(1000 * loops.pitch.ti), tidy(1000 * loops.yaw.ti)];
    this.tracking.setBlank(first === second && !own ? inField(first) : 'Tᵢ', first);
  }
}

/** The rig's own controller. */
export class DigitalPart {
  /** @param {ScenarioFields} fields */
  constructor(fields) {
    this.counts = () => fields.store.preset?.encoders ?? ENCODERS;
    this.on = fields.check(
      'digital',
      'Digital controller',
      'the rig’s own: it samples the encoders, filters the rates from them and holds its voltages between samples',
      (s, on) => withDigital(s, on ? {} : null),
    );
    this.sampleTime = fields.number({
      id: 'sample-time',
      label: 'sample time in milliseconds',
      mark: h('span', { title: 'sample time: the voltages are held between two samples' }, 'every'),
      unit: 'ms',
      field: 'scenario.digital.sample_time',
      ...allowed('scenario.digital.sample_time', 1000),
      scale: 1000,
      positive: true,
      change: (s, v) => withDigital(s, { sample_time: v }),
    });
    this.delay = fields.check(
      'delay',
      'delay',
      'computation delay: the voltages reach the motors one sample after they were computed from',
      (s, on) => withDigital(s, { delay: on }),
      'scenario.digital.delay',
    );
    this.rates = fields.check(
      'filtered',
      'filtered rates',
      'rates from the angles by second-order filters, 20 Hz, damping 0.85; otherwise the true ones',
      (s, on) => withDigital(s, { rates: on ? 'filtered' : 'true' }),
      'scenario.digital.rates',
    );
    this.encoders = AXES.map((axis) =>
      fields.number({
        id: `encoder-${axis}`,
        label: `${AXIS_NAMES[axis]} encoder, counts per revolution; 0 measures exactly, empty: this rig's`,
        mark: symbol(GREEK[axis]),
        field: `scenario.digital.encoders.${axis}`,
        ...allowed(`scenario.digital.encoders.${axis}`),
        integer: true,
        optional: true,
        change: (s, v) => withEncoder(s, axis, v, this.counts()),
      }),
    );
    this.noise = fields.number({
      id: 'noise',
      label: 'noise on the measured angles, standard deviation in degrees',
      mark: 'noise',
      unit: '°',
      field: 'scenario.digital.noise',
      ...allowed('scenario.digital.noise', DEGREE),
      scale: DEGREE,
      change: (s, v) => withDigital(s, { noise: v }),
    });
    this.seed = fields.number({
      id: 'seed',
      label: 'seed of the noise',
      mark: 'seed',
      field: 'scenario.digital.seed',
      ...allowed('scenario.digital.seed'),
      integer: true,
      change: (s, v) => withDigital(s, { seed: v }),
    });
    this.warning = h('p', { class: 'experiment-warning', role: 'status', 'data-testid': 'experiment-warning' });
    this.more = h(
      'div',
      { class: 'inner' },
      h('div', { class: 'row' }, this.rates.node, this.noise.node, this.seed.node),
      h(
        'div',
        { class: 'row' },
        h('span', { class: 'caption', title: 'counts per revolution; 0 measures exactly' }, 'encoder counts'),
        this.encoders.map((f) => f.node),
      ),
    );
    this.node = h(
      'fieldset',
      { 'aria-label': 'Digital controller' },
      h('div', { class: 'row' }, this.on.node, this.sampleTime.node, this.delay.node),
      this.more,
      this.warning,
    );
  }

  /** @param {Design} design @param {Finding[]} findings that concern it */
  render({ scenario: { digital } }, findings) {
    const { sample_time, delay, rates, noise, seed } = { ...DIGITAL, ...digital };
    this.on.input.checked = Boolean(digital);
    for (const node of [this.more, this.sampleTime.node, this.delay.node]) node.hidden = !digital;
    this.sampleTime.set(tidy(1000 * sample_time));
    this.delay.input.checked = delay;
    this.rates.input.checked = rates === 'filtered';
    const own = this.counts();
    this.encoders.forEach((field, i) => {
      field.set(digital?.encoders?.[AXES[i]] ?? NaN);
      field.setBlank(String(own[AXES[i]]), own[AXES[i]]);
    });
    this.noise.set(tidy(noise * DEGREE));
    this.seed.set(seed);
    this.seed.node.hidden = noise === 0;
    setText(this.warning, findings.map((f) => `▲ ${f.message}`).join(' '));
  }
}

/** Volts besides the controller's. */
export class DisturbancePart {
  /** @param {ScenarioFields} fields */
  constructor(fields) {
    this.on = fields.check(
      'disturbance',
      'Disturbance',
      'volts that act on the motors besides the controller’s, beyond their limits',
      (s, on) => withDisturbance(s, on ? {} : null),
    );
    this.volts = /** @type {const} */ (['V_p', 'V_y']).map((name) =>
      fields.number({
        id: `disturbance-${name}`,
        label: `disturbance of the ${name === 'V_p' ? 'pitch' : 'yaw'} motor in volts`,
        mark: symbol('V', name[2]),
        unit: 'V',
        field: `scenario.disturbance.${name}`,
        ...allowed(`scenario.disturbance.${name}`),
        change: (s, v) => withDisturbance(s, { [name]: v }),
      }),
    );
    this.since = fields.number({
      id: 'disturbance-time',
      label: 'when the disturbance sets in, seconds',
      mark: 'from',
      unit: 's',
      field: 'scenario.disturbance.time',
      ...allowed('scenario.disturbance.time'),
      change: (s, v) => withDisturbance(s, { time: v }),
    });
    this.node = h(
      'fieldset',
      { class: 'row', 'aria-label': 'Disturbance' },
      this.on.node,
      this.volts.map((f) => f.node),
      this.since.node,
    );
  }

  /** @param {Design} design */
  render({ scenario: { disturbance } }) {
    this.on.input.checked = Boolean(disturbance);
    for (const { node } of [...this.volts, this.since]) node.hidden = !disturbance;
    this.volts.forEach((field, i) => field.set(disturbance?.[i ? 'V_y' : 'V_p'] ?? 0));
    this.since.set(disturbance?.time ?? 0);
  }
}

/** How carefully it is computed. */
export class AccuracyPart {
  /** @param {ScenarioFields} fields */
  constructor(fields) {
    this.tolerance = h(
      'select',
      {
        'data-testid': 'experiment-tolerance',
        'data-field': 'scenario.rtol',
        onchange: () => fields.edit((s) => withOption(s, { rtol: Number(this.tolerance.value) })),
      },
      TOLERANCES.map(([value, text]) => h('option', { value }, text)),
    );
    this.node = h(
      'div',
      { class: 'row foot' },
      h(
        'label',
        {
          class: 'select',
          title:
            'relative tolerance of the adaptive integration; where a finer one changes the picture, the picture ' +
            'was wrong',
        },
        'tolerance',
        this.tolerance,
      ),
      h(
        'span',
        { class: 'aside' },
        'Linear responses use only the start angles; limits, stops, sampling and disturbances are left out.',
      ),
    );
  }

  /** @param {Design} design */
  render({ scenario }) {
    this.tolerance.value = String(scenario.rtol ?? STANDARD.rtol);
  }
}
