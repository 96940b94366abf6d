/** What an opened row of the comparison shows: K as a matrix, the loop's poles, and what is to be said of it. */
import { polesText, say, significant } from '../text/index.js';
import { GAIN, gainMatrix, h, integralMatrix } from '../ui/index.js';

/** @param {string} name @param {import('../types.js').Complex[]} poles */
function poles(name, poles) {
  return h('p', {}, h('span', { class: 'aside' }, `${name}, rad/s: `), polesText(poles).replaceAll(', ', ',\u2002'));
}

/** @param {import('../contract.js').Loops} loops */
const piText = ({ pitch, yaw }) =>
  [pitch, yaw]
    .map(({ kp, ti }, i) => say`${i ? 'yaw' : 'pitch'} ${significant(kp, 3)} V/rad, ${significant(ti, 3)} s`)
    .join('; ');

/** @param {import('../contract.js').ComparisonRow} row @param {string} key @param {string} title */
export function rowDetail(row, key, title) {
  const k = gainMatrix(`compare-k-${key}`, GAIN);
  k.render(row.K, (v) => significant(v, 4));
  const matrices = [k.node];
  if (row.integral) {
    const integral = integralMatrix(`compare-ki-${key}`);
    integral.render(row.integral, (v) => significant(v, 4));
    matrices.push(integral.node);
  }
  return h(
    'div',
    { class: 'inside' },
    h('div', { class: 'matrices' }, matrices),
    h(
      'div',
      { class: 'said' },
      row.optimal_poles
        ? poles('Optimal poles', row.optimal_poles)
        : poles('Poles of A − BK', row.closed_loop_poles ?? []),
      row.loops ? h('p', {}, h('span', { class: 'aside' }, 'PI loops: '), piText(row.loops)) : null,
      poles('Poles of the whole loop', row.loop_poles ?? []),
      (row.findings ?? []).map((f) => h('p', { class: f.severity }, f.message)),
      h('p', { class: 'aside' }, title.replace('\n', ': ')),
    ),
  );
}
