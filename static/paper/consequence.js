/** Where the printed K really puts the poles, as a table and in the s-plane. */
import { complex, fixed } from '../text/index.js';
import { h, head, svg, wide } from '../ui/index.js';
import { dampingRatio, polesText } from './math.js';
import { arrow, drawing } from './drawing.js';
import { chapter } from './forms.js';
import { rich } from './rich.js';

/** @typedef {import('./math.js').Complex} Complex */
const WIDTH = 440;
const SCALE = 27;
const X0 = 382; // of the imaginary axis
const Y0 = 200;
const at = (/** @type {Complex} */ p) => [X0 + SCALE * p.re, Y0 - SCALE * p.im];

/** @param {Complex[]} wanted @param {Complex[]} landed */
function plane(wanted, landed) {
  const ticks = [-12, -10, -8, -6, -4, -2];
  const label = (
    /** @type {number} */ x,
    /** @type {number} */ y,
    /** @type {string} */ text,
    anchor = 'middle',
    kind = 'muted',
  ) => svg('text', { class: `words ${kind}`, x, y, 'text-anchor': anchor }, text);
  const moved = landed.filter((p) => p.im !== 0);
  const lost = wanted.filter((w) => !landed.some((p) => p.im === 0 && Math.hypot(p.re - w.re, p.im - w.im) < 0.3));
  const from = at({ re: lost.reduce((s, p) => s + p.re, 0) / (lost.length || 1), im: 0 });
  return drawing(
    'paper-plane',
    WIDTH,
    400,
    'Where the printed K puts the poles',
    `Wanted: ${polesText(wanted, 2)}. On the rig of the manual: ${polesText(landed)}.`,
    ...ticks.map((t) => svg('line', { class: 'gridline', x1: X0 + SCALE * t, y1: 12, x2: X0 + SCALE * t, y2: 372 })),
    ...[-6, -4, -2, 2, 4, 6].map((t) =>
      svg('line', { class: 'gridline', x1: 14, y1: Y0 - SCALE * t, x2: 426, y2: Y0 - SCALE * t }),
    ),
    svg('line', { class: 'axis-line', x1: 14, y1: Y0, x2: 426, y2: Y0 }),
    svg('line', { class: 'axis-line strong', x1: X0, y1: 12, x2: X0, y2: 372 }),
    ...ticks.map((t) => label(X0 + SCALE * t, 388, fixed(t, 0))),
    label(X0, 388, '0'),
    ...[-6, -4, -2, 2, 4, 6].map((t) => label(X0 + 8, Y0 - SCALE * t + 4, fixed(t, 0), 'start')),
    label(X0 + 8, 22, 'Im', 'start'),
    label(426, Y0 - 6, 'Re', 'end'),
    ...moved.map((p) => {
      const [x, y] = at(p);
      const length = Math.hypot(x - from[0], y - from[1]);
      const [ux, uy] = [(x - from[0]) / length, (y - from[1]) / length];
      return arrow(`${from[0] + 22 * ux},${from[1] + 22 * uy} ${x - 14 * ux},${y - 14 * uy}`, 'shift');
    }),
    ...wanted.map((p) => {
      const [x, y] = at(p);
      return svg('circle', { class: 'wanted', cx: x, cy: y, r: 8 });
    }),
    ...landed.map((p) => {
      const [x, y] = at(p);
      return svg('path', {
        class: `landed ${p.im === 0 ? '' : 'moved'}`,
        d: `M ${x - 5} ${y - 5} l 10 10 M ${x + 5} ${y - 5} l -10 10`,
      });
    }),
    ...moved.map((p) => {
      const [x, y] = at(p);
      return label(x + 13, y + 5, complex(p), 'start', 'strong');
    }),
  );
}

/** @param {import('./math.js').Paper} paper */
export function consequence({ consequence: rows, numbers }) {
  const wanted = numbers.filter((n) => /^p_\d$/.test(n.name)).map((n) => ({ re: Number(n.printed), im: 0 }));
  const landed = rows[rows.length - 1].poles;
  const pair = landed.find((p) => p.im > 0);
  const says = pair
    ? `The yaw pair was meant to be real and fast, at ${polesText(wanted.slice(2), 2)}. On the rig of the manual ` +
      `it is ${polesText([pair])}: slower, and it rings, with a damping ratio of ${fixed(dampingRatio(pair))}.`
    : '';
  return chapter(
    'consequence',
    'What the unequal digits mean',
    h(
      'p',
      { class: 'prose' },
      rich(
        'A slip in a formula matters if the poles notice. Here the $K$ that the paper prints, as printed, is put ' +
          `on ${rows.length} plants, each one step nearer to the real rig. The requested poles were ` +
          `${polesText(wanted, 2)}. ${says}`,
      ),
    ),
    h(
      'div',
      { class: 'consequence' },
      wide(
        'Where the printed K puts the poles',
        h(
          'table',
          { class: 'paper-table', 'data-testid': 'paper-consequence' },
          head(['the printed K on this plant …', '… puts the poles at, rad/s', 'and its formula, unrounded, at']),
          h(
            'tbody',
            {},
            rows.map((r) =>
              h(
                'tr',
                {},
                h('th', { scope: 'row' }, rich(r.plant)),
                h('td', { class: 'poles-cell' }, polesText(r.poles)),
                h('td', { class: 'poles-cell aside' }, polesText(r.unrounded)),
              ),
            ),
          ),
        ),
        'sideways',
      ),
      h(
        'figure',
        {},
        plane(wanted, landed),
        h(
          'figcaption',
          {},
          h('span', { class: 'key wanted-key' }, 'requested'),
          h('span', { class: 'key landed-key' }, 'with the printed K on the rig of the manual'),
        ),
      ),
    ),
  );
}
