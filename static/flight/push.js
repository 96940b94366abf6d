/**
 * A hand on the body: whoever takes hold of it in the scene pulls it by a spring, whose force turns it about both axes.
 * By keys the nose is pushed. An arrow over the scene shows the force.
 * @typedef {import('./ray.js').Point} Point
 * @typedef {import('./ray.js').Shape} Shape
 * @typedef {import('./strength.js').Strength} Strength
 * @typedef {import('./keys.js').Demand} Demand
 * @typedef {{theta: number, psi: number}} Torques N·m
 * @typedef {{at: Point, force: Point, size: number}} Arrow where it holds, in the scene; N, its size in N
 * @typedef {object} Holding
 * @property {Shape} shape
 * @property {Strength} strength
 * @property {import('./ray.js').Attitude} attitude
 */
import { fixed, say, significant } from '../text/index.js';
import { h } from '../ui/index.js';
import { bodyAxes, caught, length, meets, minus, placed, plus, rayThrough, seenAt, torquesOf } from './ray.js';
import { inSteps } from './strength.js';

/** How far from the beam a mouse still holds it, and a finger, px. */
const REACH = { mouse: 12, touch: 28 };
/** By keys the nose is pushed by such a share of a hand's largest force. */
const BY_KEY = 0.5;
/** Of an arrow: so long in the scene at a hand's largest force, m. */
const LONGEST = 0.3;
const NONE = { theta: 0, psi: 0 };

/** A force in words. @param {number} size N */
export const forceText = (size) => say`${size >= 1 ? fixed(size, 1) : significant(size, 2)} N`;

/**
 * The force of a spring from a point to a hand, no larger than a hand's.
 * @param {Point} at @param {Point} hand @param {Strength} strength @returns {Point}
 */
export function pullOf(at, hand, { spring, force }) {
  const away = minus(hand, at);
  const size = Math.min(spring * length(away), force);
  return plus([0, 0, 0], away, size / Math.max(length(away), 1e-9));
}

/**
 * The force of keys at the nose: along the ways that θ and ψ move it.
 * @param {Demand} demand @param {Holding} holding
 * @returns {{at: Point, force: Point}}
 */
export function pushOf({ pitch, yaw }, { shape, strength, attitude }) {
  const { left, top } = bodyAxes(attitude);
  const size = BY_KEY * strength.force;
  const force = plus(plus([0, 0, 0], top, size * pitch), left, -size * yaw);
  return { at: [shape.arms.pitch, 0, 0], force };
}

export class Push {
  /**
   * What the pointer holds, and where it is on the overlay, px.
   * @type {{own: Point, id: number, x: number, y: number}|null}
   */
  #grip = null;
  /** @type {Arrow|null} */ arrow = null;
  #tool = false;
  #shift = false;
  #blank = true;

  /**
   * @param {object} of
   * @param {() => import('./camera.js').SceneCamera|null} of.camera
   * @param {() => Holding|null} of.holding null while nothing flies
   */
  constructor({ camera, holding }) {
    this.camera = camera;
    this.holding = holding;
    this.overlay = h('canvas', {
      class: 'push-overlay',
      'data-views': 'fly',
      'aria-hidden': 'true',
      'data-testid': 'push-overlay',
      onpointerdown: (/** @type {PointerEvent} */ e) => this.#take(e),
      onpointermove: (/** @type {PointerEvent} */ e) => this.#move(e),
      onpointerup: (/** @type {PointerEvent} */ e) => this.#leave(e),
      onpointercancel: (/** @type {PointerEvent} */ e) => this.#leave(e),
      onlostpointercapture: (/** @type {PointerEvent} */ e) => this.#leave(e),
    });
    const shifted = (/** @type {Event} */ e) => this.#shifted(/** @type {KeyboardEvent} */ (e).shiftKey === true);
    for (const type of ['keydown', 'keyup']) document.addEventListener(type, shifted, { capture: true });
    window.addEventListener('blur', () => this.#shifted(false));
  }

  /** Whether pointers on the scene push; else they turn the camera, but with Shift. */
  get tool() {
    return this.#tool;
  }
  set tool(on) {
    this.#tool = on;
    this.#reached();
  }

  /**
   * What all hands do to the body now.
   * @param {Demand} keys @param {Holding} holding @returns {Torques}
   */
  torques(keys, holding) {
    const { shape, strength, attitude } = holding;
    const held = this.#pull(holding) ?? (keys.pitch || keys.yaw ? pushOf(keys, holding) : null);
    this.arrow = held && { at: placed(held.at, shape, attitude), force: held.force, size: length(held.force) };
    if (!held) return NONE;
    const { theta, psi } = torquesOf(held.force, held.at, shape, attitude);
    return { theta: inSteps(theta, strength.step), psi: inSteps(psi, strength.step) };
  }

  /** Draws the force over the scene, as it is seen now. */
  draw() {
    const { arrow } = this;
    const camera = arrow && this.camera();
    const context = this.overlay.getContext('2d');
    if (!context || (this.#blank && !camera)) return;
    const { width, height } = this.overlay.getBoundingClientRect();
    const dense = devicePixelRatio || 1;
    const [wide, high] = [Math.round(width * dense), Math.round(height * dense)];
    if (this.overlay.width !== wide) this.overlay.width = wide;
    if (this.overlay.height !== high) this.overlay.height = high;
    context.setTransform(dense, 0, 0, dense, 0, 0);
    context.clearRect(0, 0, width, height);
    this.#blank = !camera;
    const strength = this.holding()?.strength;
    if (arrow && camera && strength) drawArrow(context, arrow, camera, strength.force);
  }

  /** @param {Holding} holding */
  #pull({ shape, strength, attitude }) {
    const grip = this.#grip;
    const camera = grip && this.camera();
    if (!grip || !camera) return null;
    const at = placed(grip.own, shape, attitude);
    const hand = meets(rayAt(camera, grip.x, grip.y), at, minus(camera.ahead, camera.position));
    return hand && { at: grip.own, force: pullOf(at, hand, strength) };
  }

  /** @param {boolean} shift */
  #shifted(shift) {
    this.#shift = shift;
    this.#reached();
  }

  /** Whether pointers reach it, or the scene below. */
  #reached() {
    this.overlay.classList.toggle('on', this.#tool || this.#shift || this.#grip !== null);
  }

  /** What a pointer would take hold of. @param {PointerEvent} e @returns {Point|null} */
  #at(e) {
    const [camera, holding] = [this.camera(), this.holding()];
    if (!camera || !holding) return null;
    const { x, y } = this.#place(e);
    const blunt = ((e.pointerType === 'touch' ? REACH.touch : REACH.mouse) * camera.fov) / camera.box[3];
    return caught(rayAt(camera, x, y), holding.shape, holding.attitude, blunt);
  }

