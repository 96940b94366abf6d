// The page's side of the scene: plays a trajectory in real time and moves the rig's nodes.
import { cameraMessages, cameraPose } from './cameras.js';
import { SceneClock } from './clock.js';
import { ghostMessages } from './ghosts.js';
import { SceneLink } from './link.js';
import { interpolate, poseMessages, rotorAngles, sampleTrajectory, themeMessages } from './pose.js';

/** @typedef {import("./pose.js").Trajectory} Trajectory */
/** @typedef {import("./pose.js").Sample} Sample */
/** @typedef {import("./pose.js").Limits} Limits */
/** @typedef {import("./pose.js").SceneMessage} SceneMessage */
/** @typedef {import("./clock.js").Snapshot} Snapshot */
/** @typedef {import("./ghosts.js").Flight} Flight */
/** @typedef {import("./cameras.js").CameraName} CameraName */
/** @typedef {import("./cameras.js").RigView} RigView */
/** @typedef {"load" | "play" | "pause" | "restart" | "seek" | "speed" | "loop"} Cause */

/**
 * @typedef {object} PlayerState
 * @property {boolean} playing
 * @property {number} time seconds
 * @property {number} duration seconds
 * @property {number} speed seconds of the response per second
 * @property {boolean} loop
 * @property {boolean} ready whether the scene shows the rig
 * @property {string} reason why it does not, where the server said so
 */

/** Longest step of the clock in seconds: a stalled page goes on where it was. */
const LONGEST_STEP = 1;

