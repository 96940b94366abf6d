/** How the experiment is run: where it starts, what limits it, which controller, what disturbs it. Folded away; one line says what differs from the standard. */
import { h, setAttr, setText, symbol } from '../dom.js';
import { DIGITAL, experimentWords, isStandard, STANDARD, standard, withDigital, withDisturbance, withEncoder, withOption, withStart } from '../experiment.js';
import { Choice, NumberField } from '../fields.js';
import { DEGREE, forField } from '../format.js';

/**
 * @typedef {import('../types.js').Scenario} Scenario
 * @typedef {import('../types.js').Encoders} Encoders
 * @typedef {'theta'|'psi'} Axis
 */
const AXES = /** @type {Axis[]} */ (['theta', 'psi']);
const GREEK = { theta: 'θ', psi: 'ψ' };
const AXIS_NAMES = { theta: 'pitch', psi: 'yaw' };
const NO_COUNTS = { theta: 4096, psi: 8192 };

/** Findings that are told at the field that they speak of. */
const TOLD_HERE = ['slow_sampling', 'fast_tracking'];

const TOLERANCES = /** @type {[number, string][]} */ ([[1e-3, '10⁻³'], [1e-5, '10⁻⁵'], [1e-8, '10⁻⁸'], [1e-11, '10⁻¹¹']]);

/** @param {number} v */
const tidy = (v) => Number(v.toPrecision(10));

