/**
 * The scene's pane: the frame with the rig, what is written over it, and the transport. Where there is no WebGL it says
 * so, and time still runs for the plots and the read-outs.
 * @typedef {import('../types.js').State} State
 */
import { degrees, fixed } from '../text/index.js';
import { motionOf } from '../model/index.js';
import { getRigViews, hasWebGl, putRig, session } from '../net/index.js';
import { CALM, Choice, h, setText, symbol } from '../ui/index.js';
import { RigKeeper } from './rig_keeper.js';
import { ScenePlayer } from './player.js';
import { SceneControls } from './controls.js';
import { flightsOf } from './ghosts.js';
import { AT_LIMIT } from './pose.js';
import { Transport } from './transport.js';

const QUIET_MS = 450; // after the last change, before the motion plays afresh
const LATE_MS = 100; // between two frames: three such in a row, and drawing the rig is slow here
/** Each motor, and its limit. @type {('V_p'|'V_y')[]} */
const MOTORS = ['V_p', 'V_y'];

export class SceneView {
  /** @type {string|null} */ #rig = null;
  /** @type {import('../types.js').Step|null} */ #loaded = null;
  /** @type {string|null} */ #design = null;
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #timer;
  #pending = false;
  #dragging = false;
  /** Whether the drag has yet to bring its first response. */ #fresh = false;
  #rests = false;
  /** When its figures were written last. */ #told = -Infinity;
  #slow = false;
  /** The time that is held while the plots' cursor is elsewhere; null: it is not. @type {number|null} */ #held = null;
  /** Where the plots' cursor is. @type {number|null} */ #peeked = null;
  /** @type {import('./player.js').PlayerState} */ #last = {
    playing: false,
    time: 0,
    duration: 0,
    speed: 1,
    loop: false,
    ready: false,
    reason: '',
  };
  /** @type {unknown[]} */ #flown = [];
  /** @type {Record<string, import('./cameras.js').RigView>|null} */ #views = null;
  #calm = matchMedia('(prefers-reduced-motion: reduce)');

  /**
   * @param {HTMLElement} root
   * @param {import('../model/store.js').Store} store
   * @param {{onTime: (t: number) => void, onTransport: NonNullable<ConstructorParameters<typeof
   *   ScenePlayer>[1]>['onTransport']}} handlers
   */
  constructor(root, store, { onTime, onTransport }) {
    this.store = store;
    this.onTime = onTime;
    this.session = session();
    this.webgl = hasWebGl();
    this.rigs = new RigKeeper((rig) => putRig(this.session, rig));
    this.frame = h('iframe', { title: 'The rig in three dimensions', 'data-testid': 'scene', tabindex: -1 });
    this.notice = h(
      'p',
      { class: 'scene-notice', 'data-testid': 'scene-notice', role: 'status' },
      this.webgl ? 'Building the rig…' : 'This browser has no WebGL, so the 3D view is off. Everything else works.',
    );
    this.hud = Object.fromEntries(
      ['theta', 'psi', 'V_p', 'V_y'].map((name) => [
        name,
        h('span', { class: 'hud-value', 'data-testid': `hud-${name}` }),
      ]),
    );
    const label = (/** @type {string} */ name, /** @type {Node} */ mark) =>
      h('div', { class: `hud-item ${name}` }, mark, this.hud[name]);
    const hud = h(
      'div',
      { class: 'hud', 'data-testid': 'hud' },
      label('theta', symbol('θ')),
      label('psi', symbol('ψ')),
      label('V_p', symbol('V', 'p')),
      label('V_y', symbol('V', 'y')),
    );
    this.motion = new Choice({
      label: 'Motion that the scene plays',
      testid: 'motion',
      onChange: (v) => store.set({ motion: v }),
      options: [
        ['theta', 'pitch step', 'the scene plays the pitch step alone'],
        ['psi', 'yaw step', 'the scene plays the yaw step alone'],
        ['both', 'both', 'the scene plays both steps at once'],
      ],
    });
    this.transport = new Transport({
      onToggle: () => this.#toggle(),
      onReplay: () => {
        this.taken();
        this.player.replay();
      },
      onSeek: (t) => this.seek(t),
      onSpeed: (speed) => this.player.setSpeed(speed),
      onLoop: (loop) => this.player.setLoop(loop),
    });
    this.controls = new SceneControls({
      onCamera: (camera) => this.player.setCamera(camera),
      onReset: () => this.player.resetCamera(),
      onFlights: () => this.#fly(store.shown),
      onSeen: () => this.#state(this.#last),
    });
    root.append(
      h(
        'div',
        { class: 'stage' },
        this.webgl ? this.frame : null,
        this.notice,
        hud,
        h('div', { class: 'motion' }, this.motion.node),
        this.webgl ? this.controls.node : null,
      ),
      this.transport.node,
    );
    const target = this.webgl ? this.frame : { contentWindow: null, clientWidth: 0, clientHeight: 0 };
    this.player = new ScenePlayer(target, {
      onFrame: (s) => this.#show(s),
      onState: (s) => this.#state(s),
      onTransport,
    });
    this.player.setCamera(this.controls.camera);
    if (this.webgl) this.#watchFrame();
    if (this.webgl) this.#followTheme();
    this.#state(this.#last);
  }

  #followTheme() {
    const dark = matchMedia('(prefers-color-scheme: dark)');
    const tell = () => {
      this.player.setTheme(dark.matches);
      this.#flown = [];
      this.#fly(this.store.shown);
    };
    dark.addEventListener('change', tell);
    tell();
  }

  /** The viewer takes the camera by moving it; a picture of another shape shows as much of the rig. */
  #watchFrame() {
    this.frame.addEventListener('load', () => {
      const inside = this.frame.contentWindow;
      const moved = (/** @type {Event} */ event) =>
        (event.type === 'wheel' || /** @type {PointerEvent} */ (event).buttons > 0) && this.controls.freed();
      for (const type of ['pointermove', 'wheel'])
        inside?.addEventListener(type, moved, { capture: true, passive: true });
    });
    new ResizeObserver(() => this.player.resized()).observe(this.frame);
  }

  /** Whoever moves time by hand keeps it: what is to play by itself after a change does not. */
  taken() {
    this.#pending = false;
    clearTimeout(this.#timer);
  }

  /** Holds the rig at a time. @param {number} t */
  seek(t) {
    this.taken();
    this.#held = null;
    this.player.pause();
    this.player.seek(t);
  }

  /**
   * Shows the rig at the plots' cursor, where time does not run, and where it was when the cursor has left.
   * @param {number|null} t
   */
  peek(t) {
    if (t === this.#peeked) return; // the plots share one cursor, and each tells of it
    this.#peeked = t;
    if (this.player.playing) this.#held = null;
    else if (t !== null) {
      this.#held ??= this.player.time;
      this.player.seek(t);
    } else if (this.#held !== null) {
      this.player.seek(this.#held);
      this.#held = null;
    }
  }

  #toggle() {
    this.taken();
    if (this.player.playing) this.player.pause();
    else this.player.play();
  }

  /** @param {State} state */
  render(state) {
    this.motion.set(state.motion);
    if (state.dragging !== this.#dragging) this.#follow(state.dragging);
    const rig = this.store.preset?.rig;
    if (state.connection === 'lost')
      // a server that returns knows nothing of this tab, and builds the right rig at once if told first
      this.#rig = null;
    else if (rig && rig !== this.#rig) this.#setRig(rig);
    if (!state.reply) return;
    const motion = motionOf(state.reply, state.motion) ?? state.reply.step;
    this.player.setLimits(state.reply.limits);
    if (motion.nonlinear !== this.#loaded) this.#load(motion.nonlinear);
    this.#fly(state);
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
   * A response: the first plays from its start, as does a drag's, which goes on with each that follows.
   * @param {import('../types.js').Step} step
   */
  #load(step) {
    const first = this.#loaded === null;
    const afresh = first || (this.#fresh && !this.#calm.matches);
    this.#loaded = step;
    this.#fresh = false;
    this.player.load(step, { keepTime: !afresh });
    if (this.#calm.matches) return;
    if (first) this.player.play();
    else if (this.#dragging && !this.player.playing) this.player.replay();
  }

  /** Who flies beside the rig. @param {State} state */
  #fly(state) {
    const { linear, pins } = this.controls;
    const seen = [state.reply, state.motion, state.pins, state.beside, linear.checked, pins.checked];
    if (seen.every((v, i) => v === this.#flown[i])) return;
    this.#flown = seen;
    const style = getComputedStyle(document.documentElement);
    this.player.setFlights(
      flightsOf(state, { linear: linear.checked, pins: pins.checked }, (name) =>
        style.getPropertyValue(`--${name}`).trim(),
      ),
    );
    this.controls.render(state.pins.length > 0, this.controls.seen.checked);
  }

  /**
   * Without a graphics card, drawing the rig holds up the whole page. Where that is seen to happen, the rig rests
   * during drags: a drag never waits. @param {boolean} dragging
   */
  #follow(dragging) {
    this.#dragging = this.#fresh = dragging;
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
    await this.rigs.want(rig); // where that fails, the frame shows what the server says of it
    if (!this.frame.src) this.frame.src = `scene/${this.session}/`;
    this.#views ??= await getRigViews().catch(() => null); // without them, the camera is the viewer's
    if (rig === this.#rig && this.#views?.[rig]) this.player.setView(this.#views[rig]);
  }

  /** @param {{t: number, theta: number, psi: number, V_p: number, V_y: number}} s */
  #show(s) {
    const now = performance.now();
    // the figures; the rig itself moves on
    if (this.#dragging && this.player.playing && now - this.#told < CALM) return;
    this.#told = now;
    setText(this.hud.theta, degrees(s.theta));
    setText(this.hud.psi, degrees(s.psi));
    for (const name of MOTORS) {
      const limit = this.store.state.reply?.limits?.[name];
      const full = limit !== undefined && Math.abs(s[name]) >= limit - AT_LIMIT;
      setText(this.hud[name], `${fixed(s[name], 1)} V${full ? ' limit' : ''}`);
      this.hud[name].classList.toggle('full', full);
    }
    this.transport.show(s.t, this.player.playing);
    this.onTime(s.t);
  }

  /** @param {import('./player.js').PlayerState} last */
  #state(last) {
    if (last.ready && !this.#last.ready) this.rigs.again(); // whoever has built it may never have heard of this tab
    this.#last = last;
    const { ready, reason } = last;
    this.transport.render(last);
    if (this.webgl) {
      const seen = this.controls.seen.checked && !this.#rests;
      this.frame.hidden = !seen;
      this.player?.setSeen(seen);
      this.controls.render(this.store.state.pins.length > 0, this.controls.seen.checked);
      this.notice.hidden = ready && seen;
      const off = this.#rests
        ? 'The 3D view pauses while you drag: graphics are slow here.'
        : 'The rig is switched off. All else works.';
      setText(this.notice, seen ? reason || 'Building the rig…' : off);
    }
  }
}
