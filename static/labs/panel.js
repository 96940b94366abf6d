/**
 * The lab beside the instrument: the step's text, its goals as they tick, questions, hints, handing in, points. It
 * talks to one desk, whoever marks there, and moves the instrument through the store alone.
 * @typedef {import('../types.js').State} State
 * @typedef {import('./shapes.js').Desk} Desk
 * @typedef {import('./shapes.js').Step} Step
 * @typedef {import('./shapes.js').Marked} Marked
 * @typedef {{step: string, design: import('../types.js').Design, marked: Marked, flight?: string}} Told  flight: which
 */
import { messageOf, say, t } from '../text/index.js';
import { button, h, setText } from '../ui/index.js';
import { bodyFrom, designFrom } from '../bodies/index.js';
import { markdown } from '../markdown/index.js';
import { copyLink } from './copy_link.js';
import { flightOf, StepFlights } from './flights.js';
import { FlyLine } from './fly_line.js';
import { pointsText } from './goals.js';
import { GoalList } from './goal_list.js';
import { StepDots } from './dots.js';
import { Hints } from './hints.js';
import { freeParts, locksOf } from './parts.js';
import { Questions } from './questions.js';
import { soon } from './soon.js';
import { designIn, startOf } from './starts.js';
import { lateText, progressOf, Verdict } from './verdict.js';

export class LabPanel {
  /** The step that is shown; after the last, the end. */ #at = 0;
  /** @type {import('../types.js').Design|null} the design of the step, as it was kept last */ #kept = null;
  /** @type {Told|null} the newest verdict */ #told = null;
  /** @type {import('./shapes.js').Answers} */ #answers = {};
  #busy = false;
  #trouble = '';
  /** Whether what was handed in last could not be sent at once. */ #late = false;
  #scheduled = false;

