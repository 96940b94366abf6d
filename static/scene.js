// The page's side of the scene: plays a trajectory in real time and moves the rig's nodes.
import { interpolate, poseMessages, rotorAngles, sampleTrajectory } from "./scene_pose.js";

/** @typedef {import("./scene_pose.js").Trajectory} Trajectory */
/** @typedef {import("./scene_pose.js").Sample} Sample */

/**
 * @typedef {object} PlayerState
 * @property {boolean} playing
 * @property {number} time seconds
 * @property {number} duration seconds
 * @property {boolean} ready whether the scene shows the rig
 * @property {string} reason why it does not, where the server said so
 */

const CHANNEL = "heli2dof-scene";
/** Longest step of the clock in seconds: a stalled page goes on where it was. */
const LONGEST_STEP = 1;

/** Plays a trajectory in the scene of a frame, in real time. */
export class ScenePlayer {
  /**
   * @param {HTMLIFrameElement} iframe shows /scene/{session}/ of the same origin
   * @param {{onFrame?: (sample: Sample) => void, onState?: (state: PlayerState) => void}} [hooks]
   *   onFrame is called in each animation frame and at each jump; onState when anything else changes
   */
  constructor(iframe, { onFrame = () => {}, onState = () => {} } = {}) {
    this.#iframe = iframe;
    this.#onFrame = onFrame;
    this.#onState = onState;
    window.addEventListener("message", this.#listen);
    document.addEventListener("visibilitychange", this.#visibility);
    this.#post({ kind: "hello" }); // The scene may have been ready before the player.
  }

  /** @type {HTMLIFrameElement} */
  #iframe;
  /** @type {(sample: Sample) => void} */
  #onFrame;
  /** @type {(state: PlayerState) => void} */
  #onState;
  /** @type {Trajectory | null} */
  #trajectory = null;
  /** @type {{pitch: Float64Array, yaw: Float64Array}} */
  #angles = { pitch: new Float64Array(0), yaw: new Float64Array(0) };
  #time = 0;
  #playing = false;
  #ready = false;
  /** Whether the scene holds the rig's nodes: also while its connection is lost. */
  #drawn = false;
  #reason = "";
  /** @type {boolean | null} */
  #dark = null;
  /** The clock's last reading in milliseconds; NaN after a pause. */
  #clock = NaN;
  #request = 0;
  /** @type {Map<string, string>} What each node was told last. */
  #sent = new Map();

  /** Seconds since the step. */
  get time() {
    return this.#time;
  }

  /** Whether time runs. */
  get playing() {
    return this.#playing;
  }

  /** Seconds; 0 without a trajectory. */
  get duration() {
    const t = this.#trajectory?.t;
    return t === undefined ? 0 : t[t.length - 1];
  }

  /**
   * Shows another response. Time starts again from 0 unless it is kept; whether it runs is kept.
   * @param {Trajectory} trajectory @param {{keepTime?: boolean}} [options]
   */
  load(trajectory, { keepTime = false } = {}) {
    this.#trajectory = trajectory;
    this.#angles = rotorAngles(trajectory);
    this.#time = keepTime ? Math.min(this.#time, this.duration) : 0;
    this.#show();
    this.#report();
  }

  /** Lets time run, from the start again if it had reached the end. */
  play() {
    if (this.#playing || this.#trajectory === null) return;
    if (this.#time >= this.duration) this.#time = 0;
    this.#playing = true;
    this.#clock = NaN;
    this.#next();
    this.#report();
  }

  /** Holds the pose. */
  pause() {
    if (!this.#playing) return;
    this.#playing = false;
    cancelAnimationFrame(this.#request);
    this.#report();
  }

  /** Plays from the start. */
  replay() {
    this.#time = 0;
    this.#clock = NaN;
    this.#show();
    if (this.#playing) this.#report();
    else this.play();
  }

  /** @param {number} time seconds, clamped to the trajectory */
  seek(time) {
    this.#time = Math.min(Math.max(time, 0), this.duration);
    this.#show();
    this.#report();
  }

  /** @param {boolean} dark whether the scene stands on a dark ground */
  setTheme(dark) {
    this.#dark = dark;
    this.#post({ kind: "theme", dark });
  }

  /** Stops and lets go of the page's events. */
  destroy() {
    this.#playing = false;
    cancelAnimationFrame(this.#request);
    window.removeEventListener("message", this.#listen);
    document.removeEventListener("visibilitychange", this.#visibility);
  }

  #next() {
    this.#request = requestAnimationFrame(this.#tick);
  }

  /** @param {number} now milliseconds */
  #tick = (now) => {
    if (!this.#playing) return;
    const step = Number.isNaN(this.#clock) ? 0 : (now - this.#clock) / 1000;
    this.#clock = now;
    this.#time = Math.min(this.#time + Math.min(Math.max(step, 0), LONGEST_STEP), this.duration);
    const ended = this.#time >= this.duration;
    if (ended) this.#playing = false;
    else this.#next();
    this.#show();
    if (ended) this.#report();
  };

  /** A hidden page gets no frames; its time stands still meanwhile. */
  #visibility = () => {
    this.#clock = NaN;
  };

  /** @param {MessageEvent} event */
  #listen = (event) => {
    const ours = event.source === this.#iframe.contentWindow && event.origin === location.origin;
    if (!ours || event.data?.channel !== CHANNEL) return;
    const { state, reason } = event.data;
    this.#ready = state === "ready";
    this.#drawn = this.#ready || (this.#drawn && state === "closed");
    this.#reason = reason ?? "";
    // The scene was built anew and has forgotten what it was told.
    if (this.#ready) {
      this.#sent.clear();
      if (this.#dark !== null) this.setTheme(this.#dark);
      this.#move();
    }
    this.#report();
  };

  #show() {
    if (this.#trajectory === null) return;
    this.#onFrame(sampleTrajectory(this.#trajectory, this.#time));
    this.#move();
  }

  /** Sends the pose at the present time, as far as the scene does not show it already. */
  #move() {
    const trajectory = this.#trajectory;
    if (trajectory === null || !this.#drawn) return;
    const sample = sampleTrajectory(trajectory, this.#time);
    const { pitch, yaw } = this.#angles;
    const [pitchRotor, yawRotor] = interpolate(trajectory.t, [pitch, yaw], this.#time);
    const pose = { ...sample, pitchRotor, yawRotor, reference: trajectory.reference };
    const messages = poseMessages(pose).filter((message) => {
      const key = `${message.type} ${message.name}`;
      const value = JSON.stringify(message);
      if (this.#sent.get(key) === value) return false;
      this.#sent.set(key, value);
      return true;
    });
    if (messages.length > 0) this.#post({ kind: "pose", messages });
  }

  /** @param {object} message */
  #post(message) {
    this.#iframe.contentWindow?.postMessage({ channel: CHANNEL, ...message }, location.origin);
  }

  #report() {
    this.#onState({
      playing: this.#playing,
      time: this.#time,
      duration: this.duration,
      ready: this.#ready,
      reason: this.#reason,
    });
  }
}
