/**
 * How much pitch and yaw feel each other at each frequency: relative gains, and off-diagonal over diagonal entries of
 * Ĝ(jω).
 */
import { dominanceWords, largest, logSpaced } from '../model/index.js';
import { relativeGain } from '../net/index.js';
import { h, symbol } from '../ui/index.js';
import { FrequencyCard } from './frequency_card.js';

const FREQUENCIES = logSpaced(0.01, 1000, 121);
const size = (/** @type {string} */ sub) => h('span', { class: 'sym' }, '|', symbol('λ', sub), '|');

/** Full decades around what is seen, and around 1. @param {number[][]} data @returns {[number, number]} */
function range(data) {
  const seen = data
    .flat()
    .filter((v) => Number.isFinite(v) && v > 0)
    .map((v) => Math.log10(v));
  return [10 ** Math.max(-6, Math.floor(Math.min(-1, ...seen))), 10 ** Math.min(6, Math.ceil(Math.max(1, ...seen)))];
}

/** @typedef {import('../contract.js').Rga} Rga */
/** @type {import('./frequency_plot.js').About<Rga>[]} */
const CHARTS = [
  {
    id: 'gains',
    title: 'Relative gains',
    range,
    series: [
      {
        kind: 'series-0',
        name: () => [size('11')],
        plain: '|λ₁₁|',
        title: 'relative gain of the diagonal pairing at this frequency',
        of: (r) => (r.rga_magnitude ?? []).map((m) => m[0][0]),
      },
      {
        kind: 'series-1',
        name: () => [size('12')],
        plain: '|λ₁₂|',
        title: 'relative gain of the crosswise pairing at this frequency',
        of: (r) => (r.rga_magnitude ?? []).map((m) => m[0][1]),
      },
    ],
  },
  {
    id: 'dominance',
    title: 'Off-diagonal over diagonal',
    range,
    rule: { value: 1, label: 'below 1: dominant', above: true },
    series: [
      {
        kind: 'series-0',
        name: () => ['rows'],
        plain: 'rows',
        title: 'larger of both rows of Ĝ(jω): an angle’s answer to the other input, over that to its own',
        of: (r) => largest(r.dominance?.rows ?? []),
      },
      {
        kind: 'series-1',
        name: () => ['columns'],
        plain: 'columns',
        title: 'larger of both columns of Ĝ(jω): an input’s effect on the other angle, over that on its own',
        of: (r) => largest(r.dominance?.columns ?? []),
      },
    ],
  },
];

/** @param {Rga} reply */
function words(reply) {
  if (!reply.rga_magnitude)
    return { figures: false, text: reply.findings?.[0]?.message ?? 'There is no steady state, so no RGA.' };
  const { dominant, text } = reply.dominance
    ? dominanceWords(reply.frequencies ?? [], reply.dominance)
    : { dominant: false, text: 'A diagonal entry of Ĝ(jω) is 0, so there is no diagonal dominance.' };
  return { text, warning: !dominant };
}

/** @extends {FrequencyCard<Rga>} */
export class InteractionCard extends FrequencyCard {
  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    const caption = ['Of the inner loop ', symbol('Ĝ'), '(', symbol('jω'), '), ', symbol('ω'), ' in rad/s.'];
    super(root, store, {
      charts: CHARTS,
      frequencies: FREQUENCIES,
      caption,
      words,
      testid: 'dominance-words',
      wait: 'Computing the frequency response…',
      ask: relativeGain,
    });
  }
}
