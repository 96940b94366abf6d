/**
 * Hands of somebody who watches a flight in a window of its own and flies along: arrow keys, W, A, S and D, and four
 * buttons for fingers. What is held is told; when the window loses the focus, nothing is held.
 * @typedef {import('./hub.js').Sticks} Sticks
 */
import { button, h } from '../ui/index.js';

/** Keys by their place, and what they ask for. @type {Record<string, Partial<Sticks>>} */
const KEYS = {
  ArrowUp: { pitch: 1 },
  ArrowDown: { pitch: -1 },
  ArrowLeft: { yaw: -1 },
  ArrowRight: { yaw: 1 },
  KeyW: { pitch: 1 },
  KeyS: { pitch: -1 },
  KeyA: { yaw: -1 },
  KeyD: { yaw: 1 },
};
/** @type {[code: string, text: string, label: string][]} */
const BUTTONS = [
  ['ArrowUp', '↑', 'Nose up'],
  ['ArrowDown', '↓', 'Nose down'],
  ['ArrowLeft', '←', 'Nose to the left'],
  ['ArrowRight', '→', 'Nose to the right'],
];

/** As in the flight's own window (flight/keys.js): a tap is fine. ms, and the share that it asks for. */
const [FINE_MS, FINE] = [200, 0.2];

export class Partner {
  /** What is held, and since when, ms. @type {Map<string, number>} */ #held = new Map();
  #told = '{}';

  /** @param {(sticks: Sticks) => void} tell */
  constructor(tell) {
    this.tell = tell;
    this.node = h(
      'div',
      { class: 'window-partner', role: 'group', 'aria-label': 'Fly along', hidden: true, 'data-testid': 'partner' },
      BUTTONS.map(([code, text, label]) => this.#button(code, text, label)),
      h('p', {}, 'Fly along: hold an arrow, here or on the keyboard.'),
    );
    // before viser, which turns the camera by these keys
    addEventListener('keydown', (e) => this.#key(e, true), { capture: true });
    addEventListener('keyup', (e) => this.#key(e, false), { capture: true });
    addEventListener('blur', () => this.release());
    document.addEventListener('visibilitychange', () => this.release());
  }

  /** Whether there is a flight to fly along with. @param {boolean} on */
  show(on) {
    if (this.node.hidden === !on) return;
    this.node.hidden = !on;
    this.release();
  }

  /** Lets go of all. */
  release() {
    this.#held.clear();
    this.#tell();
  }

  /** @param {string} code @param {string} text @param {string} label */
  #button(code, text, label) {
    const press = (/** @type {PointerEvent} */ e, /** @type {boolean} */ down) => {
      if (down) /** @type {HTMLElement} */ (e.currentTarget).setPointerCapture(e.pointerId);
      this.#hold(`button ${code}`, down);
    };
    return button(
      {
        'aria-label': label,
        class: code,
        onpointerdown: (/** @type {PointerEvent} */ e) => press(e, true),
        onpointerup: (/** @type {PointerEvent} */ e) => press(e, false),
        onpointercancel: (/** @type {PointerEvent} */ e) => press(e, false),
        oncontextmenu: (/** @type {Event} */ e) => e.preventDefault(), // a long press
      },
      text,
    );
  }

  /** @param {KeyboardEvent} e @param {boolean} down */
  #key(e, down) {
    const held = this.#meant(e);
    if (this.node.hidden || !held || e.ctrlKey || e.metaKey || e.altKey) return;
    e.preventDefault();
    e.stopImmediatePropagation();
    this.#hold(held, down);
  }

  /** What a key holds: itself, or the button that has the focus. @param {KeyboardEvent} e */
  #meant({ code, target }) {
    const at = target instanceof HTMLElement ? target : null;
    if (/^(Space|Enter)$/.test(code)) return at && this.node.contains(at) ? `button ${at.className}` : null;
    return KEYS[code] && !at?.matches('input, textarea, select') ? code : null;
  }

  /** @param {string} what @param {boolean} down */
  #hold(what, down) {
    if (!down) this.#held.delete(what);
    else if (!this.#held.has(what)) {
      this.#held.set(what, performance.now());
      setTimeout(() => this.#tell(), FINE_MS);
    }
    this.#tell();
  }

  #tell() {
    const now = performance.now() + 1; // timers may be early by a rounding
    const held = [...this.#held].map(([what, since]) => ({
      own: KEYS[/** @type {string} */ (what.split(' ').at(-1))],
      share: now - since >= FINE_MS ? 1 : FINE,
    }));
    const of = (/** @type {keyof Sticks} */ axis) => {
      const all = held.map(({ own, share }) => share * (own[axis] ?? 0));
      return Math.max(0, ...all) + Math.min(0, ...all);
    };
    const sticks = { pitch: of('pitch'), yaw: of('yaw') };
    const text = JSON.stringify(sticks);
    if (text === this.#told || (this.#told === '{}' && !held.length)) return;
    this.#told = text;
    this.tell(sticks);
  }
}