export class ExperimentPanel {
  /** @param {HTMLElement} root @param {import('../store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.words = h('span', { class: 'experiment-words', 'data-testid': 'experiment-words' });
    this.reset = h('button', { type: 'button', class: 'quiet', 'data-testid': 'experiment-reset', title: 'Back to the standard experiment; the steps stay', onclick: () => this.#reset() }, 'Standard');
    this.summary = h('summary', { 'data-testid': 'experiment' }, 'Experiment');
    this.details = h('details', { class: 'experiment' }, this.summary, h('div', { class: 'experiment-body', 'data-testid': 'experiment-body' },
      this.#starts(), this.#limits(), this.#digital(), this.#disturbance(), this.#accuracy()));
    this.details.addEventListener('keydown', (e) => e.key === 'Escape' && this.#close());
    root.append(h('div', { class: 'row experiment-row' }, this.details, this.words, this.reset));
  }

  /** @param {(s: Scenario) => Scenario} change @param {string} [gesture] @param {number} [stamp] */
  #edit(change, gesture, stamp) {
    this.store.edit((d) => ({ ...d, scenario: change(d.scenario) }), { gesture, stamp });
  }

  #reset() {
    this.#edit(standard);
    this.summary.focus();
  }

  #close() {
    this.details.open = false;
    this.summary.focus();
  }

  /**
   * A number of the experiment; `scale` from the contract's unit to the one shown.
   * @param {{id: string, label: string, mark?: Node|string, unit?: string, field: string, min: number, max: number, scale?: number, positive?: boolean, integer?: boolean, blank?: boolean,
   *   change: (s: Scenario, v: number|undefined) => Scenario}} o
   */
  #number({ id, scale = 1, change, blank, mark = '', ...rest }) {
    const gesture = `experiment-${id}`;
    return new NumberField({ testid: gesture, mark, ...rest, onInput: (v, stamp) => this.#edit((s) => change(s, tidy(v / scale)), gesture, stamp),
      onBlank: blank ? () => this.#edit((s) => change(s, undefined), gesture) : undefined, onCommit: () => this.store.commit() });
  }

  /** @param {string} id @param {string} text @param {string} title @param {(s: Scenario, on: boolean) => Scenario} change @param {string} [field] */
  #check(id, text, title, change, field) {
    const input = h('input', { type: 'checkbox', 'data-testid': `experiment-${id}`, 'data-field': field, onchange: () => this.#edit((s) => change(s, input.checked)) });
    return { input, node: h('label', { class: 'check', title }, input, text) };
  }

  #starts() {
    this.start = AXES.map((axis) => this.#number({ id: `start-${axis}`, label: `${AXIS_NAMES[axis]} angle at the start in degrees, empty: at rest`, mark: symbol(GREEK[axis]), unit: '°', field: `scenario.initial.${axis}`,
      min: axis === 'theta' ? -90 : -360, max: axis === 'theta' ? 90 : 360, scale: DEGREE, blank: true, change: (s, v) => withStart(s, axis, v) }));
    return h('div', { class: 'row' }, h('span', { class: 'caption', title: 'where the rig is let go, at rest; empty: where it is at rest anyway' }, 'Starts at'), this.start.map((f) => f.node),
      h('button', { type: 'button', class: 'quiet close', 'data-testid': 'experiment-close', 'aria-label': 'Close the experiment', title: 'Close (Esc)', onclick: () => this.#close() }, '✕'));
  }

  #limits() {
    this.saturation = this.#check('saturation', 'voltage limits', 'the motors get no more than their limits', (s, on) => withOption(s, { saturation: on }), 'scenario.saturation');
    this.stops = this.#check('stops', 'travel stops', 'pitch ends at its mechanical stops, without rebound', (s, on) => withOption(s, { travel_stops: on }), 'scenario.travel_stops');
    this.trim = this.#check('trim', 'trim feed-forward', 'the constant voltages that hold the rig are added; without them it sags until the integrals have found them', (s, on) => withOption(s, { trim_feedforward: on }), 'scenario.trim_feedforward');
    this.windup = new Choice({ label: 'Anti-windup', testid: 'experiment-windup', onChange: (v) => this.#edit((s) => withOption(s, { anti_windup: /** @type {any} */ (v) })),
      options: [['none', 'none', 'the integrals go on while a motor is at its limit'], ['clamping', 'clamping', 'the integral that pushes a motor beyond its limit stands still'],
        ['back-calculation', 'back-calculation', 'the integrals follow what the limits leave of the voltages, with the tracking time (Åström & Hägglund, Advanced PID Control, 2006, section 3.5)']] });
    this.tracking = this.#number({ id: 'tracking', label: 'tracking time of back-calculation in milliseconds, empty: the integral time', mark: h('span', { title: 'tracking time: how fast the integrals let go; empty: each loop’s own integral time' }, symbol('T', 't')), unit: 'ms', field: 'scenario.tracking_time',
      min: 0.1, max: 1e6, scale: 1000, positive: true, blank: true, change: (s, v) => withOption(s, { tracking_time: v }) });
    return h('fieldset', {}, h('div', { class: 'row' }, this.saturation.node, this.stops.node, this.trim.node),
      h('div', { class: 'row' }, h('span', { class: 'caption' }, 'Anti-windup'), this.windup.node, this.tracking.node));
  }

  #digital() {
    const counts = () => this.store.preset?.encoders ?? NO_COUNTS;
    this.isDigital = this.#check('digital', 'Digital controller', 'the rig’s own: it samples the encoders, filters the rates from them and holds its voltages between samples', (s, on) => withDigital(s, on ? {} : null));
    this.sampleTime = this.#number({ id: 'sample-time', label: 'sample time in milliseconds', mark: h('span', { title: 'sample time: the voltages are held between two samples' }, 'sampled every'), unit: 'ms', field: 'scenario.digital.sample_time', min: 0.1, max: 1000, scale: 1000, positive: true, change: (s, v) => withDigital(s, { sample_time: v }) });
    this.delay = this.#check('delay', 'one late', 'the voltages reach the motors one sample after they were computed from', (s, on) => withDigital(s, { delay: on }), 'scenario.digital.delay');
    this.rates = this.#check('filtered', 'filtered rates', 'rates from the angles by second-order filters, 20 Hz, damping 0.85; otherwise the true ones', (s, on) => withDigital(s, { rates: on ? 'filtered' : 'true' }), 'scenario.digital.rates');
    this.encoders = AXES.map((axis) => this.#number({ id: `encoder-${axis}`, label: `${AXIS_NAMES[axis]} encoder, counts per revolution; 0 measures exactly, empty: this rig's`, mark: symbol(GREEK[axis]), field: `scenario.digital.encoders.${axis}`,
      min: 0, max: 1e7, integer: true, blank: true, change: (s, v) => withEncoder(s, axis, v, counts()) }));
    this.noise = this.#number({ id: 'noise', label: 'noise on the measured angles, standard deviation in degrees', mark: 'noise', unit: '°', field: 'scenario.digital.noise', min: 0, max: 57, scale: DEGREE, change: (s, v) => withDigital(s, { noise: v }) });
    this.seed = this.#number({ id: 'seed', label: 'seed of the noise', mark: 'seed', field: 'scenario.digital.seed', min: 0, max: 2 ** 32 - 1, integer: true, change: (s, v) => withDigital(s, { seed: v }) });
    this.warning = h('p', { class: 'experiment-warning', role: 'status', 'data-testid': 'experiment-warning' });
    this.digitalRows = h('fieldset', { class: 'inner', 'aria-label': 'Digital controller' },
      h('div', { class: 'row' }, this.sampleTime.node, this.delay.node, this.rates.node),
      h('div', { class: 'row' }, h('span', { class: 'caption', title: 'counts per revolution; 0 measures exactly' }, 'encoders'), this.encoders.map((f) => f.node), this.noise.node, this.seed.node));
    return h('fieldset', {}, this.isDigital.node, this.digitalRows, this.warning);
  }

  #disturbance() {
    this.isDisturbed = this.#check('disturbance', 'Disturbance', 'volts that act on the motors besides the controller’s, beyond their limits', (s, on) => withDisturbance(s, on ? {} : null));
    this.volts = /** @type {const} */ (['V_p', 'V_y']).map((name) => this.#number({ id: `disturbance-${name}`, label: `disturbance of the ${name === 'V_p' ? 'pitch' : 'yaw'} motor in volts`, mark: symbol('V', name[2]), unit: 'V', field: `scenario.disturbance.${name}`,
      min: -1000, max: 1000, change: (s, v) => withDisturbance(s, { [name]: v }) }));
    this.since = this.#number({ id: 'disturbance-time', label: 'when the disturbance sets in, seconds', mark: 'from', unit: 's', field: 'scenario.disturbance.time', min: 0, max: 600, change: (s, v) => withDisturbance(s, { time: v }) });
    this.disturbanceRow = h('fieldset', { class: 'inner row', 'aria-label': 'Disturbance' }, this.volts.map((f) => f.node), this.since.node);
    return h('fieldset', { class: 'row' }, this.isDisturbed.node, this.disturbanceRow);
  }

  #accuracy() {
    this.tolerance = h('select', { 'data-testid': 'experiment-tolerance', 'data-field': 'scenario.rtol', 'aria-label': 'Tolerance of the simulation', onchange: () => this.#edit((s) => withOption(s, { rtol: Number(this.tolerance.value) })) },
      TOLERANCES.map(([value, text]) => h('option', { value }, text)));
    return h('div', { class: 'row spread foot' }, h('label', { class: 'select', title: 'relative tolerance of the adaptive integration; where a finer one changes the picture, the picture was wrong' }, 'tolerance', this.tolerance),
      h('span', { class: 'aside' }, 'Linear responses know the start alone.'));
  }

  /** @param {import('../types.js').State} state */
  render({ design, reply, problem }) {
    if (!design) return;
    const { scenario } = design;
    const words = experimentWords(scenario).join(' · ');
    const findings = (reply?.findings ?? []).filter((f) => TOLD_HERE.includes(f.code) && !problem);
    setText(this.words, `${findings.length ? '▲ ' : ''}${words || 'continuous controller, undisturbed'}`);
    setAttr(this.words, 'title', [words, ...findings.map((f) => f.message)].join('\n'));
    this.words.classList.toggle('warning', findings.length > 0);
    this.reset.hidden = isStandard(scenario);
    const refused = /^scenario\.(?!reference|duration|samples)/.test(problem?.field ?? '');
    this.summary.classList.toggle('refused', refused);
    this.#showLimits(design);
    this.#showDigital(scenario);
    setText(this.warning, findings.map((f) => `▲ ${f.message}`).join(' '));
    const { disturbance } = scenario;
    this.isDisturbed.input.checked = Boolean(disturbance);
    this.disturbanceRow.hidden = !disturbance;
    this.volts.forEach((field, i) => field.set(disturbance?.[i ? 'V_y' : 'V_p'] ?? 0));
    this.since.set(disturbance?.time ?? 0);
    this.tolerance.value = String(scenario.rtol ?? STANDARD.rtol);
  }

  /** @param {import('../types.js').Design} design */
  #showLimits({ scenario, theta0, outer, method, loops }) {
    const { saturation, anti_windup, travel_stops, trim_feedforward } = { ...STANDARD, ...scenario };
    const rest = [theta0, 0];
    this.start.forEach((field, i) => {
      const angle = scenario.initial?.[AXES[i]];
      field.set(angle === undefined ? NaN : tidy(angle * DEGREE));
      field.setBlank(forField(tidy(rest[i] * DEGREE)), rest[i] * DEGREE);
    });
    this.saturation.input.checked = saturation;
    this.stops.input.checked = travel_stops;
    this.stops.input.disabled = this.store.preset?.limits.theta === undefined;
    this.trim.input.checked = trim_feedforward;
    const integrates = outer === 'pi' || method === 'lqr-integral';
    this.windup.set(anti_windup);
    this.windup.disable(!saturation || !integrates);
    this.tracking.node.hidden = anti_windup !== 'back-calculation';
    this.tracking.disable(!saturation || !integrates);
    this.tracking.set(scenario.tracking_time === undefined ? NaN : tidy(1000 * scenario.tracking_time));
    const [first, second] = [loops.pitch.ti, loops.yaw.ti];
    this.tracking.setBlank(first === second && method !== 'lqr-integral' ? forField(tidy(1000 * first)) : 'Tᵢ', 1000 * first);
  }

  /** @param {Scenario} scenario */
  #showDigital({ digital }) {
    const own = this.store.preset?.encoders ?? NO_COUNTS;
    const { sample_time, delay, rates, noise, seed } = { ...DIGITAL, ...digital };
    this.isDigital.input.checked = Boolean(digital);
    this.digitalRows.hidden = !digital;
    this.sampleTime.set(tidy(1000 * sample_time));
    this.delay.input.checked = delay;
    this.rates.input.checked = rates === 'filtered';
    this.encoders.forEach((field, i) => {
      field.set(digital?.encoders?.[AXES[i]] ?? NaN);
      field.setBlank(String(own[AXES[i]]), own[AXES[i]]);
    });
    this.noise.set(tidy(noise * DEGREE));
    this.seed.set(seed);
    this.seed.node.hidden = noise === 0;
  }
}
