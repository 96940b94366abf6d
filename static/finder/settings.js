/**
 * What the finder is asked for: a row for each figure that counts, with a limit, a wish for better, or both; what is
 * free; how uncertain the rig is. In a link: `settling_time:theta:max:0.8:better::free:poles,loops::spread:0.1`, parts
 * with `::` between them, and nothing that links must escape. Pure.
 * @typedef {import('../model/figures.js').Figure} Figure
 * @typedef {import('./shapes.js').Where} Where
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Design} Design
 * @typedef {Required<Pick<Where, 'model'|'steps'>> & {measure: string, where: string, limit: number|null,
 *   most: boolean, share: number|null, better: boolean}} Row
 *   where: an axis, a motor, or both; limit: in the figure's unit, SI but for %; most: it is a largest value
 * @typedef {{rows: Row[], free: string[], spread: number, designs: number, seed: number}} Settings
 */
import { guarded, hides, LOOP, placesPoles } from '../model/index.js';
import { MEASURED_FIGURES, SHARES } from '../kernel/index.js';

/** Figures by what they tell; those that the registry has beside them follow in the menu. */
export const GROUPS = /** @type {[string, string[]][]} */ ([
  [
    'Step responses',
    ['settling_time', 'rise_time', 'overshoot', 'undershoot', 'steady_state_error', 'coupling_peak', 'iae', 'itae'],
  ],
  ['Motors', ['V_peak', 'saturated', 'effort']],
  ['Robustness', ['disk_margin', 'gain_margin', 'phase_margin', 'delay_margin', 'lag_margin', 'sensitivity_peak']],
  ['Gain K', ['norm', 'spectral_norm', 'eigenvector_condition', 'lambda_11']],
  ['Uncertain rigs', SHARES],
]);
const TITLES = /** @type {Record<string, string>} */ ({
  V_peak: 'Largest voltage',
  saturated: 'Time at the limit',
  effort: 'Effort',
  norm: 'Norm of K',
  spectral_norm: 'Spectral norm of K',
  eigenvector_condition: 'Condition of the eigenvectors',
  lambda_11: 'Relative gain',
  share_stable: 'Rigs that are stable',
  share_within_limits: 'Rigs within limits',
});

/** The figure's name in the menu. @param {string} measure */
export function titleOf(measure) {
  const head = MEASURED_FIGURES.get(measure)?.figure.head?.replace(/, \S+$/, '');
  const words = TITLES[measure] ?? head ?? measure.replaceAll('_', ' ');
  return words[0].toUpperCase() + words.slice(1);
}

/** Shares of rigs, and of time, are read in percent. @param {string} measure */
const isShare = (measure) => SHARES.includes(measure) || measure === 'saturated';

/** The unit in which it is read. @param {string} measure */
export function unitOf(measure) {
  const figure = MEASURED_FIGURES.get(measure)?.figure;
  if (isShare(measure)) return '%';
  if (figure?.notation === 'seconds') return 's';
  if (figure?.notation === 'decibel') return 'dB';
  return figure?.after?.trim() ?? figure?.head?.match(/, (\S+)$/)?.[1] ?? '';
}

/** In the unit in which it is read. @param {string} measure @param {number} v in the figure's */
export function shownValue(measure, v) {
  const figure = MEASURED_FIGURES.get(measure)?.figure;
  if (isShare(measure)) return 100 * v;
  if (figure?.notation === 'decibel') return 20 * Math.log10(v);
  return v * (figure?.notation === 'seconds' ? 1 : (figure?.scale ?? 1));
}

/** The inverse, without the digits of rounding. @param {string} measure @param {number} shown */
export function valueOfShown(measure, shown) {
  const figure = MEASURED_FIGURES.get(measure)?.figure;
  if (isShare(measure)) return Number((shown / 100).toPrecision(12));
  if (figure?.notation === 'decibel') return Number((10 ** (shown / 20)).toPrecision(12));
  const scale = figure?.notation === 'seconds' ? 1 : (figure?.scale ?? 1);
  return Number((shown / scale).toPrecision(12));
}

