/** What is chosen over the scene: where the rig is looked at from, who flies beside it, whether it is drawn. */
import { Choice, h, recall, remember } from '../ui/index.js';
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
    this.reset = h(
      'button',
      {
        type: 'button',
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
    const toggle = (/** @type {string} */ name, /** @type {boolean} */ standard) => {
      const box = h('input', {
        type: 'checkbox',
        'data-testid': name,
        checked: (recall(name) ?? String(standard)) === 'true',
        onchange: () => {
          remember(name, String(box.checked));
          onFlights();
        },
      });
      return box;
    };
    this.linear = toggle(LINEAR, false);
    this.pins = toggle(PINS, true);
    this.seen = h('input', { type: 'checkbox', checked: true, 'data-testid': 'show-scene', onchange: onSeen });
    this.pinsLabel = h(
      'label',
      { class: 'check', title: 'Pinned designs fly beside the rig as ghosts', hidden: true },
      this.pins,
      'pins',
    );
    const views = h('div', { class: 'scene-views' }, this.cameras.node, this.reset);
    this.drawn = [
      views,
      h(
        'label',
        { class: 'check', title: 'Show the linear model beside the rig, as a wire frame' },
        this.linear,
        'linear',
      ),
      this.pinsLabel,
    ];
    this.node = h(
      'div',
      { class: 'scene-controls' },
      this.drawn,
      h('label', { class: 'check', title: 'Draw the rig. Switch it off if graphics are slow.' }, this.seen, '3D'),
    );
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
