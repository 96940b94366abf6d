/**
 * How the rig stands, in two dials: from the side pitch with its stops, from above yaw as on a compass; on both the set
 * point as a bug at the rim, what a task asks as a stroke, and, where it is another, what is measured. Of a rig that is
 * bolted to its place this tells more than an artificial horizon: nobody banks.
 */
import { ROW } from '../kernel/index.js';
import { DEGREE, degrees, fixed, say } from '../text/index.js';
import { h, setAttr, setText, svg } from '../ui/index.js';

const { FLIGHT_ROW, STATE, SENSED, WISH } = ROW;
/** Radius of a dial's rim, of its ticks' inner ends, long and short, and how far the bug stands out. */
const [RIM, LONG, SHORT] = [44, 37, 40];
/** What is measured is drawn where it is so far from what is, rad. */
const APART = 0.02;
/** How far pitch is drawn to either side of level, °. */
const SIDE = 90;
/** Where pitch is written: above the tail, and below it. */
const [ABOVE, BELOW] = [-14, 24];
const TOLD = 1000; // ms

/**
 * A point on a dial's circle.
 * @param {number} angle  °, from the right, against the clock @param {number} radius
 */
const point = (angle, radius) => {
  const at = angle / DEGREE;
  return `${(radius * Math.cos(at)).toFixed(2)} ${(-radius * Math.sin(at)).toFixed(2)}`;
};

/** Ticks as a path. @param {number[]} angles  ° @param {number} inner */
const ticks = (angles, inner) => angles.map((angle) => `M${point(angle, inner)}L${point(angle, RIM)}`).join('');

/** The rim between two angles. @param {number} from  ° @param {number} to  ° @param {number} radius */
export function arc(from, to, radius) {
  const [large, way] = [Math.abs(to - from) > 180 ? 1 : 0, to > from ? 0 : 1];
  return `M${point(from, radius)}A${radius} ${radius} 0 ${large} ${way} ${point(to, radius)}`;
}

/** Turns counted from the start, where there is more than one: "+2". @param {number} psi  rad */
export function turnsOf(psi) {
  const turns = Math.round(psi / (2 * Math.PI));
  return turns === 0 ? '' : `${turns > 0 ? '+' : ''}${fixed(turns, 0)}`;
}

/** The same direction in −180 … 180°. @param {number} psi  rad */
export const headingOf = (psi) => psi - 2 * Math.PI * Math.round(psi / (2 * Math.PI));

const every = (/** @type {number} */ step, /** @type {number} */ from, /** @type {number} */ to) =>
  Array.from({ length: Math.round((to - from) / step) + 1 }, (_, i) => from + i * step);

