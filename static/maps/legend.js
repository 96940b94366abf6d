/** What a map's colours mean, in its unit, and what is hatched. What it shows and of which model stands beside it. */
import { h, setAttr, shape, svg } from '../ui/index.js';
import { levelText, titleOf, unitOf } from './choices.js';

/**
 * @typedef {object} Shown  a map, or what several have in common
 * @property {{asked: {measure: import('../kernel/found.js').Measure}}|null} map
 * @property {{unsettled: unknown[], missed: unknown[]}|null} layers
 * @property {number[]} levels
 * @property {() => import('./picture.js').Look|null} look
 */

/** Room for a number, px. */
const GAP = 38;
const HEIGHT = 9; // px

export class Legend {
  #width = 280;
  #drawn = '';

  constructor() {
    this.bar = h('div', { class: 'map-bar', role: 'img' });
    this.hatches = h('div', { class: 'map-hatches' });
    this.own = h('span', { class: 'map-own', title: 'Whose places are shown' });
    this.node = h(
      'div',
      { class: 'map-legend', 'data-testid': 'map-legend', hidden: true },
      this.own,
      this.bar,
      this.hatches,
    );
    new ResizeObserver(([{ contentRect }]) => (this.#width = contentRect.width || this.#width)).observe(this.bar);
  }

  /**
   * @param {Shown} map @param {'pitch'|'yaw'|null} own  whose places these are; null: of both loops
   * @param {number} spread
   */
  draw(map, own, spread) {
    const look = map.look();
    this.node.hidden = !look || !map.map || !map.layers;
    if (!look || !map.map || !map.layers) return;
    const { measure } = map.map.asked;
    const { unsettled, missed } = map.layers;
    const drawn = JSON.stringify([
      own,
      measure,
      spread,
      map.levels,
      look,
      this.#width,
      !unsettled.length,
      !missed.length,
    ]);
    if (drawn === this.#drawn) return;
    this.#drawn = drawn;
    setAttr(this.bar, 'aria-label', titleOf(measure, spread));
    setAttr(this.bar, 'title', titleOf(measure, spread));
    this.own.replaceChildren(...(own ? [own] : /** @type {const} */ (['pitch', 'yaw'])).map((name) => shape(name)));
    this.bar.replaceChildren(barOf(map.levels, look, unitOf(measure.name), this.#width));
    const keys = /** @type {const} */ ([
      [unsettled, 'muted', measure.name === 'settling_time' ? 'not settled' : 'none'],
      [missed, 'warn', 'missed'],
    ]);
    this.hatches.replaceChildren(
      ...keys
        .filter(([rings]) => rings.length)
        .map(([, kind, words]) => h('span', {}, h('i', { class: `map-hatch ${kind}` }), words)),
    );
  }
}

/** @param {number[]} levels @param {import('./picture.js').Look} look @param {string} unit @param {number} room px */
function barOf(levels, look, unit, room) {
  const width = 100 / look.bands.length;
  const every = Math.ceil(GAP / ((room * width) / 100));
  const first = levels.length > every ? Math.min(1, every - 1) : 0;
  const labelled = levels.map((_, k) => k % every === first);
  const last = labelled.lastIndexOf(true);
  const at = (/** @type {number} */ k) => `${((k + 1) * width).toFixed(3)}%`;
  return svg(
    'svg',
    { class: 'map-scale', 'aria-hidden': 'true' },
    look.bands.map((fill, k) =>
      svg('rect', { x: `${(k * width).toFixed(3)}%`, width: `${width.toFixed(3)}%`, height: HEIGHT, fill }),
    ),
    levels.flatMap((level, k) => {
      const tick = svg('line', { x1: at(k), x2: at(k), y2: HEIGHT + (labelled[k] ? 3 : 0), stroke: look.lines[k] });
      const text = k === last && unit ? `${levelText(level, levels)} ${unit}` : levelText(level, levels);
      return labelled[k] ? [tick, svg('text', { x: at(k), y: HEIGHT + 14, 'text-anchor': 'middle' }, text)] : [tick];
    }),
  );
}
