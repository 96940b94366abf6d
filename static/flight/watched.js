/**
 * A flight in the session's other windows: some twenty times in a second each is sent where the rig has been since, and
 * plays it a moment later (scene/window.js). They are in the room that the scene's windows share, so nothing is sent
 * where nobody watches.
 * @typedef {ReturnType<typeof import('./scene_feed.js').sampleOf>} Sample
 */

/** ms between two messages; the room passes on no more. */
const EVERY_MS = 50;
/** Without motion they are told so, so that who has just come sees the rig. */
const STILL_MS = 500;
const COURSES = /** @type {const} */ (['t', 'theta', 'psi', 'V_p', 'V_y']);

export class Watched {
  /** Poses since the last message. @type {{t: number, theta: number, psi: number, V_p: number, V_y: number}[]} */
  #poses = [];
  #sent = -Infinity;

  /** @param {import('../scene/sharing.js').SceneSharing} sharing */
  constructor(sharing) {
    this.sharing = sharing;
  }

  /**
   * A frame of the flight.
   * @param {Sample} sample @param {number} time  of the flight, s @param {number} now  ms
   * @param {number} speed  seconds of flight per second; 0: it stands still
   */
  put({ reference, thrust: _pushes, ...sample }, time, now, speed) {
    const last = this.#poses.at(-1);
    if (!this.sharing.hub.others) return;
    if (!last || last.t < time) this.#poses.push({ t: time, ...sample });
    else if (last.t > time) this.#poses = [{ t: time, ...sample }]; // it was rewound
    const fresh = this.#poses.length > 1;
    if (now - this.#sent < (fresh ? EVERY_MS : STILL_MS)) return;
    this.#sent = now;
    const poses = fresh ? this.#poses : [{ ...this.#poses[0], t: time - 1e-3 }, this.#poses[0]];
    const series = Object.fromEntries(
      COURSES.map((name) => [name, Float32Array.from(poses, (pose) => pose[name] - (name === 't' ? poses[0].t : 0))]),
    );
    const motion = /** @type {import('../types.js').Step} */ (/** @type {unknown} */ ({ ...series, reference }));
    this.sharing.tell(motion, { flight: { from: poses[0].t, speed } });
    this.#poses = this.#poses.slice(-1);
  }

  /** The flight is over, or out of sight. */
  leave() {
    this.#poses = [];
    this.#sent = -Infinity;
  }
}
