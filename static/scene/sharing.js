/**
 * The page's part in a session of several windows: it shows the others its design's motion and how time runs, and does
 * what is set at their panel.
 * Where the page is hidden behind them it gets no frames, so nothing here waits for one.
 * @typedef {import('../types.js').State} State
 */
import { evaluationOf, motionOf } from '../model/index.js';
import { hubAddress } from '../net/index.js';
import { Hub, publishClock } from './hub.js';
import { edited, shownOf, steer } from './panel.js';
import { InStep } from './step.js';

export class SceneSharing {
  /** How many of the panel's messages each design contains. @type {WeakMap<object, number>} */ #counts = new WeakMap();
  #count = 0;
  /** @type {unknown} */ #told = null;
  #calm = matchMedia('(prefers-reduced-motion: reduce)');

  /** @param {import('../model/store.js').Store} store @param {import('./view.js').SceneView} scene */
  constructor(store, scene) {
    this.store = store;
    this.scene = scene;
    this.step = new InStep(scene.player);
    this.hub = new Hub({
      open: () => new WebSocket(hubAddress(scene.session)),
      onShown: () => {}, // the page has the design
      onTransport: (snapshot, elapsed) => this.step.follow(snapshot, elapsed),
      onEdits: (edits, count) => this.#edit(edits, count),
      onWindows: (windows) => this.#windows(windows),
      onClock: publishClock,
    });
    store.addEventListener(
      'design',
      () => this.store.state.design && this.#counts.set(this.store.state.design, this.#count),
    );
    store.addEventListener('change', () => this.#show());
    document.addEventListener('visibilitychange', () => this.correct());
  }

  /** @param {import('./clock.js').Snapshot} snapshot @param {import('./player.js').Cause} cause */
  run(snapshot, cause) {
    // each window loads by itself and stays where it is
    if (cause === 'load' && this.step.expects(snapshot.time)) return;
    this.step.keep(snapshot);
    this.hub.run(snapshot);
  }

  /** @param {import('./hub.js').Windows} windows */
  #windows({ others, count }) {
    this.#count = Math.max(this.#count, count);
    if (this.store.state.design) this.#counts.set(this.store.state.design, this.#count);
    this.#told = null;
    if (!others) return;
    this.#show();
    this.run(this.scene.player.snapshot(), 'play');
  }

  /** A hidden page's time stands still, and a slow one's; the others' went on. */
  correct() {
    if (this.hub.others) this.step.correct();
  }

  /** @param {import('./panel.js').Edits} edits @param {number} count */
  #edit(edits, count) {
    this.#count = count;
    const before = this.store.state.design;
    this.store.edit((design) => edited(design, edits), { gesture: `panel ${Object.keys(edits)}` });
    if (this.store.state.design && this.store.state.design === before) {
      this.#counts.set(before, count);
      this.#told = null; // what was refused goes back to what it is
      this.#show();
    }
    this.correct();
    if (edits.play) this.scene.taken();
    steer(this.scene.player, edits);
  }

  /**
   * @param {import('../types.js').Step} motion @param {object} [more]
   * @returns {boolean} whether somebody may see it
   */
  tell(motion, more) {
    const { reply, answered, motion: which } = this.store.state;
    if (!this.hub.others || !reply || !answered) return false;
    const [rig, after] = [this.store.preset?.rig ?? '', this.#counts.get(answered) ?? 0];
    this.hub.show({ ...shownOf(evaluationOf(answered), reply, motion, { motion: which, rig, after }), ...more });
    this.#told = more ? null : motion; // a flight may have taken its place before it went
    return true;
  }

  #show() {
    const { reply, motion } = this.store.state;
    if (!this.hub.others || !reply) return;
    const step = (motionOf(reply, motion) ?? reply.step).nonlinear;
    if (step === this.#told || !this.tell(step)) return;
    if (!document.hidden) return;
    this.scene.render(this.store.state);
    if (!this.#calm.matches) this.scene.player.replay();
  }
}
