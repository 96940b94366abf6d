/**
 * What a strip chart's lanes show now, in numbers: their key as well. Written ten times a second at most.
 * @typedef {import('./lanes.js').Lane} Lane
 */
import { ROW } from '../kernel/index.js';
import { DEGREE, fixed, say } from '../text/index.js';
import { h, setText, symbol } from '../ui/index.js';
import { LANE } from './lanes.js';

const { FLIGHT_ROW, STATE, VOLTAGE, UNLIMITED, WISH, OUTSIDE } = ROW;
/** Where a lane's values stand in a row, and beside them set points, or voltages as asked. */
const AT = { angles: STATE, volts: VOLTAGE, rates: STATE + 2, torques: OUTSIDE };
const BESIDE = { angles: WISH, volts: UNLIMITED, rates: -1, torques: -1 };
const KINDS = ['pitch', 'yaw'];

export class StripValues {
  node = h('div', { class: 'strip-values' });
  #last = new Float64Array(FLIGHT_ROW);
  #some = false; // has been flown
  #limits = [Infinity, Infinity];
  #lanes = /** @type {(keyof typeof LANE)[]} */ (Object.keys(LANE)).map((name) => ({ name, ...made(LANE[name]) }));

  constructor() {
    this.node.append(...this.#lanes.map(({ node }) => node));
  }

  /** @param {readonly import('./lanes.js').Place[]} places @param {number} top  px, of the first lane's place */
  place(places, top) {
    this.#lanes.forEach(({ node }, i) => {
      node.hidden = i >= places.length;
      if (!node.hidden) node.style.top = `${top + places[i].top}px`;
    });
  }

  clear() {
    this.#some = false;
  }

  /**
   * Ticks that were flown.
   * @param {Float64Array} rows @param {number} count @param {readonly [number, number]} limits
   */
  take(rows, count, limits) {
    for (let i = 0, at = (count - 1) * FLIGHT_ROW; i < FLIGHT_ROW; i++) this.#last[i] = rows[at + i];
    [this.#some, this.#limits[0], this.#limits[1]] = [true, ...limits];
  }

  render() {
    for (const { name, node, values, besides } of this.#lanes) {
      if (node.hidden) continue;
      const lane = LANE[name];
      for (let axis = 0; axis < 2; axis++) {
        setText(values[axis], this.#some ? read(lane, this.#last[AT[name] + axis]) : '');
        if (BESIDE[name] >= 0) setText(besides[axis], this.#some ? this.#beside(name, axis) : '');
      }
    }
  }

  /** @param {'angles'|'volts'|'rates'|'torques'} name @param {number} axis */
  #beside(name, axis) {
    const value = this.#last[BESIDE[name] + axis];
    if (name === 'angles') return `→ ${read(LANE.angles, value)}`;
    return Math.abs(value) > this.#limits[axis] ? say`asked ${read(LANE.volts, value)}` : '';
  }

  /** The same for those who hear it. */
  words() {
    if (!this.#some) return '';
    const [theta, psi, pitch, yaw] = [STATE, STATE + 1, WISH, WISH + 1].map((at) =>
      whole(DEGREE * this.#last[at], '°'),
    );
    const volts = [0, 1].map((axis) => read(LANE.volts, this.#last[VOLTAGE + axis]));
    return say`Pitch ${theta}, set point ${pitch}; yaw ${psi}, set point ${yaw}; motors ${volts[0]} and ${volts[1]}.`;
  }
}

/** @param {number} value @param {string} unit */
const whole = (value, unit) => `${fixed(value, 0)}${unit}`;

/** @param {Lane} lane @param {number} value  in the row's unit */
const read = ({ factor, decimals, unit }, value) =>
  `${fixed(value * factor, decimals)}${unit === '°' ? '' : '\u00a0'}${unit}`;

/** @param {Lane} lane */
function made({ name, symbols }) {
  const values = KINDS.map(() => h('b', { translate: 'no' }));
  const besides = KINDS.map((_, axis) =>
    h('span', { class: name === 'volts' ? 'strip-asked' : `strip-wish ${KINDS[axis]}` }),
  );
  const node = h(
    'div',
    { class: `strip-value ${name}` },
    KINDS.map((kind, axis) =>
      h(
        'span',
        { class: 'key' },
        h('span', { class: `line ${kind}`, 'aria-hidden': 'true' }),
        symbol(symbols[axis][0], symbols[axis][1] || undefined),
        values[axis],
        besides[axis],
      ),
    ),
  );
  return { node, values, besides };
}
