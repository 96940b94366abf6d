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
 * What the motors give at most, in volts, and where pitch stops, in radians; absent: no limit.
 * @typedef {Partial<import('../contract.js').Limits>} Limits
 *
 * What the scene shows: a sample, the propellers' angles in radians, the reference, the limits.
 * Rotors that lag, or have lost thrust, push as if their motors had had other voltages for long: those are `thrust`.
 * @typedef {Sample & {pitchRotor?: number, yawRotor?: number, limits?: Limits, dark?: boolean,
 *   thrust?: readonly [pitch: number, yaw: number], reference?: {theta: number, psi: number}}} Pose
 */

/** @typedef {{type: string, name: string, [key: string]: unknown}} SceneMessage */

const YOKE = '/rig/yoke';
const BODY = '/rig/yoke/body';
const GHOST = '/ghost';

/** Propeller speed per volt, rad/(s V): far below the true one, which a screen cannot show. */
export const ROTOR_SCALE = 1.7;
/** Volts above which the eye sees a disk instead of blades. */
const BLUR_VOLTAGE = 5;
/** Radians by which the reference must differ from the pose for its ghost to be drawn. */
const GHOST_DISTANCE = 0.012;
/** Length of a thrust arrow per volt, in metres: thrust is proportional to voltage in the model. */
export const THRUST_SCALE = 0.0065;
/** Of an arrow's head, in metres, as app/scene/graphics.py makes it. */
const HEAD_LENGTH = 0.026;
/** Volts below which no arrow is drawn. */
const LEAST_VOLTAGE = 0.05;
/** Volts from a limit at which a motor counts as being at it; the integrator stops there exactly. */
export const AT_LIMIT = 1e-3;

/** @typedef {[number, number, number]} Color red, green and blue, 0…255 */

/** What is drawn in one colour, by theme. @type {Record<"light" | "dark", Record<string, Color>>} */
const COLORS = {
  light: {
    scale: [78, 86, 96],
    pitch: [185, 74, 44],
    yaw: [23, 74, 114],
    stop: [190, 30, 30],
    thrust: [22, 128, 84],
    reference: [79, 123, 166],
  },
  dark: {
    scale: [205, 212, 220],
    pitch: [244, 144, 111],
    yaw: [116, 184, 236],
    stop: [255, 84, 76],
    thrust: [96, 214, 150],
    reference: [140, 184, 230],
  },
};

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
export function turn(name, axis, angle) {
  const c = Math.cos(angle / 2);
  const s = Math.sin(angle / 2);
  const wxyz = axis === 'y' ? [c, 0, s, 0] : [c, 0, 0, s];
  return { type: 'SetOrientationMessage', name, wxyz, owner: '' };
}

/**
 * @param {string} name @param {boolean} visible
 * @returns {SceneMessage}
 */
export function show(name, visible) {
  return { type: 'SetSceneNodeVisibilityMessage', name, visible, owner: '' };
}

/**
 * @param {string} name @param {Record<string, unknown>} updates properties of a node
 * @returns {SceneMessage}
 */
export function change(name, updates) {
  return { type: 'SceneNodeUpdateMessage', name, updates, owner: '' };
}

/**
 * Where a node's message belongs: two with the same slot overwrite each other.
 * @param {SceneMessage} message
 */
export function slotOf({ type, name, updates }) {
  return `${type} ${name} ${updates ? Object.keys(updates) : ''}`;
}

/** @param {boolean | undefined} dark */
const colors = (dark) => COLORS[dark ? 'dark' : 'light'];

/** The ground's grid, and how dark shadows fall on it. */
const GROUND = {
  light: { cell_color: [196, 200, 206], section_color: [176, 181, 188], shadow_opacity: 0.3 },
  dark: { cell_color: [66, 74, 84], section_color: [88, 97, 109], shadow_opacity: 0.6 },
};

/**
 * Returns the messages that give the ground and the drawing about the rig their colours.
 * @param {boolean} dark @returns {SceneMessage[]}
 */
