// The rig's motion, without a frame: samples a trajectory and says how the scene's nodes stand. Pure.

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

/** @typedef {{type: string, name: string, [key: string]: unknown}} SceneMessage */

const YOKE = "/rig/yoke";
const BODY = "/rig/yoke/body";
const GHOST = "/ghost";

/** Propeller speed per volt, rad/(s V): far below the true one, which a screen cannot show. */
export const ROTOR_SCALE = 1.7;
/** Volts above which the eye sees a disk instead of blades. */
const BLUR_VOLTAGE = 5;
/** Radians by which the reference must differ from the pose for its ghost to be drawn. */
const GHOST_DISTANCE = 0.012;

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
export function interpolate(t, series, time) {
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
