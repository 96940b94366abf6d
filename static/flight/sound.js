/**
 * The rotors to be heard: two tones, pitch's at the left, whose heights follow the rotors' speeds. Silent until it is
 * asked for, while time stands still, and in a page that is not seen.
 */
import { ROW } from '../kernel/index.js';
import { button, setAttr } from '../ui/index.js';

const { FLIGHT_ROW, SPEED } = ROW;
/** Of both rotors: tone at rest, Hz; its rise with each volt that holds the speed; where it is heard, −1 … 1. */
export const ROTORS = [
  { rest: 46, rise: 5.2, side: -0.5 },
  { rest: 92, rise: 11, side: 0.5 },
];
const LOUDEST = 0.16;
/** Speed at which a rotor is at its loudest, V. */
const FULL = 24;
/** How fast tones follow, and fall silent, s. */
const [FOLLOWS, FADES] = [0.03, 0.12];
/** When nothing is left of what has faded, ms. */
const FADED = 8000 * FADES;
/** Frequency above which a rotor's tone has no parts, in its tones. */
const DULL = 6;
/** So long nothing comes before it falls silent, ms. */
const PATIENCE = 250;

/** Tone of a rotor at a speed. @param {number} rotor 0 or 1 @param {number} speed  V @returns {number} Hz */
export const toneOf = (rotor, speed) => ROTORS[rotor].rest + ROTORS[rotor].rise * Math.abs(speed);

/** How loud it is. @param {number} speed  V @returns {number} 0 … 1 */
export function loudnessOf(speed) {
  const share = Math.min(Math.abs(speed) / FULL, 1);
  return LOUDEST * share * (2 - share); // soon heard, late loud
}

/** @typedef {{tone: OscillatorNode, filter: BiquadFilterNode, loud: GainNode}} Voice */

export class Sound {
  /** @type {AudioContext|null} */ #context = null;
  /** @type {Voice[]} */ #voices = [];
  #on = false;
  #speeds = [0, 0];
  #last = -Infinity; // ms
  #quiet = true;
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #timer;

  constructor() {
    this.node = button(
      {
        'aria-pressed': 'false',
        'data-testid': 'fly-sound',
        'aria-label': 'Sound of the rotors',
        title: 'Hear the rotors: their tones rise with their speeds',
        onclick: () => this.toggle(),
        hidden: typeof AudioContext === 'undefined',
      },
      '♪',
    );
    document.addEventListener('visibilitychange', () => document.hidden && this.#stop());
  }

  /** Whether it was asked for. */
  get on() {
    return this.#on;
  }

  toggle() {
    this.#on = !this.#on;
    setAttr(this.node, 'aria-pressed', String(this.#on));
    if (!this.#on) return this.#stop();
    this.#begin();
    this.#wake(); // by a hand, as browsers ask
    if (this.#quiet) this.#sleepSoon();
  }

  #wake() {
    clearTimeout(this.#timer);
    this.#context?.resume().catch(() => {});
  }

  /** The context sleeps while nothing is to be heard. */
  #sleepSoon() {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#context?.suspend().catch(() => {}), FADED);
  }

  #stop() {
    this.hush();
    clearTimeout(this.#timer);
    this.#context?.suspend().catch(() => {});
  }

  #begin() {
    if (this.#context) return;
    const context = (this.#context = new AudioContext());
    this.#voices = ROTORS.map(({ side, rest }) => {
      const tone = new OscillatorNode(context, { type: 'sawtooth', frequency: rest });
      const filter = new BiquadFilterNode(context, { type: 'lowpass', frequency: DULL * rest });
      const loud = new GainNode(context, { gain: 0 });
      tone
        .connect(filter)
        .connect(loud)
        .connect(new StereoPannerNode(context, { pan: side }))
        .connect(context.destination);
      tone.start();
      return { tone, filter, loud };
    });
  }

  /** Ticks that were flown. @param {Float64Array} rows @param {number} count @param {number} now  ms */
  put(rows, count, now) {
    if (!this.#on || !count) return;
    const at = (count - 1) * FLIGHT_ROW + SPEED;
    [this.#speeds[0], this.#speeds[1], this.#last] = [rows[at], rows[at + 1], now];
  }

  /** Once per animation frame. @param {number} now  ms */
  render(now) {
    const context = this.#context;
    if (!context || !this.#on) return;
    if (now - this.#last > PATIENCE) return this.hush();
    if (this.#quiet) this.#wake();
    this.#quiet = false;
    this.#voices.forEach(({ tone, filter, loud }, i) => {
      const speed = Number.isFinite(this.#speeds[i]) ? this.#speeds[i] : 0;
      const hertz = toneOf(i, Math.min(Math.abs(speed), 10 * FULL));
      tone.frequency.setTargetAtTime(hertz, context.currentTime, FOLLOWS);
      filter.frequency.setTargetAtTime(DULL * hertz, context.currentTime, FOLLOWS);
      loud.gain.setTargetAtTime(loudnessOf(speed), context.currentTime, FOLLOWS);
    });
  }

  /** Until ticks are flown again. */
  hush() {
    this.#last = -Infinity;
    if (this.#quiet || !this.#context) return;
    this.#quiet = true;
    for (const { loud } of this.#voices) loud.gain.setTargetAtTime(0, this.#context.currentTime, FADES);
    this.#sleepSoon();
  }
}
