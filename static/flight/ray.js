/**
 * Rays through the scene's picture, and the rig that they meet: points in metres, z up, x towards the nose at ψ = 0;
 * the picture's own places run from −1 to 1, to the right and up. Pure.
 * @typedef {import('./camera.js').Point} Point
 * @typedef {import('./camera.js').SceneCamera} SceneCamera
 * @typedef {{from: Point, along: Point}} Ray along has length 1
 * @typedef {{pitch: number, yaw: number}} Rotors
 * @typedef {import('../scene/cameras.js').RigView & {arms: Rotors, offsets: Rotors, guard: number, wall: number}} Shape
 *   what GET scene/rigs tells of a rig
 * @typedef {{theta: number, psi: number}} Attitude rad
 */

/** Half of what a hand can hold of the beam, m. */
const BEAM = 0.035;

/** @param {Point} a @param {Point} b */
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
/** @param {Point} a @param {Point} b @returns {Point} */
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
/** a + s b @param {Point} a @param {Point} b @param {number} [s] @returns {Point} */
export const plus = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
/** @param {Point} a @param {Point} b */
export const minus = (a, b) => plus(a, b, -1);
/** @param {Point} a */
export const length = (a) => Math.hypot(...a);

/** The camera's axes: ahead, to the right, and up in its picture, each of length 1. @param {SceneCamera} camera */
function axesOf({ position, ahead, above }) {
  const forward = minus(ahead, position);
  const up = minus(above, position);
  return { forward, up, right: cross(forward, up) };
}

/**
 * What a place in the picture may show.
 * @param {SceneCamera} camera @param {number} x @param {number} y @returns {Ray}
 */
export function rayThrough(camera, x, y) {
  const { forward, up, right } = axesOf(camera);
  const high = Math.tan(camera.fov / 2);
  const along = plus(plus(forward, right, x * high * camera.aspect), up, y * high);
  const size = length(along);
  return { from: camera.position, along: [along[0] / size, along[1] / size, along[2] / size] };
}

/**
 * Where a point is seen in the picture; null behind the camera.
 * @param {SceneCamera} camera @param {Point} point
 */
export function seenAt(camera, point) {
  const { forward, up, right } = axesOf(camera);
  const away = minus(point, camera.position);
  const depth = dot(away, forward);
  if (depth <= 1e-6) return null;
  const high = depth * Math.tan(camera.fov / 2);
  return { x: dot(away, right) / (high * camera.aspect), y: dot(away, up) / high, depth };
}

/**
 * Where a ray meets a plane; null where it does not.
 * @param {Ray} ray @param {Point} through @param {Point} normal
 */
export function meets({ from, along }, through, normal) {
  const slope = dot(along, normal);
  const far = Math.abs(slope) < 1e-9 ? -1 : dot(minus(through, from), normal) / slope;
  return far > 0 ? plus(from, along, far) : null;
}

/**
 * The body's axes in the scene: to the nose, to the left, and to the top. The nose is where the model's centre of mass
 * is: positive pitch lifts it, positive yaw turns it clockwise as seen from above.
 * @param {Attitude} attitude @returns {{nose: Point, left: Point, top: Point}}
 */
export function bodyAxes({ theta, psi }) {
  const [ct, st, cp, sp] = [Math.cos(theta), Math.sin(theta), Math.cos(psi), Math.sin(psi)];
  return { nose: [cp * ct, -sp * ct, st], left: [sp, cp, 0], top: [-st * cp, st * sp, ct] };
}

/**
 * From a point of the body to where it is in the scene.
 * @param {Point} own in the body's axes, from the pitch axle @param {Shape} rig @param {Attitude} attitude
 */
export function placed(own, rig, attitude) {
  const { nose, left, top } = bodyAxes(attitude);
  return plus(plus(plus([0, 0, rig.pivot_height], nose, own[0]), left, own[1]), top, own[2]);
}

/**
 * Which point of the body a ray takes hold of: of a rotor in its guard, or of the beam between the rotors and what is
 * close to it; the nearest to the eye. In the body's axes; null where it takes hold of nothing.
 * @param {Ray} ray @param {Shape} rig @param {Attitude} attitude
 * @param {number} [blunt] how far from the beam a hand still holds it, rad as the eye sees it
 * @returns {Point|null}
 */
export function caught({ from, along }, rig, attitude, blunt = 0) {
  const { nose, left, top } = bodyAxes(attitude);
  const away = minus(from, [0, 0, rig.pivot_height]);
  /** @param {Point} v @returns {Point} */
  const own = (v) => [dot(v, nose), dot(v, left), dot(v, top)];
  const ray = { from: own(away), along: own(along) };
  /** @type {{far: number, at: Point}[]} */ const found = [];
  const { arms, offsets, guard, wall } = rig;
  const disks = /** @type {[Point, Point][]} */ ([
    [
      [arms.pitch, 0, offsets.pitch],
      [0, 0, 1],
    ],
    [
      [arms.yaw, offsets.yaw, 0],
      [0, 1, 0],
    ],
  ]);
  for (const [middle, normal] of disks)
    for (const off of [0, wall / 2, -wall / 2]) {
      // the guard's middle, or else an end of its wall
      const centre = plus(middle, normal, off);
      const at = meets(ray, centre, normal);
      if (!at || length(minus(at, centre)) > guard) continue;
      found.push({ far: length(minus(at, ray.from)), at });
      break;
    }
  const beam = nearestOnBeam(ray, rig.arms);
  if (beam && beam.apart <= Math.max(BEAM, blunt * beam.far)) found.push({ far: beam.far, at: [beam.x, 0, 0] });
  return found.sort((a, b) => a.far - b.far)[0]?.at ?? null;
}

/**
 * The point x of the body's axis between the rotors that is closest to a ray in the body's axes; null behind the eye.
 * @param {Ray} ray @param {{pitch: number, yaw: number}} arms
 */
function nearestOnBeam({ from, along }, arms) {
  const across = 1 - along[0] * along[0];
  const free = across < 1e-12 ? 0 : (from[0] - along[0] * dot(from, along)) / across;
  const x = Math.min(Math.max(free, arms.yaw), arms.pitch);
  const far = dot(minus([x, 0, 0], from), along);
  return far > 0 ? { x, far, apart: length(minus([x, 0, 0], plus(from, along, far))) } : null;
}

/**
 * What a force at a point of the body does about both axes, N·m: as θ and ψ count.
 * @param {Point} force N, in the scene's axes @param {Point} own in the body's @param {Shape} rig
 * @param {Attitude} attitude
 */
export function torquesOf(force, own, rig, attitude) {
  const arm = minus(placed(own, rig, attitude), [0, 0, rig.pivot_height]);
  const torque = cross(arm, force);
  return { theta: -dot(torque, bodyAxes(attitude).left), psi: -torque[2] };
}
