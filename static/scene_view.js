/**
 * The scene's pane: the frame with the rig, what is written over it, and the transport. Where there is no WebGL it says so, and time still runs for
 * the plots and the read-outs.
 * @typedef {import('./types.js').State} State
 */
import { h, setAttr, setText, symbol } from './dom.js';
import { Choice } from './fields.js';
import { degrees, fixed } from './format.js';
import { putRig } from './api.js';
import { ScenePlayer } from './scene.js';
import { sceneMenu } from './scene_menu.js';
import { motionOf } from './traces.js';

const KEY = 'heli2dof-scene';
const QUIET_MS = 450; // after the last change, before the motion plays afresh
const LATE_MS = 100; // between two frames: three such in a row, and drawing the rig is slow here

/** A name that nobody guesses: whoever knows it sees this tab's rig. */
function newSession() {
  const bytes = crypto.getRandomValues(new Uint8Array(18));
  return btoa(String.fromCharCode(...bytes)).replaceAll('+', '-').replaceAll('/', '_');
}

/** Kept over a reload; a duplicated tab inherits the storage but not the navigation type, and gets its own. */
function session() {
  const [navigation] = /** @type {PerformanceNavigationTiming[]} */ (performance.getEntriesByType('navigation'));
  const kept = navigation?.type === 'reload' ? sessionStorage.getItem(KEY) : null;
  const id = kept ?? newSession();
  sessionStorage.setItem(KEY, id);
  return id;
}

function hasWebGl() {
  try {
    const context = document.createElement('canvas').getContext('webgl2');
    context?.getExtension('WEBGL_lose_context')?.loseContext();
    return context !== null;
  } catch {
    return false;
  }
}

export class SceneView {
  /** @type {string|null} */ #rig = null;
  /** @type {any} */ #loaded = null;
  /** @type {any} */ #design = null;
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #timer;
  #pending = false;
  #dragging = false;
  #rests = false;
  #slow = false;
  #last = { playing: false, time: 0, duration: 0, speed: 1, loop: false, ready: false, reason: '' };
  #calm = matchMedia('(prefers-reduced-motion: reduce)');

