/** The bar under the scene: play and pause, replay, the time, speed and loop. */
import { fixed } from '../text/index.js';
import { button, check, h, setAttr, setText } from '../ui/index.js';
import { SPEEDS } from './clock.js';

const SPEED_TEXT = /** @type {Record<number, string>} */ ({ 0.25: '¼×', 0.5: '½×' });

export class Transport {
  /**
   * @param {{onToggle: () => void, onReplay: () => void, onSeek: (t: number) => void, onSpeed: (speed: number) => void,
   *   onLoop: (loop: boolean) => void}} handlers
   */
  constructor({ onToggle, onReplay, onSeek, onSpeed, onLoop }) {
    this.play = button({ class: 'play', 'data-testid': 'play', onclick: onToggle });
    this.replay = button(
      {
        class: 'replay',
        'data-testid': 'replay',
        title: 'Play from the start',
        'aria-label': 'Replay',
        onclick: onReplay,
      },
      '↺',
    );
    this.time = h('input', {
      type: 'range',
      min: 0,
      max: 5,
      step: 0.01,
      value: 0,
      'aria-label': 'Time in the motion',
      'data-testid': 'time',
      oninput: () => onSeek(Number(this.time.value)),
    });
    this.clock = h('output', { class: 'clock', 'data-testid': 'clock' });
    this.speed = h(
      'select',
      {
        'aria-label': 'Speed',
        title: 'Seconds of the motion per second',
        'data-testid': 'speed',
        onchange: () => onSpeed(Number(this.speed.value)),
      },
      SPEEDS.map((s) => h('option', { value: s }, SPEED_TEXT[s] ?? `${s}×`)),
    );
    const loop = check(
      { title: 'Play again and again', 'data-testid': 'loop', onchange: () => onLoop(this.loop.checked) },
      'loop',
    );
    this.loop = loop.box;
    this.node = h('div', { class: 'transport' }, this.play, this.replay, this.time, this.clock, this.speed, loop.node);
  }

  /** @param {import('./player.js').PlayerState} state */
  render({ playing, duration, speed, loop }) {
    setText(this.play, playing ? 'Pause' : 'Play');
    setAttr(this.play, 'aria-pressed', String(playing));
    if (duration > 0) setAttr(this.time, 'max', duration);
    this.speed.value = String(speed);
    this.loop.checked = loop;
  }

  /** @param {number} t @param {boolean} playing */
  show(t, playing) {
    if (document.activeElement !== this.time || playing) this.time.value = String(t);
    setAttr(this.time, 'aria-valuetext', `${fixed(t, 2)} seconds`);
    setText(this.clock, `${fixed(t, 2)} s`);
  }
}
