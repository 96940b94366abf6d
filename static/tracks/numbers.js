/**
 * Which numbers of a design can be swept, what they are called, and the design with another value of one; and what is
 * swept as a link has it: `loops.pitch.kp,1,100,log`, of which all but the first may be left out. Pure.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {{path: string, over: [number, number]|null, log: boolean, kept: boolean}} Swept  over: in SI units
 * @typedef {[label: string, options: [path: string, label: string][]]} Group
 */
import { bringsIntegralAction, isComplex, placesPoles, presetOf, tidy } from '../model/index.js';
import { DEGREE } from '../text/index.js';

const FIRST = 'gain';
const GAINS = ['gain', 'gain.pitch', 'gain.yaw'];
const AXES = /** @type {const} */ (['pitch', 'yaw']);
const OF_RIG = /^(parameters|rotors|operating_point)\./;
/** Ends of the range are told with so many digits, and so is a value that is taken. */
const DIGITS = 4;

/** @param {string|null} text @returns {Swept|null} null where it is nothing of this page */
export function sweptOf(text) {
  if (!text) return null;
  const [path, ...rest] = text.split(',');
  if (!/^[a-z][\w.-]*$/i.test(path)) return null;
  /** @type {string[]} */ const words = rest.filter((word) => word === 'log' || word === 'kept');
  const numbers = rest.filter((word) => !words.includes(word)).map(Number);
  if (numbers.length !== 0 && (numbers.length !== 2 || !(numbers[0] < numbers[1]))) return null;
  const over = numbers.length ? /** @type {[number, number]} */ ([numbers[0], numbers[1]]) : null;
  return { path, over, log: words.includes('log'), kept: words.includes('kept') };
}

/** @param {Swept} swept */
export const textOfSwept = ({ path, over, log, kept }) =>
  [path, ...(over ?? []), ...(log ? ['log'] : []), ...(kept ? ['kept'] : [])].join();

/** What is swept at first: the loops' gain, from the open loop on. */
export const FIRST_SWEPT = /** @type {Swept} */ ({ path: FIRST, over: null, log: false, kept: false });

/** Whether its values are designs; a gain's are none. @param {string} path */
export const isOfDesign = (path) => !GAINS.includes(path);

/** Whether the gains can be kept while it changes. @param {string} path */
export const isOfRig = (path) => OF_RIG.test(path);

/** What the present design has to be swept. @param {State} state @returns {Group[]} */
export function offered(state) {
  const { design } = state;
  if (!design) return [];
  /** @type {Group[]} */ const groups = [
    [
      'Loop gain',
      [
        ['gain', 'k, both motors'],
        ['gain.pitch', 'k, pitch motor'],
        ['gain.yaw', 'k, yaw motor'],
      ],
    ],
  ];
  if (placesPoles(state)) {
    groups.push(['Pitch poles', ofPair(design, 0)], ['Yaw poles', ofPair(design, 1)]);
    groups.push(['All poles', [['poles.factor', 'factor on all poles'], ...(design.place_rotors ? ROTOR_POLES : [])]]);
  }
  if (design.outer === 'pi' && !bringsIntegralAction(state))
    groups.push([
      'Outer loops',
      AXES.flatMap((axis) => [
        [`loops.${axis}.kp`, `kₚ, ${axis}`],
        [`loops.${axis}.ti`, `Tᵢ, ${axis}`],
      ]),
    ]);
  groups.push(['Rotors and controller', ROTORS], ['Rig', ofRig(state)]);
  return groups;
}

/** @type {[string, string][]} */
const ROTOR_POLES = [
  ['rotor_poles.0', 'p₅'],
  ['rotor_poles.1', 'p₆'],
];
/** @type {[string, string][]} */
const ROTORS = [
  ['rotors.tau', 'τ, both rotors'],
  ['rotors.pitch.tau', 'τ, pitch rotor'],
  ['rotors.yaw.tau', 'τ, yaw rotor'],
  ['scenario.digital.sample_time', 'Tₛ, sample time'],
];

