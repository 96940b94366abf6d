/**
 * The rig in a window of its own: plays what the page shows, in step with it. While there is no page, the window that
 * leads asks the server itself, so that the panel goes on working; with a session that nobody has used it starts from
 * the first preset.
 */
import { degrees, fixed } from '../text/index.js';
import { designOf, evaluationOf, motionOf } from '../model/index.js';
import { Live, liveSocket, ofSession, socketAddress } from '../net/index.js';
import { h, setText } from '../ui/index.js';
import { Hub, publishClock } from './hub.js';
import { ScenePlayer } from './player.js';
import { edited, shownOf, steer, trajectoryIn } from './panel.js';
import { Partner } from './partner.js';
import { poseMessages, ROTOR_SCALE } from './pose.js';
import { Spectator } from './spectator.js';
import { InStep } from './step.js';

const APP = new URL('../../', location.href); // the page is served at …/scene/{session}/
const SESSION = location.pathname.split('/').at(-2) ?? '';
class SceneWindow {
  /** @type {import('./panel.js').Shown|null} */ #shown = null;
  /** @type {{design: import('./panel.js').Asked, after: number}|null} What is asked of the server. */ #asked = null;
  /** @type {Live|null} */ #live = null;
  #seq = 0;
  #count = 0;
  #alone = false;
  /** @type {string|null} The rig that the camera was aimed at. */ #aimed = null;
  /** A flight of the page's. */ #spectator = new Spectator();
  /** Angles of both propellers, rad. */ #rotors = [0, 0];
  #request = 0;

  constructor() {
    this.words = h(
      'p',
      { class: 'window-words', role: 'status', 'data-testid': 'window-words' },
      'Waiting for the page that this scene belongs to…',
    );
    this.time = h('output', { class: 'window-time', 'data-testid': 'window-time' });
    this.partner = new Partner((sticks) => this.hub.steer(sticks));
    document.body.append(h('div', { class: 'window-notes' }, this.words, this.time), this.partner.node);
    const frame = {
      contentWindow: window,
      get clientWidth() {
        return innerWidth;
      },
      get clientHeight() {
        return innerHeight;
      },
    };
    this.player = new ScenePlayer(frame, {
      onFrame: ({ t, theta, psi }) => {
        setText(this.time, `${fixed(t, 2)} s   θ ${degrees(theta)}   ψ ${degrees(psi)}`);
        this.step.correct();
      },
      onTransport: (snapshot, cause) => this.#run(snapshot, cause),
    });
    this.step = new InStep(this.player);
    this.hub = new Hub({
      open: () => new WebSocket(socketAddress(new URL('hub', location.href))),
      always: true,
      onShown: (shown) => this.#show(shown),
      onTransport: (snapshot, elapsed) => this.step.follow(snapshot, elapsed),
      onEdits: (edits, count) => this.#edit(edits, count),
      onWindows: (windows) => this.#windows(windows),
      onClock: publishClock,
    });
    const dark = matchMedia('(prefers-color-scheme: dark)');
    const tell = () => this.player.setTheme(dark.matches);
    dark.addEventListener('change', tell);
    tell();
    document.addEventListener('visibilitychange', () => this.step.correct());
  }

