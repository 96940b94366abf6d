/** Whether the rotors are placed, too, and where: the third pole of each axis, as numbers below the two pairs. */
import { say } from '../text/index.js';
import { lagOf, lags, LIMIT, presetOf, withRotorPole } from '../model/index.js';
import { check, designField, h, setText } from '../ui/index.js';

const AXES = /** @type {const} */ (['pitch', 'yaw']);

export class RotorPoles {
  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    const { box, node } = check(
      {
        'data-testid': 'place-rotors',
        'data-field': 'place_rotors',
        title:
          'Full rank on six states: the rotors’ speeds are fed back, and each axis has a third pole, its rotor’s. ' +
          'So the loop no longer lives by rotors that are fast.',
        onchange: () => store.edit((d) => ({ ...d, place_rotors: box.checked })),
      },
      'place the rotors, too',
    );
    this.box = box;
    this.fields = AXES.map((axis, i) =>
      designField(store, `rotor-pole-${i}`, (d, v) => withRotorPole(d, /** @type {0|1} */ (i), v), {
        label: `${axis} rotor pole ${i + 5}, rad/s`,
        mark: h('span', { class: axis }, `p${'₅₆'[i]}`),
        field: `rotor_poles.${i}`,
        min: -LIMIT,
        max: LIMIT,
      }),
    );
    this.aside = h('span', { class: 'aside' });
    this.node = h(
      'div',
      { class: 'row rotor-poles', role: 'group', 'aria-label': 'Rotors', hidden: true, 'data-testid': 'rotor-poles' },
      node,
      this.fields.map((field) => field.node),
      this.aside,
    );
    root.append(this.node);
  }

  /** @param {import('../types.js').State} state */
  render({ design, presets }) {
    if (!design) return;
    const preset = presetOf({ presets, design });
    const [pitch, yaw] = AXES.map((axis) => lagOf(design, preset, axis));
    const able = pitch > 0 && yaw > 0;
    this.node.hidden = !lags(design, preset) && !design.place_rotors;
    this.box.checked = design.place_rotors;
    this.box.disabled = !able && !design.place_rotors;
    this.fields.forEach((field, i) => {
      field.node.hidden = !design.place_rotors;
      field.set(design.rotor_poles[i]);
    });
    const tau = pitch === yaw ? `${pitch} s` : `${pitch} s, ${yaw} s`;
    const why = say`The ${pitch ? 'yaw' : 'pitch'} rotor follows at once: it has no pole to place.`;
    setText(this.aside, !able ? why : design.place_rotors ? '' : say`they lag by ${tau}`);
  }
}
