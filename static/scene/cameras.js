// Where the scene is looked at from: positions in metres, z up, from what the server tells of the rig. Pure.

/** @typedef {[number, number, number]} Point */
/**
 * What GET scene/rigs tells of a rig, in metres and radians.
 * @typedef {{pivot_height: number, reach: number, outer: number,
 *   view: {position: Point, look_at: Point, fov: number}}} RigView
 * @typedef {"free" | "front" | "side" | "top" | "follow"} CameraName
 */

/** Name, text, explanation. @type {[CameraName, string, string][]} */
export const CAMERAS = [
  [
    'free',
    'free',
    'turn with the mouse, move with the right button, come closer with the wheel, with Ctrl where the page scrolls',
  ],
  ['front', 'front', 'from ahead: yaw turns the nose to the left'],
  ['side', 'side', 'from the right: pitch lifts the nose'],
  ['top', 'top', 'from above, the nose up at ψ = 0'],
  ['follow', 'follow', 'turns with the body, so that pitch is seen from the side whatever the yaw'],
];

/** @param {unknown} name @returns {CameraName} */
export function cameraNamed(name) {
  return CAMERAS.find(([known]) => known === name)?.[0] ?? 'free';
}

/**
 * @param {CameraName | "home"} name home: the first view @param {RigView} rig
 * @param {{aspect?: number, psi?: number}} [how] the picture's width by its height; the yaw angle, radians
 * @returns {{position: Point, lookAt: Point} | null} null where the viewer moves the camera
 */
export function cameraPose(name, rig, { aspect = 1.25, psi = 0 } = {}) {
  if (name === 'free') return null;
  const { view, outer, pivot_height: pivot } = rig;
  if (name === 'home') return { position: view.position, lookAt: view.look_at };
  const tall = 0.5 * (pivot + outer * 0.68);
  const away = (/** @type {number} */ wide, /** @type {number} */ high) =>
    (1.06 * Math.max(high, wide / aspect)) / Math.tan(view.fov / 2);
  const middle = 0.94 * tall;
  if (name === 'front') {
    const d = away(outer, tall) + 0.5 * outer;
    return { position: [d, 0, middle + 0.3 * d], lookAt: [0, 0, 0.9 * middle] };
  }
  if (name === 'side') {
    const d = away(outer, tall) + 0.65 * outer;
    return { position: [0, -d, middle + 0.1 * d], lookAt: [0, 0, middle] };
  }
  if (name === 'top') {
    // A little to the rear, as from straight above no direction is up.
    return { position: [-1e-3, 0, pivot + away(outer, outer)], lookAt: [0, 0, 0] };
  }
  const d = away(outer, tall) + 0.8 * outer;
  const [x, y, z] = [-0.42 * d, -0.88 * d, middle + 0.3 * d];
  const [c, s] = [Math.cos(psi), Math.sin(psi)];
  return { position: [c * x + s * y, c * y - s * x, z], lookAt: [0, 0, middle] };
}

/**
 * Returns viser's messages that put the camera there.
 * @param {{position: Point, lookAt: Point}} pose
 */
export function cameraMessages({ position, lookAt }) {
  return [
    { type: 'SetCameraPositionMessage', position, initial: false, name: '' },
    { type: 'SetCameraLookAtMessage', look_at: lookAt, initial: false, name: '' },
  ];
}
