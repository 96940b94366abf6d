/**
 * Any plant: a system is pasted, its poles are dragged, and its gains, responses and formulas stand beside them. What
 * the server says of the system is asked once per text, what it says of a design with every move.
 * @typedef {import('../types.js').Problem} Problem
 * @typedef {import('../contract.js').SystemRead} SystemRead
 * @typedef {import('../contract.js').SystemDesign} SystemDesign
 * @typedef {import('../contract.js').SystemExample} SystemExample
 * @typedef {import('../contract.js').SystemFormulas} SystemFormulas
 * @typedef {import('./controls.js').Wish} Wish
 */
import { messageOf } from '../text/index.js';
import { call, fileOf, Latest, ProblemError } from '../net/index.js';
import { button, h, saveFile, setText, whileSeen } from '../ui/index.js';
import { Controls } from './controls.js';
import { Editor } from './editor.js';
import { linkText, matlabText, plantIn } from './link_text.js';
import { Pins } from './pins.js';
import { Plane } from './plane.js';
import { proposal } from './poles.js';
import { Responses } from './responses.js';
import { Results } from './results.js';

const MOST_LETTERED = 6; // states for which formulas are derived
const FASTER = 3; // the observer's poles, where none are given, against the placed ones
const FILES = /** @type {const} */ ([
  ['matlab', 'MATLAB, Octave', '.m'],
  ['python', 'Python', '.py'],
  ['json', 'JSON', '.json'],
]);

/** @param {unknown} error @returns {Problem} */
const problemOf = (error) => (error instanceof ProblemError ? error.problem : { detail: messageOf(error) });

const rounded = (/** @type {number} */ v) => Number(v.toPrecision(4));

export class PlantPanel {
  /** @type {Wish} */ #wish = { poles: [], observer: null, method: 'full-rank', weights: null };
  /** @type {SystemRead|null} */ #read = null;
  /** @type {SystemDesign|null} */ #design = null;
  /** @type {string|null} what the address says of it */ #linked = null;
  /** @type {Wish|null} what a text is to be opened with */ #opening = null;
  #begun = false;
  #touched = false;
  #held = false;
  #fresh = true;

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.root = root;
    this.editor = new Editor({
      onText: (text) => this.#text(text),
      onExample: (example) => this.#example(example, true),
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
    this.responses = new Responses();
    this.pins = new Pins({ onChange: () => this.#drawCurves(), onLoad: (plant) => this.#open(plant) });
    this.pin = button({ 'data-testid': 'plant-pin', onclick: () => this.#keep() }, 'Pin this design');
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
    this.reads = new Latest((/** @type {{text: string}} */ item) => {
      this.#readText(item.text);
      return true;
    });
    this.derives = new Latest((/** @type {Record<string, string[][]>} */ rows) => {
      this.#derive(rows);
      return true;
    });
    whileSeen(root, (seen) => seen && this.#begin());
  }

  /** @param {import('../types.js').State} state */
  render({ methods, plant }) {
    this.controls.offer(methods);
    if (plant === this.#linked || plant === null) return;
    this.#linked = plant;
    this.#begun ||= this.#offer();
    this.#open(plant);
  }

  #begin() {
    if (this.#begun) return;
    this.#begun = this.#offer(true);
  }

  /** The textbooks' systems, the first of which is opened where nothing else is. @param {boolean} [first] */
  #offer(first = false) {
    call('api/v1/system/examples').then(
      (/** @type {SystemExample[]} */ examples) => {
        this.editor.offer(examples);
        if (first && !this.editor.text) this.#example(examples[0], false);
      },
      (error) => this.editor.complain(problemOf(error)),
    );
    return true;
  }

  /** @param {SystemExample} example @param {boolean} touched */
  #example({ text, method, weights, ...example }, touched) {
    this.editor.set(text, { text, method, ...example });
    const own = weights ? { states: weights.states, inputs: weights.inputs } : null;
    this.#opening = { poles: [], observer: null, method, weights: own };
    this.#text(text, touched);
  }

  /** A system from a link or a pin. @param {string} text */
  #open(text) {
    const plant = plantIn(text);
    if (!plant) {
      this.editor.complain({ detail: 'The plant of this link cannot be read.', hint: 'Paste it as text.' });
      return;
    }
    const written = matlabText(plant);
    this.editor.set(written);
    const { poles, observer, method, weights } = plant;
    this.#opening = { poles: poles ?? [], observer, method, weights };
    this.#text(written);
  }

  /** @param {string} text @param {boolean} [touched] by a person */
  #text(text, touched = true) {
    this.#touched ||= touched;
    this.reads.put({ text });
  }

  /** @param {string} text */
  async #readText(text) {
    this.root.setAttribute('aria-busy', 'true');
    try {
      /** @type {SystemRead} */ const read = await call('api/v1/system/read', { text });
      if (!this.reads.overtaken) this.#took(read);
    } catch (error) {
      if (!this.reads.overtaken) this.editor.complain(problemOf(error));
    }
    this.root.removeAttribute('aria-busy');
    this.reads.done();
  }

  /** @param {SystemRead} read */
  #took(read) {
    const n = read.analysis.poles.length;
    const p = read.matrices.B.values[0].length;
    const opened = this.#opening;
    this.#opening = null;
    this.#fresh = true;
    this.editor.complain(null);
    this.editor.show(read);
    this.results.read(read);
    const wish = opened ?? this.#wish;
    const fits = wish.poles.length === n;
    const fit = (/** @type {number[]|undefined} */ own, /** @type {number} */ many) => own?.length === many;
    const weights = wish.weights && fit(wish.weights.states, n) && fit(wish.weights.inputs, p) ? wish.weights : null;
    this.#wish = {
      ...wish,
      poles:
        opened?.poles.length && fits
          ? opened.poles
          : (read.poles ?? (fits ? wish.poles : proposal(read.analysis.poles))),
      observer: this.#observerOf(read, wish, n),
      weights,
    };
    this.#read = read;
    this.#change({});
    if (n > MOST_LETTERED) this.results.letters(`Closed forms are derived for up to ${MOST_LETTERED} states.`);
    else {
      this.results.letters(null);
      this.derives.put(Object.fromEntries(Object.entries(read.matrices).map(([name, { rows }]) => [name, rows])));
    }
  }