export function themeMessages(dark) {
  const { scale, pitch, yaw, stop, reference } = colors(dark);
  return [
    change('/ground', GROUND[dark ? 'dark' : 'light']),
    ...['/rig/scale', `${YOKE}/pitch_scale`].map((name) => change(name, { color: scale })),
    change(`${BODY}/pointer`, { color: pitch }),
    change(`${YOKE}/pointer`, { color: yaw }),
    ...['stop_up', 'stop_down'].map((name) => change(`${YOKE}/${name}`, { color: stop })),
    ...['', '/body'].map((part) => change(`${GHOST}/yoke${part}/shape`, { color: reference })),
  ];
}

/**
 * Returns the messages that draw a rotor's thrust: as long as it is large, red and capped where the motor gives all it
 * can.
 * @param {string} node @param {number} volts that give it @param {boolean} full @param {boolean} [dark]
 * @returns {SceneMessage[]}
 */
function thrustMessages(node, volts, full, dark) {
  const size = Math.abs(volts);
  return ['positive', 'negative'].flatMap((sign) => {
    const arrow = `${node}_${sign}`;
    const drawn = size > LEAST_VOLTAGE && volts > 0 === (sign === 'positive');
    if (!drawn) return [show(arrow, false)];
    const { stop, thrust } = colors(dark);
    const color = full ? stop : thrust;
    const length = size * THRUST_SCALE;
    const head = Math.min(1, length / (1.25 * HEAD_LENGTH));
    const neck = length - head * HEAD_LENGTH;
    return [
      show(arrow, true),
      change(`${arrow}/shaft`, { scale: [1, 1, Math.max(neck, 1e-4)] }),
      change(`${arrow}/shaft`, { color }),
      { type: 'SetPositionMessage', name: `${arrow}/head`, position: [0, 0, neck], owner: '' },
      change(`${arrow}/head`, { scale: [head, head, head] }),
      change(`${arrow}/head`, { color }),
      show(`${arrow}/cap`, full),
      { type: 'SetPositionMessage', name: `${arrow}/cap`, position: [0, 0, neck], owner: '' },
    ];
  });
}

/**
 * Returns the messages that put the travel stops where the design has them.
 * @param {number | undefined} limit radians @returns {SceneMessage[]}
 */
function stopMessages(limit) {
  return [
    ['stop_up', -1],
    ['stop_down', 1],
  ].flatMap(([name, side]) => {
    const node = `${YOKE}/${name}`;
    if (limit === undefined) return [show(node, false)];
    return [show(node, true), turn(node, 'y', Number(side) * limit)];
  });
}

/**
 * Returns viser's messages that put the rig into a pose. With z up and x towards the nose, positive yaw turns clockwise
 * seen from above and positive pitch lifts the nose: both turns are negative.
 * @param {Pose} pose
 * @returns {SceneMessage[]}
 */
export function poseMessages(pose) {
  const { theta, psi, V_p, V_y, thrust = [V_p, V_y], reference, limits = {}, dark } = pose;
  const messages = [turn(YOKE, 'z', -psi), turn(BODY, 'y', -theta), ...stopMessages(limits.theta)];
  const rotors = /** @type {const} */ ([
    ['pitch', 'z', pose.pitchRotor, V_p, thrust[0], limits.V_p],
    ['yaw', 'y', pose.yawRotor, V_y, thrust[1], limits.V_y],
  ]);
  for (const [name, axis, angle = 0, volts, pushes, limit = Infinity] of rotors) {
    const fast = Math.abs(volts) > BLUR_VOLTAGE;
    for (const [part, seen] of /** @type {const} */ ([
      ['rotor', !fast],
      ['blur', fast],
    ])) {
      messages.push(turn(`${BODY}/${name}_${part}`, axis, angle), show(`${BODY}/${name}_${part}`, seen));
    }
    messages.push(...thrustMessages(`${BODY}/${name}_thrust`, pushes, Math.abs(volts) >= limit - AT_LIMIT, dark));
  }
  const away = reference !== undefined && Math.hypot(reference.theta - theta, reference.psi - psi) > GHOST_DISTANCE;
  messages.push(show(GHOST, away));
  if (away) {
    messages.push(turn(`${GHOST}/yoke`, 'z', -reference.psi));
    messages.push(turn(`${GHOST}/yoke/body`, 'y', -reference.theta));
  }
  return messages;
}
