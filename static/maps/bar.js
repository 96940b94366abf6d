/** Below the s-plane: whether there is a map, and which. */
import { button, h, setAttr, setText, svg } from '../ui/index.js';
import { CHOICES } from './choices.js';

/** @typedef {import('./types.d.ts').Choice} Choice */
/** @type {Choice} */ const FIRST = { name: 'settling_time', axis: 'own', model: 'nonlinear', pair: 'hand' };
/** A window in which the PI loops have no room for fields beside all else. */
export const LOW = '(max-height: 899px) and (min-width: 1180px)';
/** Two lines of equal height around a summit. */
const ICON =
  'M 2 11 C 1 5 5 2 9 3 C 14 4 15 9 12 12 C 9 15 3 15 2 11 Z ' +
  'M 5.5 9.5 C 5 7 7 5.5 9 6.5 C 11 8 9.5 11.5 7.5 11.5 C 6 11.5 5.7 10.5 5.5 9.5 Z';

const icon = () =>
  svg('svg', { class: 'map-icon', viewBox: '0 0 16 16', 'aria-hidden': 'true' }, svg('path', { d: ICON }));

/** In place of the loops' sliders their fields, where these have no room of their own. @param {() => void} act */
export const fieldsButton = (act) =>
  button(
    {
      class: 'map-fields',
      'data-testid': 'map-fields',
      'aria-label': 'Maps of kₚ and Tᵢ',
      title: 'Maps of kₚ and Tᵢ in place of their sliders',
      hidden: true,
      onclick: act,
    },
    icon(),
  );

export class Bar {
  /** The last choice, which comes back. @type {Choice} */ #choice = FIRST;
  #key = '';

  /** @param {(choice: Choice|null) => void} choose */
  constructor(choose) {
    /**
     * @param {string} label @param {string} testid @param {string} title @param {[string, string][]} options
     * @param {(value: string) => Partial<Choice>} read
     */
    const select = (label, testid, title, options, read) => {
      const node = h(
        'select',
        {
          'aria-label': label,
          title,
          'data-testid': testid,
          onchange: () => choose({ ...this.#choice, ...read(node.value) }),
        },
        options.map(([value, text]) => h('option', { value }, text)),
      );
      return node;
    };
    this.toggle = button(
      {
        'data-testid': 'map',
        'aria-label': 'Map',
        title: 'Map: in colour, what each place would give for the pair in hand, and each k_p and T_i',
        onclick: () => choose(this.node.hidden ? this.#choice : null),
      },
      icon(),
    );
    this.name = select(
      'What the map shows',
      'map-name',
      'What each place would give',
      Object.entries(CHOICES).map(([value, { label }]) => [value, label]),
      (name) => ({ name }),
    );
    this.axis = select(
      'Axis that is stepped',
      'map-axis',
      'The step whose response is judged; own: that of the pair or loop that moves',
      [
        ['own', 'own step'],
        ['theta', 'pitch step'],
        ['psi', 'yaw step'],
        ['both', 'worse of both'],
      ],
      (axis) => ({ axis: /** @type {Choice['axis']} */ (axis) }),
    );
    this.model = select(
      'Model of the response',
      'map-model',
      'The rig with its limits, or the linear model',
      [
        ['nonlinear', 'nonlinear'],
        ['linear', 'linear'],
      ],
      (model) => ({ model: /** @type {Choice['model']} */ (model) }),
    );
    this.pair = select(
      'Poles that the map is of',
      'map-pair-of',
      'Whose places are shown: of the pair touched last, or always of one, so that one sees its valley move',
      [
        ['hand', 'in hand'],
        ['pitch', 'pitch poles'],
        ['yaw', 'yaw poles'],
      ],
      (pair) => ({ pair: /** @type {Choice['pair']} */ (pair) }),
    );
    this.note = h('p', { class: 'map-note', role: 'status', hidden: true });
    const { name, axis, model, pair, note } = this;
    this.node = h('div', { class: 'map-choices', hidden: true }, name, axis, model, pair, note);
  }

  /** Why the plane has no map, where it has none. @param {boolean} places  poles by hand @param {boolean} loops */
  explain(places, loops) {
    this.note.hidden = places;
    if (places) return;
    setText(
      this.note,
      loops
        ? 'The method computes the poles: only kₚ and Tᵢ of the loops have maps.'
        : 'The method computes the poles: there is nothing to map.',
    );
  }

  /**
   * @param {Choice|null} choice
   * @param {(name: string) => boolean} isHidden
   */
  render(choice, isHidden) {
    const kept = Object.keys(CHOICES).filter(isHidden);
    const key = JSON.stringify([choice, kept]);
    if (key === this.#key) return; // a select that is set is laid out anew
    this.#key = key;
    if (choice) this.#choice = choice;
    this.node.hidden = !choice;
    setAttr(this.toggle, 'aria-pressed', String(choice !== null));
    for (const option of this.name.options) option.hidden = kept.includes(option.value);
    if (!choice) return;
    const { stepped } = CHOICES[choice.name];
    for (const node of [this.axis, this.model]) node.hidden = !stepped;
    this.name.value = choice.name;
    this.axis.value = choice.axis;
    this.model.value = choice.model;
    this.pair.value = choice.pair;
  }
}
