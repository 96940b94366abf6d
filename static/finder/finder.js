/**
 * View Find: what a design shall do, what may be changed for it, and what the server's search finds. What is asked for
 * stands in the state and in the link; what was found stays until it is searched again.
 * @typedef {import('../types.js').State} State
 * @typedef {import('./settings.js').Settings} Settings
 * @typedef {import('./settings.js').Row} Row
 * @typedef {import('./shapes.js').Found} Found
 */
import { count, say, significant, t } from '../text/index.js';
import { bodyOf, presetOf, scenarioOf } from '../model/index.js';
import { button, check, h, setText } from '../ui/index.js';
import { uncertain } from '../clouds/index.js';
import { AskedRows } from './asked.js';
import { FindFeed } from './feed.js';
import { Preview } from './preview.js';
import { Reach } from './reach.js';
import { Results } from './results.js';
import { readAs } from './scatter_math.js';
import {
  isHidden,
  isSame,
  isKeptBack,
  askedOf,
  BUDGETS,
  freeOf,
  linkText,
  objectionTo,
  proposed,
  settingsIn,
  SPREADS,
  titleOf,
  unitOf,
  whereOf,
} from './settings.js';

/** @param {import('./shapes.js').Progress} progress @param {import('./shapes.js').Seen[]} better */
function progressWords({ tried, designs, met, points }, better) {
  const share = [tried, designs].map((own) => own.toLocaleString('en')).join(' / ');
  const words = `${share}: ${count(met, '{0} meets all', '{0} meet all')}`;
  const best = better.length === 1 && points.length ? readAs(better[0], points[0][0]) : undefined;
  if (best === undefined) return words;
  return say`${words}; best so far ${`${significant(best, 3)} ${unitOf(better[0].measure)}`.trim()}`;
}

export class Finder {
  /** What stands in the controls. @type {Settings|null} */ #settings = null;
  /** @type {string|null} the text they were read from */ #text = '';
  /** @type {import('../types.js').Requirements|null} */ #bar = null;
  /** @type {import('../types.js').Design|null} */ #from = null;
  #freeKey = '';
  /** @type {Found|null} what was found last */ #last = null;
  /** @type {import('./shapes.js').Seen[]} what the search makes better */ #better = [];

