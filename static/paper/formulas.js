/**
 * K and the RGA as typeset formulas, each entry of K beside its present value: of four states, or of six where the
 * rotors are placed; with an observer its L. Fetched once per structure, when first seen.
 */
import { messageOf, say } from '../text/index.js';
import { bodyOf, FULL_RANK, nameOf, presetOf } from '../model/index.js';
import { formula, h, Lazy, setText, whileSeen } from '../ui/index.js';
import { ofObserver, ofPaper, ofRotors } from './derived.js';
import { watchEnds } from './ends.js';
import { copying, defined, Entries, nonzero } from './entries.js';
import { rich } from './rich.js';
import { memberOf } from './structure.js';
import { SymbolCards } from './symbol_cards.js';
import { toldOf } from './symbols.js';
import { walk } from './walk.js';

/**
 * @typedef {import('../contract.js').Symbolic} Symbolic
 * @typedef {import('../contract.js').SymbolicRotors} SymbolicRotors
 * @typedef {import('../contract.js').SymbolicObserver} SymbolicObserver
 * @typedef {ReturnType<typeof memberOf> & {six: boolean, observed: boolean}} Wanted
 */
/** @type {[import('../types.js').KeysOf<Symbolic & SymbolicRotors, import('../contract.js').Formula>, string][]} */
const OTHERS = [
  ['RGA', 'Relative gain array at s = 0'],
  ['A', 'System matrix A'],
  ['B', 'Input matrix B'],
  ['T', 'Luenberger’s transformation T'],
  ['Q', 'Q'],
  ['closed_loop', 'Closed loop A − BK'],
  ['canonical_closed_loop', 'Closed loop in Luenberger’s basis, T(A − BK)T⁻¹'],
  ['G', 'Closed loop Ĝ(s)'],
];
/** Those that have no room beside another. */
const WIDE = new Set(['RGA', 'closed_loop', 'canonical_closed_loop', 'G']);

