/** The verdict on the whole loop, and what else is to be said of the design, worst first, in a place that is always kept free for it. */
import { h, setText } from '../dom.js';
import { fixed } from '../format.js';
import { limitsCost } from '../limits_cost.js';

const ICON = { error: '✕', warning: '▲', info: 'i' };
const WORD = { error: 'Error', warning: 'Warning', info: 'Note' };
const RANK = { error: 0, warning: 1, info: 2 };
const SHOWN = 2;
/** What is chosen in the experiment and explains others of its severity. */
const CAUSES = ['slow_sampling', 'fast_tracking'];

/** @param {import('../types.js').State} state @returns {import('../types.js').Finding[]} */
export function findingsOf({ reply, problem, design }) {
  if (problem) return [{ code: problem.code ?? 'refused', severity: 'error', message: [problem.detail ?? problem.title ?? 'The server refused this design.', problem.hint].filter(Boolean).join(' ') }];
  const cost = limitsCost(reply, design?.scenario);
  const own = /** @type {import('../types.js').Finding[]} */ (cost ? [{ code: 'limits_cost', severity: 'warning', message: cost }] : []);
  const rank = (/** @type {import('../types.js').Finding} */ f) => (RANK[f.severity] ?? 3) - (CAUSES.includes(f.code) ? 0.5 : 0);
  return [...own, ...(reply?.findings ?? [])].sort((a, b) => rank(a) - rank(b));
}

export class FindingsPanel {
  #key = '';

  /** @param {HTMLElement} root */
  constructor(root) {
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

  /** @param {import('../types.js').Finding} f */
  #item(f) {
    const severity = f.severity in ICON ? f.severity : 'info';
    return h('li', { class: severity, title: f.message, 'data-code': f.code }, h('span', { class: 'icon', 'aria-hidden': 'true' }, ICON[severity]), h('span', { class: 'sr' }, `${WORD[severity]}: `),
      h('span', { class: 'message' }, f.message));
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    const { reply, problem } = state;
    const kind = problem ? 'refused' : !reply ? 'waiting' : reply.stable ? 'stable' : 'unstable';
    const worst = reply ? Math.max(...reply.loop_poles.map((p) => p.re)) : NaN;
    this.verdict.className = `verdict ${kind}`;
    setText(this.icon, { refused: '!', waiting: '…', stable: '✓', unstable: '✕' }[kind]);
    setText(this.word, { refused: 'Not computed', waiting: 'Waiting', stable: 'Stable', unstable: 'Unstable' }[kind]);
    setText(this.detail, !reply || problem ? '' : `${reply.stable ? 'slowest' : 'worst'} of ${reply.loop_poles.length} poles at Re ${fixed(worst)}`);

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
    setText(this.more, findings.length > SHOWN ? `${findings.length - SHOWN} more` : 'Read all');
    if (this.more.hidden) this.#toggle(false);
  }
}
