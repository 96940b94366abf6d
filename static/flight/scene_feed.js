/**
 * The rig of a flight in the scene: once per animation frame it stands as it flies now. Propellers turn with the speeds
 * of every tick that was flown, whatever the screen's rate; arrows are what they push with, lag and faults and all.
 * @typedef {{poses: typeof import('../scene/pose.js'), ghosts: typeof import('../scene/ghosts.js')}} SceneParts
 * @typedef {import('../scene/ghosts.js').Ghost} Ghost
 * @typedef {import('../scene/view.js').SceneView} SceneView
 */
import { degrees, fixed } from '../text/index.js';
import { INPUT, ROW } from '../kernel/index.js';
import { setText } from '../ui/index.js';

const { FLIGHT_ROW, STATE, VOLTAGE, SPEED, WISH } = ROW;
const MOTORS = /** @type {const} */ (['V_p', 'V_y']);

/** What of a row of a flight's course a scene shows. @param {ArrayLike<number>} rows @param {number} [at] of the row */
export const sampleOf = (rows, at = 0) => ({
  theta: rows[at + STATE],
  psi: rows[at + STATE + 1],
  V_p: rows[at + VOLTAGE],
  V_y: rows[at + VOLTAGE + 1],
  thrust: /** @type {[number, number]} */ ([rows[at + SPEED], rows[at + SPEED + 1]]),
  reference: { theta: rows[at + WISH], psi: rows[at + WISH + 1] },
});

/** Of a craft as it is now. @param {import('./craft.js').Craft} craft */
export function sampleNow({ theta, psi, volts: [V_p, V_y], speeds, u, reference }) {
  /** @type {[number, number]} */
  const thrust = [speeds[0] * u[INPUT.THRUST], speeds[1] * u[INPUT.THRUST + 1]];
  return { theta, psi, V_p, V_y, thrust, reference: { theta: reference[0], psi: reference[1] } };
}

export class SceneFeed {
  /** Angles of both propellers, rad. */ #rotors = [0, 0];
  #dark = matchMedia('(prefers-color-scheme: dark)');
  /** Who flies beside it. @type {Ghost[]} */ ghosts = [];

  /** @param {SceneView} scene @param {SceneParts} parts */
  constructor(scene, { poses, ghosts }) {
    this.scene = scene;
    this.poses = poses;
    this.parts = ghosts;
  }

  /** Turns the propellers by what was flown. @param {{rows: Float64Array, count: number, step: number}} flown */
  turn({ rows, count, step }) {
    for (let motor = 0; motor < 2; motor++) {
      let speeds = 0;
      for (let n = 0; n < count; n++) speeds += rows[n * FLIGHT_ROW + SPEED + motor];
      this.#rotors[motor] = (this.#rotors[motor] + this.poses.ROTOR_SCALE * step * speeds) % (2 * Math.PI);
    }
  }

  /** @param {ReturnType<typeof sampleOf>} sample @param {import('../scene/pose.js').Limits} [limits] */
  show(sample, limits = {}) {
    const [pitchRotor, yawRotor] = this.#rotors;
    const pose = { t: 0, ...sample, pitchRotor, yawRotor, limits, dark: this.#dark.matches };
    const messages = [...this.poses.poseMessages(pose), ...this.parts.ghostsAt(this.ghosts)];
    this.scene.player.live({ messages, psi: sample.psi });
    const { hud } = this.scene;
    setText(hud.theta, degrees(sample.theta));
    setText(hud.psi, degrees(sample.psi));
    for (const name of MOTORS) {
      const full = Math.abs(sample[name]) >= (limits[name] ?? Infinity) - this.poses.AT_LIMIT;
      setText(hud[name], `${fixed(sample[name], 1)} V${full ? ' limit' : ''}`);
      hud[name].classList.toggle('full', full);
    }
  }

  /** A colour as ghosts have it. @param {string} text of a style sheet, "#rrggbb" */
  colorOf(text) {
    return this.parts.rgb(text);
  }

  /** The scene shows again what the page plays. */
  leave() {
    this.scene.player.live(null);
  }
}
