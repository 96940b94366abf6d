/**
 * Sticks on the screen: one for pitch, up and down, one for yaw, left and right, so that two thumbs or two people fly.
 * A stick springs back to its middle when it is let go. Its knob shows what is asked for by whatever hand: keys and
 * gamepads move it, too.
 * @typedef {import('./keys.js').Demand} Demand
 */
import { setAttr, h } from '../ui/index.js';
import { inSteps } from './strength.js';

/** A stick's places between its middle and its end: fine enough for a thumb, and a log stays small. */
const FINEST = 0.02;

/**
 * Where a stick is under a pointer: −1 … 1 along it, from its middle to where its knob touches the edge.
 * @param {number} at px along the pad, as far as it is to count @param {number} length px @param {number} knob px
 */
export const stickAt = (at, length, knob) =>
  inSteps(Math.min(Math.max((at - length / 2) / Math.max((length - knob) / 2, 1), -1), 1), FINEST);

export class Stick {
  /** @type {number|null} */ #pointer = null;
  /** What the hand on it asks for. */ value = 0;
  #shown = 0;

  /**
   * @param {keyof Demand} axis @param {{label: string, testid: string, onChange: () => void}} how
   */
  constructor(axis, { label, testid, onChange }) {
    this.upright = axis === 'pitch';
    this.onChange = onChange;
    this.knob = h('span', { class: 'knob', 'aria-hidden': 'true' });
    this.node = h(
      'div',
      {
        class: `stick ${axis}`,
        role: 'slider',
        tabindex: 0,
        'aria-label': label,
        'aria-orientation': this.upright ? 'vertical' : 'horizontal',
        'aria-valuemin': -100,
        'aria-valuemax': 100,
        'aria-valuenow': 0,
        'data-testid': testid,
        onpointerdown: (/** @type {PointerEvent} */ e) => this.#take(e),
        onpointermove: (/** @type {PointerEvent} */ e) => e.pointerId === this.#pointer && this.#follow(e),
        onpointerup: (/** @type {PointerEvent} */ e) => this.#leave(e),
        onpointercancel: (/** @type {PointerEvent} */ e) => this.#leave(e),
        onlostpointercapture: (/** @type {PointerEvent} */ e) => this.#leave(e),
      },
      this.knob,
    );
  }

  /** Shows what is asked for by all hands. @param {number} value −1 … 1 @param {string} words what that means */
  show(value, words) {
    if (value !== this.#shown) this.knob.style.setProperty('--at', value.toFixed(3));
    this.#shown = value;
    setAttr(this.node, 'aria-valuenow', Math.round(100 * value));
    setAttr(this.node, 'aria-valuetext', words);
  }

  /** The first pointer on it has it until it leaves. @param {PointerEvent} e */
  #take(e) {
    if (this.#pointer !== null || e.button > 0) return;
    this.#pointer = e.pointerId;
    this.node.setPointerCapture(e.pointerId);
    this.#follow(e);
  }

  /** @param {PointerEvent} e */
  #follow({ clientX, clientY }) {
    const box = this.node.getBoundingClientRect();
    const knob = this.knob.offsetWidth;
    this.#ask(
      this.upright ? stickAt(box.bottom - clientY, box.height, knob) : stickAt(clientX - box.left, box.width, knob),
    );
  }

  /** @param {PointerEvent} e */
  #leave({ pointerId }) {
    if (pointerId !== this.#pointer) return;
    this.#pointer = null;
    this.#ask(0);
  }

  /** @param {number} value */
  #ask(value) {
    if (value === this.value) return;
    this.value = value;
    this.onChange();
  }
}
