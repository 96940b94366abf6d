/**
 * The paper's Figs. 2 and 3 as block diagrams with the present values in their blocks: the state feedback, and the
 * loops around it.
 */
import { inverseOf, mixingOf } from '../model/index.js';
import { svg } from '../ui/index.js';
import { clean, figure } from './math.js';
import { arrow, drawing, math, node, sum, words } from './drawing.js';

/** @typedef {import('./walk.js').Walk} Walk */
const STATES = ['θ', 'ψ', 'θ̇', 'ψ̇'];
const MOTORS = [
  ['V', 'p'],
  ['V', 'y'],
];
const WIDTH = 380;

const value = (
  /** @type {number} */ x,
  /** @type {number} */ y,
  /** @type {string} */ text,
  anchor = 'middle',
  testid = '',
) => svg('text', { class: 'value', x, y, 'text-anchor': anchor, 'data-testid': testid || undefined }, text);
const label = (
  /** @type {number} */ x,
  /** @type {number} */ y,
  /** @type {string} */ base,
  sub = '',
  kind = 'small',
) => math(x, y, base, sub || undefined, { kind });

const short = (/** @type {number} */ v) => figure(v, Math.abs(v) < 1 ? 3 : 4);

/** @param {number} x @param {number} y @param {number} width @param {number} height @param {...Node} children */
const block = (x, y, width, height, ...children) =>
  svg('g', { class: 'box' }, svg('rect', { x, y, width, height, rx: 4 }), ...children);

/**
 * A matrix's entries, right-aligned in their columns.
 * @param {number[][]|undefined} matrix
 * @param {number} x right edge of the first column
 * @param {number} y baseline of the first row
 * @param {number} step
 * @param {number} digits
 * @param {string} testid
 */
const entries = (matrix, x, y, step, digits, testid) =>
  (matrix ?? []).flatMap((row, i) =>
    row.map((v, j) => value(x + j * step, y + 18 * i, figure(v, digits), 'end', `${testid}-${i}${j}`)),
  );

/**
 * Fig. 2: the state feedback, and before it what makes the angles come to rest at their references where no outer loop
 * does.
 * @param {Walk} walk
 */
export function stateFeedback(walk) {
  const before = walk.asked.outer === 'none' && !walk.integral;
  const inverse = walk.G_0 && inverseOf(walk.G_0);
  const K = clean(walk.K);
  const said = K
    ? K.map(
        (/** @type {number[]} */ row, /** @type {number} */ i) =>
          `row ${'V_p V_y'.split(' ')[i]}: ${row.map((v) => figure(v, 4)).join(', ')}`,
      ).join('; ')
    : 'not available';
  return drawing(
    'fig-2-drawing',
    WIDTH,
    216,
    'State feedback',
    `${before ? 'The reference r passes through the inverse of G hat of 0 and becomes the command v. ' : ''}The ` +
      `command v less K x is the input u of the plant x dot equals A x plus B u; C gives the output y. K, ${said}.`,
    ...(before
      ? [
          arrow('0,52 14,52'),
          label(6, 42, 'r'),
          block(14, 18, 74, 68, label(51, 38, 'Ĝ(0)⁻¹'), ...entries(inverse, 48, 58, 37, 3, 'fig-2-before')),
          arrow('88,52 103,52'),
          label(95, 42, 'v'),
        ]
      : [arrow('40,52 103,52'), label(60, 42, 'v')]),
    sum(114, 52),
    arrow('125,52 158,52'),
    label(140, 42, 'u'),
    block(158, 28, 106, 48, label(211, 58, 'ẋ = Ax + Bu')),
    arrow('264,52 306,52'),
    label(275, 42, 'x'),
    node(286, 52),
    block(306, 34, 30, 36, label(321, 58, 'C')),
    arrow('336,52 376,52'),
    label(352, 42, 'y'),
    arrow('286,52 286,114'),
    block(
      136,
      114,
      242,
      92,
      label(150, 133, 'K'),
      ...STATES.map((s, j) => label(194 + 55 * j, 133, s, '', 'tiny')),
      ...MOTORS.map(([b, s], i) => label(149, 160 + 26 * i, b, s, 'tiny')),
      ...(K ?? []).flatMap((/** @type {number[]} */ row, /** @type {number} */ i) =>
        row.map((v, j) => value(207 + 55 * j, 160 + 26 * i, short(v), 'end', `fig-2-K-${i}${j}`)),
      ),
    ),
    arrow('136,160 114,160 114,63'),
    words(127, 80, '−', { kind: 'sign' }),
  );
}

/** @param {'p'|'y'} axis @param {number} y @param {{kp: number, ti: number}} pi */
const controller = (axis, y, { kp, ti }) =>
  block(
    66,
    y - 31,
    78,
    62,
    label(105, y - 13, 'PI', axis),
    value(105, y + 7, `${figure(kp, 4)} V/rad`, 'middle', `fig-3-kp-${axis}`),
    value(105, y + 24, `${figure(ti, 4)} s`, 'middle', `fig-3-ti-${axis}`),
  );

const UP = 76; // of pitch's row
const LOW = 164; // of yaw's
/** Both commands, from one place to another, with their names at `at`. */
const commands = (/** @type {number} */ from, /** @type {number} */ at, to = 242) => [
  arrow(`${from},${UP} ${to},${UP}`),
  arrow(`${from},${LOW} ${to},${LOW}`),
  label(at, UP - 8, 'v', 'p', 'tiny'),
  label(at, LOW - 8, 'v', 'y', 'tiny'),
];
const crossed = (/** @type {number} */ from, /** @type {number} */ to, /** @type {number} */ sign) => [
  arrow(`144,${from} 160,${from} 222,${to} 242,${to}`),
  sign < 0 ? words(154, from + 17, '−', { kind: 'sign' }) : '',
];