  /** @param {SystemRead} read @param {Wish} wish @param {number} n */
  #observerOf(read, wish, n) {
    if (!read.matrices.C) return null;
    if (read.observer_poles) return read.observer_poles;
    return wish.observer?.length === n ? wish.observer : null;
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

  /** @param {Partial<Wish>} change */
  #change(change) {
    const read = this.#read;
    if (!read) return;
    if (Object.keys(change).length) this.#touched = true;
    this.#wish = { ...this.#wish, ...change };
    this.#drawWish();
    this.asks.put({ read, wish: this.#wish, exactly: !this.#held });
    if (this.#touched && !this.#held) this.#link();
  }

  #drawWish() {
    const read = this.#read;
    if (!read) return;
    const { poles, observer, method } = this.#wish;
    const quadratic = method.startsWith('lqr');
    this.plane.show(
      {
        open: read.analysis.poles,
        zeros: read.analysis.zeros,
        poles,
        observer: observer ?? [],
        loop: quadratic ? (this.#design?.poles ?? []) : null,
      },
      this.#fresh,
    );
    this.#fresh = false;
    const B = read.matrices.B.values;
    this.controls.show(this.#wish, { n: poles.length, p: B[0].length }, Boolean(read.matrices.C));
  }

  /** The link of this plant with this design. */
  get #plant() {
    const read = this.#read;
    if (!read) return null;
    const rows = Object.fromEntries(Object.entries(read.matrices).map(([name, own]) => [name, own.rows]));
    const quadratic = this.#wish.method.startsWith('lqr');
    return linkText({ rows, letters: read.letters, ...this.#wish, weights: quadratic ? this.#wish.weights : null });
  }

  #link() {
    this.#linked = this.#plant;
    this.store.set({ plant: this.#linked });
  }

  /** @param {SystemRead} read @param {Wish} wish @param {boolean} exactly */
  #body(read, wish, exactly) {
    const matrices = Object.fromEntries(Object.entries(read.matrices).map(([name, { values }]) => [name, values]));
    return {
      ...matrices,
      poles: wish.poles,
      method: wish.method,
      exactly,
      ...(wish.observer ? { observer_poles: wish.observer } : {}),
      ...(wish.weights && wish.method.startsWith('lqr') ? { weights: wish.weights } : {}),
    };
  }

  /** @param {{read: SystemRead, wish: Wish, exactly: boolean}} item */
  async #ask({ read, wish, exactly }) {
    try {
      /** @type {SystemDesign} */ const design = await call('api/v1/system/design', this.#body(read, wish, exactly));
      if (read === this.#read) {
        this.root.classList.remove('refused');
        this.#answered(design, read);
      }
    } catch (error) {
      if (read === this.#read) {
        this.#design = null;
        this.root.classList.add('refused'); // what is below is another system's
        this.results.refuse(problemOf(error));
        this.results.remark(read.findings);
        this.pin.disabled = true;
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
    this.pin.disabled = this.pins.full;
    this.#drawWish();
    this.#drawCurves();
  }

  #drawCurves() {
    if (this.#design) {
      const kept = this.pins.list.map((pin) => pin.design);
      this.responses.show(this.#design, kept);
    }
    this.pin.disabled = this.pins.full || !this.#design;
  }

  #keep() {
    const plant = this.#plant;
    const name = this.controls.method.selectedOptions[0]?.textContent ?? this.#wish.method;
    if (this.#design && plant) this.pins.add({ plant, method: name, design: this.#design });
  }

  /** @param {Record<string, string[][]>} rows */
  async #derive({ A, B, C }) {
    /** @type {SystemFormulas|string} */ let told;
    try {
      told = await call('api/v1/system/formulas', { A, B, ...(C ? { C } : {}) });
    } catch (error) {
      const { detail, title, hint } = problemOf(error);
      told = [detail ?? title, hint].filter(Boolean).join(' ');
    }
    if (!this.derives.overtaken) this.results.letters(told);
    this.derives.done();
  }

  /** @param {string} format @param {string} suffix */
  async #export(format, suffix) {
    const read = this.#read;
    if (!read) return;
    this.#link();
    const link = new URL(location.href);
    link.hash = `#v1&plant=${encodeURIComponent(this.#linked ?? '').replace(/%(?:2C|3A|2F|2B)/g, decodeURIComponent)}`;
    try {
      const query = new URLSearchParams(link.href.length < 4000 ? { link: link.href } : {});
      saveFile(
        `heli2dof_system${suffix}`,
        await fileOf(`api/v1/system/export/${format}?${query}`, this.#body(read, this.#wish, true)),
      );
      setText(this.told, '');
    } catch (error) {
      const { detail, hint } = problemOf(error);
      setText(this.told, [detail, hint].filter(Boolean).join(' '));
    }
  }
}
