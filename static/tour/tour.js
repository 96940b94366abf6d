/**
 * Five short hints at the lower right, for a first visit: nothing is blocked, the page goes on beneath. Gone for good
 * when ended; the header brings them back.
 */
import { say } from '../text/index.js';
import { button, h, remember, setText } from '../ui/index.js';

export const MEMORY = 'tour';

/** @type {{title: string, text: string, targets: string[]}[]} */
export const STEPS = [
  {
    title: 'Drag a pole',
    targets: ['#splane'],
    text:
      'Round marks are pitch’s poles, square ones yaw’s. Drag one, or use the arrow keys. Diamonds are the ' +
      'poles of the whole loop; a dotted line shows where the PI loops take the pole that you touch.',
  },
  {
    title: 'See the response',
    targets: ['#plots'],
    text:
      'Solid lines are the nonlinear rig’s, dashed ones the linear model’s. Point at a plot to read its ' +
      'values. Click to move the rig to that moment.',
  },
  {
    title: 'Mind the limits',
    targets: ['[data-testid=plot-V_p]', '[data-testid=plot-V_y]', '#strip'],
    text:
      'Red lines are the motors’ limits. The line at the top says what is unstable, saturated or badly paired. ' +
      'Click a remark to go to its place.',
  },
  {
    title: 'Who moves what',
    targets: ['#numbers'],
    text:
      'K is the gain that places these poles. The relative gain array (RGA) says which motor should control ' +
      'which angle. Where crosswise is better, one button changes the pairing.',
  },
  {
    title: 'Share it',
    targets: ['.share', '[data-testid=pin]'],
    text: 'Copy link copies an address that opens this design. Pin keeps a design beside those that follow.',
  },
];

export class Tour {
  #at = 0;
  /** @type {Element[]} */ #marked = [];
  /** @type {HTMLElement|null} */ #from = null;

  /** @param {HTMLElement} root */
  constructor(root) {
    this.count = h('span', { class: 'tour-count' });
    this.title = h('strong');
    this.text = h('p', { 'data-testid': 'tour-text' });
    this.back = button({ 'data-testid': 'tour-back', onclick: () => this.#show(this.#at - 1) }, 'Back');
    this.next = button({
      class: 'primary',
      'data-testid': 'tour-next',
      onclick: () => (this.#at + 1 < STEPS.length ? this.#show(this.#at + 1) : this.end()),
    });
    const close = button(
      {
        class: 'quiet',
        'data-testid': 'tour-close',
        'aria-label': 'End the tour',
        title: 'End the tour (Esc)',
        onclick: () => this.end(),
      },
      '✕',
    );
    this.node = h(
      'section',
      {
        class: 'tour',
        hidden: true,
        'aria-label': 'Tour',
        'data-testid': 'tour',
        onkeydown: (/** @type {KeyboardEvent} */ e) => this.#key(e),
      },
      h('div', { role: 'status' }, h('div', { class: 'row' }, this.title, this.count), this.text),
      h('div', { class: 'row' }, this.back, this.next, close),
    );
    root.append(this.node);
  }

  /** @param {HTMLElement} [from] the button that asked for it, which gets the focus back */
  start(from) {
    this.#from = from ?? null;
    this.node.hidden = false;
    this.#show(0);
    if (from) this.next.focus();
  }

  end() {
    const inside = this.node.contains(document.activeElement);
    this.node.hidden = true;
    this.#mark([]);
    remember(MEMORY, 'done');
    if (inside) (this.#from ?? document.querySelector('[data-testid=tour-open]'))?.focus();
  }

  /** @param {number} at */
  #show(at) {
    this.#at = at;
    const { title, text, targets } = STEPS[at];
    setText(this.title, title);
    setText(this.count, say`${at + 1} of ${STEPS.length}`);
    setText(this.text, text);
    if (at === 0 && document.activeElement === this.back) this.next.focus();
    this.back.disabled = at === 0;
    setText(this.next, at + 1 < STEPS.length ? 'Next' : 'Done');
    this.#mark(targets.map((selector) => document.querySelector(selector)).filter((node) => node !== null));
    if (at > 0) this.#marked[0]?.scrollIntoView({ block: 'nearest' });
  }

  /** @param {Element[]} nodes */
  #mark(nodes) {
    for (const node of this.#marked) node.classList.remove('toured');
    for (const node of nodes) node.classList.add('toured');
    this.#marked = nodes;
  }

  /** @param {KeyboardEvent} e */
  #key(e) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[e.key];
    if (e.key === 'Escape') this.end();
    else if (step && STEPS[this.#at + step]) this.#show(this.#at + step);
    else return;
    e.preventDefault();
  }
}
