/**
 * Weather and faults: gusts, one by one or as a seed has them, a mass at the nose, rotors that lose thrust, encoders
 * that stick. Each is an event of the flight; what is shown is what acts, also after it was rewound.
 * @typedef {import('./strength.js').Strength} Strength
 * @typedef {{after: number, theta: number, psi: number, lasts: number}} Gust s since the one before; shares of the
 *   largest torques, −1 … 1; s
 * @typedef {{gust: boolean, mass: number, arm: number, thrust: [number, number], stuck: [boolean, boolean]}} Acting
 *   kg, m; shares; whether encoders stick
 */
import { INPUT, uniform, WITHIN } from '../kernel/index.js';
import { fixed, inField, percent, say, t } from '../text/index.js';
import { button, check, h, setText } from '../ui/index.js';
import { inSteps, MASSES } from './strength.js';

/** Of a button's gust: share of the largest torques, and how long, s. */
const GUSTS = { small: { share: 0.35, lasts: 0.8 }, large: { share: 1, lasts: 1.2 } };
/** Of random weather: from gust to gust, s; shares of the largest torque; how long each is, s. */
const BETWEEN = [1.6, 4];
const SHARES = [0.2, 1];
const LASTS = [0.4, 1.5];
const THRUSTS = [1, 0.8, 0.5, 0.2, 0];
/** Streams of random numbers, a seed's own. */
const STREAMS = 8;
const MOST_SEED = 99_999;
/** Words of what is shown here. */
const SHOWN = new Set(['gust', 'hung', 'thrust', 'stuck']);

/** @param {[number, number]|number[]} range @param {number} u −1 … 1 */
const within = ([low, high], u) => low + ((high - low) * (u + 1)) / 2;

/**
 * A gust of random weather: of the same seed it is always the same.
 * @param {number} seed @param {number} k which one, from 0 on @returns {Gust}
 */
export function gustOf(seed, k) {
  const [wait, way, size, long] = [0, 1, 2, 3].map((stream) => uniform(k, STREAMS * seed + stream));
  const share = within(SHARES, size);
  return {
    after: within(BETWEEN, wait),
    theta: share * Math.cos(Math.PI * way),
    psi: share * Math.sin(Math.PI * way),
    lasts: within(LASTS, long),
  };
}

/**
 * What acts now.
 * @param {Float64Array} u what acts, as INPUT has it @param {number} tick
 * @returns {Acting}
 */
export function actingIn(u, tick) {
  const [inertia, moment] = [u[INPUT.HUNG], u[INPUT.HUNG + 1]];
  const arm = moment === 0 ? 0 : (inertia / moment) * WITHIN.GRAVITY;
  return {
    gust: tick < u[INPUT.GUST_FROM] + u[INPUT.GUST_TICKS] && (u[INPUT.GUST] !== 0 || u[INPUT.GUST + 1] !== 0),
    mass: arm === 0 ? 0 : moment / (WITHIN.GRAVITY * arm),
    arm,
    thrust: [u[INPUT.THRUST], u[INPUT.THRUST + 1]],
    stuck: [u[INPUT.STUCK] !== 0, u[INPUT.STUCK + 1] !== 0],
  };
}

/** @param {number} kg */
export const massText = (kg) => say`${inField(Number((1000 * kg).toPrecision(3)))} g`;

/** What acts, in words; empty where nothing does. @param {Acting} acting */
export function actingText({ gust, mass, thrust, stuck }) {
  const rotor = [t('pitch rotor'), t('yaw rotor')];
  const angle = ['θ', 'ψ'];
  return [
    gust ? t('a gust') : '',
    mass ? say`${massText(mass)} at the nose` : '',
    ...thrust.map((share, i) => (share === 1 ? '' : say`${rotor[i]} at ${percent(share)} of its thrust`)),
    ...stuck.map((on, i) => (on ? say`the encoder of ${angle[i]} sticks` : '')),
  ]
    .filter(Boolean)
    .join(', ');
}

export class Weather {
  /** Gusts of buttons so far: each comes from elsewhere. */ #blown = 0;
  /** When random weather began, s of flight; null: there is none. @type {number|null} */ #since = null;
  /** Its next gust, and when. */ #next = 0;
  #due = 0;
  /** For which masses there are choices. @type {number|null} */ #mass = null;