export class Horizon {
  #row = new Float64Array(FLIGHT_ROW);
  #changed = false;
  /** @type {readonly [number, number]|null} */ #asks = null;
  #lastTold = -Infinity;
  #travel = -1;
  #pitch = dial('pitch', 'Pitch, from the side', pitchFace(), pitchBody());
  #yaw = dial('yaw', 'Yaw, from above', yawFace(), yawBody());
  #stops = svg('path', { class: 'dial-stop' });
  node = h('div', { class: 'horizon', 'data-testid': 'fly-horizon' }, this.#pitch.node, this.#yaw.node);

  constructor() {
    this.#pitch.face.append(this.#stops);
    this.travel = Infinity;
  }

  /** Where pitch stops to either side of level, rad; Infinity: nowhere. @param {number} travel */
  set travel(travel) {
    if (travel === this.#travel) return;
    this.#travel = travel;
    const at = travel * DEGREE;
    const shown = at < SIDE;
    setAttr(this.#stops, 'd', shown ? `${arc(at, SIDE, RIM)}${arc(-at, -SIDE, RIM)}${ticks([at, -at], LONG - 5)}` : '');
  }

  /** Ticks that were flown: the last one is shown. @param {Float64Array} rows @param {number} count */
  put(rows, count) {
    if (count) this.look(rows, (count - 1) * FLIGHT_ROW);
  }

  /** Shows a moment. @param {Float64Array} rows @param {number} at  where its row begins */
  look(rows, at) {
    for (let i = 0; i < FLIGHT_ROW; i++) this.#row[i] = rows[at + i];
    this.#changed = true;
  }

  /** What a task asks, θ and ψ, rad; null: nothing. @param {readonly [number, number]|null} asks */
  asked(asks) {
    this.#changed ||= asks !== this.#asks;
    this.#asks = asks;
  }

  /**
   * How it stands before it flies.
   * @param {number} theta @param {number} psi  rad @param {{theta: number, psi: number}} wish
   */
  rest(theta, psi, wish) {
    const row = this.#row;
    row.fill(0);
    [row[STATE], row[STATE + 1], row[SENSED], row[SENSED + 1]] = [theta, psi, theta, psi];
    [row[WISH], row[WISH + 1]] = [wish.theta, wish.psi];
    this.#changed = true;
  }

  /** Once per animation frame. @param {number} now  ms */
  render(now) {
    if (!this.#changed) return;
    this.#changed = false;
    const row = this.#row;
    const told = now - this.#lastTold >= TOLD;
    if (told) this.#lastTold = now;
    [this.#pitch, this.#yaw].forEach((own, axis) => {
      const [is, seen, wish] = [row[STATE + axis], row[SENSED + axis], row[WISH + axis]];
      // against the clock from the side, with it from above
      turned(own.body, axis ? is : -is);
      turned(own.bug, axis ? wish : -Math.min(Math.max(wish, -Math.PI / 2), Math.PI / 2));
      setAttr(own.asked, 'visibility', this.#asks ? 'visible' : 'hidden');
      if (this.#asks) turned(own.asked, this.#asks[axis] * (axis ? 1 : -1));
      const apart = Math.abs(seen - is) > APART;
      setAttr(own.seen, 'visibility', apart ? 'visible' : 'hidden');
      if (apart) turned(own.seen, axis ? seen : -seen);
      setText(own.value, degrees(axis ? headingOf(is) : is, 0));
      if (!axis) setAttr(own.value, 'y', is < -APART ? BELOW : ABOVE); // where the tail is not
      if (told)
        setAttr(
          own.node,
          'aria-label',
          axis
            ? say`Yaw ${degrees(is, 0)}, set point ${degrees(wish, 0)}`
            : say`Pitch ${degrees(is, 0)}, set point ${degrees(wish, 0)}`,
        );
    });
    setText(this.#yaw.more, turnsOf(row[STATE + 1]));
  }
}

/** @param {Element} node @param {number} angle  rad, with the clock */
const turned = (node, angle) => setAttr(node, 'transform', `rotate(${(angle * DEGREE).toFixed(1)})`);

/**
 * @param {string} kind @param {string} label @param {Element[]} face @param {Element[]} body
 */
function dial(kind, label, face, body) {
  const shown = svg('g', { class: 'dial-face' }, ...face);
  const seen = svg(
    'g',
    { class: 'dial-seen', visibility: 'hidden' },
    svg('path', { d: kind === 'pitch' ? 'M-30 0H36' : 'M0 24V-36' }),
  );
  const moving = svg('g', { class: 'dial-body' }, ...body);
  const bug = svg(
    'g',
    { class: 'dial-bug' },
    svg('path', { d: kind === 'pitch' ? 'M44 0L53 -5V5Z' : 'M0 -44L-5 -53H5Z' }),
  );
  const asked = svg(
    'g',
    { class: 'dial-asked', visibility: 'hidden' },
    svg('path', { d: kind === 'pitch' ? 'M52 0H30' : 'M0 -52V-30' }),
  );
  const value = svg('text', {
    class: 'dial-value',
    x: kind === 'pitch' ? -26 : 0,
    y: kind === 'pitch' ? ABOVE : 22,
    translate: 'no',
  });
  const more = svg('text', { class: 'dial-more', x: 0, y: 33, translate: 'no' });
  const node = svg(
    'svg',
    { class: `dial ${kind}`, viewBox: '-56 -56 112 112', role: 'img', 'aria-label': label },
    shown,
    seen,
    asked,
    moving,
    bug,
    value,
    more,
  );
  return { node, face: shown, body: moving, seen, asked, bug, value, more };
}

/** Degrees to either side of level, a stand below. */
function pitchFace() {
  return [
    svg('path', { class: 'dial-rim', d: arc(-SIDE, SIDE, RIM) }),
    svg('path', { class: 'dial-ticks', d: ticks(every(10, -SIDE, SIDE), SHORT) + ticks(every(30, -SIDE, SIDE), LONG) }),
    svg('path', { class: 'dial-level', d: 'M-44 0H44' }),
    svg('path', { class: 'dial-stand', d: 'M-2.5 3L-4 44H4L2.5 3Z' }),
  ];
}

/** The rig from the side, nose at the right: its beam, the pitch rotor in its ring, the yaw rotor's ring on edge. */
function pitchBody() {
  return [
    svg('path', { class: 'dial-beam', d: 'M-30 0H30' }),
    svg('path', { class: 'dial-ring', d: 'M18 -2.5H38' }),
    svg('circle', { class: 'dial-ring', cx: -32, cy: 0, r: 8 }),
    svg('circle', { class: 'dial-hub', r: 3 }),
  ];
}

/** All around, 0° at the top. */
function yawFace() {
  return [
    svg('circle', { class: 'dial-rim', r: RIM }),
    svg('path', { class: 'dial-ticks', d: ticks(every(10, 0, 350), SHORT) + ticks(every(30, 0, 330), LONG) }),
    svg('path', { class: 'dial-level', d: 'M0 -44V-37' }),
  ];
}

/** The rig from above, nose at the top. */
function yawBody() {
  return [
    svg('path', { class: 'dial-beam', d: 'M0 26V-20' }),
    svg('circle', { class: 'dial-ring', cx: 0, cy: -24, r: 9 }),
    svg('path', { class: 'dial-ring', d: 'M2.5 20V34' }),
    svg('circle', { class: 'dial-hub', r: 3 }),
  ];
}
