// The page's side of the scene: samples a trajectory in real time and moves the rig's nodes.

/**
 * A response: equally long series over time, absolute angles in radians, voltages in volts.
 * @typedef {object} Trajectory
 * @property {ArrayLike<number>} t seconds, increasing from 0
 * @property {ArrayLike<number>} theta
 * @property {ArrayLike<number>} psi
 * @property {ArrayLike<number>} V_p
 * @property {ArrayLike<number>} V_y
 * @property {{theta: number, psi: number}} [reference] radians; drawn as a ghost
 */

/**
 * @typedef {object} Sample
 * @property {number} t seconds
 * @property {number} theta radians
 * @property {number} psi radians
 * @property {number} V_p volts
 * @property {number} V_y volts
 */

/**
 * What the scene shows: a sample, the propellers' angles in radians and the reference.
 * @typedef {Sample & {pitchRotor?: number, yawRotor?: number,
 *   reference?: {theta: number, psi: number}}} Pose
 */

/**
 * @typedef {object} PlayerState
 * @property {boolean} playing
 * @property {number} time seconds
 * @property {number} duration seconds
 * @property {boolean} ready whether the scene shows the rig
 * @property {string} reason why it does not, where the server said so
 */

/** @typedef {{type: string, name: string, [key: string]: unknown}} SceneMessage */

const CHANNEL = "heli2dof-scene";
const YOKE = "/rig/yoke";
const BODY = "/rig/yoke/body";
const GHOST = "/ghost";

/** Propeller speed per volt, rad/(s V): far below the true one, which a screen cannot show. */
export const ROTOR_SCALE = 1.7;
/** Volts above which the eye sees a disk instead of blades. */
const BLUR_VOLTAGE = 5;
/** Radians by which the reference must differ from the pose for its ghost to be drawn. */
const GHOST_DISTANCE = 0.012;
/** Longest step of the clock in seconds: a stalled page goes on where it was. */
const LONGEST_STEP = 1;

/**
 * Returns the index of the last time not after `time`, at most the last but one.
 * @param {ArrayLike<number>} t @param {number} time
 */
function indexAt(t, time) {
  let low = 0;
  let high = t.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (t[middle] <= time) low = middle;
    else high = middle;
  }
  return low;
}

/**
 * Interpolates series linearly at one time; before the first and after the last point they rest.
 * @param {ArrayLike<number>} t @param {ArrayLike<number>[]} series @param {number} time
 * @returns {number[]}
 */
function interpolate(t, series, time) {
  const i = indexAt(t, time);
  const j = Math.min(i + 1, t.length - 1);
  const span = t[j] - t[i];
  const part = span > 0 ? Math.min(Math.max((time - t[i]) / span, 0), 1) : 0;
  return series.map((y) => y[i] + part * (y[j] - y[i]));
}

/**
 * Returns the response at one time in seconds, held at its ends.
 * @param {Trajectory} trajectory @param {number} time
 * @returns {Sample}
 */
export function sampleTrajectory(trajectory, time) {
  const { t, theta, psi, V_p, V_y } = trajectory;
  const at = Math.min(Math.max(time, t[0]), t[t.length - 1]);
  const [th, ps, vp, vy] = interpolate(t, [theta, psi, V_p, V_y], at);
  return { t: at, theta: th, psi: ps, V_p: vp, V_y: vy };
}

/**
 * Returns both propellers' angles in radians at each time: the voltages integrated by trapezoids.
 * @param {Trajectory} trajectory @param {number} [scale] rad/(s V)
 * @returns {{pitch: Float64Array, yaw: Float64Array}}
 */
export function rotorAngles(trajectory, scale = ROTOR_SCALE) {
  const { t, V_p, V_y } = trajectory;
  const pitch = new Float64Array(t.length);
  const yaw = new Float64Array(t.length);
  for (let k = 1; k < t.length; k += 1) {
    const half = (scale * (t[k] - t[k - 1])) / 2;
    pitch[k] = pitch[k - 1] + half * (V_p[k] + V_p[k - 1]);
    yaw[k] = yaw[k - 1] + half * (V_y[k] + V_y[k - 1]);
  }
  return { pitch, yaw };
}

/**
 * @param {string} name @param {"y" | "z"} axis @param {number} angle radians
 * @returns {SceneMessage}
 */
function turn(name, axis, angle) {
  const c = Math.cos(angle / 2);
  const s = Math.sin(angle / 2);
  const wxyz = axis === "y" ? [c, 0, s, 0] : [c, 0, 0, s];
  return { type: "SetOrientationMessage", name, wxyz, owner: "" };
}

/**
 * @param {string} name @param {boolean} visible
 * @returns {SceneMessage}
 */
function show(name, visible) {
  return { type: "SetSceneNodeVisibilityMessage", name, visible, owner: "" };
}

/**
 * Returns viser's messages that put the rig into a pose. With z up and x towards the nose, positive
 * yaw turns clockwise seen from above and positive pitch lifts the nose: both turns are negative.
 * @param {Pose} pose
 * @returns {SceneMessage[]}
 */
export function poseMessages(pose) {
  const { theta, psi, V_p, V_y, reference } = pose;
  const messages = [
    turn(YOKE, "z", -psi),
    turn(BODY, "y", -theta),
    turn(`${BODY}/pitch_rotor`, "z", pose.pitchRotor ?? 0),
    turn(`${BODY}/yaw_rotor`, "y", pose.yawRotor ?? 0),
    show(`${BODY}/pitch_blur`, Math.abs(V_p) > BLUR_VOLTAGE),
    show(`${BODY}/yaw_blur`, Math.abs(V_y) > BLUR_VOLTAGE),
  ];
  const away =
    reference !== undefined &&
    Math.hypot(reference.theta - theta, reference.psi - psi) > GHOST_DISTANCE;
  messages.push(show(GHOST, away));
  if (away) {
    messages.push(turn(`${GHOST}/yoke`, "z", -reference.psi));
    messages.push(turn(`${GHOST}/yoke/body`, "y", -reference.theta));
  }
  return messages;
}

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
