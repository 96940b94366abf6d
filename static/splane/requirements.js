/**
 * What is asked of the response: two fields below the s-plane; and, as a guide, the regions where a pole alone would
 * not do, hatched.
 */
import { forField, say, t } from '../text/index.js';
import { forbidden, isAsked, leastDamping, missesLag, missing, NONE, RANGES } from '../model/index.js';
import { button, h, NumberField, setText, svg } from '../ui/index.js';
import { bounds, toPixel } from './math.js';

/** @typedef {import('../types.js').Requirements} Requirements */
/** @typedef {import('./math.js').View} View */

/** Two hatchings that can be told apart where they cross. @param {string} id @param {number} angle */
const pattern = (id, angle) =>
  svg(
    'pattern',
    { id, width: 7, height: 7, patternUnits: 'userSpaceOnUse', patternTransform: `rotate(${angle})` },
    svg('line', { class: 'asked-line', x1: 0, y1: 0, x2: 0, y2: 7 }),
  );

export const hatchings = () => [pattern('hatch-settling', 45), pattern('hatch-overshoot', -45)];

/** @param {SVGGElement} layer @param {View} view @param {Requirements} r */
export function drawForbidden(layer, view, r) {
  const regions = forbidden(bounds(view), r);
  // Hatched up to the imaginary axis: beyond it the plane is hatched as unstable.
  const hatched = svg('svg', { width: Math.max(0, toPixel(view, { re: 0, im: 0 })[0]), height: view.height });
  /** @type {SVGElement[]} */ const nodes = [hatched];
  for (const kind of /** @type {const} */ (['overshoot', 'settling'])) {
    const corners = regions[kind];
    if (!corners) continue;
    const points = corners.map((p) =>
      toPixel(view, p)
        .map((v) => v.toFixed(1))
        .join(' '),
    );
    hatched.append(
      svg('path', {
        class: 'forbidden',
        'data-testid': `forbidden-${kind}`,
        fill: `url(#hatch-${kind})`,
        d: `M ${points.join(' L ')} Z`,
      }),
    );
    const border = kind === 'settling' ? points.slice(0, 2) : [points[1], points[0], points[points.length - 1]];
    nodes.push(svg('path', { class: 'forbidden-edge', d: `M ${border.join(' L ')}` }));
  }
  if (regions.settling && r.settling !== null) {
    const [x, y] = [toPixel(view, regions.settling[0])[0] + 12, view.height - 48];
    nodes.push(
      svg(
        'text',
        { class: 'forbidden-label', x, y, transform: `rotate(-90 ${x} ${y})` },
        say`guide: alone settling > ${forField(r.settling)} s`,
      ),
    );
  }
  const zeta = leastDamping(r);
  if (zeta !== undefined && r.overshoot !== null) {
    const [x0, y0] = toPixel(view, { re: 0, im: 0 });
    const angle = (Math.acos(zeta) * 180) / Math.PI;
    // Along the upper side of the wedge, where it is well in view.
    const along = 0.55 * Math.min(zeta > 0.05 ? x0 / zeta : Infinity, y0 / Math.max(0.05, Math.sqrt(1 - zeta * zeta)));
    const [x, y] = [x0 - along * zeta, y0 - along * Math.sqrt(1 - zeta * zeta)];
    if (along > 60)
      nodes.push(
        svg(
          'text',
          {
            class: 'forbidden-label',
            x,
            y: y - 5,
            'text-anchor': 'middle',
            transform: `rotate(${angle.toFixed(1)} ${x} ${y})`,
          },
          say`guide: alone overshoot > ${forField(r.overshoot)} %`,
        ),
      );
  }
  layer.replaceChildren(...nodes);
}

export class RequirementsBar {
  /** @type {Requirements} */ #shown = NONE;

  /** @param {import('../model/store.js').Store} store */
  constructor(store) {
    const field = (
      /** @type {keyof Requirements} */ key,
      /** @type {string} */ mark,
      /** @type {string} */ unit,
      /** @type {number} */ start,
      /** @type {string} */ title,
    ) => {
      const least = key === 'lag';
      const made = new NumberField({
        label: `${mark} at ${least ? 'least' : 'most'}, ${unit === 's' ? 'seconds' : 'percent'}; empty: not asked`,
        mark: h('span', { title }, `${mark} ${least ? '≥' : '≤'}`),
        unit,
        testid: `require-${key}`,
        ...RANGES[key],
        optional: true,
        onInput: (v) =>
          store.set({ requirements: { ...store.state.requirements, [key]: Number.isFinite(v) ? v : null } }),
        onCommit: () => {},
      });
      made.setBlank('off', start);
      return made;
    };
    this.settling = field(
      'settling',
      'settling',
      's',
      1,
      'The steps shall settle to 2 % within this time. Hatched, as a guide: where a pole alone would take longer, ' +
        '4/σ. Empty: not asked',
    );
    this.overshoot = field(
      'overshoot',
      'overshoot',
      '%',
      10,
      'The steps shall overshoot by no more. Hatched, as a guide: where a pair alone would overshoot by more, ' +
        'e^(−πζ/√(1 − ζ²)). Empty: not asked',
    );
    this.lag = field(
      'lag',
      'lag',
      's',
      0.3,
      say`The loop shall stay stable with rotors that are so slow: an Aero’s need ${0.16} s. Empty: not asked`,
    );
    this.verdict = h('span', { class: 'asked-verdict', 'data-testid': 'requirements-verdict', role: 'status' });
    this.node = h(
      'div',
      { class: 'asked', id: 'asked', role: 'group', 'aria-label': 'Requirements on the response', hidden: true },
      this.settling.node,
      this.overshoot.node,
      this.lag.node,
      this.verdict,
    );
    this.opener = button(
      {
        class: 'quiet',
        'aria-controls': 'asked',
        'aria-expanded': 'false',
        'data-testid': 'requirements',
        title: 'What the steps’ responses shall keep: settling time, overshoot, lag in the rotors',
        onclick: () => this.#show(Boolean(this.node.hidden)),
      },
      'Requirements',
    );
  }

  /** @param {boolean} open */
  #show(open) {
    this.node.hidden = !open;
    this.opener.setAttribute('aria-expanded', String(open));
  }

  /** @param {import('../types.js').State} state */
  render({ reply, requirements: r }) {
    const asked = isAsked(r) || r.lag !== null;
    if (r !== this.#shown) {
      if (asked) this.#show(true); // a link may have brought them
      this.#shown = r;
      this.settling.set(r.settling ?? NaN);
      this.overshoot.set(r.overshoot ?? NaN);
      this.lag.set(r.lag ?? NaN);
    }
    const missed = [...missing(reply, r), ...(missesLag(reply, r) ? [t('lag margin')] : [])];
    this.verdict.classList.toggle('missed', missed.length > 0);
    setText(this.verdict, !asked || !reply ? '' : missed.length ? `✕ ${missed.join(', ')}` : '✓ met');
  }
}