/**
 * From the controllers to the inner loop.
 * @param {Walk} walk
 * @param {import('../model/loop_values.js').Two|undefined} mixing
 */
function between({ asked }, mixing) {
  if (asked.decoupler) {
    return [
      arrow(`144,${UP} 154,${UP}`),
      arrow(`144,${LOW} 154,${LOW}`),
      block(154, 48, 70, 144, label(189, 70, 'D'), ...entries(mixing, 186, 116, 34, 2, 'fig-3-D')),
      ...commands(224, 233),
    ];
  }
  if (asked.pairing !== 'cross') return commands(144, 194);
  return [
    ...crossed(UP, LOW, mixing?.[1][0] ?? 1),
    ...crossed(LOW, UP, mixing?.[0][1] ?? 1),
    label(233, UP - 8, 'v', 'p', 'tiny'),
    label(233, LOW - 8, 'v', 'y', 'tiny'),
  ];
}

/** @param {'pitch'|'yaw'} axis @param {boolean} closed */
function row(axis, closed) {
  const y = axis === 'pitch' ? UP : LOW;
  const greek = axis === 'pitch' ? 'θ' : 'ψ';
  const around = axis === 'pitch' ? y - 56 : y + 56;
  return svg(
    'g',
    { class: axis },
    arrow(closed ? `2,${y} 33,${y}` : `2,${y} 66,${y}`),
    label(15, y - 9, greek, 'ref', 'tiny'),
    arrow(`322,${y} 378,${y}`),
    label(366, y - 9, greek),
    ...(closed
      ? [
          sum(44, y),
          arrow(`55,${y} 66,${y}`),
          node(346, y),
          arrow(`346,${y} 346,${around} 44,${around} 44,${axis === 'pitch' ? y - 11 : y + 11}`),
          words(axis === 'pitch' ? 55 : 55, axis === 'pitch' ? y - 14 : y + 24, '−', { kind: 'sign' }),
        ]
      : []),
  );
}

const inner = (/** @type {number|undefined} */ lambda) =>
  block(
    242,
    48,
    80,
    144,
    words(282, 72, 'inner loop'),
    words(282, 89, '(Fig. 2)', { kind: 'muted' }),
    label(282, 126, 'Ĝ(s)'),
    ...(lambda === undefined
      ? []
      : [label(282, 158, 'λ', '11', 'tiny'), value(282, 178, figure(lambda, 5), 'middle', 'fig-3-lambda')]),
  );

/**
 * Fig. 3 but for what stands between the errors and the inner loop.
 * @param {Walk} walk
 * @param {string} title
 * @param {string} description
 * @param {boolean} closed
 * @param {(Node|string)[]} between
 */
function loops(walk, title, description, closed, ...between) {
  const lambda = walk.rga?.[0][0];
  const tail = lambda === undefined ? '' : ` The relative gain lambda 11 is ${figure(lambda, 5)}.`;
  return drawing(
    'fig-3-drawing',
    WIDTH,
    240,
    title,
    description + tail,
    row('pitch', closed),
    row('yaw', closed),
    ...between,
    inner(lambda),
  );
}

/** Fig. 3, with what is paired with what; without outer loops, what takes their place. @param {Walk} walk */
export function outerLoops(walk) {
  const { asked } = walk;
  if (walk.integral) {
    return loops(
      walk,
      'The method’s own integral action',
      `The errors of theta and psi are integrated and weighted by the method's own matrix of gains, rows ` +
        `${walk.integral.map((/** @type {number[]} */ r) => r.map((v) => figure(v, 4)).join(', ')).join('; ')}; ` +
        'the result enters the inner loop.',
      true,
      block(
        66,
        48,
        130,
        144,
        label(131, 72, 'K', 'I'),
        words(131, 94, 'integral action', { kind: 'muted' }),
        ...entries(walk.integral, 126, 128, 62, 4, 'fig-3-integral'),
      ),
      ...commands(196, 219),
    );
  }
  if (asked.outer === 'none') {
    return loops(
      walk,
      'No outer loops',
      'Without outer loops the references pass through the inverse of G hat of 0 and enter the inner loop; nothing ' +
        'is fed back but the state.',
      false,
      block(
        66,
        48,
        110,
        144,
        label(121, 76, 'Ĝ(0)⁻¹'),
        ...entries(walk.G_0 && inverseOf(walk.G_0), 118, 116, 50, 4, 'fig-3-before'),
      ),
      ...commands(176, 209),
    );
  }
  const mixing = mixingOf(walk.G_0, asked.pairing, asked.decoupler);
  const { pitch, yaw } = asked.loops;
  const paired = asked.decoupler
    ? 'The static decoupler D makes the commands v p and v y of both.'
    : asked.pairing === 'cross'
      ? 'Crosswise: pitch’s output is the command v y, yaw’s is v p.'
      : 'Pitch’s output is the command v p, yaw’s is v y.';
  return loops(
    walk,
    'PI control of the whole loop',
    `The errors of theta and psi each drive a PI controller: pitch ${figure(pitch.kp)} volts per radian and ` +
      `${figure(pitch.ti)} seconds, yaw ${figure(yaw.kp)} and ${figure(yaw.ti)}. ${paired} The angles are fed back ` +
      'to their references with a minus sign.',
    true,
    controller('p', UP, pitch),
    controller('y', LOW, yaw),
    ...between(walk, mixing),
  );
}