  /** @param {PointerEvent} e where on the overlay, which lies on the frame */
  #place({ clientX, clientY }) {
    const { left, top } = this.overlay.getBoundingClientRect();
    return { x: clientX - left, y: clientY - top };
  }

  /** @param {PointerEvent} e */
  #take(e) {
    if (this.#grip || e.button > 0) return;
    const own = this.#at(e);
    if (!own) return;
    e.preventDefault();
    this.#grip = { own, id: e.pointerId, ...this.#place(e) };
    this.overlay.setPointerCapture(e.pointerId);
  }

  /** @param {PointerEvent} e */
  #move(e) {
    if (e.pointerId === this.#grip?.id) Object.assign(this.#grip, this.#place(e));
    else if (!this.#grip) this.overlay.classList.toggle('holds', this.#at(e) !== null);
  }

  /** @param {PointerEvent} e */
  #leave({ pointerId }) {
    if (pointerId !== this.#grip?.id) return;
    this.#grip = null;
    this.#reached();
  }
}

/**
 * The ray through a place of the frame, px.
 * @param {import('./camera.js').SceneCamera} camera @param {number} x @param {number} y
 */
function rayAt(camera, x, y) {
  const [left, top, width, height] = camera.box;
  return rayThrough(camera, (2 * (x - left)) / width - 1, 1 - (2 * (y - top)) / height);
}

/**
 * @param {CanvasRenderingContext2D} context @param {Arrow} arrow @param {import('./camera.js').SceneCamera} camera
 * @param {number} most a hand's largest force, N
 */
function drawArrow(context, { at, force, size }, camera, most) {
  const [left, top, width, height] = camera.box;
  const px = (/** @type {Point} */ point) => {
    const seen = seenAt(camera, point);
    return seen && { x: left + ((seen.x + 1) / 2) * width, y: top + ((1 - seen.y) / 2) * height };
  };
  const [from, to] = [px(at), px(plus(at, force, LONGEST / most))];
  if (!from || !to) return;
  const style = getComputedStyle(document.documentElement);
  const colour = style.getPropertyValue('--danger').trim();
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const far = Math.hypot(dx, dy);
  context.lineWidth = 3;
  context.lineCap = 'round';
  context.strokeStyle = context.fillStyle = colour;
  context.beginPath();
  context.arc(from.x, from.y, 5, 0, 2 * Math.PI);
  context.fill();
  if (far > 2) {
    const [ux, uy] = [dx / far, dy / far];
    const head = Math.min(12, far);
    context.beginPath();
    context.moveTo(from.x, from.y);
    context.lineTo(to.x - ux * head * 0.8, to.y - uy * head * 0.8);
    context.stroke();
    context.beginPath();
    context.moveTo(to.x, to.y);
    context.lineTo(to.x - ux * head - uy * head * 0.5, to.y - uy * head + ux * head * 0.5);
    context.lineTo(to.x - ux * head + uy * head * 0.5, to.y - uy * head - ux * head * 0.5);
    context.fill();
  }
  const words = forceText(size);
  context.font = '600 14px system-ui, sans-serif';
  context.textBaseline = 'middle';
  context.textAlign = dx < 0 ? 'right' : 'left';
  const [x, y] = [to.x + (dx < 0 ? -10 : 10), to.y + (dy > 0 ? 14 : -14)];
  context.lineWidth = 4;
  context.lineJoin = 'round';
  context.strokeStyle = style.getPropertyValue('--panel').trim();
  context.strokeText(words, x, y);
  context.fillText(words, x, y);
}
