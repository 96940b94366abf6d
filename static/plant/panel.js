/**
 * Any plant: a system is pasted, its poles are dragged, and its gains, responses and formulas stand beside them. What
 * the server says of the system is asked once per text, what it says of a design with every move. What is chosen goes
 * to the store as a link has it, and comes from there: by undo, Back, a link, a pin.
 * @typedef {import('../types.js').Problem} Problem
 * @typedef {import('../contract.js').SystemRead} SystemRead
 * @typedef {import('../contract.js').SystemDesign} SystemDesign
 * @typedef {import('../contract.js').SystemExample} SystemExample
 * @typedef {import('../contract.js').SystemFormulas} SystemFormulas
 * @typedef {import('./wish.js').Wish} Wish
 * @typedef {{text: string, example: SystemExample|null}} Typed
 * @typedef {Typed & {wish: Wish|null, session?: number, own: boolean, turn: number}} Reading wish: what it is opened
 *   with; own: whether a person has changed it, rather than the store
 */
import { messageOf } from '../text/index.js';
import { call, fileOf, Latest, ProblemError } from '../net/index.js';
import { samePlant } from '../model/index.js';
import { button, h, saveFile, setText, whileSeen } from '../ui/index.js';
import { Controls } from './controls.js';
import { Editor } from './editor.js';
import { linkText, matlabText, plantIn, systemText } from './link_text.js';
import { Pins } from './pins.js';
import { Plane } from './plane.js';
import { Responses } from './responses.js';
import { Results } from './results.js';
import { bodyOf, fitting, NO_WISH, sizesOf } from './wish.js';

const MOST_LETTERED = 6; // states for which formulas are derived
const FASTER = 3; // the observer's poles, where none are given, against the placed ones
const TEXTS = 300; // as typed, that undo brings back
const FILES = /** @type {const} */ ([
  ['matlab', 'MATLAB, Octave', '.m'],
  ['python', 'Python', '.py'],
  ['json', 'JSON', '.json'],
]);

/** @param {unknown} error @returns {Problem} */
const problemOf = (error) => (error instanceof ProblemError ? error.problem : { detail: messageOf(error) });
const wordsOf = (/** @type {Problem} */ { detail, title, hint }) => [detail ?? title, hint].filter(Boolean).join(' ');

const rounded = (/** @type {number} */ v) => Number(v.toPrecision(4));

