/**
 * The verdict on the whole loop, and what else is to be said of the design, worst first, in a place that is always kept
 * free for it.
 */
import { fixed, say, t } from '../text/index.js';
import { AXES, hidesRemarks, LOOP, missesLag, placeOf, remarked, textOf, tipOf, verdictOf } from '../model/index.js';
import { button, h, setText } from '../ui/index.js';
import { leadTo } from './lead.js';

const ICON = { error: '✕', warning: '▲', info: 'i' };
const WORD = { error: 'Error', warning: 'Warning', info: 'Note' };
const RANK = { error: 0, warning: 1, info: 2 };
const SHOWN = 2;
const AWAY = 'server_away';
/** What the page itself says of its numbers. */
const OWN = [AWAY, 'requirement_missed', 'lag_margin_missed'];
/** What explains others of its severity, or says what they cost. */
const CAUSES = ['slow_sampling', 'fast_tracking', 'unlike_linear'];

/**
 * The requirements that the steps miss, in words; empty where they are met or none is asked.
 * @param {import('../types.js').State} state
 */
function missedWords({ reply, requirements }) {
  const [pitch, yaw] = AXES.map((axis) => verdictOf(reply, axis, requirements)).map((v) =>
    v?.met === false ? v.text : '',
  );
  if (pitch && yaw) return say`Requirements missed: the pitch step ${pitch}; the yaw step ${yaw}.`;
  return pitch
    ? say`Requirement missed: the pitch step ${pitch}.`
    : yaw
      ? say`Requirement missed: the yaw step ${yaw}.`
      : '';
}

/** @param {import('../types.js').State} state @returns {import('../types.js').Finding[]} */
export function findingsOf(state) {
  const { reply, problem, heard, answered, connection } = state;
  if (problem)
    return [
      {
        code: problem.code ?? 'refused',
        severity: 'error',
        message: [problem.detail ?? problem.title ?? 'The server refused this design.', problem.hint]
          .filter(Boolean)
          .join(' '),
      },
    ];
  const missed = missedWords(state);
  const slower = missesLag(reply, state.requirements)
    ? say`Requirement missed: the loop bears ${textOf(LOOP.lag, reply?.lag_margin)} of lag in its rotors.`
    : '';
  const away =
    connection === 'lost' && heard !== answered ? t('The server is away: remarks are of an earlier design.') : '';
  const own = /** @type {import('../types.js').Finding[]} */ (
    [
      { code: AWAY, severity: 'info', message: away },
      { code: 'requirement_missed', severity: 'warning', message: missed },
      { code: 'lag_margin_missed', severity: 'warning', message: slower },
    ].filter((f) => f.message)
  );
  const rank = (/** @type {import('../types.js').Finding} */ f) =>
    (f.code === AWAY ? -1 : (RANK[f.severity] ?? 3)) - (CAUSES.includes(f.code) ? 0.5 : 0);
  return [...own, ...remarked(state)].sort((a, b) => rank(a) - rank(b));
}

export class FindingsPanel {
  #key = '';

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.icon = h('span', { class: 'icon', 'aria-hidden': 'true' });
    this.word = h('strong');
    this.detail = h('span', { class: 'detail' });
    this.lag = h('span', { class: 'detail', title: tipOf(LOOP.lag), 'data-testid': 'strip-lag' });
    this.verdict = h(
      'div',
      { class: 'verdict', 'data-testid': 'verdict', role: 'status' },
      this.icon,
      h('div', {}, h('span', {}, this.word, ' ', this.lag), this.detail),
    );
    this.list = h('ul', { class: 'list', 'aria-live': 'polite' });
    this.all = h('ul', { class: 'all', hidden: true, id: 'all-findings' });
    this.more = button({
      class: 'more',
      hidden: true,
      'aria-expanded': 'false',
      'aria-controls': 'all-findings',
      onclick: () => this.#toggle(Boolean(this.all.hidden)),
    });
    root.append(
      this.verdict,
      h('div', { class: 'findings', 'data-testid': 'findings' }, this.list, this.more, this.all),
    );
    root.addEventListener('keydown', (e) => e.key === 'Escape' && this.#toggle(false));
    document.addEventListener(
      'pointerdown',
      (e) => !root.contains(/** @type {Node} */ (e.target)) && this.#toggle(false),
    );
  }

