/**
 * What can be said of a system and its design: verdict, findings, K, L, F, indices, zeros, T, Q, M, relative gains, and
 * the gains in closed form.
 * @typedef {import('../contract.js').SystemRead} SystemRead
 * @typedef {import('../contract.js').SystemDesign} SystemDesign
 * @typedef {import('../contract.js').SystemFormulas} SystemFormulas
 */
import { say, significant, t } from '../text/index.js';
import { copyButton, formula, h, setText, symbol } from '../ui/index.js';
import { NumberMatrix } from './matrices.js';
import { polesLine } from './poles.js';

const LONG = 240; // characters of LaTeX from which on a matrix is shown entry by entry
const LARGE = /\d{7}/; // a number that nobody reads
/** The law where references are not weighed by F. @type {Record<string, string>} */
const FED = { integral: 'u = −Kx + K_z ∫ (r − y) dt', inputs: 'u = −Kx + v' };
const SIGNS = { error: '✕', warning: '!', info: 'i' };

export class Results {
  constructor() {
    const matrix = (
      /** @type {string} */ name,
      /** @type {[string, string]} */ letters,
      /** @type {string} */ about,
      exact = false,
    ) => new NumberMatrix(name, letters, about, exact);
    this.K = matrix('K', ['u', 'x'], 'u = −Kx + F r');
    this.L = matrix('L', ['x', 'y'], 'x̂′ = Ax̂ + Bu + L (y − ŷ)');
    this.Kz = matrix('K_z', ['u', 'z'], 'of the integrated errors');
    this.F = matrix('F', ['u', 'r'], 'how references enter');
    this.T = matrix('T', ['z', 'x'], 'x̄ = Tx, Luenberger’s canonical form', true);
    this.Q = matrix('Q', ['u', 'u'], 'the nonzero rows of TB', true);
    this.M = matrix('M', ['x', 'm'], '[b₁ … A^(σ₁−1)b₁ | b₂ …]', true);
    this.rga = matrix('RGA', ['y', 'u'], 'of the plant at ω = 0', true);
    this.rga.node.classList.add('relative-gain');
    this.facts = h('dl', { class: 'plant-facts', 'data-testid': 'plant-facts' });
    this.findings = h('ul', { class: 'plant-findings', 'data-testid': 'plant-findings' });
    this.verdict = h('p', { class: 'plant-verdict', role: 'status', 'data-testid': 'plant-verdict' });
    this.gains = h(
      'section',
      { class: 'card plant-gains', 'aria-label': 'The gains' },
      h('h3', {}, 'Gains'),
      this.verdict,
      this.findings,
      this.K.node,
      this.Kz.node,
      this.L.node,
      this.F.node,
    );
    this.structure = h(
      'section',
      { class: 'card plant-structure', 'aria-label': 'The plant by itself' },
      h('h3', {}, 'The plant by itself'),
      this.facts,
      this.rga.node,
      this.T.node,
      this.Q.node,
      this.M.node,
    );
    this.closed = h('div', { class: 'plant-closed', 'data-testid': 'plant-closed' });
    this.formulas = h(
      'section',
      { class: 'card plant-letters-card', 'aria-label': 'Closed form' },
      h('h3', {}, 'Closed form'),
      this.closed,
    );
  }

  /** @param {SystemRead} read */
  read({ analysis: a }) {
    const modes = (/** @type {import('../types.js').Complex[]} */ poles) =>
      poles.length ? polesLine(poles) : t('none');
    /** @type {[string, string, string?][]} */ const facts = [
      [t('Poles, rad/s'), `${modes(a.poles)} (${a.stable ? t('stable') : t('not stable')})`],
      [t('Zeros, rad/s'), modes(a.zeros)],
      [t('Controllability indices'), a.inputs.indices.join(', ')],
    ];
    if (a.inputs.lost.length) facts.push([t('Not controllable'), modes(a.inputs.lost)]);
    if (a.outputs) facts.push([t('Observability indices'), a.outputs.indices.join(', ')]);
    if (a.outputs?.lost.length) facts.push([t('Not observable'), modes(a.outputs.lost)]);
    if (a.niederlinski !== undefined)
      facts.push([t('Niederlinski index'), significant(a.niederlinski, 4), 'relative-gain']);
    this.facts.replaceChildren(
      ...facts.flatMap(([name, value, kind]) => [
        h('dt', { class: kind }, name),
        h('dd', { class: kind, translate: 'no' }, value),
      ]),
    );
    for (const name of /** @type {const} */ (['T', 'Q', 'M', 'rga'])) this[name].show(a[name]);
  }