  /**
   * @param {HTMLElement} root
   * @param {import('../model/store.js').Store} store
   * @param {(design: import('../types.js').Design) => import('../types.js').Reply|null|undefined} compute
   * @param {import('../splane/splane.js').SPlane} plane
   * @param {() => WebSocket} [open]
   */
  constructor(root, store, compute, plane, open) {
    this.store = store;
    this.feed = new FindFeed({ changed: () => this.#standing(), found: (found) => this.#found(found) }, open);
    this.preview = new Preview(store, compute, { reach: new Reach(plane, store) }); // for others, too
    this.results = new Results(store, this.preview, (of, value) => this.#give(of, value));
    this.rows = new AskedRows((rows) => this.#change({ rows }));
    this.free = h('div', { class: 'lock-list' });
    this.spread = this.#select(
      'spread',
      SPREADS.map((v) => [v, v ? `± ${100 * v} %` : 'none']),
      (spread) => ({ spread }),
    );
    this.budget = this.#select(
      'budget',
      BUDGETS.map((v) => [v, say`${v.toLocaleString('en')} designs`]),
      (designs) => ({ designs }),
    );
    this.run = button({ class: 'primary', 'data-testid': 'find-run', onclick: () => this.#run() }, 'Find');
    this.cancel = button({ 'data-testid': 'find-cancel', hidden: true, onclick: () => this.feed.cancel() }, 'Cancel');
    this.bar = h('progress', { 'data-testid': 'find-bar', 'aria-label': 'Designs tried', max: 1, hidden: true });
    this.standing = h('p', { class: 'caption', role: 'status', 'data-testid': 'find-standing' });
    this.problem = h('p', { class: 'find-problem', role: 'alert', 'data-testid': 'find-problem', hidden: true });
    const part = (/** @type {string} */ title, /** @type {string} */ hint, /** @type {Node} */ node) =>
      h('fieldset', { class: 'find-part' }, h('legend', { title: hint }, title), node);
    root.append(
      h(
        'p',
        { class: 'caption find-about' },
        'Say what the responses shall keep and what shall be as good as it can be. The machine tries thousands of ' +
          'designs on the nonlinear rig, and proves what it found by the same computation as all figures here.',
      ),
      h(
        'div',
        { class: 'find-body' },
        h(
          'form',
          { class: 'card find-asked', onsubmit: (/** @type {Event} */ e) => e.preventDefault() },
          part('What counts', 'figures, their limits, and which shall be better still', this.rows.node),
          part('What is free', 'what the search may change; all else stays as it is', this.free),
          h(
            'div',
            { class: 'row find-how' },
            h(
              'label',
              { class: 'select', title: 'the same controller on rigs whose parameters differ by so much' },
              h('span', {}, 'Uncertain rigs'),
              this.spread,
            ),
            h(
              'label',
              { class: 'select', title: 'more find more, and take longer; the same number gives the same answer' },
              h('span', {}, 'Try'),
              this.budget,
            ),
          ),
          h('div', { class: 'row find-go' }, this.run, this.cancel, this.bar),
          this.standing,
          this.problem,
        ),
        h('div', { class: 'card find-found' }, this.results.node, (this.empty = this.#nothingYet())),
      ),
    );
  }

  #nothingYet() {
    return h(
      'p',
      { class: 'status', 'data-testid': 'find-empty' },
      'What is found stands here as points, one for each design. The page shows the one under the pointer.',
    );
  }

  /**
   * @param {string} id @param {(string|number)[][]} options @param {(v: number) => Partial<Settings>} part
   */
  #select(id, options, part) {
    const node = h(
      'select',
      { 'data-testid': `find-${id}` },
      options.map(([value, text]) => h('option', { value }, String(text))),
    );
    node.addEventListener('change', () => this.#change(part(Number(node.value))));
    return node;
  }

  /** @returns {Settings} */
  #now(state = this.store.state) {
    if (!this.#settings || state.find !== this.#text || (state.find === null && state.requirements !== this.#bar)) {
      this.#settings = state.find === null ? proposed(state) : settingsIn(state.find);
      this.#text = state.find;
      this.#bar = state.requirements;
    }
    return this.#settings;
  }

  /** @param {Partial<Settings>} part */
  #change(part) {
    this.#settings = { ...this.#now(), ...part };
    this.#text = linkText(this.#settings);
    this.store.set({ find: this.#text });
    this.render(this.store.state);
  }

  /** @param {State} state */
  render(state) {
    const settings = this.#now(state);
    this.rows.render(settings);
    this.spread.value = String(settings.spread);
    this.budget.value = String(settings.designs);
    this.#drawFree(state, settings);
    this.results.render(state);
    // what was found before would tell what the step asks for
    this.results.node.classList.toggle('elsewhere', isKeptBack(state));
    const objection = this.#objection(state);
    this.run.disabled = Boolean(objection) || state.connection === 'lost';
    this.run.title = t(objection);
    this.#standing();
  }

  /** @param {State} state @param {Settings} settings */
  #drawFree(state, { free }) {
    const parts = freeOf(state);
    const key = JSON.stringify([parts.map(({ name, locked }) => [name, locked]), free]);
    if (key === this.#freeKey) return;
    this.#freeKey = key;
    const focused = document.activeElement?.getAttribute('data-testid');
    this.free.replaceChildren(
      ...parts.map(({ name, title, about, locked }) => {
        const own = check(
          {
            'data-testid': `find-free-${name}`,
            checked: free.includes(name) && !locked,
            disabled: locked,
            title: locked ? (state.task ? 'Fixed in this step' : 'Locked by the link that opened this page') : about,
            onchange: () => {
              const rest = this.#now().free.filter((one) => one !== name);
              this.#change({ free: own.box.checked ? [...rest, name] : rest });
            },
          },
          title,
        );
        return own.node;
      }),
    );
    if (focused?.startsWith('find-free-'))
      /** @type {HTMLElement|null} */ (this.free.querySelector(`[data-testid="${focused}"]`))?.focus();
  }

  /** What the server is asked. @param {State} state */
  #asked(state) {
    const settings = this.#now(state);
    const { design } = state;
    const may = freeOf(state).flatMap(({ name, locked }) => (locked ? [] : [name]));
    const names = design ? uncertain(design, presetOf(state)).filter((name) => name !== 'g') : [];
    return askedOf(
      { ...settings, rows: settings.rows.filter(({ measure }) => !isHidden(state, measure)) },
      settings.free.filter((name) => may.includes(name)),
      names,
    );
  }

  /** Why nothing can be searched now; empty where it can. @param {State} state */
  #objection(state) {
    if (isKeptBack(state)) return 'In this step of the lab the search is yours.';
    return objectionTo(this.#asked(state));
  }

  #run() {
    const { state } = this.store;
    const { design } = state;
    if (!design) return;
    const asked = this.#asked(state);
    this.#from = design;
    this.#better = asked.minimize.map((own) => ({ ...own, title: titleOf(own.measure) }));
    this.feed.ask({ ...bodyOf(design), scenario: scenarioOf(design), find: asked });
    this.cancel.focus();
  }

  /** @param {Found} found */
  #found(found) {
    if (!this.#from) return;
    this.#last = found;
    this.results.put(found, this.#from);
    // below the window it would be there and nobody would know
    const { node } = this.results;
    if (node.getBoundingClientRect().top > innerHeight / 2) node.scrollIntoView({ block: 'start' });
  }

  #standing() {
    const { busy, progress, problem, cancelled } = this.feed.standing;
    const led = [this.run, this.cancel].includes(/** @type {HTMLButtonElement} */ (document.activeElement));
    this.cancel.hidden = this.bar.hidden = !busy;
    this.run.hidden = busy;
    if (led) (busy ? this.cancel : this.run).focus();
    if (busy && progress) this.bar.value = progress.designs ? progress.tried / progress.designs : 0;
    else this.bar.removeAttribute('value');
    setText(
      this.standing,
      cancelled
        ? 'Called off.'
        : !busy
          ? this.#objection(this.store.state)
          : !progress
            ? 'Searching…'
            : progressWords(progress, this.#better),
    );
    this.results.follow(busy && progress ? { figures: this.#better, points: progress.points } : null);
    this.empty.hidden = !this.results.node.hidden;
    this.problem.hidden = !problem;
    setText(this.problem, problem ? [problem.detail ?? problem.title, problem.hint].filter(Boolean).join(' ') : '');
  }

  /** Takes another limit for one that contradicts, and searches again. @param {Found['requirements'][number]} of */
  #give(of, /** @type {number} */ value) {
    const { rows } = this.#now();
    const i = rows.findIndex((row) => row.limit === (row.most ? of.max : of.min) && this.#isOf(row, of));
    if (i < 0) return;
    this.#change({ rows: rows.map((row, k) => (k === i ? { ...row, limit: value } : row)) });
    this.#run();
  }

  /** @param {Row} row @param {Found['requirements'][number]} of */
  #isOf(row, of) {
    const figure = this.#last?.figures[of.figure];
    if (!figure) return false;
    return isSame({ measure: row.measure, ...whereOf(row) }, figure);
  }
}