  /** @param {boolean} open */
  #toggle(open) {
    this.all.hidden = !open;
    this.more.setAttribute('aria-expanded', String(open));
  }

  /** @param {string} code */
  #lead(code) {
    this.#toggle(false);
    leadTo(placeOf(code, this.store.state));
  }

  /** @param {import('../types.js').Finding} f */
  #item(f) {
    const severity = f.severity in ICON ? f.severity : 'info';
    const words = [
      h('span', { class: 'icon', 'aria-hidden': 'true' }, ICON[severity]),
      h('span', { class: 'sr' }, `${t(WORD[severity])}: `),
      h('span', { class: 'message' }, f.message),
    ];
    const place = placeOf(f.code, this.store.state);
    const lead = place
      ? button({ class: 'finding', title: say`${f.message} Go there.`, onclick: () => this.#lead(f.code) }, words)
      : words;
    const kind = OWN.includes(f.code) ? `${severity} own` : severity;
    return h('li', { class: kind, title: place ? undefined : f.message, 'data-code': f.code }, lead);
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    const { reply, problem } = state;
    const findings = findingsOf(state);
    const kind = problem ? 'refused' : !reply ? 'waiting' : reply.stable ? 'stable' : 'unstable';
    // in a stable loop what is not left of the axis is the integrator of a loop that is switched off
    const poles = (reply?.loop_poles ?? []).filter((p) => !reply?.stable || p.re < 0);
    const worst = reply ? Math.max(...poles.map((p) => p.re)) : NaN;
    const uneasy = kind === 'stable' && findings.some((f) => f.severity !== 'info');
    this.verdict.className = `verdict ${kind}${uneasy ? ' uneasy' : ''}`;
    setText(this.icon, uneasy ? ICON.warning : { refused: '!', waiting: '…', stable: '✓', unstable: '✕' }[kind]);
    setText(this.word, { refused: 'Not computed', waiting: 'Waiting', stable: 'Stable', unstable: 'Unstable' }[kind]);
    const lag = problem || reply?.lag_margin === undefined ? '' : textOf(LOOP.lag, reply.lag_margin);
    setText(this.lag, lag && say`lag margin ${lag}`);
    setText(
      this.detail,
      problem && reply
        ? 'figures: last computed design'
        : !reply || problem
          ? ''
          : reply.stable
            ? say`slowest of ${poles.length} poles at Re ${fixed(worst)}`
            : say`worst of ${reply.loop_poles.length} poles at Re ${fixed(worst)}`,
    );

    const calm = hidesRemarks(state)
      ? `Remarks on this design are hidden ${state.task ? 'in this step' : 'by the link that opened this page'}.`
      : state.design?.scenario.saturation === false
        ? 'No warnings. Voltage limits are off in this experiment.'
        : 'No warnings. Motor voltages stay within their limits.';
    const key = JSON.stringify([kind, findings, calm]);
    if (key === this.#key) return;
    this.#key = key;
    const none = h('li', { class: 'none' }, h('span', { class: 'message' }, reply ? calm : ''));
    this.list.replaceChildren(...(findings.length ? findings.slice(0, SHOWN).map((f) => this.#item(f)) : [none]));
    this.all.replaceChildren(...findings.map((f) => this.#item(f)));
    const cut = [...this.list.querySelectorAll('.message')].some(
      (m) => m.scrollHeight > m.clientHeight + 1 || m.scrollWidth > m.clientWidth + 1,
    );
    this.more.hidden = findings.length <= SHOWN && !cut;
    setText(this.more, findings.length > SHOWN ? say`${findings.length - SHOWN} more` : 'Read all');
    if (this.more.hidden) this.#toggle(false);
  }
}
