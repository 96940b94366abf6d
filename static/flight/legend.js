/** What keys, the gamepad and fingers do in a flight, as a table. */
import { t } from '../text/index.js';
import { h } from '../ui/index.js';

/** What it does, by which keys, by what of a gamepad. @returns {[string, string[], string][]} */
const rows = () => [
  [t('Pitch: nose up, down'), ['↑', '↓', 'W', 'S'], t('left stick')],
  [t('Yaw: nose left, right'), ['←', '→', 'A', 'D'], t('left stick; hands on, the right one')],
  [t('Hands on: the sticks are the voltages'), ['H'], 'X'],
  [t('Freeze, go on'), ['Space'], 'A'],
  [t('One sample'), ['.'], ''],
  [t('Slow motion'), [','], ''],
  [t('Back by 5 s'), ['Backspace'], 'Y'],
  [t('A gust'), ['B'], 'B'],
  [t('Push the nose'), ['Shift + ↑ ↓ ← →'], ''],
  [t('Push by dragging the body'), ['P', 'Shift'], ''],
  [t('Take off, from the start again'), ['R'], ''],
  [t('End'), ['X'], ''],
];

/** The table. */
export const legend = () =>
  h(
    'table',
    { class: 'fly-legend', 'data-testid': 'fly-legend' },
    h('caption', {}, 'In flight, where no field has the focus. A tap on a key moves finely'),
    h(
      'thead',
      {},
      h(
        'tr',
        {},
        ['what', 'keys', 'gamepad'].map((name) => h('th', { scope: 'col' }, name)),
      ),
    ),
    h(
      'tbody',
      {},
      rows().map(([does, keys, pad]) =>
        h(
          'tr',
          {},
          h('th', { scope: 'row' }, does),
          h(
            'td',
            {},
            keys.flatMap((key, i) => [i ? ' ' : '', h('kbd', {}, key)]),
          ),
          h('td', {}, pad),
        ),
      ),
    ),
  );
