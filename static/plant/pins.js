/**
 * Up to four designs that are kept: their curves faint beside the present ones, their gains in a table. The store has
 * them as links do; what each comes to is computed here where it is not known.
 * @typedef {import('../types.js').PlantPin} PlantPin
 */
import { letterOf, MOST_PLANTS, samePlant } from '../model/index.js';
import { call, ProblemError } from '../net/index.js';
import { say, significant, t } from '../text/index.js';
import { button, copyButton, h, keepingFocus } from '../ui/index.js';
import { matlabText, plantIn } from './link_text.js';
import { polesLine } from './poles.js';
import { bodyOf, fitting, methodName } from './wish.js';

const COLUMNS = ['Pin', 'Poles, rad/s', 'Method', '‖K‖', 'K'];

/** The design of a plant as a link has it. @param {string} text @param {typeof call} [ask] */
export async function designOf(text, ask = call) {
  const plant = plantIn(text);
  if (!plant?.poles) throw new ProblemError({ detail: t('This plant cannot be read.') });
  /** @type {import('../contract.js').SystemRead} */
  const read = await ask('api/v1/system/read', { text: matlabText(plant) });
  const wish = fitting(read, { ...plant, poles: plant.poles }, true);
  /** @type {import('../contract.js').SystemDesign} */
  const design = await ask('api/v1/system/design', bodyOf(read, wish));
  return design;
}

export class Pins {
  /** @type {readonly PlantPin[]} */ #shown = [];
  #titles = '';
  #busy = false;
  #failed = false;

  /** @param {import('../model/store.js').Store} store @param {{onChange: () => void, ask?: typeof designOf}} how */
  constructor(store, { onChange, ask = designOf }) {
    this.store = store;
    this.onChange = onChange;
    this.ask = ask;
    this.body = h('tbody');
    this.node = h(
      'div',
      {
        class: 'sideways plant-pins',
        tabindex: 0,
        role: 'group',
        'aria-label': 'Pinned designs of the plant',
        hidden: true,
      },
      h(
        'table',
        { class: 'compare-table', 'data-testid': 'plant-pins' },
        h(
          'thead',
          {},
          h(
            'tr',
            {},
            COLUMNS.map((words) => h('th', { scope: 'col' }, words)),
            h('td'),
          ),
        ),
        this.body,
      ),
    );
  }

  /** Whether there is no room for it, or no need. @param {string} plant */
  refuses(plant) {
    return this.#shown.length >= MOST_PLANTS || this.#shown.some((pin) => samePlant(pin.plant, plant));
  }

  /** Those that are computed. */
  get designs() {
    return this.#shown.flatMap(({ index, design }) => (design ? [{ index, design }] : []));
  }

  /** @param {Pick<import('../types.js').State, 'plantPins'|'methods'|'connection'>} state */
  render({ plantPins, methods, connection }) {
    if (connection !== 'open') this.#failed = false; // asked again when it is back
    const titles = methods.map(({ title }) => title).join('\n');
    if (plantPins !== this.#shown || titles !== this.#titles) {
      this.#shown = plantPins;
      this.#titles = titles;
      this.node.hidden = plantPins.length === 0;
      keepingFocus(this.body, () => this.body.replaceChildren(...plantPins.map((pin) => this.#row(pin, methods))));
      this.onChange();
    }
    if (!this.#busy && !this.#failed && connection === 'open') this.#compute();
  }

  async #compute() {
    const pin = this.store.state.plantPins.find((p) => !p.design && !p.refused);
    if (!pin) return;
    this.#busy = true;
    /** @type {Partial<PlantPin>|null} */ let part = null;
    try {
      part = { design: await this.ask(pin.plant) };
    } catch (error) {
      if (error instanceof ProblemError) part = { refused: error.message };
      else this.#failed = true;
    }
    this.#busy = false;
    if (part) this.store.changePlantPin(pin.id, part);
  }

  /** @param {PlantPin} pin @param {readonly import('../contract.js').Method[]} methods */
  #row({ id, index, plant, design, refused }, methods) {
    const letter = letterOf(index);
    const by = plantIn(plant)?.method ?? '';
    const method = methodName(methods.find((own) => own.name === by) ?? { name: by });
    const cells = design
      ? [
          h('td', { translate: 'no' }, polesLine(design.poles)),
          h('td', {}, t(method)),
          h('td', { translate: 'no' }, significant(design.norm, 4)),
          h(
            'td',
            { translate: 'no' },
            design.K.map((row) => row.map((v) => significant(v, 4)).join('  ')).join('; '),
            copyButton(`plant-pin-${letter}`, () => [{ name: 'K', matrix: design.K }]),
          ),
        ]
      : [h('td', { colspan: COLUMNS.length - 1, class: refused ? 'failure' : 'caption' }, refused ?? 'Computing …')];
    return h(
      'tr',
      {},
      h('th', { scope: 'row' }, h('span', { class: `plant-pin pin-${index}` }, letter)),
      cells,
      h(
        'td',
        {},
        button(
          {
            'data-testid': `plant-use-${letter}`,
            'aria-label': say`Use pin ${letter}`,
            onclick: () => this.store.editPlant(plant),
          },
          'Use',
        ),
        button(
          {
            'data-testid': `plant-remove-${letter}`,
            'aria-label': say`Remove pin ${letter}`,
            onclick: () => this.store.unpinPlant(id),
          },
          'Remove',
        ),
      ),
    );
  }
}