  /**
   * @param {import('./flight.js').Flight} flight
   * @param {() => {strength: Strength, arm: number}|null} rig null before it is known
   */
  constructor(flight, rig) {
    this.flight = flight;
    this.rig = rig;
    this.small = this.#gustButton('small', t('Small gust'));
    this.large = this.#gustButton('large', t('Large gust'));
    this.random = check(
      {
        'data-testid': 'weather-random',
        title: 'Gusts of random strength, way and length, every few seconds; the same seed brings the same weather',
        onchange: () => this.#turn(this.random.box.checked),
      },
      'random weather',
    );
    this.seed = h('input', {
      class: 'number',
      type: 'number',
      min: 0,
      max: MOST_SEED,
      step: 1,
      value: 1,
      'aria-label': 'Seed of the random weather',
      'data-testid': 'weather-seed',
      onchange: () => this.#turn(this.random.box.checked),
    });
    this.mass = this.#select('weather-mass', () => this.#hang(Number(this.mass.value)), [[0, t('nothing')]]);
    const shares = THRUSTS.map((share) => /** @type {[number, string]} */ ([share, percent(share)]));
    this.rotors = ['pitch', 'yaw'].map((axis) => this.#select(`weather-${axis}`, () => this.#weaken(), shares));
    this.encoders = ['θ', 'ψ'].map((angle, i) =>
      check(
        {
          'data-testid': `weather-stuck-${i ? 'psi' : 'theta'}`,
          'aria-label': say`the encoder of ${angle} sticks`,
          title: 'It goes on to tell its last reading',
          onchange: () => this.#stick(),
        },
        angle,
      ),
    );
    this.calm = button(
      { 'data-testid': 'weather-calm', title: 'No weather, and everything whole again', onclick: () => this.clear() },
      'All well again',
    );
    this.told = h('span', { class: 'weather-told', role: 'status', 'data-testid': 'weather-told' });
    const row = (/** @type {string} */ name, /** @type {Node[]} */ ...nodes) =>
      h('label', { class: 'weather-row' }, h('span', {}, name), ...nodes);
    this.node = h(
      'details',
      { class: 'weather', 'data-testid': 'weather' },
      h('summary', {}, h('span', {}, 'Weather and faults'), this.told),
      h('div', { class: 'weather-gusts' }, this.small, this.large),
      h('div', { class: 'weather-random' }, this.random.node, this.seed),
      row(t('At the nose hangs'), this.mass),
      row(t('Pitch rotor has'), this.rotors[0]),
      row(t('Yaw rotor has'), this.rotors[1]),
      h(
        'div',
        { class: 'weather-row' },
        h('span', {}, 'Encoders that stick'),
        h('span', { class: 'weather-stuck' }, this.encoders[0].node, this.encoders[1].node),
      ),
      this.calm,
    );
    flight.addEventListener('start', () => this.#again(0));
    flight.addEventListener('cut', (e) => this.#again(/** @type {CustomEvent} */ (e).detail.time));
    for (const type of ['start', 'cut', 'change', 'end']) flight.addEventListener(type, () => this.render());
    flight.addEventListener('did', (e) => SHOWN.has(/** @type {CustomEvent} */ (e).detail.word) && this.render());
    this.render();
  }

  /** Blows once, from somewhere else each time. @param {'small'|'large'} kind @returns {boolean} whether it does */
  gust(kind) {
    const { share, lasts } = GUSTS[kind];
    const way = Math.PI * uniform(this.#blown, 0);
    this.#blown += 1;
    return this.#blow({ theta: share * Math.cos(way), psi: share * Math.sin(way), lasts });
  }

  /** What random weather has for now. */
  blow() {
    const { time, mode } = this.flight.state;
    if (this.#since === null || mode !== 'flying') return;
    for (; this.#due <= time; this.#goOn()) {
      const next = gustOf(this.#seeded, this.#next);
      if (this.#due > time - next.lasts) this.#blow(next);
    }
  }

  /** Nothing acts any more. */
  clear() {
    const { craft } = this.flight;
    this.#turn((this.random.box.checked = false));
    if (!craft) return;
    const acting = actingIn(craft.u, craft.tick);
    if (acting.gust) this.flight.do('gust', 0, 0, 1);
    if (acting.mass) this.flight.do('hung', 0, 0);
    if (acting.thrust.some((share) => share !== 1)) this.flight.do('thrust', 1, 1);
    if (acting.stuck.some(Boolean)) this.flight.do('stuck', 0, 0);
  }

  /** Shows what acts. */
  render() {
    const { craft, state } = this.flight;
    const can = craft !== null && (state.mode === 'flying' || state.mode === 'frozen') && !state.replay;
    const acting = craft ? actingIn(craft.u, craft.tick) : null;
    this.#offer();
    for (const node of [this.small, this.large, this.mass, ...this.rotors, this.calm]) node.disabled = !can;
    for (const { box } of this.encoders) box.disabled = !can;
    for (const node of [this.small, this.large]) node.classList.toggle('acts', acting?.gust === true);
    const marked = (/** @type {HTMLElement} */ node, /** @type {boolean} */ on) => node.classList.toggle('acts', on);
    choose(this.mass, acting ? Number(acting.mass.toPrecision(3)) : 0);
    marked(this.mass, Boolean(acting?.mass));
    this.rotors.forEach((node, i) => {
      choose(node, acting?.thrust[i] ?? 1);
      marked(node, (acting?.thrust[i] ?? 1) !== 1);
    });
    this.encoders.forEach(({ box, node }, i) => {
      box.checked = acting?.stuck[i] ?? false;
      marked(node, box.checked);
    });
    marked(this.random.node, this.#since !== null);
    const words = acting ? actingText(acting) : '';
    setText(this.told, words);
    this.told.classList.toggle('acts', words !== '');
  }

  /** @param {'small'|'large'} kind @param {string} words */
  #gustButton(kind, words) {
    const { lasts } = GUSTS[kind];
    return button(
      {
        'data-testid': `gust-${kind}`,
        title: say`From somewhere else each time; lasts ${fixed(lasts, 1)} s`,
        onclick: () => this.gust(kind),
      },
      words,
    );
  }

  /** @param {string} testid @param {() => void} onchange @param {[number, string][]} options */
  #select(testid, onchange, options) {
    return h('select', { 'data-testid': testid, onchange }, options.map(optionOf));
  }

  /** The masses that suit the rig. */
  #offer() {
    const mass = this.rig()?.strength.mass ?? null;
    if (mass === null || mass === this.#mass) return;
    this.#mass = mass;
    const all = MASSES.map((times) => Number((times * mass).toPrecision(3)));
    this.mass.replaceChildren(
      ...[/** @type {[number, string]} */ ([0, t('nothing')]), ...all.map((kg) => [kg, massText(kg)])].map((option) =>
        optionOf(/** @type {[number, string]} */ (option)),
      ),
    );
  }

  /** @param {{theta: number, psi: number, lasts: number}} gust */
  #blow({ theta, psi, lasts }) {
    const [strength, step] = [this.rig()?.strength, this.flight.craft?.step];
    if (!strength || !step) return false;
    const torques = [theta * strength.theta, psi * strength.psi].map((v) => inSteps(v, strength.step));
    return this.flight.do('gust', ...torques, Math.max(Math.round(lasts / step), 1));
  }

  /** @param {number} kg */
  #hang(kg) {
    this.flight.do('hung', kg, kg && inSteps(this.rig()?.arm ?? 0, 1e-3));
  }

  #weaken() {
    this.flight.do('thrust', ...this.rotors.map((node) => Number(node.value)));
  }

  #stick() {
    this.flight.do('stuck', ...this.encoders.map(({ box }) => Number(box.checked)));
  }

  get #seeded() {
    const seed = Math.round(Number(this.seed.value));
    return Math.min(Math.max(Number.isFinite(seed) ? seed : 0, 0), MOST_SEED);
  }

  /** Random weather from now on, or none. @param {boolean} on */
  #turn(on) {
    this.#since = on ? this.flight.state.time : null;
    this.#begin();
    this.render();
  }

  #begin() {
    [this.#next, this.#due] = [0, this.#since ?? 0];
    this.#due += gustOf(this.#seeded, 0).after;
  }

  #goOn() {
    this.#next += 1;
    this.#due += gustOf(this.#seeded, this.#next).after;
  }

  /** The flight stands at another time: the weather is that of then. @param {number} time s */
  #again(time) {
    if (this.#since === null) return;
    if (time < this.#since || time === 0) this.#since = time;
    this.#begin();
    while (this.#due <= time) this.#goOn();
  }
}

/** @param {[number, string]} option */
const optionOf = ([value, words]) => h('option', { value }, words);

/** Shows a value, also one that nobody can choose here. @param {HTMLSelectElement} node @param {number} value */
function choose(node, value) {
  if (Number(node.value) === value) return;
  const text = String(value);
  if (![...node.options].some((option) => option.value === text)) {
    const { testid = '' } = node.dataset;
    node.append(optionOf([value, testid === 'weather-mass' ? massText(value) : percent(value)]));
  }
  node.value = text;
}