  /** @param {import('./clock.js').Snapshot} snapshot @param {import('./player.js').Cause} cause */
  #run(snapshot, cause) {
    if (cause === 'load' && (!this.step || !this.#alone || this.step.expects(snapshot.time))) return;
    this.step.keep(snapshot);
    this.hub.run(snapshot);
  }

  /** @param {unknown} shown */
  #show(shown) {
    const trajectory = trajectoryIn(shown);
    if (!trajectory) return;
    this.#asked = null;
    const { flight } = /** @type {{flight?: import('./spectator.js').Told}} */ (shown);
    if (!flight) return this.#load(/** @type {import('./panel.js').Shown} */ (shown));
    if (!this.#shown) this.#load(/** @type {import('./panel.js').Shown} */ (shown)); // who has come amid a flight
    this.#spectator.take(flight, trajectory, performance.now());
    if (!this.#request) this.#fly(performance.now());
  }

  /** A flight, for as long as one hears of it. @param {number} before ms, of the last frame */
  #fly(before) {
    this.#request = requestAnimationFrame((now) => {
      this.#request = 0;
      const pose = this.#spectator.at(now);
      const watches = pose !== null && this.#spectator.watches(performance.now());
      this.partner.show(watches);
      if (!watches) return this.player.live(null);
      const { psi, theta, V_p, V_y } = pose;
      const turned = (ROTOR_SCALE * Math.max(now - before, 0)) / 1000;
      this.#rotors = [this.#rotors[0] + turned * V_p, this.#rotors[1] + turned * V_y];
      const [pitchRotor, yawRotor] = this.#rotors;
      const limits = this.#shown?.limits ?? {};
      const dark = matchMedia('(prefers-color-scheme: dark)').matches;
      this.player.live({ messages: poseMessages({ ...pose, pitchRotor, yawRotor, limits, dark }), psi });
      setText(this.time, `${fixed(pose.t, 2)} s   θ ${degrees(theta)}   ψ ${degrees(psi)}`);
      this.#fly(now);
    });
  }

  /** @param {import('./panel.js').Shown} shown */
  #load(shown) {
    this.#shown = shown;
    this.player.setLimits(shown.limits ?? {});
    this.player.load(shown.trajectory, { keepTime: true });
    this.words.hidden = true;
    if (shown.rig !== this.#aimed) this.#aim(shown.rig);
  }

  /** Looks at the rig as the page does at first, in a window of any shape. @param {string} rig */
  async #aim(rig) {
    this.#aimed = rig;
    const views = await (await fetch(new URL('scene/rigs', APP))).json();
    if (rig !== this.#aimed || !Object.hasOwn(views, rig)) return;
    this.player.setView(views[rig]);
    this.player.resetCamera();
  }

  /** @param {import('./hub.js').Windows} windows */
  async #windows({ leads, count }) {
    this.#count = Math.max(this.#count, count);
    this.#alone = leads;
    if (!leads) return;
    if (this.#shown) this.hub.show(this.#shown);
    if (this.#shown) return this.#putRig(this.#shown.rig); // the server may have been started anew
    const presets = await (await fetch(ofSession(new URL('api/v1/presets', APP), SESSION))).json();
    if (!this.#shown && this.#alone && !this.#asked) this.#ask(evaluationOf(designOf(presets[0])));
  }

  /** @param {string} rig */
  async #putRig(rig) {
    await fetch(new URL('rig', location.href), {
      method: 'PUT',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify({ rig }),
    });
  }

  /** @param {import('./panel.js').Edits} edits @param {number} count */
  #edit(edits, count) {
    this.#count = count;
    const design = this.#asked?.design ?? this.#shown?.design;
    if (design) {
      const next = edited(design, edits);
      if (next !== design) this.#ask(next);
    }
    steer(this.player, edits);
  }

  /** @param {import('./panel.js').Asked} design */
  #ask(design) {
    this.#live ??= new Live({
      onReply: (reply) => this.#answered(reply),
      onProblem: () => {}, // the panel keeps what was refused until something else is set
      onStatus: () => {},
      open: () => liveSocket(ofSession(new URL('api/v1/live', APP), SESSION)),
    });
    this.#asked = { design, after: this.#count };
    this.#seq += 1;
    this.#live.send({ seq: this.#seq, ...design });
  }

  /** @param {import('../types.js').Reply} reply */
  #answered(reply) {
    if (!this.#asked || reply.seq !== this.#seq) return;
    const { design, after } = this.#asked;
    const { motion = 'both', rig = 'helicopter' } = this.#shown ?? {};
    const step = (motionOf(reply, motion) ?? reply.step).nonlinear;
    const first = this.#shown === null;
    const shown = shownOf(design, reply, step, { motion, rig, after });
    this.hub.show(shown);
    this.#load(shown);
    if (!matchMedia('(prefers-reduced-motion: reduce)').matches || first) this.player.replay();
  }
}

new SceneWindow();
