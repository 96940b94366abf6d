/** The paper's Figs. 1 to 3 as line drawings: the rig from its side and from above, the state feedback, the PI loops around it. */
import { h, svg } from './dom.js';
import { arrow, box, dimension, drawing, math, node, sum, through, wire, words } from './paper_drawing.js';

const TILT = (16 * Math.PI) / 180;
const TURN = (24 * Math.PI) / 180;

/** A point on the body: so far along it and so far above it. @param {number[]} pivot @param {number} angle counterclockwise @returns {(along: number, above?: number) => number[]} */
const frame = ([x, y], angle) => (along, above = 0) => [
  Math.round(10 * (x + along * Math.cos(angle) - above * Math.sin(angle))) / 10, Math.round(10 * (y - along * Math.sin(angle) - above * Math.cos(angle))) / 10];

function sideView() {
  const pivot = [186, 186];
  const at = frame(pivot, TILT);
  const [nose, tail, centre] = [at(146), at(-118), at(84)];
  const turned = (/** @type {number[]} */ [x, y]) => `rotate(${(-TILT * 180) / Math.PI} ${x} ${y})`;
  return drawing('fig-1-side', 384, 276, 'The helicopter from its side',
    'A body on a post, nose to the right and up by the pitch angle theta from the horizontal. The pitch propeller at the nose, at distance r p from the pivot, pushes with F p at right angles to the body. The yaw propeller at the tail, at distance r y, pushes with F y into the page. Gravity m g acts at the centre of mass, at distance l ahead of the pivot. The yaw angle psi turns about the vertical axis.',
    svg('g', { transform: 'translate(-10 -18)' }, svg('path', { class: 'base', d: 'M 186 186 V 276 M 146 276 H 226' }),
    wire('30,186 384,186', 'dashed'), wire('186,186 186,44', 'dashed'),
    words(186, 34, 'yaw axis, z', { kind: 'muted' }), math(390, 190, 'x', '', { kind: 'muted' }),
    svg('path', { class: 'wire', d: 'M 160 70 A 26 8 0 1 0 212 70' }), arrow('163,63 160,70 161,64', 'small'), math(228, 80, 'ψ'),
    svg('path', { class: 'wire', d: `M 320 186 A 134 134 0 0 0 ${frame(pivot, TILT)(134).join(' ')}` }), arrow(`${at(134, -7)} ${at(134)}`, 'small'), math(336, 172, 'θ'),
    wire(`${tail} ${nose}`, 'body'),
    svg('ellipse', { class: 'rotor pitch', cx: nose[0], cy: nose[1], rx: 40, ry: 6, transform: turned(nose) }),
    svg('circle', { class: 'rotor yaw', cx: tail[0], cy: tail[1], r: 25 }), through(tail[0], tail[1], false, 'yaw'),
    arrow(`${nose} ${at(146, 76)}`, 'pitch'), math(at(146, 76)[0] + 20, at(146, 76)[1] + 8, 'F', 'p', { kind: 'pitch' }),
    math(tail[0] - 38, tail[1] + 6, 'F', 'y', { kind: 'yaw' }),
    arrow(`${centre[0]},${centre[1]} ${centre[0]},${centre[1] + 88}`), math(centre[0] + 20, centre[1] + 86, 'mg'),
    svg('circle', { class: 'mass', cx: centre[0], cy: centre[1], r: 6.5 }), svg('path', { class: 'quarters', d: `M ${centre} h 6.5 a 6.5 6.5 0 0 0 -6.5 -6.5 z M ${centre} h -6.5 a 6.5 6.5 0 0 0 6.5 6.5 z` }),
    through(pivot[0], pivot[1], true, ''), words(178, 222, 'pitch axis', { kind: 'muted', anchor: 'end' }),
    dimension(at(0, 26), at(84, 26)), math(at(50, 34)[0], at(50, 34)[1], 'l'),
    dimension(at(0, 52), at(146, 52)), math(at(94, 62)[0], at(94, 62)[1], 'r', 'p'),
    dimension(at(0, 52), at(-118, 52)), math(at(-62, 62)[0], at(-62, 62)[1], 'r', 'y')));
}

