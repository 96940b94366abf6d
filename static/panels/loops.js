/**
 * The outer loops: on or off, their PI values, how they are paired; and the method that makes the inner loop's gain.
 */
import { messageOf } from '../text/index.js';
import { allowed, bodyOf, bringsIntegralAction, FULL_RANK, keyOf, nameOf, partOf, STRUCTURES } from '../model/index.js';
import { suggestLoops } from '../net/index.js';
import { button, check, Choice, h, designField, setText, shape, symbol } from '../ui/index.js';

/** @typedef {'pitch'|'yaw'} Axis */
const AXES = /** @type {Axis[]} */ (['pitch', 'yaw']);

/** @param {string[][]} options value, name, explanation */
const optionsOf = (options) => options.map(([value, name, title]) => h('option', { value, title }, name));

/** @param {import('../types.js').Method[]} methods */
const groupsOf = (methods) => [
  h('optgroup', { label: 'Full-rank' }, optionsOf(STRUCTURES)),
  h(
    'optgroup',
    { label: 'Other methods' },
    methods
      .filter((m) => m.name !== FULL_RANK)
      .map((m) =>
        h(
          'option',
          {
            value: m.name,
            disabled: !m.available,
            title: m.available
              ? `${m.title}: ${m.source}`
              : `${m.title} needs the package ${m.needs ?? ''}, which this server has not`,
          },
          nameOf({ method: m.name, title: m.title }),
        ),
      ),
  ),
];

export class LoopsPanel {
  /** @type {import('../types.js').Preset|undefined} */ #preset;
  /** @type {import('../types.js').Design|null} */ #told = null;
  /** @type {import('../types.js').Method[]|null} */ #methods = null;

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.outer = new Choice({
      label: 'Outer loop',
      testid: 'outer',
      onChange: (v) => this.#set({ outer: v }),
      options: [
        ['none', 'Inner loop alone', 'v = Ĝ(0)⁻¹ r: the placed poles, and no others'],
        ['pi', 'PI loops', 'a PI controller on each axis, which moves the placed poles'],
      ],
    });
    this.suggest = button(
      {
        'data-testid': 'suggest-pi',
        title: 'Suggest PI values that suit these poles',
        'aria-label': 'Suggest PI for these poles',
        onclick: () => this.#suggest(),
      },
      'Suggest PI',
    );
    this.note = h('p', { class: 'note', 'data-testid': 'loops-note', 'aria-live': 'polite' });
    this.method = this.#select('Method', 'method', [], partOf);
    this.pairing = this.#select(
      'Pairing',
      'pairing',
      [
        ['diagonal', 'diagonal', 'pitch error to the pitch motor'],
        ['cross', 'crosswise', 'pitch error to the yaw motor'],
      ],
      (value) => ({ pairing: value }),
    );
    const decoupler = check(
      {
        title: 'static decoupler Ĝ(0)⁻¹ between the PI loops and the motors',
        'data-testid': 'decoupler',
        'data-field': 'decoupler',
        onchange: () => this.#set({ decoupler: this.decoupler.checked }),
      },
      'decoupler',
    );
    this.decoupler = decoupler.box;
    this.axes = AXES.map((axis) => this.#axis(axis));
    for (const event of ['pointerdown', 'keydown']) document.addEventListener(event, () => setText(this.note, ''));
    root.append(
      h('div', { class: 'row spread' }, this.outer.node, this.suggest),
      h(
        'div',
        { class: 'pis' },
        this.axes.map((a) => a.node),
      ),
      h('div', { class: 'row advanced' }, this.method.node),
      h('div', { class: 'row advanced' }, this.pairing.node, decoupler.node),
      this.note,
    );
  }

  /** @param {Partial<import('../types.js').Design>} part */
  #set(part) {
    this.store.edit((d) => ({ ...d, ...part }));
  }

  /**
   * @template {string} V
   * @param {string} text
   * @param {string} key
   * @param {[V, string, string][]} options value, name, explanation
   * @param {(value: V) => Partial<import('../types.js').Design>} read
   */
  #select(text, key, options, read) {
    const select = h(
      'select',
      { 'data-testid': key, 'data-field': key, onchange: () => this.#set(read(/** @type {V} */ (select.value))) },
      optionsOf(options),
    );
    return { select, node: h('label', { class: 'select' }, h('span', {}, text), select) };
  }

  /** @param {Axis} axis */
  #axis(axis) {
    const field = (
      /** @type {'kp'|'ti'} */ key,
      /** @type {Node} */ mark,
      /** @type {string} */ unit,
      /** @type {string} */ words,
      /** @type {{min: number, max: number, log: true}} */ slider,
    ) =>
      designField(
        this.store,
        `${key}-${axis}`,
        (d, v) => ({ ...d, loops: { ...d.loops, [axis]: { ...d.loops[axis], [key]: v } } }),
        {
          label: `${axis} ${words}`,
          mark,
          unit,
          field: `loops.${axis}.${key}`,
          ...allowed(`loops.${axis}.${key}`),
          ...(key === 'kp' ? { min: 0 } : { positive: true }), // a negative gain reverses a loop: the pairing does that
          slider,
        },
      );
    const kp = field('kp', symbol('k', 'p'), 'V/rad', 'proportional gain', { min: 0.5, max: 200, log: true });
    const ti = field('ti', symbol('T', 'i'), 's', 'integral time', { min: 0.01, max: 10, log: true });
    const node = h('fieldset', { class: `pi ${axis}` }, h('legend', {}, shape(axis), `${axis} PI`), kp.node, ti.node);
    return { axis, kp, ti, node };
  }

  async #suggest() {
    const { design } = this.store.state;
    if (!design) return;
    this.suggest.disabled = true;
    try {
      const answer = await suggestLoops(bodyOf(design));
      this.#set({ loops: answer.loops, outer: 'pi' });
      this.#tell(answer.rule ?? '');
    } catch (error) {
      this.#tell(messageOf(error));
    }
    this.suggest.disabled = false;
  }

  /** Says something of the present design; the next change takes it away. @param {string} text */
  #tell(text) {
    this.#told = this.store.state.design;
    setText(this.note, text);
  }

  /** @param {import('../types.js').State} state */
  render({ design, methods }) {
    if (!design) return;
    if (methods !== this.#methods) {
      this.#methods = methods;
      this.method.select.replaceChildren(...groupsOf(methods));
    }
    if (design !== this.#told) this.#tell('');
    const preset = this.store.preset;
    if (preset && preset !== this.#preset) {
      this.#preset = preset;
      for (const { axis, kp, ti } of this.axes) {
        kp.setRange({ min: preset.loops[axis].kp / 60, max: preset.loops[axis].kp * 6 });
        ti.setRange({ min: Math.min(0.01, preset.loops[axis].ti / 10), max: Math.max(5, preset.loops[axis].ti * 5) });
      }
    }
    const off = design.outer === 'none' || bringsIntegralAction(this.store.shown);
    this.outer.set(design.outer);
    for (const { axis, kp, ti, node } of this.axes) {
      kp.set(design.loops[axis].kp);
      ti.set(design.loops[axis].ti);
      kp.disable(off);
      ti.disable(off);
      node.classList.toggle('off', off);
    }
    this.pairing.select.value = design.pairing;
    this.pairing.select.disabled = off;
    this.decoupler.checked = design.decoupler;
    this.decoupler.disabled = off;
    this.method.select.value = keyOf(design);
    this.method.select.title = this.method.select.selectedOptions[0]?.title ?? '';
  }
}