export class FormulasPanel {
  #structure = '';
  #visible = false;
  #six = false;
  /** @type {Entries|null} */ #K = null;
  /** @type {Entries|null} */ #L = null;
  /** @type {import('./walk.js').Walk|null} */ #walk = null;

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.body = h('div', { class: 'formulas-body', 'data-testid': 'formulas' });
    this.whose = h('p', { class: 'caption', role: 'status', 'data-testid': 'formulas-whose' });
    root.append(this.whose, this.body);
    watchEnds(root);
    this.cards = new SymbolCards(root, () => ({
      parameters: { ...presetOf(store.state)?.parameters, ...store.state.design?.parameters },
      components: {},
      walk: toldOf(this.#walk, store.state),
    }));
    this.lazy = new Lazy(root, h('div'), store, {
      wait: '',
      body: bodyOf,
      ask: walk,
      show: (answer) => {
        this.#walk = answer;
        this.cards.refresh();
      },
    });
    whileSeen(root, (seen) => {
      this.#visible = seen;
      this.render(store.state);
    });
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    const { design, reply } = state;
    this.lazy.render(state);
    if (!design || !this.#visible) return;
    const observer = reply?.observer ?? reply?.gains.observer; // what the loop has, or what the design has besides
    const wanted = {
      ...memberOf({ ...design, method: FULL_RANK }),
      six: (reply?.gains.K[0].length ?? 4) > 4,
      observed: Boolean(observer),
    };
    const structure = JSON.stringify(wanted);
    if (structure !== this.#structure) {
      this.#structure = structure;
      this.#load(wanted, structure);
    }
    // another method's K is not this formula's, and neither is that of the other model
    const own = reply && design.method === FULL_RANK && wanted.six === this.#six;
    setText(
      this.whose,
      design.method === FULL_RANK
        ? ''
        : say`The full-rank method’s formulas. The present K is ${nameOf(design)}’s, which has none like these.`,
    );
    this.#K?.render(own ? reply.gains.K : undefined);
    this.#L?.render(design.observer?.method === 'kalman' ? undefined : observer?.L);
  }

  /** @param {Wanted} wanted @param {string} structure */
  async #load(wanted, structure) {
    this.body.setAttribute('aria-busy', 'true');
    if (!this.body.childElementCount) this.body.append(h('p', {}, 'Deriving…'));
    try {
      const [symbolic, observer] = await Promise.all([
        wanted.six ? ofRotors(wanted) : ofPaper(wanted),
        wanted.observed ? ofObserver(wanted) : null,
      ]);
      if (structure === this.#structure) this.#show(wanted, symbolic, observer);
    } catch (error) {
      this.#structure = '';
      this.body.replaceChildren(h('p', { class: 'failure' }, `The formulas could not be fetched: ${messageOf(error)}`));
    }
    this.body.removeAttribute('aria-busy');
  }

  /** @param {Wanted} wanted @param {Symbolic|SymbolicRotors} symbolic @param {SymbolicObserver|null} observer */
  #show({ six }, symbolic, observer) {
    this.#six = six;
    const of = /** @type {Partial<Symbolic & SymbolicRotors>} */ (symbolic);
    const copy = copying(symbolic);
    this.#K = new Entries(nonzero(symbolic.entries.K), 'k-formulas', copy);
    const cards = OTHERS.flatMap(([key, title]) => {
      const own = of[key];
      return own
        ? h(
            'section',
            { class: `card ${WIDE.has(key) ? 'wide' : ''}` },
            h('h3', {}, title, ' ', copy(key, own)),
            h(
              'div',
              { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': title, 'data-testid': `formula-${key}` },
              formula(own.mathml),
            ),
          )
        : [];
    });
    const marks = new Map(symbolic.symbols.map((s) => [s.name, s.mathml]));
    const symbols = h(
      'section',
      { class: 'card' },
      h('h3', {}, 'Symbols'),
      h(
        'table',
        { class: 'symbols' },
        h(
          'tbody',
          {},
          symbolic.symbols
            .filter(({ name }) => !/^k_/.test(name))
            .map((s) =>
              h(
                'tr',
                {},
                h(
                  'th',
                  { scope: 'row' },
                  s.mathml
                    ? [h('span', { class: 'sr' }, s.name), h('span', { 'aria-hidden': 'true' }, formula(s.mathml))]
                    : s.name,
                ),
                h('td', {}, rich(s.meaning)),
                h('td', {}, s.unit),
              ),
            ),
        ),
      ),
    );
    this.body.replaceChildren(
      h(
        'section',
        { class: 'card gains' },
        h(
          'h3',
          {},
          `State feedback K, u = −Kx + v${six ? ', x with both rotors’ speeds' : ''} `,
          copy('K', symbolic.K),
        ),
        this.#K.node,
        zeros(symbolic.entries.K),
        h('div', { class: 'definitions' }, 'with', defined(symbolic.definitions, marks)),
      ),
      ...this.#observer(observer),
      ...cards,
      symbols,
    );
    this.cards.learn([
      ...symbolic.symbols.map((s) => (six ? { ...s, part: /** @type {const} */ ('rotors') } : s)),
      ...(observer?.symbols ?? []).map((s) => ({
        ...s,
        chapters: ['observer'],
        part: /** @type {const} */ ('observer'),
      })),
    ]);
    for (const part of this.body.querySelectorAll('.card'))
      this.cards.mark(part, part.matches('.observer') ? 'observer' : '');
    this.render(this.store.state);
  }

  /** The card of an observer's L. @param {SymbolicObserver|null} observer */
  #observer(observer) {
    this.#L = null;
    if (!observer) return [];
    const copy = copying(observer);
    this.#L = new Entries(nonzero(observer.entries.L), 'l-card', copy);
    const marks = new Map(observer.symbols.map((s) => [s.name, s.mathml]));
    return [
      h(
        'section',
        { class: 'card gains observer' },
        h('h3', {}, 'Observer L, x̂′ = Ax̂ + Bu + L(y − Cx̂) ', copy('L', observer.L)),
        this.#L.node,
        zeros(observer.entries.L),
        h('div', { class: 'definitions' }, 'with', defined(observer.definitions, marks)),
      ),
    ];
  }
}

/** @param {Record<string, import('../contract.js').Formula>} entries */
const zeros = (entries) =>
  Object.values(entries).some((e) => e.sympy === '0')
    ? h('p', { class: 'aside' }, 'An entry that is not here is 0.')
    : null;
