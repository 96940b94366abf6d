/**
 * Where the paper's model ends, and what follows: the rotors' equations, six states and their gain, the observer. Each
 * chapter's formulas are fetched when it is first seen.
 */
import { FULL_RANK, nameOf } from '../model/index.js';
import { h, Lazy, Matrix, setText, symbol, wide } from '../ui/index.js';
import { assumedWords, BEYOND, DEFINED, EDGE, lagWords, STEPS } from './beyond_words.js';
import { ofObserver, ofRotors } from './derived.js';
import { copying, defined, Entries, nonzero } from './entries.js';
import { mark } from './equations.js';
import { chapter, typeset } from './forms.js';
import { clean, figure, polesText } from './math.js';
import { rich } from './rich.js';
import { memberOf } from './structure.js';
import { CHAPTERS } from './words.js';

/**
 * @typedef {import('../contract.js').Formula} Formula
 * @typedef {import('../contract.js').SymbolicRotors} SymbolicRotors
 * @typedef {import('../contract.js').SymbolicObserver} SymbolicObserver
 * @typedef {import('./symbols.js').Term} Term
 * @typedef {import('./walk.js').Walk} Walk
 * @typedef {import('./symbols.js').Part} Part
 * @typedef {{learn: (part: Part, terms: Term[]) => void, mark: (node: Element, chapter: string)
 *   => void}} Cards
 */
const STATES = ['θ', 'ψ', 'θ̇', 'ψ̇'].map((s) => () => symbol(s));
const SPEEDS = ['p', 'y'].map((j) => () => symbol('v', j));
const made = (/** @type {(() => Node)[]} */ list) => list.map((make) => make());
const motors = () => [symbol('V', 'p'), symbol('V', 'y')];

/** @param {string} testid @param {string} name @param {Node[]} rows @param {Node[]} columns @param {string} [note] */
const numbers = (testid, name, rows, columns, note) =>
  new Matrix(
    testid,
    h('b', {}, name),
    rows,
    columns,
    (i, j) => `${name}, row ${i + 1}, column ${j + 1}`,
    note === undefined ? undefined : { name, note: note || undefined },
  );

/** @param {string} name of a step @param {string} inChapter @param {...import('../ui/dom.js').Child} content */
function step(name, inChapter, ...content) {
  const [title, plain] = STEPS[/** @type {keyof typeof STEPS} */ (name)];
  const id = `eq-beyond-${name}`;
  return h(
    'article',
    { class: 'eq', id, 'aria-labelledby': `${id}-title`, 'data-testid': 'beyond-step', 'data-chapter': inChapter },
    h(
      'div',
      { class: 'margin' },
      h('a', { class: 'eq-number aside', href: `#${id}`, 'aria-label': `unnumbered: ${title}` }, 'unnumbered'),
      mark('explained'),
    ),
    h(
      'div',
      { class: 'eq-main' },
      h('h4', { id: `${id}-title` }, title),
      h('p', { class: 'plainly' }, rich(plain, id)),
      h('div', { class: 'eq-body' }, content),
    ),
  );
}

/**
 * @param {string} caption
 * @param {[string, Formula][]} formulas with what stands before each, as rich text
 * @param {string} label
 */
const forms = (caption, formulas, label) =>
  h(
    'figure',
    { class: 'form derived explained' },
    h('figcaption', {}, caption),
    formulas.map(([before, form]) =>
      h(
        'div',
        { class: 'named-formula' },
        before ? h('span', { class: 'before' }, rich(before)) : null,
        typeset(form, `${label}${before ? `, ${before.replaceAll('$', '').replace(' =', '')}` : ''}`),
      ),
    ),
  );

const live = (/** @type {import('../ui/dom.js').Children} */ ...parts) =>
  h('div', { class: 'live' }, h('p', { class: 'live-caption' }, 'on the present rig'), ...parts);

/**
 * What the letters stand for, those of a kind together.
 * @param {Record<string, Formula>} all
 * @param {Map<string, string>} marks MathML by name
 */
const letters = (all, marks) =>
  h(
    'div',
    {},
    DEFINED.flatMap(([title, kind]) => {
      const own = Object.entries(all).filter(([name]) => (/^[dh](?=_)/.exec(name)?.[0] ?? '') === kind);
      return own.length
        ? [
            h('p', { class: 'unit-line' }, title),
            h('div', { class: 'definitions' }, defined(Object.fromEntries(own), marks)),
          ]
        : [];
    }),
  );

