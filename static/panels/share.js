/** "Copy link", and the small panel that makes a link with locks for a class. */
import { LOCKS } from '../model/index.js';
import { button, check, copyText, h, popupButton, setText } from '../ui/index.js';
import { MOST } from '../link/index.js';

const SHOWN_MS = 1600;

export class ShareButtons {
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #timer;

  /** @param {import('../model/store.js').Store} store @param {import('../link/address.js').Address} address */
  constructor(store, address) {
    this.store = store;
    this.address = address;
    this.copy = button(
      {
        class: 'copy-link',
        'data-testid': 'copy-link',
        title: 'Copy a link that opens this design: rig, poles, loops, steps and pins',
        onclick: () => this.#copy(address.link),
      },
      'Copy link',
    );
    this.told = h('span', { class: 'sr', role: 'status', 'data-testid': 'link-copied' });
    this.node = h(
      'span',
      { class: 'share' },
      this.copy,
      popupButton({
        label: 'A link that locks controls, for a class',
        text: '▾',
        testid: 'share',
        kind: 'share-more',
        content: () => this.#panel(),
      }),
      this.told,
    );
  }

  /** @param {string} hash */
  async #copy(hash) {
    const done = await copyText(`${location.origin}${location.pathname}${location.search}${hash}`);
    setText(this.copy, done ? 'Copied' : 'Not copied');
    setText(
      this.told,
      done ? 'The link is in the clipboard.' : 'The browser blocked copying. The link is in the address bar.',
    );
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => setText(this.copy, 'Copy link'), SHOWN_MS);
    return done;
  }

  #panel() {
    const { locks, pins, plantPins } = this.store.state;
    const boxes = Object.entries(LOCKS).map(([name, { name: words }]) => ({
      name,
      ...check({ checked: locks.includes(name), 'data-testid': `lock-${name}`, onchange: () => show() }, words),
    }));
    const address = h('input', {
      class: 'link',
      readonly: true,
      'aria-label': 'Link',
      'data-testid': 'share-link',
      onfocus: () => address.select(),
    });
    const words = h('p', { class: 'caption', role: 'status' });
    const copy = button(
      {
        'data-testid': 'share-copy',
        onclick: async () =>
          setText(words, (await this.#copy(link())) ? 'Copied.' : 'Not copied: select it and copy it by hand.'),
      },
      'Copy this link',
    );
    const link = () => this.address.linkWith(boxes.filter((b) => b.box.checked).map((b) => b.name));
    const show = () => {
      address.value = `${location.origin}${location.pathname}${location.search}${link()}`;
      const left = [...(pins.length ? ['&pin='] : []), ...(plantPins.length ? ['&plant.pin='] : [])];
      const missing = left.some((part) => !link().includes(part))
        ? ` Pins are left out: with them the link would exceed ${MOST}.`
        : '';
      setText(words, `${address.value.length} characters.${missing}`);
    };
    show();
    return [
      h('h3', {}, 'Link for a class'),
      h('p', { class: 'caption' }, 'Anyone who opens it cannot change what is ticked:'),
      h(
        'div',
        { class: 'lock-list' },
        boxes.map(({ node }) => node),
      ),
      address,
      h('div', { class: 'row spread' }, words, copy),
    ];
  }
}
