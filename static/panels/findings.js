/** The verdict on the whole loop, and what else is to be said of the design, worst first, in a place that is always kept free for it. */
import { h, setText } from '../dom.js';
import { fixed } from '../format.js';
import { placeOf } from '../finding_places.js';
import { leadTo } from '../lead.js';
import { limitsCost } from '../limits_cost.js';
import { placesPoles } from '../methods.js';
import { isAsked, pairVerdict } from '../requirements.js';
import { say, t } from '../words.js';

const ICON = { error: '✕', warning: '▲', info: 'i' };
const WORD = { error: 'Error', warning: 'Warning', info: 'Note' };
const RANK = { error: 0, warning: 1, info: 2 };
const SHOWN = 2;
/** What is chosen in the experiment and explains others of its severity. */
const CAUSES = ['slow_sampling', 'fast_tracking'];

/** The requirements that the placed poles miss, in words; empty where they are met or none is asked. @param {import('../types.js').State} state */
function missedWords(state) {
  const { design, requirements } = state;
  if (!design || !requirements || !isAsked(requirements) || !placesPoles(state)) return '';
  const [pitch, yaw] = /** @type {const} */ ([0, 1]).map((pair) => pairVerdict(design.poles, pair, requirements));
  if (pitch.met && yaw.met) return '';
  return pitch.met ? say`The placed poles miss the requirements: yaw ${yaw.text}.` : yaw.met ? say`The placed poles miss the requirements: pitch ${pitch.text}.` : say`The placed poles miss the requirements: pitch ${pitch.text}, yaw ${yaw.text}.`;
}

/** @param {import('../types.js').State} state @returns {import('../types.js').Finding[]} */
export function findingsOf(state) {
  const { reply, problem, design } = state;
  if (problem) return [{ code: problem.code ?? 'refused', severity: 'error', message: [problem.detail ?? problem.title ?? 'The server refused this design.', problem.hint].filter(Boolean).join(' ') }];
  const cost = limitsCost(reply, design?.scenario);
  const missed = missedWords(state);
  const own = /** @type {import('../types.js').Finding[]} */ ([cost && { code: 'limits_cost', severity: 'warning', message: cost }, missed && { code: 'requirement_missed', severity: 'warning', message: missed }].filter(Boolean));
  const rank = (/** @type {import('../types.js').Finding} */ f) => (RANK[f.severity] ?? 3) - (CAUSES.includes(f.code) ? 0.5 : 0);
  return [...own, ...(reply?.findings ?? [])].sort((a, b) => rank(a) - rank(b));
}

export class FindingsPanel {
  #key = '';

  /** @param {HTMLElement} root @param {import('../store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.icon = h('span', { class: 'icon', 'aria-hidden': 'true' });
    this.word = h('strong');
    this.detail = h('span', { class: 'detail' });
    this.verdict = h('div', { class: 'verdict', 'data-testid': 'verdict', role: 'status' }, this.icon, h('div', {}, this.word, this.detail));
    this.list = h('ul', { class: 'list', 'aria-live': 'polite' });
    this.all = h('ul', { class: 'all', hidden: true, id: 'all-findings' });
    this.more = h('button', { type: 'button', class: 'more', hidden: true, 'aria-expanded': 'false', 'aria-controls': 'all-findings', onclick: () => this.#toggle(Boolean(this.all.hidden)) });
    root.append(this.verdict, h('div', { class: 'findings', 'data-testid': 'findings' }, this.list, this.more, this.all));
    root.addEventListener('keydown', (e) => e.key === 'Escape' && this.#toggle(false));
    document.addEventListener('pointerdown', (e) => !root.contains(/** @type {Node} */ (e.target)) && this.#toggle(false));
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
    const words = [h('span', { class: 'icon', 'aria-hidden': 'true' }, ICON[severity]), h('span', { class: 'sr' }, `${t(WORD[severity])}: `), h('span', { class: 'message' }, f.message)];
    const place = placeOf(f.code, this.store.state);
    const lead = place ? h('button', { type: 'button', class: 'finding', title: say`${f.message} Go there.`, onclick: () => this.#lead(f.code) }, words) : words;
    return h('li', { class: severity, title: place ? undefined : f.message, 'data-code': f.code }, lead);
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    const { reply, problem } = state;
    const kind = problem ? 'refused' : !reply ? 'waiting' : reply.stable ? 'stable' : 'unstable';
    // in a stable loop what is not left of the axis is the integrator of a loop that is switched off
    const poles = (reply?.loop_poles ?? []).filter((p) => !reply?.stable || p.re < 0);
    const worst = reply ? Math.max(...poles.map((p) => p.re)) : NaN;
    this.verdict.className = `verdict ${kind}`;
    setText(this.icon, { refused: '!', waiting: '…', stable: '✓', unstable: '✕' }[kind]);
    setText(this.word, { refused: 'Not computed', waiting: 'Waiting', stable: 'Stable', unstable: 'Unstable' }[kind]);
    setText(this.detail, !reply || problem ? '' : reply.stable ? say`slowest of ${poles.length} poles at Re ${fixed(worst)}` : say`worst of ${reply.loop_poles.length} poles at Re ${fixed(worst)}`);

    const findings = findingsOf(state);
    const calm = state.design?.scenario.saturation === false ? 'Nothing to object; but here the motors know no limits.' : 'Nothing to object: the motors stay within their limits.';
    const key = JSON.stringify([kind, findings, calm]);
    if (key === this.#key) return;
    this.#key = key;
    const none = h('li', { class: 'none' }, h('span', { class: 'message' }, reply ? calm : ''));
    this.list.replaceChildren(...(findings.length ? findings.slice(0, SHOWN).map((f) => this.#item(f)) : [none]));
    this.all.replaceChildren(...findings.map((f) => this.#item(f)));
    const cut = [...this.list.querySelectorAll('.message')].some((m) => m.scrollHeight > m.clientHeight + 1 || m.scrollWidth > m.clientWidth + 1);
    this.more.hidden = findings.length <= SHOWN && !cut;
    setText(this.more, findings.length > SHOWN ? say`${findings.length - SHOWN} more` : 'Read all');
    if (this.more.hidden) this.#toggle(false);
  }
}