/** Whether more is better. @param {string} measure */
export const isHigher = (measure) =>
  SHARES.includes(measure) || MEASURED_FIGURES.get(measure)?.figure.better === 'higher';

/** What may be said of a figure's response. @param {string} measure */
export function choicesOf(measure) {
  const of = MEASURED_FIGURES.get(measure)?.of ?? '';
  const response = ['axis', 'step', 'motor'].includes(of);
  return {
    axis: response,
    motor: of === 'motor' || of === 'margins',
    model: response,
    together: response && of !== 'step',
  };
}

/** @param {string} measure @param {Partial<Row>} [part] @returns {Row} */
export const rowOf = (measure, part) => ({
  measure,
  where: 'both',
  model: 'nonlinear',
  steps: 'alone',
  limit: null,
  most: !isHigher(measure),
  share: null,
  better: false,
  ...part,
});

/** @template {{kp: number, ti: number}} L @param {L} loop @returns {L} */
const otherLoop = (loop) => ({ ...loop, kp: loop.kp + 1, ti: loop.ti + 1 });

/** What can be free: a change that shows whether all of it may be changed, and where it means anything. */
const FREE = /** @type {Record<string, {title: string, about: string, with: (d: Design) => Design,
  of?: (state: State) => boolean}>} */ ({
  poles: {
    title: 'poles',
    about: 'the four poles that are placed',
    with: (d) => ({ ...d, poles: /** @type {Design['poles']} */ (d.poles.map(({ re, im }) => ({ re: re - 1, im }))) }),
    of: placesPoles,
  },
  rotor_poles: {
    title: 'rotor poles',
    about: 'the poles of both rotors, where they are placed',
    with: (d) => ({ ...d, rotor_poles: [d.rotor_poles[0] - 1, d.rotor_poles[1] - 1] }),
    of: ({ design }) => design?.place_rotors === true,
  },
  loops: {
    title: 'PI loops',
    about: 'k_p and T_i of both outer loops',
    with: (d) => ({ ...d, loops: { pitch: otherLoop(d.loops.pitch), yaw: otherLoop(d.loops.yaw) } }),
    of: ({ design }) => design?.outer === 'pi',
  },
  structure: {
    title: 'structure',
    about: 'how the inner loops are coupled, and which axis leads',
    with: (d) => ({ ...d, lead: /** @type {Design['lead']} */ (d.lead === 'pitch' ? 'yaw' : 'pitch') }),
    of: placesPoles,
  },
  shift: {
    title: 'shift',
    about: 'the shift c of the triangular structure',
    with: (d) => ({ ...d, shift: Number(d.shift) + 1 }),
    of: placesPoles,
  },
  pairing: {
    title: 'pairing',
    about: 'which motor each outer loop drives',
    with: (d) => ({ ...d, pairing: d.pairing === 'cross' ? 'diagonal' : 'cross' }),
    of: ({ design }) => design?.outer === 'pi',
  },
  decoupler: {
    title: 'decoupler',
    about: 'the static decoupler, with or without',
    with: (d) => ({ ...d, decoupler: !d.decoupler }),
    of: ({ design }) => design?.outer === 'pi',
  },
  observer: {
    title: 'observer’s poles',
    about: 'the poles of the observer, where it estimates the states',
    with: (d) => ({ ...d, observer: undefined }),
    of: ({ design }) => design?.scenario.measured === 'observer' && design.observer?.method !== 'kalman',
  },
  weights: {
    title: 'weights',
    about: 'the weights of a quadratic method',
    with: (d) => ({ ...d, weights: { ...d.weights, inputs: { V_p: 1, V_y: 2 } } }),
    of: (state) => !placesPoles(state) && /lq/.test(state.design?.method ?? ''),
  },
});

