/** The bar under the scene while one flies: freeze, step, slow motion, back in time, again, end. */
import { count, fixed, percent, say, t } from '../text/index.js';
import { button, h, setAttr, setText } from '../ui/index.js';
import { ROW } from '../kernel/index.js';

/** @typedef {import('./flight.js').Flight} Flight */
/** @typedef {import('./course.js').Rows} Rows */

/** Seconds of flight in one of the wall's. */
export const SPEEDS = [1, 0.5, 0.25, 0.1];
const SPEED_TEXT = ['1×', '½×', '¼×', '⅒×'];
/** Seconds that can be taken back. */
const BACK = 60;
/** By the button, and by a key, s. */
export const LEAP = 5;
const { FLIGHT_ROW } = ROW;

export class FlightBar {
  /** What can be gone back to, while the hand looks for it. @type {Rows|null} */ #past = null;

  /**
   * @param {Flight} flight
   * @param {object} how
   * @param {() => void} how.again
   * @param {(rows: Float64Array, at: number, time: number) => void} how.look  shows a moment of the past, the row at
   *   this index
   */
  constructor(flight, { again, look }) {
    this.flight = flight;
    this.look = look;
    const tool = (
      /** @type {string} */ id,
      /** @type {string} */ text,
      /** @type {string} */ title,
      /** @type {() => void} */ act,
      /** @type {string} */ kind = '',
    ) => button({ class: kind || undefined, 'data-testid': `fly-${id}`, title, onclick: act }, text);
    this.hold = tool('freeze', 'Freeze', 'Time stands still, and goes on (Space)', () => flight.toggle(), 'play');
    this.one = tool('step', 'Step', 'One sample of the controller (.)', () => flight.step());
    this.back = tool('back', '−5 s', 'Back by five seconds; what came after has not happened (Backspace)', () =>
      flight.rewind(LEAP),
    );
    this.past = h('input', {
      type: 'range',
      min: -BACK,
      max: 0,
      step: 0.1,
      value: 0,
      'aria-label': 'Back to a moment of the last minute',
      title: 'Look back over the last minute; let go to fly on from there',
      'data-testid': 'fly-past',
      oninput: () => this.#seek(),
      onchange: () => this.looks && this.#go(),
    });
    this.speed = h(
      'select',
      {
        'aria-label': 'Speed of time',
        title: 'Slow motion (,)',
        'data-testid': 'fly-speed',
        onchange: () => flight.setSpeed(Number(this.speed.value)),
      },
      SPEEDS.map((speed, i) => h('option', { value: speed, translate: 'no' }, SPEED_TEXT[i])),
    );
    this.clock = h('output', { class: 'clock', 'data-testid': 'fly-time' });
    this.slow = h('span', {
      class: 'slow',
      hidden: true,
      title: 'This machine does not keep up: time passes more slowly, and nothing is left out',
      'data-testid': 'fly-slow',
    });
    this.again = tool('again', 'Again', 'From the start again (R)', again);
    this.end = tool('end', 'End', 'End this flight (X)', () => flight.end(t('You have ended it.')));
    this.told = h('span', { class: 'sr', role: 'status', 'data-testid': 'fly-status' });
    this.node = h(
      'div',
      { class: 'fly-bar', role: 'group', 'aria-label': 'Time of the flight' },
      this.hold,
      this.one,
      this.back,
      this.past,
      this.clock,
      this.slow,
      this.speed,
      this.again,
      this.end,
      this.told,
    );
  }

  /** Whether the past is looked at. */
  get looks() {
    return this.#past !== null;
  }

  #seek() {
    this.flight.freeze();
    this.#past ??= this.flight.lastRows(BACK);
    const { times, count: rows } = this.#past;
    if (!rows) return;
    const wanted = this.flight.state.time + Number(this.past.value);
    const found = times.findIndex((time) => time >= wanted);
    const at = found < 0 ? rows - 1 : found;
    setText(this.clock, `${fixed(times[at], 1)} s`);
    setAttr(this.past, 'aria-valuetext', say`at ${fixed(times[at], 1)} seconds`);
    this.look(this.#past.rows, at * FLIGHT_ROW, times[at]);
  }

  #go() {
    const back = -Number(this.past.value);
    this.#leave();
    if (back > 0) this.flight.rewind(back);
  }

  #leave() {
    this.#past = null;
    this.past.value = '0';
  }

  /** After a change of the flight's state. */
  render() {
    const { mode, speed, slow, why, time, replay, past } = this.flight.state;
    if (mode === 'flying' || mode === 'replaying') this.#leave(); // whoever let it go on looks no more
    const on = mode === 'flying' || mode === 'frozen' || mode === 'replaying';
    setText(this.hold, mode === 'frozen' ? 'Go on' : 'Freeze');
    for (const node of [this.hold, this.one, this.speed, this.end]) node.disabled = !on;
    this.again.disabled = mode === 'idle';
    this.back.disabled = this.past.disabled = !past;
    this.speed.value = String(SPEEDS.find((own) => Math.abs(own - speed) < 1e-9) ?? 1);
    this.slow.hidden = !(on && slow < 0.95);
    setText(this.slow, say`time slowed to ${percent(slow)}`);
    setText(this.told, this.#words(mode, time, why, replay));
    this.tick();
  }

  /** @param {import('./flight.js').Mode} mode @param {number} time @param {string} why @param {boolean} replay */
  #words(mode, time, why, replay) {
    if (mode === 'flying') return t('Flying.');
    if (mode === 'replaying') return t('Replaying.');
    if (mode === 'frozen') return say`Frozen at ${fixed(time, 1)} seconds.`;
    if (mode !== 'ended') return '';
    const long = count(Math.round(time), '{0} second', '{0} seconds');
    return replay ? say`The replay has ended after ${long}. ${why}` : say`The flight has ended after ${long}. ${why}`;
  }

  /** In each frame. */
  tick() {
    if (this.#past) return;
    const { time } = this.flight.state;
    setText(this.clock, `${fixed(time, 1)} s`);
    setAttr(this.past, 'aria-valuetext', say`now, ${fixed(time, 0)} seconds`);
  }
}
