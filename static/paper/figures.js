/** The paper's Fig. 1 as a line drawing: the rig from its side and from above. */
import { h, svg } from '../ui/index.js';
import { arrow, dimension, drawing, math, through, wire, words } from './drawing.js';

const TILT = (16 * Math.PI) / 180;
const TURN = (24 * Math.PI) / 180;

/**
 * A point on the body: so far along it and so far above it.
 * @param {number[]} pivot
 * @param {number} angle counterclockwise
 * @returns {(along: number, above?: number) => number[]}
 */
const frame =
  ([x, y], angle) =>
  (along, above = 0) => [
    Math.round(10 * (x + along * Math.cos(angle) - above * Math.sin(angle))) / 10,
    Math.round(10 * (y - along * Math.sin(angle) - above * Math.cos(angle))) / 10,
  ];

function sideView() {
  const pivot = [186, 186];
  const at = frame(pivot, TILT);
  const [nose, tail, centre] = [at(146), at(-118), at(84)];
  const turned = (/** @type {number[]} */ [x, y]) => `rotate(${(-TILT * 180) / Math.PI} ${x} ${y})`;
  return drawing(
    'fig-1-side',
    384,
    276,
    'The helicopter from its side',
    'A body on a post, nose to the right and up by the pitch angle theta from the horizontal. The pitch propeller ' +
      'at the nose, at distance r p from the pivot, pushes with F p at right angles to the body. The yaw propeller ' +
      'at the tail, at distance r y, pushes with F y into the page. Gravity m g acts at the centre of mass, at ' +
      'distance l ahead of the pivot. The yaw angle psi turns about the vertical axis.',
    svg(
      'g',
      { transform: 'translate(-10 -18)' },
      svg('path', { class: 'base', d: 'M 186 186 V 276 M 146 276 H 226' }),
      wire('30,186 384,186', 'dashed'),
      wire('186,186 186,44', 'dashed'),
      words(186, 34, 'yaw axis, z', { kind: 'muted' }),
      math(390, 190, 'x', '', { kind: 'muted' }),
      svg('path', { class: 'wire', d: 'M 160 70 A 26 8 0 1 0 212 70' }),
      arrow('163,63 160,70 161,64', 'small'),
      math(228, 80, 'ψ'),
      svg('path', { class: 'wire', d: `M 320 186 A 134 134 0 0 0 ${frame(pivot, TILT)(134).join(' ')}` }),
      arrow(`${at(134, -7)} ${at(134)}`, 'small'),
      math(336, 172, 'θ'),
      wire(`${tail} ${nose}`, 'body'),
      svg('ellipse', { class: 'rotor pitch', cx: nose[0], cy: nose[1], rx: 40, ry: 6, transform: turned(nose) }),
      svg('circle', { class: 'rotor yaw', cx: tail[0], cy: tail[1], r: 25 }),
      through(tail[0], tail[1], false, 'yaw'),
      arrow(`${nose} ${at(146, 76)}`, 'pitch'),
      math(at(146, 76)[0] + 20, at(146, 76)[1] + 8, 'F', 'p', { kind: 'pitch' }),
      math(tail[0] - 38, tail[1] + 6, 'F', 'y', { kind: 'yaw' }),
      arrow(`${centre[0]},${centre[1]} ${centre[0]},${centre[1] + 88}`),
      math(centre[0] + 20, centre[1] + 86, 'mg'),
      svg('circle', { class: 'mass', cx: centre[0], cy: centre[1], r: 6.5 }),
      svg('path', {
        class: 'quarters',
        d: `M ${centre} h 6.5 a 6.5 6.5 0 0 0 -6.5 -6.5 z M ${centre} h -6.5 a 6.5 6.5 0 0 0 6.5 6.5 z`,
      }),
      through(pivot[0], pivot[1], true, ''),
      words(178, 222, 'pitch axis', { kind: 'muted', anchor: 'end' }),
      dimension(at(0, 26), at(84, 26)),
      math(at(50, 34)[0], at(50, 34)[1], 'l'),
      dimension(at(0, 52), at(146, 52)),
      math(at(94, 62)[0], at(94, 62)[1], 'r', 'p'),
      dimension(at(0, 52), at(-118, 52)),
      math(at(-62, 62)[0], at(-62, 62)[1], 'r', 'y'),
    ),
  );
}

function topView() {
  const pivot = [160, 140];
  const at = frame(pivot, -TURN);
  const [nose, tail] = [at(122), at(-92)];
  return drawing(
    'fig-1-top',
    320,
    250,
    'The helicopter from above',
    'The body turned clockwise by the yaw angle psi from the x axis. The yaw propeller at the tail pushes with F y ' +
      'at right angles to the body; the thrust F p of the pitch propeller comes out of the page.',
    wire('40,140 300,140', 'dashed'),
    wire('160,140 160,36', 'dashed'),
    math(308, 144, 'x', '', { kind: 'muted' }),
    math(160, 28, 'y', '', { kind: 'muted' }),
    svg('path', { class: 'wire', d: `M 218 140 A 58 58 0 0 1 ${at(58).join(' ')}` }),
    arrow(`${at(58, 7)} ${at(58)}`, 'small'),
    math(233, 158, 'ψ'),
    wire(`${tail} ${nose}`, 'body'),
    svg('circle', { class: 'rotor pitch', cx: nose[0], cy: nose[1], r: 34 }),
    through(nose[0], nose[1], true, 'pitch'),
    math(nose[0] - 2, nose[1] + 27, 'F', 'p', { kind: 'pitch' }),
    wire(`${at(-92, -30)} ${at(-92, 30)}`, 'rotor yaw edge'),
    arrow(`${tail} ${at(-92, 74)}`, 'yaw'),
    math(at(-92, 74)[0] - 20, at(-92, 74)[1] + 4, 'F', 'y', { kind: 'yaw' }),
    through(pivot[0], pivot[1], true, ''),
    words(150, 172, 'yaw axis', { kind: 'muted', anchor: 'end' }),
  );
}

/** Fig. 1: seen from two sides, since pitch and yaw do not share a plane. */
export const freeBody = () =>
  h(
    'div',
    { class: 'views' },
    h('figure', {}, sideView(), h('figcaption', {}, 'From its side, not to scale')),
    h('figure', {}, topView(), h('figcaption', {}, 'From above')),
  );
