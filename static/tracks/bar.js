/**
 * Below the s-plane: which number is swept and over what; a figure over it, a slider along it, what holds there, and
 * ways to take the value.
 * @typedef {import('./numbers.js').Swept} Swept
 * @typedef {import('./numbers.js').Group} Group
 */
import { forField, parseNumber } from '../text/index.js';
import { button, check, h, setAttr, setText, svg } from '../ui/index.js';
import { Strip } from './strip.js';

/** A curve between a cross and a square. */
const ICON = 'M 1 12 L 5 16 M 1 16 L 5 12 M 4 13 C 6 6 9 9 11 4 M 10 1 H 14 V 5 H 10 Z';
/** The slider's steps: as many as it may have pixels. */
export const STEPS = 1000;
const PLAY = 'M 4 2 L 14 8 L 4 14 Z';
const PAUSE = 'M 4 2 H 7 V 14 H 4 Z M 9 2 H 12 V 14 H 9 Z';

/**
 * @typedef {object} Hand  what is done with the bar
 * @property {(swept: Swept|null) => void} choose
 * @property {(share: number) => void} seek  how far along, 0 to 1
 * @property {() => void} play
 * @property {() => void} take
 * @property {(kind: 'csv'|'svg') => void} save
 */

export class Bar {
  /** @type {Swept|null} */ #swept = null;
  #scale = 1;
  #offered = '';

  /** @param {Hand} hand @param {Swept} first */
  constructor(hand, first) {
    const change = (/** @type {Partial<Swept>} */ part) => hand.choose({ ...(this.#swept ?? first), ...part });
    this.toggle = button(
      {
        'data-testid': 'show-track',
        'aria-label': 'Track',
        title: 'Track: one number swept, the poles of the loop as a curve; the root locus among them',
        onclick: () => hand.choose(this.node.hidden ? (this.#swept ?? first) : null),
      },
      svg('svg', { class: 'track-icon', viewBox: '0 0 16 17', 'aria-hidden': 'true' }, svg('path', { d: ICON })),
    );
    this.path = h('select', {
      'data-testid': 'track-path',
      'aria-label': 'Number that is swept',
      title: 'Number that is swept: the loop’s poles move along the curves from × to □',
      onchange: () => change({ path: this.path.value, over: null, log: false, kept: false }),
    });
    const end = (/** @type {string} */ label, /** @type {string} */ testid) => {
      const node = h('input', {
        type: 'text',
        inputmode: 'decimal',
        'aria-label': label,
        'data-testid': testid,
        size: 5,
      });
      node.addEventListener('change', () => this.#range(change));
      return node;
    };
    this.from = end('Lowest value', 'track-from');
    this.to = end('Highest value', 'track-to');
    this.unit = h('span', { class: 'track-unit', translate: 'no' });
    this.log = check(
      {
        'data-testid': 'track-log',
        title: 'Values by equal factors',
        onchange: () => change({ log: this.log.box.checked }),
      },
      'log',
    );
    this.kept = check(
      {
        'data-testid': 'track-kept',
        title: 'The gains stay as they are and only the rig changes; else each value has a design of its own',
        onchange: () => change({ kept: this.kept.box.checked }),
      },
      'K kept',
    );
    this.icon = svg('path', { d: PLAY });
    this.play = button(
      {
        'data-testid': 'track-play',
        'aria-pressed': 'false',
        'aria-label': 'Move the poles along their curves',
        title: 'Move the poles along their curves: of a gain from the open to the closed loop',
        onclick: () => hand.play(),
      },
      svg('svg', { viewBox: '0 0 16 16', 'aria-hidden': 'true' }, this.icon),
    );
    this.slider = h('input', {
      type: 'range',
      min: 0,
      max: STEPS,
      'data-testid': 'track-slider',
      'aria-label': 'Along the track',
      oninput: () => hand.seek(Number(this.slider.value) / STEPS),
    });
    this.figure = h('select', {
      'data-testid': 'track-figure',
      'aria-label': 'Figure that is drawn over the number',
      title: 'Figure that is drawn over the number',
    });
    this.strip = new Strip();
    this.value = h('output', { class: 'track-here-value', 'data-testid': 'track-value', translate: 'no' });
    this.take = button(
      {
        'data-testid': 'track-take',
        title: 'Make the design with this value the present one',
        onclick: () => hand.take(),
      },
      'Take',
    );
    this.words = h('div', { class: 'track-words', 'data-testid': 'track-words', role: 'status' });
    const file = (/** @type {'csv'|'svg'} */ kind, /** @type {string} */ title) =>
      button(
        { class: 'track-file', 'data-testid': `track-${kind}`, title, onclick: () => hand.save(kind) },
        kind.toUpperCase(),
      );
    this.node = h(
      'div',
      { class: 'track-bar', role: 'group', 'aria-label': 'Track', hidden: true },
      h(
        'div',
        { class: 'track-row' },
        this.path,
        h('span', { class: 'track-range' }, this.from, '…', this.to, this.unit),
        this.log.node,
        this.kept.node,
      ),
      h(
        'div',
        { class: 'track-row' },
        this.play,
        h('div', { class: 'track-along' }, this.strip.node, this.slider, this.figure),
        h(
          'div',
          { class: 'track-ways' },
          this.take,
          file('csv', 'The track as numbers'),
          file('svg', 'The track as a picture'),
        ),
      ),
      h('div', { class: 'track-row track-told' }, this.value, this.words),
    );
  }

  /** What is swept, in short. */
  get name() {
    return (this.path.selectedOptions[0]?.text ?? '').split(',')[0];
  }

  /** @param {(part: Partial<Swept>) => void} change */
  #range(change) {
    const ends = [this.from, this.to].map(({ value }) => parseNumber(value) / this.#scale);
    const right = ends.every(Number.isFinite) && ends[0] < ends[1];
    for (const node of [this.from, this.to]) setAttr(node, 'aria-invalid', String(!right));
    if (right) change({ over: [ends[0], ends[1]] });
  }

  /** @param {Swept|null} swept @param {Group[]} groups */
  render(swept, groups) {
    this.node.hidden = !swept;
    setAttr(this.toggle, 'aria-pressed', String(swept !== null));
    if (!swept) return;
    this.#swept = swept;
    const key = JSON.stringify(groups);
    if (key !== this.#offered) {
      this.#offered = key;
      this.path.replaceChildren(
        ...groups.map(([label, options]) =>
          h(
            'optgroup',
            { label },
            options.map(([value, text]) => h('option', { value }, text)),
          ),
        ),
      );
    }
    if (![...this.path.options].some(({ value }) => value === swept.path))
      this.path.append(h('option', { value: swept.path, translate: 'no' }, swept.path));
    this.path.value = swept.path;
    this.log.box.checked = swept.log;
    this.kept.box.checked = swept.kept;
  }

  /**
   * The range in the unit shown.
   * @param {readonly [number, number]} range @param {number} scale @param {string} unit
   */
  showRange(range, scale, unit) {
    this.#scale = scale;
    for (const [k, node] of [this.from, this.to].entries()) {
      if (node === document.activeElement) continue;
      node.value = forField(Number((range[k] * scale).toPrecision(4)));
      setAttr(node, 'aria-invalid', 'false');
    }
    setText(this.unit, unit);
  }

  /** @param {boolean} on */
  playing(on) {
    setAttr(this.icon, 'd', on ? PAUSE : PLAY);
    setAttr(this.play, 'aria-pressed', String(on));
  }
}
