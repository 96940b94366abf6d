/**
 * Every number that the paper prints, beside what its formula gives: the table that is meant to be searched in seconds.
 */
import { h, head, wide } from '../ui/index.js';
import { countsOf, digitsText, figure, groupBy, minus } from './math.js';
import { chapter } from './forms.js';
import { named, rich } from './rich.js';

/** @typedef {import('./math.js').PrintedNumber} PrintedNumber */
const COLUMNS = [
  'quantity',
  'printed',
  'unit',
  'from the printed formula',
  'corrected',
  'on the rig of the manual',
  'digits that agree',
  'verdict',
  'note',
];
/** @type {Record<string, string>} */
const VERDICTS = { reproduced: '✓ reproduced', differs: '≠ differs', given: 'given' };

/** @param {PrintedNumber} n */
function row(n) {
  const value = (/** @type {number|undefined} */ v) => figure(v, n.digits_printed + 2);
  return h(
    'tr',
    { class: n.verdict, 'data-testid': `paper-number-${n.name}`, 'data-verdict': n.verdict },
    h('th', { scope: 'row' }, named(n.name)),
    h('td', { class: 'printed' }, minus(n.printed)),
    h(
      'td',
      { class: 'unit' },
      n.unit === '1' ? '' : n.unit,
      n.printed_unit ? [' ', h('s', { title: 'the unit as printed' }, n.printed_unit)] : null,
    ),
    h('td', {}, n.recomputed === undefined ? null : h('small', {}, rich(n.formula)), value(n.recomputed)),
    h('td', {}, value(n.corrected)),
    h('td', {}, value(n.on_rig)),
    h('td', { class: 'digits' }, digitsText(n)),
    h('td', { class: 'verdict-cell' }, VERDICTS[n.verdict]),
    h('td', { class: 'note-cell' }, rich(n.note)),
  );
}

/** @param {import('./math.js').Paper} paper */
export function numbers(paper) {
  const c = countsOf(paper);
  return chapter(
    'numbers',
    'Every printed number',
    h(
      'p',
      { class: 'prose' },
      `The paper prints ${c.numbers} numbers. ${c.derivable} of them can be computed from its formulas: ` +
        `${c.reproduced} come out to every printed digit, ${c.differs} do not. The other ${c.given} are given, not ` +
        'derived. ',
      '“From the printed formula” takes the values that reproduce the paper’s results, in Table I the components ' +
        'of the design file; “corrected” puts the same values into the right formula, in Table I it is the value ' +
        'that the results used; “on the rig of the manual” puts the manual’s values into the right formula.',
    ),
    wide(
      'Table of the printed numbers',
      h(
        'table',
        { class: 'paper-table numbers-table', 'data-testid': 'paper-numbers' },
        head(COLUMNS),
        groupBy(paper.numbers, (n) => n.where).map(([where, list]) =>
          h(
            'tbody',
            {},
            h('tr', { class: 'where' }, h('th', { colspan: COLUMNS.length, scope: 'rowgroup' }, h('span', {}, where))),
            list.map(row),
          ),
        ),
      ),
      'sideways',
    ),
  );
}