  /** @param {SystemDesign|null} design */
  design(design) {
    this.K.show(design?.K);
    this.Kz.show(design?.K_z);
    this.L.show(design?.observer?.L);
    this.F.show(FED[design?.scaling ?? ''] ? undefined : design?.F);
    if (!design) return;
    setText(this.K.about, FED[design.scaling] ?? 'u = −Kx + F r');
    const parts = [
      say`Closed loop: ${polesLine(design.poles)} rad/s.`,
      design.pole_error === undefined
        ? ''
        : say`Pole error ${design.pole_error ? significant(design.pole_error, 2) : '0'}.`,
      `‖K‖ = ${significant(design.norm, 4)}.`,
      t(design.reason),
    ];
    this.verdict.classList.remove('failure');
    setText(this.verdict, parts.filter(Boolean).join(' '));
  }

  /** @param {import('../types.js').Problem} problem */
  refuse({ detail, title, hint }) {
    this.design(null);
    this.verdict.classList.add('failure');
    setText(this.verdict, [detail ?? title, hint].filter(Boolean).join(' '));
  }

  /** @param {import('../contract.js').Finding[]} findings */
  remark(findings) {
    this.findings.replaceChildren(
      ...findings.map(({ severity, message, code }) =>
        h(
          'li',
          { class: severity, 'data-code': code },
          h('span', { class: 'icon', 'aria-hidden': 'true' }, SIGNS[severity]),
          h('span', {}, message),
        ),
      ),
    );
  }

  /** @param {SystemFormulas|string|null} told formulas, why there are none, or null while they are derived */
  letters(told) {
    this.closed.setAttribute('aria-busy', String(told === null));
    if (told === null) {
      if (!this.closed.childElementCount) this.closed.replaceChildren(h('p', { class: 'caption' }, 'Deriving …'));
      return;
    }
    if (typeof told === 'string') {
      this.closed.replaceChildren(h('p', { class: 'caption' }, told));
      return;
    }
    if (LARGE.test(told.K.latex)) {
      const words = 'These numbers make formulas of long fractions. Give letters for some of them, as m in 1/m.';
      this.closed.replaceChildren(h('p', { class: 'caption' }, words));
      return;
    }
    const shown = (/** @type {string} */ name, /** @type {Node[]} */ parts) =>
      h(
        'div',
        { class: 'sideways plant-closed-form', tabindex: 0, role: 'group', 'aria-label': say`${name} in closed form` },
        parts,
      );
    const inWords = (/** @type {string} */ entry) =>
      h('span', { class: 'plant-entry' }, symbol(entry[0], entry.slice(2)), ' = ');
    const part = (
      /** @type {string} */ name,
      /** @type {import('../contract.js').Formula} */ own,
      /** @type {Record<string, import('../contract.js').Formula>} */ entries,
      /** @type {import('../contract.js').Formula[]} */ unless,
    ) => [
      h(
        'div',
        { class: 'plant-formula-head' },
        h('b', { translate: 'no' }, name),
        copyButton(`plant-closed-${name}`, () => [{ name, latex: own.latex, sympy: own.sympy }]),
      ),
      own.latex.length > LONG
        ? Object.entries(entries).map(([entry, { mathml }]) => shown(entry, [inWords(entry), formula(mathml)]))
        : shown(name, [formula(own.mathml)]),
      unless.length
        ? h(
            'p',
            { class: 'caption plant-unless' },
            'holds unless one of these is 0: ',
            unless.map((c) => formula(c.mathml)),
          )
        : null,
    ];
    this.closed.replaceChildren(
      ...[
        ...part('K', told.K, told.K_entries, told.holds_unless),
        ...(told.L ? part('L', told.L, told.L_entries ?? {}, told.observer_holds_unless ?? []) : []),
        told.reason ? h('p', { class: 'caption' }, told.reason) : null,
        h('p', { class: 'caption' }, 'p₁ … pₙ are the desired poles, q₁ … qₙ the observer’s.'),
      ]
        .flat()
        .filter((node) => node !== null),
    );
  }
}
