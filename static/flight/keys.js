/**
 * Keys that fly. They act only while a flight is in hand, and only where no other part of the page wants them: not in
 * fields, sliders or the s-plane, not with Ctrl, Alt or Meta, not where somebody has used the key already, and a letter
 * right after G is the page's, which goes to a view by it.
 * @typedef {'hands'|'toggle'|'step'|'slow'|'rewind'|'gust'|'push'|'restart'|'end'|'legend'} Act
 * @typedef {{pitch: number, yaw: number}} Demand −1 … 1 each: nose up, and nose to the right
 */

/**
 * Sticks by the place of the key, so that W, A, S, D are where they are on any keyboard.
 * @type {Record<string, Demand>}
 */
const STICKS = {
  ArrowUp: { pitch: 1, yaw: 0 },
  ArrowDown: { pitch: -1, yaw: 0 },
  ArrowLeft: { pitch: 0, yaw: -1 },
  ArrowRight: { pitch: 0, yaw: 1 },
  KeyW: { pitch: 1, yaw: 0 },
  KeyS: { pitch: -1, yaw: 0 },
  KeyA: { pitch: 0, yaw: -1 },
  KeyD: { pitch: 0, yaw: 1 },
};

/** All else by what is written on the key. @type {Record<string, Act>} */
const ACTS = {
  h: 'hands',
  ' ': 'toggle',
  '.': 'step',
  ',': 'slow',
  backspace: 'rewind',
  b: 'gust',
  p: 'push',
  r: 'restart',
  x: 'end',
  k: 'legend',
};
/** What a key that is held does again and again. @type {Set<Act>} */
const AGAIN = new Set(/** @type {Act[]} */ (['step']));

/** For so long, ms, a key asks for so much of what it asks for later: a tap is fine. */
const [FINE_MS, FINE] = [200, 0.2];

/** As many ms after G as panels/views.js takes a letter for a view's. */
const LED = 1500;

/** What has keys of its own. `data-flies`: a part of the flight's own, whose keys are these. */
const FIELDS =
  'input:not([type=checkbox]), textarea, select, [contenteditable], [role=slider], [role=spinbutton], ' +
  '[role=textbox], [role=tab], [role=menuitem], [role=option], .splane, #splane, .popup, dialog';
/** What Space and Enter press. */
const PRESSED =
  'a[href], button, summary, label, [type=checkbox], [role=button], [role=switch], [role=link], [role=checkbox]';

/**
 * What can be told of an element: its own kind, or what it is in.
 * @typedef {{closest?: (kinds: string) => unknown}} Place
 */

/**
 * What a press of a key means here; null: it is not the flight's.
 * @param {{key: string, code: string, ctrlKey: boolean, metaKey: boolean, altKey: boolean, repeat: boolean,
 *   defaultPrevented: boolean}} press
 * @param {Place|null} at where the focus is @param {boolean} led whether it follows the page's G
 * @returns {{stick: Demand}|{act: Act, again: boolean}|null} again: it is held, and nothing happens by it
 */
export function keyOf(press, at, led) {
  if (press.ctrlKey || press.metaKey || press.altKey || press.defaultPrevented) return null;
  if (at?.closest?.(FIELDS) && !at.closest('[data-flies]')) return null;
  if (led && /^[a-z]$/i.test(press.key)) return null;
  const name = press.key.toLowerCase();
  if (Object.hasOwn(ACTS, name)) {
    const act = ACTS[name];
    if (act === 'toggle' && at?.closest?.(PRESSED)) return null;
    return { act, again: press.repeat && !AGAIN.has(act) };
  }
  return Object.hasOwn(STICKS, press.code) ? { stick: STICKS[press.code] } : null;
}

export class Keys {
  /**
   * Held keys by their place, whether with Shift, and since when, ms.
   * @type {Map<string, {stick: Demand, shift: boolean, since: number}>}
   */
  #held = new Map();
  #led = -Infinity;
  /** Of the scene's frame, whose page may be another. @type {AbortController|null} */ #within = null;

  /**
   * @param {object} hooks
   * @param {() => boolean} hooks.active whether keys are the flight's
   * @param {() => boolean} hooks.flies whether sticks do something
   * @param {(act: Act) => boolean} hooks.onAct whether it did something
   */
  constructor({ active, flies, onAct }) {
    this.active = active;
    this.flies = flies;
    this.onAct = onAct;
    this.#listen(document, window);
    document.addEventListener('visibilitychange', () => this.release());
  }

  /**
   * Keys pressed while the focus is in the scene's frame, where viser would turn the camera by them.
   * @param {HTMLIFrameElement} frame
   */
  within(frame) {
    const listen = () => {
      const inside = frame.contentWindow;
      this.#within?.abort();
      this.#within = new AbortController();
      if (!inside) return;
      const { signal } = this.#within;
      this.#listen(inside, inside, signal);
      // whoever has turned the camera goes on flying by keys
      inside.addEventListener('pointerup', () => this.active() && frame.blur(), { signal });
    };
    listen();
    frame.addEventListener('load', listen);
  }

  /** What the held keys ask for: of the sticks, or with Shift of a push. */
  get demands() {
    const now = performance.now();
    const sum = (/** @type {boolean} */ shift) => {
      const held = [...this.#held.values()].filter((key) => key.shift === shift);
      const of = (/** @type {keyof Demand} */ axis) => {
        const all = held.map(({ stick, since }) => stick[axis] * (shift || now - since >= FINE_MS ? 1 : FINE));
        return Math.max(0, ...all) + Math.min(0, ...all);
      };
      return { pitch: of('pitch'), yaw: of('yaw') };
    };
    return { sticks: sum(false), push: sum(true) };
  }

  /** Lets go of all. */
  release() {
    this.#held.clear();
  }

  /**
   * @param {Document|Window} target @param {Window} window
   * @param {AbortSignal} [signal] of the scene's frame, where these keys come before all others
   */
  #listen(target, window, signal) {
    const first = signal !== undefined;
    const on = { signal, capture: first };
    target.addEventListener('keydown', (e) => this.#down(/** @type {KeyboardEvent} */ (e), first), on);
    target.addEventListener('keyup', (e) => this.#up(/** @type {KeyboardEvent} */ (e)), { signal, capture: true });
    window.addEventListener('blur', () => this.release(), { signal });
  }

  /** @param {KeyboardEvent} e @param {boolean} alone whether nobody else is to hear of a key that flies */
  #down(e, alone) {
    const led = e.timeStamp - this.#led < LED;
    this.#led = e.key.toLowerCase() === 'g' && !e.ctrlKey && !e.metaKey && !e.altKey ? e.timeStamp : -Infinity;
    if (!this.active()) return;
    const at = /** @type {Place|null} */ (/** @type {unknown} */ (e.target));
    const meant = keyOf(e, at, led);
    if (!meant) return;
    if ('stick' in meant) {
      if (!this.flies()) return;
      const since = this.#held.get(e.code)?.since ?? performance.now();
      this.#held.set(e.code, { stick: meant.stick, shift: e.shiftKey, since });
    } else if (!meant.again && !this.onAct(meant.act)) return;
    e.preventDefault();
    if (alone) e.stopImmediatePropagation();
  }

  /** Wherever the focus is by then. @param {KeyboardEvent} e */
  #up(e) {
    this.#held.delete(e.code);
  }
}
