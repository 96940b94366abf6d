/**
 * Where the scene is seen from: asked of the script in the scene's frame (scene/shim.js), which answers at once.
 * @typedef {[number, number, number]} Point metres, z up, x towards the nose at ψ = 0
 * @typedef {object} SceneCamera
 * @property {Point} position
 * @property {Point} ahead a point 1 m before it, in the picture's middle
 * @property {Point} above a point 1 m above it, as the picture has it
 * @property {number} fov vertical, rad
 * @property {number} aspect the picture's width by its height
 * @property {[left: number, top: number, width: number, height: number]} box the picture within the frame, CSS px
 *
 * As much of viser's client, and of three.js in it, as the shim asks:
 * @typedef {{x: number, y: number, z: number, clone: () => Vector, set: (x: number, y: number, z: number) => Vector}}
 *   Vector
 * @typedef {{localToWorld: (v: Vector) => Vector, worldToLocal: (v: Vector) => Vector}} Placed
 * @typedef {{canvas?: HTMLCanvasElement|null, nodeRefFromName?: Record<string, Placed|undefined>,
 *   camera?: (Placed & {position: Vector, fov: number, aspect: number})|null}} Viser
 */

const CHANNEL = 'heli2dof-scene';

/** Asks a frame for its camera. */
export class CameraOfScene {
  /** @type {SceneCamera|null} */ #told = null;

  /** @param {HTMLIFrameElement|null} frame shows /scene/{session}/; null: there is no scene */
  constructor(frame) {
    this.frame = frame;
    if (frame) window.addEventListener('message', this.#listen);
  }

  /** The camera now; null where the scene is not there, not drawn, or does not know it. */
  now() {
    const inside = this.frame?.hidden ? null : this.frame?.contentWindow;
    this.#told = null;
    if (inside) {
      const { origin } = location;
      const data = { channel: CHANNEL, kind: 'camera' };
      inside.dispatchEvent(new MessageEvent('message', { data, origin, source: window }));
    }
    return this.#told;
  }

  /** @param {MessageEvent} event */
  #listen = ({ source, origin, data }) => {
    const ours = source === this.frame?.contentWindow && origin === location.origin;
    if (ours && data?.channel === CHANNEL && data.camera) this.#told = data.camera;
  };
}