export class PlantPanel {
  /** @type {Wish} */ #wish = NO_WISH;
  /** @type {SystemRead|null} */ #read = null;
  /** @type {SystemDesign|null} */ #design = null;
  /** @type {string|null} what the store has of it; null: the first of the textbooks' */ #linked = null;
  /** @type {Typed} as it was read */ #typed = { text: '', example: null };
  /** @type {Map<string, Typed>} as it was typed, by what links have of it */ #texts = new Map();
  /** Whose turn it is to be read: what was asked for before is not taken any more. */ #turn = 0;
  /** @type {Promise<SystemExample[]>|null} */ #examples = null;
  #held = false;
  #fresh = true;

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.root = root;
    this.editor = new Editor({
      onText: (text, session) => this.#take({ text, example: null }, null, session),
      onExample: (example) => this.#take({ text: example.text, example }, wishOf(example)),
      onLeave: () => store.commit(),
    });
    this.plane = new Plane({
      onMove: (which, poles, held) => {
        this.#held = held;
        this.#change({ [which]: poles });
      },
    });
    this.controls = new Controls(
      (change) => this.#change(change),
      () => this.#observe(),
    );
    this.results = new Results();
    this.responses = new Responses((x0) => this.#change({ x0 }));
    this.pins = new Pins(store, { onChange: () => this.#drawCurves() });
    this.pin = button({ 'data-testid': 'plant-pin', onclick: () => this.#pinned() }, 'Pin this design');
    this.told = h('span', { class: 'caption', role: 'status', 'data-testid': 'plant-told' });
    const files = FILES.map(([format, name, suffix]) =>
      button({ 'data-testid': `plant-export-${format}`, onclick: () => this.#export(format, suffix) }, name),
    );
    const placed = h(
      'section',
      { class: 'card plant-place', 'aria-label': 'Poles of the closed loop' },
      h('h3', {}, 'Poles'),
      this.plane.node,
      this.controls.node,
    );
    const tools = h(
      'div',
      { class: 'plant-row plant-tools' },
      this.pin,
      h('span', { class: 'caption' }, 'Save as'),
      files,
      this.told,
    );
    root.append(
      h(
        'div',
        { class: 'plant-body', 'data-testid': 'plant' },
        this.editor.node,
        placed,
        this.results.gains,
        h('div', { class: 'plant-wide' }, tools, this.pins.node),
        this.responses.node,
        this.results.structure,
        this.results.formulas,
      ),
    );
    this.asks = new Latest((/** @type {{read: SystemRead, wish: Wish, exactly: boolean}} */ item) => {
      this.#ask(item);
      return true;
    });
    this.reads = new Latest((/** @type {Reading} */ item) => {
      this.#readText(item);
      return true;
    });
    this.derives = new Latest((/** @type {Record<string, string[][]>} */ rows) => {
      this.#derive(rows);
      return true;
    });
    whileSeen(root, (seen) => seen && !this.#examples && !this.#read && this.#linked === null && this.#open(null));
  }

  /** @param {import('../types.js').State} state */
  render({ methods, plant, plantPins, connection }) {
    this.controls.offer(methods);
    if (plant !== this.#linked) this.#open(plant);
    this.pins.render({ plantPins, methods, connection });
  }

  /** The textbooks' systems. */
  get #textbooks() {
    if (this.#examples) return this.#examples;
    /** @type {Promise<SystemExample[]>} */ const asked = call('api/v1/system/examples');
    this.#examples = asked;
    asked.then(
      (examples) => this.editor.offer(examples),
      (error) => {
        this.#examples = null;
        this.editor.complain(problemOf(error));
      },
    );
    return asked;
  }

  /** A plant as the store has it. @param {string|null} text null: where nothing is chosen yet */
  async #open(text) {
    this.#linked = text;
    this.#turn += 1;
    const turn = this.#turn;
    if (text === null) {
      const first = await this.#textbooks.then(
        (examples) => examples[0],
        () => null,
      );
      if (first && turn === this.#turn) this.#show({ text: first.text, example: first }, wishOf(first));
      return;
    }
    this.#textbooks.catch(() => {});
    const plant = plantIn(text);
    if (!plant) {
      this.editor.complain({ detail: 'The plant of this link cannot be read.', hint: 'Paste it as text.' });
      return;
    }
    const wish = { ...plant, poles: plant.poles ?? [] };
    const same = this.#read !== null && samePlant(systemText(plant), systemText(this.#system(this.#read)));
    const typed = this.#texts.get(text) ?? (same ? this.#typed : { text: matlabText(plant), example: null });
    if (!same || !this.#read) return this.#show(typed, wish);
    this.editor.set(typed.text, typed.example);
    this.editor.complain(null);
    this.#typed = typed;
    return this.#change(fitting(this.#read, wish, true), false);
  }

  /** From the store. @param {Typed} typed @param {Wish} wish */
  #show(typed, wish) {
    this.editor.set(typed.text, typed.example);
    this.reads.put({ ...typed, wish, own: false, turn: this.#turn });
  }

  /** From a person. @param {Typed} typed @param {Wish|null} wish @param {number} [session] */
  #take(typed, wish, session) {
    if (typed.example) this.editor.set(typed.text, typed.example);
    this.#turn += 1;
    this.reads.put({ ...typed, wish, session, own: true, turn: this.#turn });
  }

  /** @param {Reading} item */
  async #readText(item) {
    this.root.setAttribute('aria-busy', 'true');
    try {
      /** @type {SystemRead} */ const read = await call('api/v1/system/read', { text: item.text });
      if (item.turn === this.#turn) this.#took(read, item);
    } catch (error) {
      if (item.turn === this.#turn) this.editor.complain(problemOf(error));
    }
    this.root.removeAttribute('aria-busy');
    this.reads.done();
  }

  /** @param {SystemRead} read @param {Reading} item */
  #took(read, { text, example, wish, session, own }) {
    this.#fresh = true;
    this.#typed = { text, example };
    this.editor.complain(null);
    this.editor.show(read);
    this.results.read(read);
    this.#wish = fitting(read, wish ?? this.#wish, wish !== null);
    this.#read = read;
    this.#change({}, own, session);
    const n = read.analysis.poles.length;
    if (n > MOST_LETTERED) this.results.letters(`Closed forms are derived for up to ${MOST_LETTERED} states.`);
    else {
      this.results.letters(null);
      this.derives.put(this.#system(read).rows);
    }
  }

  #observe() {
    const read = this.#read;
    if (!read) return;
    const faster = () =>
      this.#wish.poles.map((p) => ({
        re: rounded(FASTER * Math.min(p.re, -Math.hypot(p.re, p.im) / 2)),
        im: rounded(FASTER * p.im),
      }));
    this.#change({ observer: this.#wish.observer ? null : faster() });
  }

  /** @param {Partial<Wish>} change @param {boolean} [own] a person's @param {number} [session] of typing */
  #change(change, own = true, session) {
    const read = this.#read;
    if (!read) return;
    this.#wish = { ...this.#wish, ...change };
    this.#drawWish();
    this.asks.put({ read, wish: this.#wish, exactly: !this.#held });
    if (!this.#held) this.#keep(own, session);
  }

  /** Tells the store what is there now. @param {boolean} own @param {number} [session] */
  #keep(own, session) {
    const plant = this.#plant;
    const first = this.#linked === null;
    if (first && !own) this.#first = plant;
    if (first && plant === this.#first) return;
    this.#linked = plant;
    this.#texts.set(plant, this.#typed);
    if (this.#texts.size > TEXTS) this.#texts.delete([...this.#texts.keys()][0]);
    if (!own) {
      if (plant !== this.store.state.plant) this.store.set({ plant }); // the same in the words of this page
      return;
    }
    this.store.editPlant(plant, session === undefined ? undefined : `text ${session}`);
    if (session !== this.editor.session) this.store.commit(); // the text was left meanwhile
  }
  #first = '';

  #drawWish() {
    const read = this.#read;
    if (!read) return;
    const { poles, observer, method } = this.#wish;
    const chosen = this.controls.about(method).places_poles === false;
    this.plane.show(
      {
        open: read.analysis.poles,
        zeros: read.analysis.zeros,
        poles,
        observer: observer ?? [],
        loop: chosen ? (this.#design?.poles ?? []) : null,
      },
      this.#fresh,
    );
    this.#fresh = false;
    this.controls.show(this.#wish, sizesOf(read));
    this.responses.from(this.#wish.x0, poles.length);
  }

  /** As a link has it. @param {SystemRead} read */
  #system({ matrices, letters }) {
    return { rows: Object.fromEntries(Object.entries(matrices).map(([name, own]) => [name, own.rows])), letters };
  }

  /** This plant with what is wanted of it, as a link has it. */
  get #plant() {
    return this.#read ? linkText({ ...this.#system(this.#read), ...this.#wish }) : '';
  }

  /** @param {{read: SystemRead, wish: Wish, exactly: boolean}} item */
  async #ask({ read, wish, exactly }) {
    try {
      /** @type {SystemDesign} */ const design = await call('api/v1/system/design', bodyOf(read, wish, exactly));
      if (read === this.#read) {
        this.root.classList.remove('plant-refused');
        this.#answered(design, read);
      }
    } catch (error) {
      if (read === this.#read) {
        this.#design = null;
        this.root.classList.add('plant-refused'); // what is below is another system's
        this.results.refuse(problemOf(error));
        this.results.remark(read.findings);
        this.pin.disabled = true;
        this.#drawWish();
      }
    }
    this.root.dataset.settled = String(!this.asks.overtaken);
    this.asks.done();
  }

  /** @param {SystemDesign} design @param {SystemRead} read */
  #answered(design, read) {
    this.#design = design;
    this.results.design(design);
    this.results.remark([...read.findings, ...design.findings]);
    this.#drawWish();
    this.#drawCurves();
  }

  #drawCurves() {
    if (this.#design) this.responses.show(this.#design, this.pins.designs);
    this.pin.disabled = !this.#design || this.pins.refuses(this.#plant);
  }

  #pinned() {
    if (this.#design) this.store.addPlantPins([{ plant: this.#plant, design: this.#design }]);
  }

  /** @param {Record<string, string[][]>} rows */
  async #derive({ A, B, C }) {
    /** @type {SystemFormulas|string} */ let told;
    try {
      told = await call('api/v1/system/formulas', { A, B, ...(C ? { C } : {}) });
    } catch (error) {
      told = wordsOf(problemOf(error));
    }
    if (!this.derives.overtaken) this.results.letters(told);
    this.derives.done();
  }

  /** @param {string} format @param {string} suffix */
  async #export(format, suffix) {
    const read = this.#read;
    if (!read) return;
    const link = new URL(location.href);
    link.hash = `#v1&plant=${encodeURIComponent(this.#plant).replace(/%(?:2C|3A|2F|2B)/g, decodeURIComponent)}`;
    try {
      const query = new URLSearchParams(link.href.length < 4000 ? { link: link.href } : {});
      saveFile(
        `heli2dof_system${suffix}`,
        await fileOf(`api/v1/system/export/${format}?${query}`, bodyOf(read, this.#wish)),
      );
      setText(this.told, '');
    } catch (error) {
      setText(this.told, wordsOf(problemOf(error)));
    }
  }
}

/** What a textbook wants of its system. @param {SystemExample} example @returns {Wish} */
function wishOf({ method, weights }) {
  const { states, inputs, integrals } = weights ?? {};
  const own = weights ? { states, inputs, ...(integrals?.length && { integrals }) } : null;
  return { ...NO_WISH, method, weights: own };
}