  /**
   * @param {HTMLElement} root
   * @param {import('../model/store.js').Store} store
   * @param {Desk} desk
   * @param {{leave?: () => void, notMe?: () => void}} [ways] out of it
   */
  constructor(root, store, desk, { leave, notMe } = {}) {
    this.root = root;
    this.store = store;
    this.desk = desk;
    const { lab } = desk;
    this.goals = new GoalList();
    this.questions = new Questions(lab.math ?? {}, (answers) => this.#answered(answers));
    this.hints = new Hints((n) => this.#hint(n));
    this.flights = new StepFlights({
      nameOf: (step) => desk.flightName?.(step) ?? step,
      design: () => store.state.design && bodyFrom(store.state.design),
      whole: (body) => bodyFrom(designFrom(body, store.state.presets)),
      told: () => this.#schedule(),
    });
    this.fly = new FlyLine(() => this.#fly());
    this.standing = h('p', { class: 'lab-standing', role: 'status', 'data-testid': 'lab-standing' });
    this.points = h('span', { class: 'lab-points', 'data-testid': 'lab-points' });
    this.dots = new StepDots(lab, (i) => this.start(i));
    this.title = h('h3', { tabindex: -1, 'data-testid': 'lab-step-title' });
    this.text = h('div', { class: 'lab-text', 'data-testid': 'lab-text' });
    this.free = h('p', { class: 'lab-free', 'data-testid': 'lab-free' });
    this.recording = button(
      { 'data-testid': 'lab-recording', onclick: () => this.#record() },
      'Fetch your rig’s recording',
    );
    this.handIn = button(
      {
        class: 'primary',
        'data-testid': 'lab-hand-in',
        title:
          desk.words?.handIn ?? 'Ctrl+Enter: the server marks the design and your answers; the best attempt counts',
        onclick: () => this.#handIn(),
      },
      'Hand in',
    );
    this.again = button(
      {
        'data-testid': 'lab-reset',
        title: 'The design with which this step starts; what was handed in stays. It can be undone.',
        onclick: () => this.#startAgain(),
      },
      'Back to the start',
    );
    this.next = button({ 'data-testid': 'lab-next', onclick: () => this.start(this.#at + 1, true) }, 'Next step');
    this.verdict = new Verdict();
    this.foot = h('div', { class: 'lab-foot' }, this.handIn, this.next, this.again);
    const more = [
      desk.who && h('span', { class: 'lab-who', 'data-testid': 'lab-who', translate: 'no' }, desk.who),
      desk.link && copyLink(desk.link),
      desk.who && notMe && button({ class: 'quiet', 'data-testid': 'lab-not-me', onclick: notMe }, 'This is not me'),
      leave && button({ class: 'quiet', 'data-testid': 'lab-leave', onclick: leave }, 'Leave the lab'),
    ].filter((node) => typeof node === 'object');
    this.body = h(
      'div',
      { class: 'lab-step' },
      this.title,
      this.text,
      this.recording,
      this.free,
      this.goals.node,
      this.fly.node,
      this.questions.node,
      this.hints.node,
      this.verdict.node,
      this.foot,
    );
    root.replaceChildren(
      h(
        'div',
        { class: 'lab-head' },
        h('h2', { translate: 'no', 'data-testid': 'lab-title' }, lab.title),
        h('div', { class: 'lab-progress' }, this.dots.node, this.points),
        this.standing,
      ),
      this.goals.ticker,
      this.body,
      h('div', { class: 'lab-more' }, more),
    );
    this.off = new AbortController();
    const { signal } = this.off;
    this.flights.listen(signal);
    root.addEventListener('keydown', (e) => this.#key(e), { signal });
    let { connection } = store.state;
    const changed = () => {
      if (connection === 'lost' && store.state.connection === 'open') desk.heal?.(); // at once, not at its next turn
      ({ connection } = store.state);
      this.#schedule();
    };
    store.addEventListener('change', changed, { signal });
    store.addEventListener('design', () => this.#moved(), { signal });
    desk.onChange(
      () => this.#schedule(),
      (...late) => this.#arrived(...late),
    );
    const at = lab.steps.findIndex(({ name }) => name === desk.at);
    this.start(Math.max(0, at));
  }

  /** @returns {Step|undefined} undefined: the end */
  get step() {
    return this.desk.lab.steps[this.#at];
  }

  /**
   * Shows a step, with the design that was kept of it or its start.
   * @param {number} at  after the last: the end
   * @param {boolean} [led] whether it was asked for within the panel, which then has the focus
   */
  start(at, led = false) {
    const { lab, rig, kept } = this.desk;
    const { presets } = this.store.state;
    this.#at = Math.min(at, lab.steps.length);
    this.#told = null;
    this.#trouble = '';
    this.#late = false;
    const { step } = this;
    if (step) {
      const { locks, free } = locksOf(step.unlocked ?? []);
      const hidden = step.hidden ?? [];
      this.#answers = { ...kept[step.name]?.answers };
      this.#kept = null; // what comes now is the page's doing
      this.store.set({ locks: [], task: null });
      const design = designIn(lab, step, rig, kept, presets);
      this.#kept = design;
      this.store.load(design);
      this.store.set({
        locks,
        task: { free, hidden, goals: step.goals, flight: flightOf(step) },
        notice: null,
        view: step.view ?? 'design',
        motion: 'both',
      });
      document.documentElement.dataset.hidden = hidden.join(' ');
      this.questions.show(step.questions, this.#answers);
      this.hints.show(step.hints);
      if (this.desk.at !== step.name) this.#keep();
    } else {
      document.documentElement.dataset.hidden = '';
    }
    this.#fill();
    this.render();
    this.root.scrollTop = 0;
    if (led) this.title.focus({ preventScroll: true });
  }

  /** What of the panel is the step's alone. */
  #fill() {
    const { lab } = this.desk;
    const { step } = this;
    setText(this.title, step ? step.title : t('That was the lab'));
    const words = step ? [this.#at === 0 ? lab.text : '', step.text] : [lab.end];
    this.text.replaceChildren(...words.flatMap((text) => markdown(text, lab.math, 4)));
    const parts = freeParts(step?.unlocked ?? []);
    this.free.hidden = !step;
    this.free.replaceChildren(
      t(parts.length ? 'Free in this step:' : 'Nothing is free in this step.'),
      ...parts.flatMap((part) => [' ', this.#leadTo(part)]),
    );
    this.goals.show(step?.goals ?? []);
    this.flights.show(step);
    for (const node of [this.questions.node, this.hints.node, this.handIn, this.again, this.goals.ticker])
      node.hidden = !step;
    this.recording.hidden = !step?.recording || !this.desk.recording;
    this.next.hidden = !step;
    setText(this.next, this.#at === lab.steps.length - 1 ? 'Finish' : 'Next step');
  }

  /** A chip that leads to what is free. @param {import('../types.js').Lock} part */
  #leadTo({ name, controls }) {
    return button(
      {
        class: 'lab-chip',
        onclick: () => {
          const nodes = [...document.querySelectorAll(controls)];
          for (const node of nodes)
            for (let outer = node.closest('details'); outer; outer = outer.parentElement?.closest('details') ?? null)
              outer.open = true;
          const there = nodes.find((node) => node.checkVisibility?.() !== false && !node.hasAttribute('disabled'));
          document.documentElement.dataset.sheet = 'low'; // out of the way, where it lies over the page
          there?.scrollIntoView({ block: 'center' });
          /** @type {HTMLElement|undefined} */ (there)?.focus({ preventScroll: true });
        },
      },
      name,
    );
  }

  /** @param {KeyboardEvent} e */
  #key(e) {
    if (e.key !== 'Enter' || !(e.ctrlKey || e.metaKey) || !this.step) return;
    e.preventDefault();
    this.#handIn();
  }

  /** The design has changed, by hand. */
  #moved() {
    const { design } = this.store.state;
    if (!this.step || !this.#kept || design === this.#kept) return;
    this.#kept = design;
    this.#keep();
  }

  /** @param {import('./shapes.js').Answers} answers */
  #answered(answers) {
    this.#answers = answers;
    this.#keep();
    this.#schedule();
  }

  #keep() {
    const { design } = this.store.state;
    if (this.step && design) this.desk.keep(this.step.name, bodyFrom(design), this.#answers);
  }

  #startAgain() {
    const { step } = this;
    if (!step) return;
    const { lab, rig, kept } = this.desk;
    this.#kept ??= this.store.state.design;
    this.store.restore(startOf(lab, step, rig, kept, this.store.state.presets));
  }

  async #handIn() {
    const { step } = this;
    const { design } = this.store.state;
    if (!step || !design || this.#busy) return;
    this.#busy = true;
    this.#trouble = '';
    this.#late = false;
    this.render();
    try {
      const answers = this.#answers;
      const flight = this.flights.best?.log;
      const marked = await soon(this.desk.mark(step.name, bodyFrom(design), answers, flight));
      if (marked && this.step === step) this.#tell(marked, design, answers, flight);
      this.#late = !marked && this.step === step;
    } catch (error) {
      this.#trouble = messageOf(error);
    }
    this.#busy = false;
    this.render();
    this.verdict.node.scrollIntoView({ block: 'nearest' });
  }

  /**
   * @param {Marked} marked @param {import('../types.js').Design} design
   * @param {import('./shapes.js').Answers} answers @param {import('./shapes.js').Log} [flight]
   */
  #tell(marked, design, answers, flight) {
    this.#told = { step: this.step?.name ?? '', design, marked: { ...marked, answers }, flight: flight?.checksum };
  }

  /** What had to wait is marked, or refused. @type {import('./shapes.js').Arrived} */
  #arrived({ step: name, design: body, answers, flight }, marked, error) {
    const { design } = this.store.state;
    if (name !== this.step?.name || !design) return;
    this.#late = false;
    if (!marked) this.#trouble = messageOf(error);
    else if (JSON.stringify(body) === JSON.stringify(bodyFrom(design))) this.#tell(marked, design, answers, flight);
    this.#schedule();
  }

  /** @param {number} n from 1 */
  async #hint(n) {
    const { step } = this;
    if (!step) return;
    try {
      await this.desk.hint(step.name, n);
      this.#trouble = '';
    } catch (error) {
      this.#trouble = messageOf(error);
    }
    this.#schedule();
  }

  /** To the view Fly, which takes the task from the state. */
  #fly() {
    this.store.set({ view: 'fly' });
  }

  async #record() {
    const { step } = this;
    if (!step || !this.desk.recording) return;
    this.recording.disabled = true;
    try {
      const file = await this.desk.recording(step.name);
      this.store.set({ view: 'rig' });
      document.dispatchEvent(new CustomEvent('recording', { detail: { file, name: `${step.name}.csv` } }));
    } catch (error) {
      this.#trouble = messageOf(error);
    }
    this.recording.disabled = false;
    this.#schedule();
  }

  /** Once for each frame. */
  #schedule() {
    if (this.#scheduled || this.off.signal.aborted) return;
    this.#scheduled = true;
    requestAnimationFrame(() => {
      this.#scheduled = false;
      if (!this.off.signal.aborted) this.render();
    });
  }

  render() {
    const { lab, kept, standing } = this.desk;
    const { step } = this;
    const { state } = this.store;
    setText(this.standing, standing.words);
    this.standing.className = `lab-standing ${standing.kind}`;
    const steps = lab.steps.map((one) => progressOf(kept[one.name], one));
    const sum = steps.reduce((all, { points }) => all + points, 0);
    setText(this.points, say`${pointsText(sum)} of ${pointsText(lab.points)} points`);
    this.dots.render(steps, this.#at);
    if (!step) return this.verdict.end(this.desk, steps, sum);
    const newest = this.#told?.step === step.name ? this.#told : null;
    const told = newest?.design === state.design ? newest.marked : null;
    const flown = this.flights.best;
    const verdict = newest?.flight === flown?.log.checksum ? told : null;
    if (state.problem) this.goals.render({ reply: null, design: state.design }, verdict, flown);
    else if (state.reply && state.answered === state.design) this.goals.render(state, verdict, flown);
    this.fly.render(step, this.flights);
    this.questions.render(newest?.marked ?? kept[step.name]?.best ?? null, kept[step.name]?.hand ?? [], this.#answers);
    this.hints.render(kept[step.name]?.hints ?? []);
    this.handIn.disabled = this.#busy;
    setText(this.handIn, this.#busy ? 'Marking…' : 'Hand in');
    this.next.classList.toggle('primary', steps[this.#at].done);
    this.handIn.classList.toggle('primary', !steps[this.#at].done);
    const late = this.#late ? lateText(standing) : '';
    this.verdict.step(told, kept[step.name], { trouble: this.#trouble, late, byHand: Boolean(this.desk.who) });
  }

  /** Nobody is here any more; the design stays. */
  close() {
    this.off.abort();
    this.desk.leave();
    this.store.set({ locks: [], task: null });
    delete document.documentElement.dataset.hidden;
  }
}