/** @param {Design} design @param {number} own @returns {[string, string][]} */
function ofPair(design, own) {
  const name = `${AXES[own]}-pair`;
  const [p, q] = [0, 1].map((k) => design.poles[2 * own + k]);
  const product = p.re * q.re - p.im * q.im;
  /** @type {[string, string][]} */ const alone = [0, 1].map((k) => [
    `poles.${2 * own + k}`,
    `p${'₁₂₃₄'[2 * own + k]}`,
  ]);
  /** @type {[string, string][]} */ const polar = [
    [`${name}.frequency`, `ωₙ, ${AXES[own]} poles`],
    [`${name}.damping`, `ζ, ${AXES[own]} poles`],
  ];
  return [
    ...(isComplex(design.poles, /** @type {0|1} */ (own)) ? [] : alone),
    ...(product > 0 ? polar : []),
    [`${name}.re`, `Re, ${AXES[own]} poles`],
    [`${name}.im`, `Im, ${AXES[own]} poles`],
  ];
}

/** @param {State} state @returns {[string, string][]} */
const ofRig = (state) => [
  ['operating_point.theta', 'θ₀, operating point'],
  .../** @type {[string, string][]} */ (
    Object.keys(presetOf(state)?.parameters ?? {}).map((name) => [`parameters.${name}`, name])
  ),
];

/** What a value in SI units is multiplied with to be shown. @param {string} unit */
export const scaleOf = (unit) => (unit === 'rad' ? DEGREE : 1);

/** @param {string} unit */
export const shownUnit = (unit) => (unit === 'rad' ? '°' : unit);

/** As few digits as a person would give. @param {number} v */
export const rounded = (v) => Number(v.toPrecision(DIGITS));

/**
 * The design with another value of a number; null of gains, whose values are no designs.
 * @param {Design} design @param {string} path @param {number} value SI
 * @returns {Design|null}
 */
export function designAt(design, path, value) {
  if (!isOfDesign(path)) return null;
  const [top, part] = path.split('.');
  const pair = ['pitch-pair', 'yaw-pair'].indexOf(top);
  if (pair >= 0) return { ...design, poles: withPair(design.poles, pair, part, value) };
  if (path === 'poles.factor') return { ...design, poles: poles(design.poles.map((p) => scaled(p, value))) };
  if (top === 'poles')
    return { ...design, poles: poles(design.poles.map((p, i) => (i === Number(part) ? { re: value, im: 0 } : p))) };
  if (top === 'rotor_poles') {
    const [first, second] = design.rotor_poles;
    return { ...design, rotor_poles: part === '0' ? [value, second] : [first, value] };
  }
  if (path === 'operating_point.theta') return { ...design, theta0: value };
  if (path === 'rotors.tau') return AXES.reduce((own, axis) => withAt(own, ['rotors', axis, 'tau'], value), design);
  return withAt(design, path.split('.'), value);
}

/** @param {Complex[]} of */
const poles = (of) => /** @type {Design['poles']} */ (of.map(({ re, im }) => ({ re: tidy(re), im: tidy(im) })));

/** @param {Complex} p @param {number} by */
const scaled = (p, by) => ({ re: by * p.re, im: by * p.im });

/**
 * One pair as it is told by its parts; what is not told stays.
 * @param {Design['poles']} all @param {number} own @param {string} part @param {number} value
 */
function withPair(all, own, part, value) {
  const [p, q] = [all[2 * own], all[2 * own + 1]];
  const product = p.re * q.re - p.im * q.im;
  let middle = 0.5 * (p.re + q.re); // p, q = middle ± √square
  let square = p.im ? -(p.im ** 2) : 0.25 * (p.re - q.re) ** 2;
  if (part === 're') middle = value;
  else if (part === 'im') square = -(value ** 2);
  else if (part === 'frequency')
    [middle, square] = [middle, square].map((v, i) => v * (value / Math.sqrt(product)) ** (i + 1));
  else [middle, square] = [-value * Math.sqrt(product), product * (value ** 2 - 1)];
  const root = Math.sqrt(Math.abs(square));
  const pair =
    square < 0
      ? [
          { re: middle, im: root },
          { re: middle, im: -root },
        ]
      : [
          { re: middle + root, im: 0 },
          { re: middle - root, im: 0 },
        ];
  return poles(all.map((pole, i) => (Math.floor(i / 2) === own ? pair[i % 2] : pole)));
}

/**
 * @template {object} T
 * @param {T} to @param {string[]} path @param {number} value
 * @returns {T}
 */
function withAt(to, [key, ...rest], value) {
  const inner = /** @type {Record<string, object>} */ (to ?? {})[key];
  return /** @type {T} */ ({ ...to, [key]: rest.length ? withAt(inner ?? {}, rest, value) : value });
}
