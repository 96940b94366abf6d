/**
 * Where on the page a finding belongs: where its link leads, and what is said of it in few words at that place. Pure.
 * @typedef {import('../types.js').Finding} Finding
 * @typedef {import('../types.js').State} State
 */
import { say, share, t } from '../text/index.js';
import { AXES, verdictOf } from './requirements.js';

const testid = (/** @type {string} */ name) => `[data-testid="${name}"]`;
const plot = (/** @type {string} */ signal) => `${testid(`plot-${signal}`)} .plot-body`;
const LOOPS = `${testid('suggest-pi')}`;

/** Selectors of what takes the focus, by the finding's code. @type {Record<string, string>} */
const PLACES = {
  pi_unstable: LOOPS,
  loop_unstable: LOOPS,
  poorly_damped: LOOPS,
  pitch_loop_open: testid('kp-pitch'),
  yaw_loop_open: testid('kp-yaw'),
  saturation_V_p: plot('V_p'),
  saturation_V_y: plot('V_y'),
  travel_stop: plot('theta'),
  diverges: plot('theta'),
  unlike_linear: testid('more-figures'),
  not_settled: testid('duration'),
  slow_pole: LOOPS,
  reference_beyond_stop: testid('step-theta'),
  starts_on_stop: testid('experiment-start-theta'),
  integration_stopped: testid('experiment-tolerance'),
  disturbance_left_out: testid('more-figures'),
  slow_sampling: testid('experiment-sample-time'),
  fast_tracking: testid('experiment-tracking'),
  pairing_cross: testid('pair-advised'),
  pairing_diagonal: testid('pair-advised'),
  own_poles: testid('method'),
  own_integral_action: testid('method'),
  nearly_uncontrollable: testid('rig-K_pp'),
  lives_by_fast_rotors: testid('show-lag'),
  rotors_unstable: testid('place-rotors'),
  flat_thrust: testid('show-lag'),
  observer_unstable: testid('measured'),
  lag_unlimited: testid('more-figures'),
  lag_margin_missed: testid('require-lag'),
};

/**
 * Which of the placed poles a finding is about, by how it is measured.
 * @type {Record<string, (p: import('../types.js').Complex, index: number, s: Pick<State, 'requirements'|'reply'>) =>
 *   number>}
 */
const POLES = {
  right_half_plane: (p) => p.re,
  imaginary_axis: (p) => p.re,
  no_steady_state: (p) => -Math.hypot(p.re, p.im),
  far_out: (p) => Math.hypot(p.re, p.im),
  repeated_poles: () => 0,
  open_loop_pole: () => 0,
  pole_error: () => 0,
  short_delay_margin: (p) => Math.hypot(p.re, p.im),
  high_gain: (p) => Math.hypot(p.re, p.im),
  requirement_missed: (p, index, { requirements, reply }) =>
    (verdictOf(reply, AXES[index < 2 ? 0 : 1], requirements)?.met === false ? 1e6 : 0) + p.re,
};

/**
 * @param {string} code
 * @param {Pick<State, 'design'|'requirements'|'problem'|'reply'>} state
 * @returns {string} a selector; empty where it belongs to no place
 */
export function placeOf(code, { design, requirements, problem, reply }) {
  if (problem) return problem.field ? `[data-field="${CSS_SAFE.test(problem.field) ? problem.field : ''}"]` : '';
  const measure = POLES[code];
  if (!measure || !design) return PLACES[code] ?? '';
  const sizes = design.poles.map((p, i) => measure(p, i, { requirements, reply }));
  return testid(`pole-${sizes.indexOf(Math.max(...sizes))}`);
}
const CSS_SAFE = /^[\w.]+$/;

/** @param {Finding[]} findings @param {string[]} codes the one that matters most first */
const first = (findings, codes) =>
  codes.map((code) => findings.find((f) => f.code === code)).find((f) => f !== undefined);

/**
 * What is said at the loops and at the plots, each in few words with its whole sentence behind.
 * @param {Pick<State, 'reply'|'problem'> & Partial<Pick<State, 'motion'>>} state
 * @returns {Record<'loops'|'theta'|'V_p'|'V_y', {text: string, severity: string, message: string}|null>}
 */
export function remarksOf({ reply, problem, motion = 'both' }) {
  const findings = problem ? [] : (reply?.findings ?? []);
  const remark = (/** @type {Finding|undefined} */ f, /** @type {string} */ text) =>
    f ? { text: `${f.severity === 'error' ? '✕' : '▲'} ${text}`, severity: f.severity, message: f.message } : null;
  const motor = (/** @type {'V_p'|'V_y'} */ name) => {
    const alone = motion === 'both' ? undefined : reply?.axis_steps?.[motion]; // as it is seen, and counted
    const part = (alone ?? reply?.step)?.nonlinear.metrics?.[name]?.saturated ?? 0;
    return remark(first(findings, [`saturation_${name}`]), part > 0 ? say`at limit ${share(part)}` : t('at limit'));
  };
  const stop = first(findings, ['reference_beyond_stop', 'travel_stop', 'starts_on_stop']);
  const unstable = first(findings, [
    'pi_unstable',
    'loop_unstable',
    'rotors_unstable',
    'observer_unstable',
    'flat_thrust',
  ]);
  const open = first(findings, ['pitch_loop_open', 'yaw_loop_open']);
  return {
    loops: unstable
      ? remark(unstable, t('unstable'))
      : open
        ? remark(open, t('open loop'))
        : (remark(first(findings, ['poorly_damped']), t('rings')) ?? remark(first(findings, ['slow_pole']), t('slow'))),
    theta: remark(stop, stop?.code === 'travel_stop' ? t('hits a stop') : t('beyond a stop')),
    V_p: motor('V_p'),
    V_y: motor('V_y'),
  };
}
