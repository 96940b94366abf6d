/** Table I for the present rig, and Eqs. 1 and 8 worked through with the values of the rig's components. */
import { h, setText } from '../ui/index.js';
import { centreSteps, figure, thrustSteps } from './math.js';
import { named, rich } from './rich.js';

/** @typedef {import('./math.js').Step} Step @typedef {import('../types.js').Preset} Preset */

export class Machine {
  #key = '';
  /** @type {Record<string, HTMLElement>} */ #examples = {};

  constructor() {
    this.table = h('table', { class: 'parameters', 'data-testid': 'paper-parameters' });
  }

  /** @param {string} number */
  example(number) {
    return (this.#examples[number] = h('div', {
      class: 'worked',
      'data-testid': `paper-worked-${number === 'Eq. 1' ? 'l' : 'K'}`,
    }));
  }

  /** @param {Preset[]} presets @param {Preset|undefined} preset @param {Record<string, number>} overrides */
  render(presets, preset, overrides) {
    const key = JSON.stringify([preset?.name, overrides]);
    if (!preset || key === this.#key) return;
    this.#key = key;
    const values = { ...preset.parameters, ...overrides };
    this.table.replaceChildren(
      h(
        'tbody',
        {},
        Object.entries(preset.parameter_info ?? {}).map(([name, info]) =>
          h(
            'tr',
            {},
            h('th', { scope: 'row' }, named(name)),
            h('td', {}, info.meaning),
            h('td', { class: name in overrides ? 'changed' : '' }, figure(values[name], 7)),
            h('td', { class: 'aside' }, info.unit),
          ),
        ),
      ),
    );
    const owner = Object.keys(preset.components ?? {}).length
      ? preset
      : presets.find((p) => Object.keys(p.components ?? {}).length);
    for (const [number, node] of Object.entries(this.#examples)) {
      if (!owner) setText(node, 'No parameter set here lists its components.');
      else
        node.replaceChildren(
          ...this.#steps(
            number === 'Eq. 1' ? centreSteps(owner.components) : thrustSteps(owner.components),
            values,
            owner === preset ? '' : owner.title,
          ),
        );
    }
  }

  /**
   * @param {Step[]} steps
   * @param {Record<string, number>} values
   * @param {string} other whose components they are, where not the present rig's
   */
  #steps(steps, values, other) {
    const compare = steps
      .filter(({ name }) => name in values)
      .map(({ name }) => [...named(name), ` = ${figure(values[name])}`]);
    return [
      h(
        'div',
        { class: 'steps' },
        steps.map(({ name, symbols, figures, value, unit, digits }) =>
          h(
            'div',
            { class: 'step' },
            h('span', { class: 'what' }, named(name)),
            h('span', { class: 'as' }, ' = ', rich(symbols)),
            figures ? h('span', { class: 'with' }, ' = ', figures.replace(/ (?=[A-Za-zΩ])/g, '\u00a0')) : null,
            h('b', {}, ` = ${figure(value, digits)} ${unit}`),
          ),
        ),
      ),
      h(
        'p',
        { class: 'live-note' },
        other
          ? `The present rig’s components are not listed; these are of “${other}”. The present rig has `
          : 'The present rig has ',
        compare.flatMap((part, i) => (i ? [', ', ...part] : part)),
        '.',
      ),
    ];
  }
}
