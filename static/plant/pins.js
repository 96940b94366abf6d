/** Up to four designs that are kept: their curves faint beside the present ones, their gains in a table. */
import { say, significant, t } from '../text/index.js';
import { button, copyButton, h } from '../ui/index.js';
import { polesLine } from './poles.js';

export const MOST_PINS = 4;
const LETTERS = 'ABCD';

/** @typedef {{letter: string, plant: string, method: string, design: import('../contract.js').SystemDesign}} Pinned */

export class Pins {
  /** @type {Pinned[]} */ list = [];

  /** @param {{onChange: () => void, onLoad: (plant: string) => void}} how */
  constructor({ onChange, onLoad }) {
    this.onChange = onChange;
    this.onLoad = onLoad;
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
            ['Pin', 'Poles, rad/s', 'Method', '‖K‖', 'K'].map((words) => h('th', { scope: 'col' }, words)),
            h('td'),
          ),
        ),
        this.body,
      ),
    );
  }

  get full() {
    return this.list.length >= MOST_PINS;
  }

  /** @param {Omit<Pinned, 'letter'>} pin */
  add(pin) {
    const letter = [...LETTERS].find((own) => this.list.every((known) => known.letter !== own));
    if (!letter) return;
    this.list = [...this.list, { ...pin, letter }];
    this.#draw();
  }

  /** @param {Pinned} pin */
  #remove(pin) {
    this.list = this.list.filter((own) => own !== pin);
    this.#draw();
  }

  #draw() {
    this.node.hidden = this.list.length === 0;
    this.body.replaceChildren(
      ...this.list.map((pin, i) =>
        h(
          'tr',
          {},
          h('th', { scope: 'row' }, h('span', { class: `plant-pin pin-${i}` }, pin.letter)),
          h('td', { translate: 'no' }, polesLine(pin.design.poles)),
          h('td', {}, t(pin.method)),
          h('td', { translate: 'no' }, significant(pin.design.norm, 4)),
          h(
            'td',
            { translate: 'no' },
            pin.design.K.map((row) => row.map((v) => significant(v, 4)).join('  ')).join('; '),
            copyButton(`plant-pin-${pin.letter}`, () => [{ name: 'K', matrix: pin.design.K }]),
          ),
          h(
            'td',
            {},
            button({ 'aria-label': say`Use pin ${pin.letter}`, onclick: () => this.onLoad(pin.plant) }, 'Use'),
            button({ 'aria-label': say`Remove pin ${pin.letter}`, onclick: () => this.#remove(pin) }, 'Remove'),
          ),
        ),
      ),
    );
    this.onChange();
  }
}
