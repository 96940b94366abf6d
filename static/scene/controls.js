/** What is chosen over the scene: where the rig is looked at from, who flies beside it, whether it is drawn. */
import { button, check, Choice, h, recall, remember } from '../ui/index.js';
import { cameraNamed, CAMERAS } from './cameras.js';

/** @typedef {import('./cameras.js').CameraName} CameraName */
const [CAMERA, LINEAR, PINS] = ['camera', 'fly-linear', 'fly-pins'];

export class SceneControls {
  /**
   * @param {{onCamera: (camera: CameraName) => void, onReset: () => void, onFlights: () => void, onSeen: () => void}}
   *   handlers
   */
  constructor({ onCamera, onReset, onFlights, onSeen }) {
    this.#onCamera = onCamera;
    this.camera = cameraNamed(recall(CAMERA));
    this.cameras = new Choice({
      label: 'Camera',
      testid: 'camera',
      options: CAMERAS,
      onChange: (name) => this.#choose(cameraNamed(name)),
    });
    this.cameras.set(this.camera);
    this.reset = button(
      {
        class: 'quiet',
        title: 'Look at the rig as at first',
        'aria-label': 'Reset the camera',
        'data-testid': 'camera-reset',
        onclick: () => {
          this.freed();
          onReset();
        },
      },
      '⌂',
    );
    const flight = (
      /** @type {string} */ name,
      /** @type {boolean} */ standard,
      /** @type {string} */ title,
      /** @type {string} */ text,
    ) => {
      const { box, node } = check(
        {
          title,
          'data-testid': name,
          checked: (recall(name) ?? String(standard)) === 'true',
          onchange: () => {
            remember(name, String(box.checked));
            onFlights();
          },
        },
        text,
      );
      return { box, node };
    };
    const linear = flight(LINEAR, false, 'Show the linear model beside the rig, as a wire frame', 'linear');
    const pins = flight(PINS, true, 'Pinned designs fly beside the rig as ghosts', 'pins');
    const seen = check(
      {
        title: 'Draw the rig. Switch it off if graphics are slow.',
        checked: true,
        'data-testid': 'show-scene',
        onchange: onSeen,
      },
      '3D',
    );
    this.linear = linear.box;
    this.pins = pins.box;
    this.seen = seen.box;
    this.pinsLabel = pins.node;
    this.pinsLabel.hidden = true;
    this.drawn = [h('div', { class: 'scene-views' }, this.cameras.node, this.reset), linear.node, pins.node];
    this.node = h('div', { class: 'scene-controls' }, this.drawn, seen.node);
  }

  /** @type {(camera: CameraName) => void} */
  #onCamera;

  /** @param {CameraName} camera */
  #choose(camera) {
    this.camera = camera;
    remember(CAMERA, camera);
    this.#onCamera(camera);
  }

  /** The viewer has moved the camera. */
  freed() {
    if (this.camera === 'free') return;
    this.cameras.set('free');
    this.#choose('free');
  }

  /** @param {boolean} any whether there are pins @param {boolean} drawn whether the rig is drawn */
  render(any, drawn) {
    for (const node of this.drawn) node.hidden = !drawn || (node === this.pinsLabel && !any);
  }
}