/** Whether locks leave nothing out of a change. @param {Design} from @param {Design} to @param {State} state */
const isWhole = (from, to, { locks, task }) =>
  JSON.stringify(guarded(from, to, locks, task?.free)) === JSON.stringify(to);

/**
 * What can be free for this design, and what a link or a lab's step locks of it.
 * @param {State} state
 * @returns {{name: string, title: string, about: string, locked: boolean}[]}
 */
export function freeOf(state) {
  const { design } = state;
  if (!design) return [];
  return Object.entries(FREE)
    .filter(([, { of }]) => of?.(state) ?? true)
    .map(([name, { title, about, with: changed }]) => ({
      name,
      title,
      about,
      // of what is locked in part, the search would find what may not be taken
      locked: !isWhole(design, changed(design), state),
    }));
}

/** What is proposed: the s-plane's requirements, and to be quick with little voltage. @param {State} state */
export function proposed({ requirements: r }) {
  /** @type {Settings} */
  const settings = {
    rows: [
      rowOf('settling_time', { limit: r.settling, better: true }),
      rowOf('overshoot', { limit: r.overshoot ?? 10 }),
      rowOf('V_peak', { better: true }),
      rowOf('disk_margin', { limit: 0.4 }),
      ...(r.lag === null ? [] : [rowOf(LOOP.lag.name, { limit: r.lag })]),
    ],
    free: ['poles', 'loops'],
    spread: 0,
    designs: USUAL,
    seed: 0,
  };
  return settings;
}

const PLACES = ['theta', 'psi', 'V_p', 'V_y', 'both'];
export const SPREADS = [0, 0.05, 0.1, 0.2];
const USUAL = 20_000;
/** Designs to be tried. */
export const BUDGETS = [5_000, USUAL, 100_000];
/** In so many seconds at most; a budget that is used up gives the same answer on every machine. */
const CEILINGS = [10, 20, 60];
export const MOST_ROWS = 16;

/** @param {Settings} settings */
export const linkText = ({ rows, free, spread, designs, seed }) =>
  [
    ...rows.map(({ measure, where, model, steps, limit, most, share, better }) => [
      measure,
      ...(where === 'both' ? [] : [where]),
      ...(model === 'linear' ? [model] : []),
      ...(steps === 'together' ? [steps] : []),
      ...(limit === null ? [] : [most ? 'max' : 'min', Number(limit.toPrecision(9))]),
      ...(share === null ? [] : ['share', Number(share.toPrecision(6))]),
      ...(better ? ['better'] : []),
    ]),
    ...(free.length ? [['free', free.join()]] : []),
    ...(spread ? [['spread', spread]] : []),
    ...(designs === USUAL ? [] : [['designs', designs]]),
    ...(seed ? [['seed', seed]] : []),
  ]
    .map((words) => words.join(':'))
    .join('::');

/** @param {string} text @returns {Settings} what of it is understood */
export function settingsIn(text) {
  /** @type {Settings} */ const settings = { rows: [], free: [], spread: 0, designs: USUAL, seed: 0 };
  for (const part of text.split('::').slice(0, MOST_ROWS)) {
    const [name, ...words] = part.split(':');
    const number = Number(words[0]);
    if (name === 'free') settings.free = (words[0] ?? '').split(',').filter((free) => Object.hasOwn(FREE, free));
    else if (name === 'spread') settings.spread = number >= 0 && number <= 0.5 ? number : 0;
    else if (name === 'designs') settings.designs = BUDGETS.includes(number) ? number : USUAL;
    else if (name === 'seed') settings.seed = Number.isInteger(number) && number >= 0 ? number : 0;
    else if (MEASURED_FIGURES.has(name) || SHARES.includes(name)) settings.rows.push(rowIn(name, words));
  }
  return settings;
}

