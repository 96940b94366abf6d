/** Plots over frequency with a sentence below, asked for while their card is seen. */
import { significant } from '../text/index.js';
import { bodyOf } from '../model/index.js';
import { h, Lazy, setText } from '../ui/index.js';
import { subtitle } from '../plots/index.js';
import { FrequencyPlot } from './frequency_plot.js';

/**
 * @template R a reply
 * @typedef {object} Card
 * @property {import('./frequency_plot.js').About<R>[]} charts
 * @property {number[]} frequencies rad/s
 * @property {(Node|string)[]} caption
 * @property {string} testid of the sentence
 * @property {string} wait
 * @property {(body: ReturnType<typeof bodyOf> & {frequencies: number[]}) => Promise<R>} ask
 * @property {(reply: R) => {text: string, warning?: boolean, figures?: boolean}} words figures: whether there is
 *   anything to plot
 */

/** @template R */
export class FrequencyCard {
  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store @param {Card<R>} card */
  constructor(root, store, card) {
    this.card = card;
    this.at = h('span', { class: 'at-frequency' });
    this.words = h('p', { class: 'claim', 'data-testid': card.testid });
    this.plots = card.charts.map(
      (about) =>
        new FrequencyPlot(about, card.frequencies, { onHover: (i) => this.#hover(i), subtitle: () => subtitle(store) }),
    );
    this.figures = h(
      'div',
      {},
      h('p', { class: 'caption' }, card.caption, ' Values at ', this.at),
      h(
        'div',
        { class: 'frequency-plots' },
        this.plots.map((p) => p.node),
      ),
    );
    const content = h('div', {}, this.figures, this.words);
    root.append(content);
    this.lazy = new Lazy(root, content, store, {
      wait: card.wait,
      ask: card.ask,
      show: (answer) => this.#show(answer),
      body: (d) => ({ ...bodyOf(d), frequencies: card.frequencies }),
    });
  }

  /** @param {R} reply */
  #show(reply) {
    const { text, warning = false, figures = true } = this.card.words(reply);
    setText(this.words, text);
    this.figures.hidden = !figures;
    if (!figures) return;
    for (const plot of this.plots) plot.show(reply);
    this.words.classList.toggle('warning', warning);
    this.#hover(null);
  }

  /** @param {number|null} i */
  #hover(i) {
    setText(this.at, `${significant(this.card.frequencies[i ?? 0], 3)} rad/s${i === null ? ', the lowest' : ''}`);
    for (const plot of this.plots) plot.valuesAt(i ?? 0);
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    this.lazy.render(state);
  }
}
