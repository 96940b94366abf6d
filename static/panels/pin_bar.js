/** The pinned designs over the plots: what each letter means, and back to one of them by one press. */
import { colorOf, letterOf } from '../model/index.js';
import { button, h, setAttr } from '../ui/index.js';

/** The letter in its pin's colour. @param {number} index */
export const badge = (index) => h('span', { class: `badge ${colorOf(index)}`, 'aria-hidden': 'true' }, letterOf(index));

export class PinBar {
  /** @type {import('../types.js').Pin[]} */ #pins = [];
  /** @type {HTMLElement[]} */ #chips = [];

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.root = root;
    this.store = store;
    this.list = h('div', { class: 'chips' });
    root.append(
      h('span', { class: 'caption' }, 'Pinned'),
      this.list,
      h('a', { class: 'button', href: '#pins', 'data-testid': 'pins-link' }, 'Differences'),
    );
  }

  /** @param {import('../types.js').State} state */
  render({ pins, design }) {
    if (pins !== this.#pins) {
      this.#pins = pins;
      this.root.hidden = !pins.length;
      this.#chips = pins.map((pin) =>
        h(
          'span',
          { class: `chip ${colorOf(pin.index)}`, 'data-testid': `pin-chip-${pin.index}` },
          button(
            {
              class: 'use',
              title: pin.refused ?? `Back to ${pin.name}`,
              onclick: () => this.store.usePin(pin.id),
            },
            badge(pin.index),
            h('span', {}, pin.name),
            pin.refused ? ' (not computed)' : '',
            pin.reply && !pin.reply.stable
              ? h(
                  'b',
                  { class: 'unstable-word', title: 'unstable' },
                  h('span', { 'aria-hidden': 'true' }, '✕'),
                  h('span', { class: 'sr' }, 'unstable'),
                )
              : null,
          ),
          button(
            {
              class: 'remove',
              title: `Unpin ${pin.name}`,
              'aria-label': `Unpin ${pin.name}`,
              onclick: () => this.store.unpin(pin.id),
            },
            '×',
          ),
        ),
      );
      this.list.replaceChildren(...this.#chips);
    }
    this.#chips.forEach((chip, i) =>
      setAttr(/** @type {Element} */ (chip.firstElementChild), 'aria-pressed', String(pins[i].design === design)),
    );
  }
}
