/**
 * The section below the instrument: the same poles through every method, dealt every way, interaction and open loops
 * over frequency.
 */
import { h } from '../ui/index.js';
import { CompareTable } from './table.js';
import { InteractionCard } from './interaction.js';
import { OpenLoopsCard } from './open_loops.js';
import { SplitsCard } from './splits.js';

export class ComparePanel {
  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    const card = (/** @type {string} */ title, /** @type {string} */ testid, /** @type {string} */ kind) =>
      h('section', { class: `card ${kind}`, 'data-testid': testid, 'aria-label': title }, h('h3', {}, title));
    const methods = card('The same poles and steps through each method', 'compare', 'wide');
    const splits = card('Splits of these poles', 'splits', 'splits');
    const interaction = card('Interaction over frequency', 'interaction', 'interaction');
    const loops = card('Bode plots and margins', 'open-loops', 'wide');
    root.append(h('div', { class: 'compare-body' }, methods, splits, interaction, loops));
    this.cards = [
      new CompareTable(methods, store),
      new SplitsCard(splits, store),
      new InteractionCard(interaction, store),
      new OpenLoopsCard(loops, store),
    ];
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    for (const card of this.cards) card.render(state);
  }
}