  /** @param {HTMLElement} root @param {import('./store.js').Store} store @param {{onTime: (t: number) => void, onTransport: NonNullable<ConstructorParameters<typeof ScenePlayer>[1]>['onTransport']}} handlers */
  constructor(root, store, { onTime, onTransport }) {
    this.store = store;
    this.onTime = onTime;
    this.session = session();
    this.webgl = hasWebGl();
    this.frame = h('iframe', { title: 'The rig in three dimensions', 'data-testid': 'scene', tabindex: -1 });
    this.notice = h('p', { class: 'scene-notice', 'data-testid': 'scene-notice', role: 'status' }, this.webgl ? 'Building the rig…' : 'This browser shows no WebGL, so the rig stays unseen. All else works.');
    this.hud = Object.fromEntries(['theta', 'psi', 'V_p', 'V_y'].map((name) => [name, h('span', { class: 'hud-value', 'data-testid': `hud-${name}` })]));
    const label = (/** @type {string} */ name, /** @type {Node} */ mark) => h('div', { class: `hud-item ${name}` }, mark, this.hud[name]);
    const hud = h('div', { class: 'hud', 'data-testid': 'hud' }, label('theta', symbol('θ')), label('psi', symbol('ψ')), label('V_p', symbol('V', 'p')), label('V_y', symbol('V', 'y')));
    this.motion = new Choice({ label: 'Motion that the scene plays', testid: 'motion', onChange: (v) => store.set({ motion: /** @type {any} */ (v) }),
      options: [['theta', 'pitch step', 'the scene plays the pitch step alone'], ['psi', 'yaw step', 'the scene plays the yaw step alone'], ['both', 'both', 'the scene plays both steps at once']] });
    this.play = h('button', { type: 'button', class: 'play', 'data-testid': 'play', onclick: () => this.#toggle() });
    this.replay = h('button', { type: 'button', 'data-testid': 'replay', title: 'Play from the start', onclick: () => this.player.replay() }, 'Replay');
    this.time = h('input', { type: 'range', min: 0, max: 5, step: 0.01, value: 0, 'aria-label': 'Time in the motion', 'data-testid': 'time', oninput: () => this.#seek(Number(this.time.value)) });
    this.clock = h('output', { class: 'clock', 'data-testid': 'clock' });
    this.loop = h('input', { type: 'checkbox', 'data-testid': 'loop', onchange: () => this.player.setLoop(this.loop.checked) });
    this.seen = h('input', { type: 'checkbox', checked: true, 'data-testid': 'show-scene', onchange: () => this.#state(this.#last) });
    root.append(h('div', { class: 'stage' }, this.webgl ? this.frame : null, this.notice, hud, h('div', { class: 'motion' }, this.motion.node)),
      h('div', { class: 'transport' }, this.play, this.replay, this.time, this.clock, h('label', { class: 'check', title: 'Play again and again' }, this.loop, 'loop'),
        this.webgl ? h('label', { class: 'check', title: 'Draw the rig: switch it off where the graphics are slow' }, this.seen, '3D') : null, this.webgl ? sceneMenu(store, this.session) : null));
    const target = this.webgl ? this.frame : /** @type {HTMLIFrameElement} */ (/** @type {unknown} */ ({ contentWindow: null }));
    this.player = new ScenePlayer(target, { onFrame: (s) => this.#show(s), onState: (s) => this.#state(s), onTransport });
    if (this.webgl) this.#followTheme();
    this.#state(this.#last);
  }

  #followTheme() {
    const dark = matchMedia('(prefers-color-scheme: dark)');
    const tell = () => this.player.setTheme(dark.matches);
    dark.addEventListener('change', tell);
    tell();
  }

  /** @param {number} t */
  #seek(t) {
    this.player.pause();
    this.player.seek(t);
  }

  /** @param {number} t */
  seek(t) {
    this.#seek(t);
  }

  #toggle() {
    if (this.player.playing) this.player.pause();
    else this.player.play();
  }

  /** @param {State} state */
  render(state) {
    this.motion.set(state.motion);
    if (state.dragging !== this.#dragging) this.#follow(state.dragging);
    const rig = this.store.preset?.rig;
    if (state.connection === 'lost') this.#rig = null; // a server that returns knows nothing of this tab
    else if (rig && rig !== this.#rig) this.#setRig(rig);
    if (!state.reply) return;
    const motion = motionOf(state.reply, state.motion) ?? state.reply.step;
    if (motion.nonlinear !== this.#loaded) {
      const first = this.#loaded === null;
      this.#loaded = motion.nonlinear;
      this.player.load(motion.nonlinear, { keepTime: !first });
      if (first && !this.#calm.matches) this.player.play();
    }
    const wanted = `${state.motion}/${JSON.stringify(state.design)}`;
    if (wanted !== this.#design) {
      if (this.#design !== null) this.#pending = true;
      this.#design = wanted;
      clearTimeout(this.#timer);
    }
    // Whoever has just changed the design wants to see what it does, from the start.
    if (this.#pending && !state.dragging && !this.#calm.matches) {
      this.#pending = false;
      this.#timer = setTimeout(() => this.player.replay(), QUIET_MS);
    }
  }

  /**
   * Without a graphics card, drawing the rig holds up the whole page. Where that is seen to happen, the rig rests during drags: a drag never
   * waits. @param {boolean} dragging
   */
  #follow(dragging) {
    this.#dragging = dragging;
    this.#rests = dragging && this.#slow;
    this.#state(this.#last);
    let [late, last] = [0, performance.now()];
    const tick = (/** @type {number} */ now) => {
      if (!this.#dragging || this.#rests) return;
      late = now - last > LATE_MS ? late + 1 : 0;
      last = now;
      if (late >= 3) {
        this.#slow = this.#rests = true;
        this.#state(this.#last);
      }
      requestAnimationFrame(tick);
    };
    if (dragging) requestAnimationFrame(tick);
  }

  /** @param {string} rig */
  async #setRig(rig) {
    this.#rig = rig;
    if (!this.webgl) return;
    try {
      await putRig(this.session, rig);
    } catch {
      // The frame shows what the server says of it.
    }
    if (!this.frame.src) this.frame.src = `scene/${this.session}/`;
  }

  /** @param {{t: number, theta: number, psi: number, V_p: number, V_y: number}} s */
  #show(s) {
    setText(this.hud.theta, degrees(s.theta));
    setText(this.hud.psi, degrees(s.psi));
    for (const name of /** @type {('V_p'|'V_y')[]} */ (['V_p', 'V_y'])) {
      const limit = this.store.state.reply?.limits?.[name];
      const full = limit !== undefined && Math.abs(s[name]) >= limit - 1e-3;
      setText(this.hud[name], `${fixed(s[name], 1)} V${full ? ' limit' : ''}`);
      this.hud[name].classList.toggle('full', full);
    }
    if (document.activeElement !== this.time || this.player.playing) this.time.value = String(s.t);
    setAttr(this.time, 'aria-valuetext', `${fixed(s.t, 2)} seconds`);
    setText(this.clock, `${fixed(s.t, 2)} s`);
    this.onTime(s.t);
  }

  /** @param {import('./scene.js').PlayerState} last */
  #state(last) {
    this.#last = last;
    const { playing, duration, loop, ready, reason } = last;
    this.loop.checked = loop;
    setText(this.play, playing ? 'Pause' : 'Play');
    setAttr(this.play, 'aria-pressed', String(playing));
    if (duration > 0) setAttr(this.time, 'max', duration);
    if (this.webgl) {
      const seen = this.seen.checked && !this.#rests;
      this.frame.hidden = !seen;
      this.notice.hidden = ready && seen;
      const off = this.#rests ? 'The rig rests while you drag: drawing it is slow here.' : 'The rig is switched off. All else works.';
      setText(this.notice, seen ? reason || 'Building the rig…' : off);
    }
  }
}