function topView() {
  const pivot = [160, 140];
  const at = frame(pivot, -TURN);
  const [nose, tail] = [at(122), at(-92)];
  return drawing('fig-1-top', 320, 250, 'The helicopter from above',
    'The body turned clockwise by the yaw angle psi from the x axis. The yaw propeller at the tail pushes with F y at right angles to the body; the thrust F p of the pitch propeller comes out of the page.',
    wire('40,140 300,140', 'dashed'), wire('160,140 160,36', 'dashed'), math(308, 144, 'x', '', { kind: 'muted' }), math(160, 28, 'y', '', { kind: 'muted' }),
    svg('path', { class: 'wire', d: `M 218 140 A 58 58 0 0 1 ${at(58).join(' ')}` }), arrow(`${at(58, 7)} ${at(58)}`, 'small'), math(233, 158, 'ψ'),
    wire(`${tail} ${nose}`, 'body'),
    svg('circle', { class: 'rotor pitch', cx: nose[0], cy: nose[1], r: 34 }), through(nose[0], nose[1], true, 'pitch'), math(nose[0] - 2, nose[1] + 27, 'F', 'p', { kind: 'pitch' }),
    wire(`${at(-92, -30)} ${at(-92, 30)}`, 'rotor yaw edge'),
    arrow(`${tail} ${at(-92, 74)}`, 'yaw'), math(at(-92, 74)[0] - 20, at(-92, 74)[1] + 4, 'F', 'y', { kind: 'yaw' }),
    through(pivot[0], pivot[1], true, ''), words(150, 172, 'yaw axis', { kind: 'muted', anchor: 'end' }));
}

/** Fig. 1: seen from two sides, since pitch and yaw do not share a plane. */
export const freeBody = () => h('div', { class: 'views' },
  h('figure', {}, sideView(), h('figcaption', {}, 'From its side, not to scale')), h('figure', {}, topView(), h('figcaption', {}, 'From above')));

/** Fig. 2, with the sign that is right. */
export const stateFeedback = () => drawing('fig-2-drawing', 430, 176, 'State feedback', 'The auxiliary input v and minus K x are added to the input u of the plant x dot equals A x plus B u; C gives the output y. K feeds the state x back with a minus sign.',
  arrow('14,56 67,56'), math(26, 46, 'v'), sum(78, 56), arrow('89,56 140,56'), math(112, 46, 'u'),
  box(140, 32, 130, 48, ['ẋ = Ax + Bu']), arrow('270,56 338,56'), math(296, 46, 'x'), node(306, 56), box(338, 36, 40, 40, ['C']), arrow('378,56 424,56'), math(402, 46, 'y'),
  arrow('306,56 306,138 228,138'), box(188, 118, 40, 40, ['K']), arrow('188,138 78,138 78,67'), words(92, 84, '−', { kind: 'sign' }));

/** Fig. 3. */
export const piLoops = () => drawing('fig-3-drawing', 500, 268, 'PI control of the whole loop', 'The errors of theta and of psi, reference less angle, each drive a PI controller, whose outputs v p and v y enter the state feedback of Fig. 2; the angles theta and psi are fed back to their references with a minus sign.',
  svg('rect', { class: 'frame', x: 194, y: 50, width: 218, height: 172, rx: 8 }), words(303, 215, 'the loop of Fig. 2', { kind: 'muted' }),
  svg('g', { class: 'pitch' }, arrow('6,84 45,84'), math(20, 74, 'θ', 'ref'), sum(56, 84), arrow('67,84 106,84'), math(85, 74, 'e', 'θ'), box(106, 64, 46, 40, ['PI_p']), arrow('152,84 216,84'), math(174, 74, 'v', 'p'),
    arrow('376,84 492,84'), math(472, 74, 'θ'), node(440, 84), arrow('440,84 440,22 56,22 56,73'), words(70, 62, '−', { kind: 'sign' })),
  svg('g', { class: 'yaw' }, arrow('6,144 45,144'), math(20, 134, 'ψ', 'ref'), sum(56, 144), arrow('67,144 106,144'), math(85, 134, 'e', 'ψ'), box(106, 124, 46, 40, ['PI_y']), arrow('152,144 216,144'), math(174, 134, 'v', 'y'),
    arrow('376,144 492,144'), math(472, 134, 'ψ'), node(440, 144), arrow('440,144 440,246 56,246 56,155'), words(70, 178, '−', { kind: 'sign' })),
  svg('g', { class: 'sum' }, svg('rect', { x: 216, y: 66, width: 18, height: 96, rx: 9 }), svg('path', { d: 'M 220 114 h 10 M 225 109 v 10' })),
  arrow('234,114 262,114'), math(247, 104, 'u'), box(262, 66, 114, 96, ['ẋ = Ax + Bu', 'y = Cx']), arrow('319,162 319,186 294,186', 'thin'), math(330, 180, 'x'), box(262, 170, 32, 30, ['K']), arrow('262,186 225,186 225,162', 'thin'), words(236, 180, '−', { kind: 'sign' }));