/** @param {string} measure @param {string[]} words @returns {Row} */
function rowIn(measure, words) {
  const after = (/** @type {string} */ word) => {
    const text = words.includes(word) ? words[words.indexOf(word) + 1] : undefined;
    return text && Number.isFinite(Number(text)) ? Number(text) : null;
  };
  const [max, min, share] = [after('max'), after('min'), after('share')];
  return rowOf(measure, {
    where: words.find((word) => PLACES.includes(word)) ?? 'both',
    model: words.includes('linear') ? 'linear' : 'nonlinear',
    steps: words.includes('together') ? 'together' : 'alone',
    limit: max ?? min,
    most: max !== null || (min === null && !isHigher(measure)),
    share: share !== null && share >= 0 && share <= 1 ? share : null,
    better: words.includes('better'),
  });
}

/** Of which response. @param {Row} row @returns {Where} what can be said of such a figure */
export function whereOf({ measure, where, model, steps }) {
  const can = choicesOf(measure);
  const isMotor = where === 'V_p' || where === 'V_y';
  return {
    ...(can.axis && { axis: /** @type {Where['axis']} */ (isMotor ? 'both' : where) }),
    ...(can.motor && isMotor && { motor: where }),
    ...(can.model && { model }),
    ...(can.together && steps === 'together' && { steps }),
  };
}

const WHERE = /** @type {const} */ (['axis', 'motor', 'model', 'steps']);
/** What is meant where nothing is said. */
const USUALLY = { axis: 'both', motor: 'both', model: 'nonlinear', steps: 'alone' };

/**
 * Whether two figures are one, of the same response.
 * @param {Where & {measure: string}} a @param {Where & {measure: string}} b
 */
export const isSame = (a, b) =>
  a.measure === b.measure && WHERE.every((name) => (a[name] ?? USUALLY[name]) === (b[name] ?? USUALLY[name]));

/**
 * What the server is asked.
 * @param {Settings} settings
 * @param {string[]} free of those that may be
 * @param {string[]} names of what is uncertain
 * @returns {import('./shapes.js').Asked}
 */
export function askedOf({ rows, spread, designs, seed }, free, names) {
  /** @type {import('./shapes.js').Asked['require']} */ const require = {};
  for (const row of rows) {
    if (row.limit === null || !counts(row, spread)) continue;
    const limit = { [row.most ? 'max' : 'min']: row.limit, ...(spread && row.share !== null && { share: row.share }) };
    (require[row.measure] ??= []).push({ ...limit, ...whereOf(row) });
  }
  return {
    free,
    require,
    minimize: rows
      .filter((row) => row.better && counts(row, spread))
      .map((row) => ({ measure: row.measure, ...whereOf(row) })),
    ...(spread && { uncertainty: { spread: Object.fromEntries(names.map((name) => [name, spread])) } }),
    designs,
    seconds: CEILINGS[BUDGETS.indexOf(designs)] ?? CEILINGS[1],
    seed,
  };
}

/** Shares of rigs say nothing where the rig is certain. @param {Row} row @param {number} spread */
const counts = ({ measure }, spread) => spread > 0 || !SHARES.includes(measure);

/** Whether a lab's step leaves the search to the student. @param {Partial<State>} state */
export const isKeptBack = (state) => ['remarks', 'suggestions', 'poles', 'metrics'].some((what) => hides(state, what));

/** Whether a figure is kept back. @param {Partial<State>} state @param {string} measure */
export function isHidden(state, measure) {
  const of = MEASURED_FIGURES.get(measure)?.of ?? '';
  const margins = ['margins', 'sensitivity', 'loop'].includes(of);
  return (margins && hides(state, 'margins')) || (measure === 'lambda_11' && hides(state, 'rga'));
}

/**
 * Why it cannot be asked.
 * @param {import('./shapes.js').Asked} asked
 * @returns {string} empty where it can
 */
export function objectionTo({ free, require, minimize }) {
  if (!free.length) return 'Nothing is free: tick what may be changed.';
  if (!Object.keys(require).length && !minimize.length)
    return 'Nothing is asked for: give a limit, or tick what shall be minimized.';
  if (minimize.length > 3) return 'At most three figures can be minimized or maximized at once.';
  return '';
}