/** Plays a trajectory in the scene of a frame, in real time or at another speed. */
export class ScenePlayer {
  /**
   * @param {import('./link.js').Frame} iframe shows /scene/{session}/ of the same origin
   * @param {object} [hooks]
   * @param {(sample: Sample) => void} [hooks.onFrame] called in each animation frame and at each jump
   * @param {(state: PlayerState) => void} [hooks.onState] called when anything else changes
   * @param {(snapshot: Snapshot, cause: Cause) => void} [hooks.onTransport] called when someone on
   *   this page has changed how time runs, so that other windows can follow; not while it just runs
   */
  constructor(iframe, { onFrame = () => {}, onState = () => {}, onTransport = () => {} } = {}) {
    this.#onFrame = onFrame;
    this.#onState = onState;
    this.#onTransport = onTransport;
    document.addEventListener('visibilitychange', this.#visibility);
    this.#link = new SceneLink(iframe, { onRebuilt: () => this.#retell(), onState: () => this.#report() });
  }

  /** @type {SceneLink} */
  #link;
  /** @type {(sample: Sample) => void} */
  #onFrame;
  /** @type {(state: PlayerState) => void} */
  #onState;
  /** @type {(snapshot: Snapshot, cause: Cause) => void} */
  #onTransport;
  #clock = new SceneClock();
  /** @type {Trajectory | null} */
  #trajectory = null;
  /** @type {{pitch: Float64Array, yaw: Float64Array}} */
  #angles = { pitch: new Float64Array(0), yaw: new Float64Array(0) };
  /** @type {Limits} */
  #limits = {};
  /** @type {Flight[]} */
  #flights = [];
  /** @type {CameraName} */
  #camera = 'free';
  /** @type {RigView | null} */
  #view = null;
  /** @type {boolean | null} */
  #dark = null;
  /** The last frame's time in milliseconds; NaN where time has not run since. */
  #before = NaN;
  #seen = true;
  #request = 0;
  /** What is shown in place of the trajectory. @type {{messages: SceneMessage[], psi: number}|null} */ #live = null;
  /** @type {{snapshot: Snapshot, since: number} | null} What was to be followed before there was a trajectory. */
  #awaited = null;

  /** Seconds since the step. */
  get time() {
    return this.#clock.time;
  }

  /** Whether time runs. */
  get playing() {
    return this.#clock.playing;
  }

  /** Seconds; 0 without a trajectory. */
  get duration() {
    return this.#clock.duration;
  }

  /** How time runs, for another window to follow. */
  snapshot() {
    return this.#clock.snapshot();
  }

  /**
   * Shows another response. Time starts again from 0 unless it is kept; whether it runs is kept.
   * @param {Trajectory} trajectory @param {{keepTime?: boolean}} [options]
   */
  load(trajectory, { keepTime = false } = {}) {
    this.#trajectory = trajectory;
    this.#angles = rotorAngles(trajectory);
    if (!keepTime) this.#clock.seek(0);
    this.#clock.setDuration(trajectory.t[trajectory.t.length - 1]);
    if (this.#awaited !== null) {
      const { snapshot, since } = this.#awaited;
      this.#awaited = null;
      this.follow(snapshot, (performance.now() - since) / 1000);
    } else this.#changed('load');
  }

  /** Lets time run, from the start again if it had reached the end. */
  play() {
    if (this.playing || this.#trajectory === null) return;
    this.#clock.play();
    this.#changed('play');
  }

  /** Holds the pose. */
  pause() {
    if (!this.playing) return;
    this.#clock.pause();
    this.#changed('pause');
  }

  /** Plays from the start. */
  replay() {
    this.#clock.restart();
    this.#before = NaN;
    this.#changed('restart');
  }

  /** @param {number} time seconds, clamped to the trajectory */
  seek(time) {
    this.#clock.seek(time);
    this.#changed('seek');
  }

  /** @param {number} speed seconds of the response per second; the nearest of SPEEDS is taken */
  setSpeed(speed) {
    this.#clock.setSpeed(speed);
    this.#changed('speed');
  }

  /** @param {boolean} loop whether the end is followed by the start */
  setLoop(loop) {
    this.#clock.setLoop(loop);
    this.#changed('loop');
  }

  /**
   * Lets time run as another window's does; nobody is told of it.
   * @param {Snapshot} snapshot @param {number} [elapsed] seconds since it was taken
   */
  follow(snapshot, elapsed = 0) {
    if (this.#trajectory === null) {
      this.#awaited = { snapshot, since: performance.now() - 1000 * elapsed };
      return;
    }
    this.#clock.apply(snapshot, elapsed);
    this.#before = NaN;
    this.#run();
  }

  /**
   * Shows a pose of somebody else's making, until there is none.
   * @param {{messages: SceneMessage[], psi: number}|null} pose viser's messages; the yaw angle, radians
   */
  live(pose) {
    this.#live = pose;
    if (pose) this.#move();
    else this.#show(); // the figures are the trajectory's again, too
  }

  /** @param {boolean} seen whether the scene is drawn at all; where it is not, nothing moves in it */
  setSeen(seen) {
    if (seen === this.#seen) return;
    this.#seen = seen;
    this.#move();
  }

  /** @param {boolean} dark whether the scene stands on a dark ground */
  setTheme(dark) {
    this.#dark = dark;
    this.#link.post({ kind: 'theme', dark });
    this.#link.send(themeMessages(dark));
    this.#move();
  }

  /** @param {Limits} limits what the motors give at most and where pitch stops */
  setLimits(limits) {
    this.#limits = limits;
    this.#move();
  }

  /** @param {Flight[]} flights who flies beside the rig */
  setFlights(flights) {
    this.#flights = flights;
    this.#move();
  }

  /** @param {RigView} view what cameras need to know of the rig that is shown: another rig is looked at as at first */
  setView(view) {
    const other = this.#view !== null && view !== this.#view;
    this.#view = view;
    this.#aim(other && this.#camera === 'free' ? 'home' : this.#camera, true);
  }

  /** @param {CameraName} camera where the rig is looked at from, from now on */
  setCamera(camera) {
    this.#camera = camera;
    this.#aim(camera, true);
  }

  /** Looks at the rig as at first, and leaves the camera to the viewer. */
  resetCamera() {
    this.#camera = 'free';
    this.#aim('home', true);
  }

  /** Looks from where it was to be looked from in a picture of another shape. */
  resized() {
    this.#aim(this.#camera, true);
  }

  /** Stops and lets go of the page's events. */
  destroy() {
    this.#clock.pause();
    cancelAnimationFrame(this.#request);
    this.#link.destroy();
    document.removeEventListener('visibilitychange', this.#visibility);
  }

  /** @param {Cause} cause */
  #changed(cause) {
    this.#onTransport(this.#clock.snapshot(), cause); // before it is shown: who listens may correct what is not as told
    this.#run(cause !== 'load' || !this.playing); // a drag's responses come faster than frames
  }

  /** Asks for frames while time runs. @param {boolean} [atOnce] whether the pose is not left to the next one */
  #run(atOnce = true) {
    cancelAnimationFrame(this.#request);
    if (this.playing) this.#request = requestAnimationFrame(this.#tick);
    else this.#before = NaN;
    if (atOnce) this.#show();
    this.#report();
  }

  /** @param {number} now milliseconds */
  #tick = (now) => {
    const step = Number.isNaN(this.#before) ? 0 : (now - this.#before) / 1000;
    this.#before = now;
    const ended = this.#clock.advance(Math.min(step, LONGEST_STEP));
    if (this.playing) this.#request = requestAnimationFrame(this.#tick);
    this.#show();
    if (ended) this.#report();
  };

  /** A hidden page gets no frames; its time stands still meanwhile. */
  #visibility = () => {
    this.#before = NaN;
  };

  /** Tells a scene that was built anew all that it has to know. */
  #retell() {
    if (this.#dark !== null) this.setTheme(this.#dark);
    else this.#move();
    this.#aim(this.#camera, true);
  }

  /** @param {CameraName | "home"} camera @param {boolean} again also where the viewer has moved it since */
  #aim(camera, again) {
    const psi = (this.#live ?? (this.#trajectory && sampleTrajectory(this.#trajectory, this.time)))?.psi ?? 0;
    const aspect = this.#link.aspect || undefined;
    const pose = this.#view && cameraPose(camera, this.#view, { aspect, psi });
    if (pose) this.#link.send(cameraMessages(pose), { again });
  }

  #show() {
    if (this.#trajectory === null || this.#live) return;
    this.#onFrame(sampleTrajectory(this.#trajectory, this.time));
    this.#move();
  }

  /** Sends the pose at the present time, as far as the scene does not show it already. */
  #move() {
    if (!this.#seen) return;
    const messages = this.#live?.messages ?? (this.#trajectory && this.#posed(this.#trajectory));
    if (!messages) return;
    this.#link.send(messages);
    if (this.#camera === 'follow') this.#aim('follow', false);
  }

  /** @param {Trajectory} trajectory */
  #posed(trajectory) {
    const sample = sampleTrajectory(trajectory, this.time);
    const { pitch, yaw } = this.#angles;
    const [pitchRotor, yawRotor] = interpolate(trajectory.t, [pitch, yaw], this.time);
    const { reference } = trajectory;
    const pose = { ...sample, pitchRotor, yawRotor, reference, limits: this.#limits, dark: this.#dark === true };
    return [...poseMessages(pose), ...ghostMessages(this.#flights, this.time)];
  }

  #report() {
    const { playing, time, duration, speed, loop } = this.#clock;
    this.#onState({ playing, time, duration, speed, loop, ready: this.#link.ready, reason: this.#link.reason });
  }
}
