/** The formulas of the structure that is chosen, beside those of the paper's own. */
import { FULL_RANK, nameOf } from '../model/index.js';
import { h } from '../ui/index.js';
import { ofPaper } from './derived.js';
import { rich } from './rich.js';
import { typeset } from './forms.js';

/**
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('./math.js').Equation} Equation
 * @typedef {import('../contract.js').Formula} Formula
 * @typedef {import('../contract.js').Symbolic} Symbolic
 */
/** @type {Record<string, string>} what stands before a formula, as rich text */
const NAMES = {
  T: '$T$ =',
  Q: '$Q$ =',
  A_bar: '$Ā$ =',
  B_bar: '$B̄$ =',
  K_bar: '$K̄$ =',
  K: '$K$ =',
  canonical_closed_loop: '$T(A − BK)T$⁻¹ =',
  G: '$Ĝ(s)$ =',
  G_0: '$Ĝ(0)$ =',
  RGA: 'RGA =',
};

/** The structure that formulas are wanted of: the paper's where another method has none. @param {Design} design */
export const memberOf = ({ method, coupling, lead, shift }) =>
  method === FULL_RANK
    ? {
        coupling,
        lead: coupling === 'triangular' ? lead : /** @type {const} */ ('pitch'),
        shifted: typeof shift === 'number' && coupling !== 'axis-decoupled',
      }
    : { coupling: /** @type {const} */ ('triangular'), lead: /** @type {const} */ ('pitch'), shifted: false };

/** The structure whose formulas are missing: none where it is the paper's. @param {Design} design */
export function structureOf(design) {
  const member = memberOf(design);
  return member.coupling === 'triangular' && member.lead === 'pitch' && !member.shifted ? null : member;
}

/** @param {ReturnType<typeof structureOf>} structure */
export const askStructure = async (structure) => ({
  structure,
  formulas: structure ? await ofPaper(structure) : null,
});

export class StructureForms {
  /** @type {{names: string[], node: HTMLElement, number: string, chapter: string}[]} */ #places = [];

  /** @param {(part: Element, chapter: string) => void} mark makes symbols known */
  constructor(mark) {
    this.mark = mark;
  }

  /** @param {Equation} e */
  at(e) {
    if (!e.formulas.length) return null;
    const node = h('figure', { class: 'form derived chosen', hidden: true, 'data-testid': 'chosen-structure' });
    this.#places.push({ names: e.formulas, node, number: e.number, chapter: e.chapter });
    return node;
  }

  /** @param {{structure: ReturnType<typeof structureOf>, formulas: Symbolic|null}} answer */
  show({ structure, formulas }) {
    for (const { names, node, number, chapter } of this.#places) {
      node.hidden = !formulas;
      if (!formulas || !structure) continue;
      const title = nameOf({ method: FULL_RANK, ...structure });
      node.replaceChildren(
        h('figcaption', {}, `in the structure chosen above: ${title}`),
        ...names.map((name) =>
          h(
            'div',
            { class: 'named-formula' },
            h('span', { class: 'before' }, rich(NAMES[name] ?? name)),
            typeset(
              formulas[/** @type {import('../types.js').KeysOf<Symbolic, Formula>} */ (name)],
              `${number}, ${name}, ${title}`,
            ),
          ),
        ),
      );
      this.mark(node, chapter);
    }
  }
}
