/**
 * Findings where they concern: a few words at the loops and in the captions of the plots, in room that is kept for
 * them.
 */
import { remarked, remarksOf } from '../model/index.js';
import { h, setAttr, setText } from '../ui/index.js';

/** After which element each stands. */
const SPOTS = /** @type {const} */ ([
  ['loops', '#loops .select:has([data-testid=pairing])'],
  ['theta', '[data-testid=plot-theta] .what'],
  ['V_p', '[data-testid=plot-V_p] .what'],
  ['V_y', '[data-testid=plot-V_y] .what'],
]);

export class Remarks {
  /** @param {Document} document in which the panels have been built */
  constructor(document) {
    this.spots = SPOTS.map(([name, after]) => {
      const node = h('span', { class: 'remark', 'data-testid': `remark-${name}` });
      document.querySelector(after)?.after(node);
      return { name, node };
    });
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    const { reply, problem, motion } = state;
    const remarks = remarksOf({ reply: reply && { ...reply, findings: remarked(state) }, problem, motion });
    for (const { name, node } of this.spots) {
      const remark = remarks[name];
      setText(node, remark?.text ?? '');
      setAttr(node, 'title', remark?.message ?? '');
      node.classList.toggle('error', remark?.severity === 'error');
    }
  }
}