export class Beyond {
  /** @type {Walk|null} */ #walk = null;
  /** @type {Record<string, ((walk: Walk) => void)[]>} */ #fill = { six: [], observer: [] };

  /** @param {import('../model/store.js').Store} store @param {Cards} cards */
  constructor(store, cards) {
    this.cards = cards;
    this.judged = h('p', { class: 'live-line', 'data-testid': 'paper-lag' });
    this.chapters = BEYOND.map((words, i) => this.#chapter(words, CHAPTERS.length + i + 1));
    this.chapters[0].append(this.#limit());
    const [, six, observer] = this.chapters;
    const [a, b] = [h('div'), h('div')];
    six.append(a);
    observer.append(b);
    const wait = 'Deriving…';
    this.lazy = [
      new Lazy(six, a, store, { wait, body: memberOf, ask: ofRotors, show: (f) => this.#six(a, f, store) }),
      new Lazy(observer, b, store, {
        wait,
        body: memberOf,
        ask: ofObserver,
        show: (f) => this.#observer(b, f),
      }),
    ];
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    for (const lazy of this.lazy) lazy.render(state);
    if (state.reply) setText(this.judged, lagWords(state.reply));
  }

  /** @param {Walk} walk */
  show(walk) {
    this.#walk = walk;
    for (const fills of Object.values(this.#fill)) for (const fill of fills) fill(walk);
  }

  /** @param {typeof BEYOND[number]} words @param {number} number */
  #chapter({ name, title, text, look }, number) {
    return chapter(
      name,
      [h('span', { class: 'ordinal' }, String(number)), title],
      h(
        'div',
        { class: 'prose' },
        h('p', {}, rich(text)),
        h('p', { class: 'look' }, h('b', {}, 'Look at this. '), rich(look)),
      ),
    );
  }

  #limit() {
    const row = (/** @type {string} */ head, /** @type {string[]} */ cells) =>
      h(
        'tr',
        {},
        h('th', { scope: 'row' }, head),
        cells.map((text) => h('td', {}, text)),
      );
    const sign = (/** @type {number} */ v) => (v > 0 ? '+' : '') + v.toFixed(2).replace('-', '−');
    return h(
      'div',
      { class: 'eq-body' },
      wide(
        'The first design’s poles by the rotors’ lag',
        h(
          'table',
          { class: 'paper-table', 'data-testid': 'paper-lag-table' },
          h(
            'tbody',
            {},
            row(
              'lag of both rotors, s',
              EDGE.map(([tau]) => figure(tau)),
            ),
            row(
              'largest real part, rad/s',
              EDGE.map(([, re]) => sign(re)),
            ),
          ),
        ),
      ),
      live(this.judged),
    );
  }

  /** @param {HTMLElement} root @param {SymbolicRotors} f @param {import('../model/store.js').Store} store */
  #six(root, f, store) {
    const marks = new Map(f.symbols.map((s) => [s.name, s.mathml]));
    const entries = new Entries(nonzero(f.entries.K), 'k6-formulas', copying(f, 'beyond'), marks);
    const states = [...STATES, ...SPEEDS];
    const rates = () => [...['θ̇', 'ψ̇', 'θ̈', 'ψ̈'].map((s) => symbol(s)), symbol('v̇', 'p'), symbol('v̇', 'y')];
    const A = numbers('paper-A6', 'A', rates(), made(states), '');
    const B = numbers('paper-B6', 'B', rates(), motors(), '');
    const K = numbers('paper-K6', 'K', motors(), made(states), 'θ, ψ: V/rad; rates: V·s/rad; v: V/V');
    const assumed = h('p', { class: 'unit-line' });
    const poles = h('p', { class: 'live-line', 'data-testid': 'paper-poles6' });
    const why = h('p', { class: 'refused-words' });
    const { design } = store.state;
    const whose = h('p', { class: 'unit-line' });
    this.#fill.six = [
      (walk) => {
        const own = walk.refused === undefined ? walk.rotors : undefined;
        setText(why, walk.refused ?? own?.refused ?? '');
        why.hidden = !why.textContent;
        A.render(clean(own?.A), (v) => figure(v));
        B.render(clean(own?.B), (v) => figure(v));
        K.render(clean(own?.K), (v) => figure(v, 6));
        entries.render(walk.asked.method === FULL_RANK ? own?.K : undefined);
        setText(assumed, own ? assumedWords(own.assumed) : '');
        setText(poles, own?.poles ? `Eigenvalues of A − BK: ${polesText(own.poles, 4)} rad/s.` : '');
        whose.hidden = walk.asked.method === FULL_RANK;
        setText(whose, `As ${nameOf(walk.asked)} computes it, not by this formula.`);
      },
    ];
    const structure = design ? nameOf({ method: FULL_RANK, ...memberOf(design) }) : '';
    const scrolled = (/** @type {Matrix} */ m, /** @type {string} */ label) =>
      h('div', { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': label }, m.node);
    root.replaceChildren(
      step(
        'lag',
        'six',
        forms(
          'two equations more',
          [
            ['', f.lag_pitch],
            ['', f.lag_yaw],
          ],
          'Rotors',
        ),
      ),
      step(
        'thrust',
        'six',
        forms(
          'quadratic, of either motor',
          [
            ['$φ(v)$ =', f.thrust],
            ['$φ′(v)$ =', f.slope],
          ],
          'Thrust',
        ),
      ),
      step(
        'model',
        'six',
        forms(
          'derived',
          [
            ['$A$ =', f.A],
            ['$B$ =', f.B],
          ],
          'Six states',
        ),
        live(h('div', { class: 'numerics' }, scrolled(A, 'A of six states'), scrolled(B, 'B of six states')), assumed),
      ),
      step(
        'basis',
        'six',
        forms(
          structure,
          [
            ['$T$ =', f.T],
            ['$Q$ =', f.Q],
          ],
          'Basis of six states',
        ),
      ),
      step(
        'gain',
        'six',
        h(
          'figure',
          { class: 'form derived explained' },
          h('figcaption', {}, `derived: ${structure}; an entry that is not here is 0`),
          entries.node,
        ),
        letters(f.definitions, marks),
        live(
          scrolled(K, 'K of six states'),
          h('p', { class: 'unit-line' }, 'θ, ψ: V/rad; rates: V·s/rad; v: V/V'),
          poles,
          whose,
          why,
        ),
      ),
      step('limit', 'six'),
    );
    this.#known('rotors', 'six', f.symbols, root);
  }

  /** @param {HTMLElement} root @param {SymbolicObserver} f */
  #observer(root, f) {
    const marks = new Map(f.symbols.map((s) => [s.name, s.mathml]));
    const entries = new Entries(nonzero(f.entries.L), 'l-formulas', copying(f, 'beyond'), marks);
    const L = numbers('paper-L', 'L', made(STATES), made(STATES.slice(0, 2)), '1/s, and 1/s² below');
    const poles = h('p', { class: 'live-line', 'data-testid': 'paper-observer-poles' });
    this.#fill.observer = [
      (walk) => {
        const own = walk.refused === undefined ? walk.observer : undefined;
        L.render(clean(own?.L), (v) => figure(v, 6));
        entries.render(own?.asked && own.L);
        const whose = own?.used ? 'The feedback acts on it' : 'The design’s feedback does not act on it';
        const kalman = own && !own.asked ? ' It is a Kalman filter’s, not by this formula.' : '';
        setText(poles, own ? `Eigenvalues of A − LC: ${polesText(own.poles, 4)} rad/s. ${whose}.${kalman}` : '');
      },
    ];
    root.replaceChildren(
      step('observer', 'observer', forms('its rate', [['$x̂′$ =', f.observer]], 'Observer')),
      step(
        'dual',
        'observer',
        forms(
          'what is placed',
          [
            ['$C$ =', f.C],
            ['$T$ =', f.T],
            ['$Q$ =', f.Q],
          ],
          'Dual pair',
        ),
        h(
          'figure',
          { class: 'form derived explained' },
          h('figcaption', {}, 'derived; an entry that is not here is 0'),
          entries.node,
        ),
        letters(f.definitions, marks),
        live(L.node, h('p', { class: 'unit-line' }, '1/s, and 1/s² below'), poles),
      ),
      step('separation', 'observer', forms('derived, of [x, e]', [['', f.separation]], 'Separation')),
    );
    this.#known('observer', 'observer', f.symbols, root);
  }

  /** @param {Part} part @param {string} inChapter @param {Term[]} symbols @param {Element} root */
  #known(part, inChapter, symbols, root) {
    this.cards.learn(
      part,
      symbols.map((s) => ({ ...s, chapters: [inChapter], part })),
    );
    for (const own of root.children) this.cards.mark(own, inChapter);
    if (this.#walk) for (const fill of this.#fill[inChapter]) fill(this.#walk);
  }
}
