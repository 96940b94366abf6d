/**
 * The first minute: what this is in one sentence, six steps that each ask for something, and the few switches that they
 * bring along. S-plane, plot and rig are the page's own, large (see views.css).
 * @typedef {import('../types.js').State} State
 * @typedef {import('./steps.js').Switch} Switch
 */
import { say, significant, t } from '../text/index.js';
import { pairAlone } from '../model/index.js';
import { button, Choice, h, Projector, recall, remember, setAttr, setText, shape, symbol } from '../ui/index.js';
import { sideOf, STEPS, SWITCHES } from './steps.js';

const MEMORY = 'explore';

export class Explore {
  #at = 0;
  /** @type {Set<string>} names of steps */ #done = new Set();
  /** @type {import('../types.js').Poles|null} the poles with which the step began */ #poles = null;

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.root = root;
    this.store = store;
    this.#recall();
    this.pair = new Choice({
      label: 'Pair of poles',
      testid: 'explore-pair',
      options: [
        ['theta', 'pitch'],
        ['psi', 'yaw'],
      ],
      onChange: (v) => store.set({ motion: v }),
    });
    for (const [i, input] of this.pair.inputs.entries()) input.nextElementSibling?.prepend(shape(i ? 'yaw' : 'pitch'));
    this.seen = new Choice({
      label: 'Plot',
      testid: 'explore-plot',
      options: [
        ['angle', 'angle'],
        ['volts', 'voltage'],
      ],
      onChange: (v) => this.#show(v),
    });
    this.switches = /** @type {Switch[]} */ (Object.keys(SWITCHES)).map((name) => {
      const node = button(
        { class: 'switch', 'data-testid': `explore-${name}`, 'aria-pressed': 'false', onclick: () => this.#turn(name) },
        SWITCHES[name].text,
      );
      return { name, node };
    });
    this.dots = STEPS.map(({ title }, i) =>
      button({ class: 'dot', title, 'data-testid': `step-${i + 1}`, onclick: () => this.#begin(i) }, String(i + 1)),
    );
    this.title = h('h2', { tabindex: -1, 'data-testid': 'step-title' });
    this.ask = h('p', { class: 'ask', 'data-testid': 'step-ask' });
    this.see = h('p', { class: 'see' });
    this.now = h('span', { class: 'now', 'data-testid': 'step-now' });
    this.told = h('span', { class: 'well', role: 'status', 'data-testid': 'step-done' });
    this.skip = button({ class: 'quiet', 'data-testid': 'step-skip', onclick: () => this.#on() }, 'Skip');
    this.next = button({ class: 'primary', 'data-testid': 'step-next', onclick: () => this.#on() }, 'Next');
    const projector = new Projector();
    this.projector = button(
      {
        class: 'quiet',
        'data-testid': 'projector',
        title: 'For a lecture hall: large type',
        'aria-pressed': String(projector.on),
        onclick: () => setAttr(this.projector, 'aria-pressed', String(projector.toggle())),
      },
      'Large type',
    );
    this.end = h(
      'p',
      { class: 'onward' },
      h('a', { class: 'button primary', href: '#design', 'data-testid': 'explore-design' }, 'Design with all of it'),
      h('a', { class: 'button', href: '#paper-feedback' }, 'See where K comes from'),
      h('a', { class: 'button', href: '#labs', 'data-testid': 'explore-labs' }, 'Labs'),
      button({ 'data-testid': 'explore-again', onclick: () => this.#again() }, 'Once more'),
    );
    this.volts = ['θ', 'ψ', 'θ̇', 'ψ̇'].map((state) => ({ k: h('span', { class: 'k' }), state: symbol(state) }));
    this.motor = h('span');
    this.gain = h(
      'p',
      {
        class: 'gain',
        'data-testid': 'explore-K',
        title: 'u = −Kx + v, the row of the motor: K in V/rad and V·s/rad, v what the reference asks for',
      },
      this.motor,
      this.volts.map(({ k, state }) => h('span', { class: 'term' }, k, state)),
    );
    root.append(
      h(
        'p',
        { class: 'what-it-is', 'data-testid': 'what-it-is' },
        'Two motors hold this laboratory helicopter. Its poles, the crosses, say how it moves. Drag them: the ' +
          'gain K that puts them there follows, and so does the rig.',
      ),
      h(
        'div',
        { class: 'step', 'data-testid': 'step' },
        h('div', { class: 'dots', role: 'group', 'aria-label': 'Steps' }, this.dots, this.projector),
        this.title,
        this.ask,
        this.see,
        this.end,
        h('div', { class: 'step-foot' }, this.told, this.now, this.skip, this.next),
      ),
      h(
        'div',
        { class: 'switches', role: 'group', 'aria-label': 'What is seen and switched' },
        this.pair.node,
        this.seen.node,
        this.switches.map(({ node }) => node),
      ),
      this.gain,
    );
    this.#show('angle');
    this.#go(this.#at);
  }

  #recall() {
    const [at, ...done] = (recall(MEMORY) ?? '').split(' ');
    this.#done = new Set(STEPS.map(({ name }) => name).filter((name) => done.includes(name)));
    this.#at = Math.max(0, Math.min(STEPS.length, Math.trunc(Number(at)) || 0));
  }

  /** @param {'angle'|'volts'} what */
  #show(what) {
    this.seen.set(what);
    document.documentElement.dataset.plot = what;
  }

  /** @param {Switch} name */
  #turn(name) {
    const { on, turned } = SWITCHES[name];
    this.store.edit((d) => turned(d, !on(this.store.state), this.store.state));
  }

  /** The next step, in sight; its title has the focus, where the last one has no button to go on. */
  #on() {
    this.#begin(this.#at + 1);
    this.title.scrollIntoView({ block: 'nearest' });
    if (!STEPS[this.#at]) this.title.focus({ preventScroll: true });
  }

  /** From the beginning, with pitch. */
  #again() {
    this.#done.clear();
    this.store.set({ motion: 'theta' });
    this.#begin(0);
  }

  /** A step with the design that it begins with; after the last, the way on. @param {number} at */
  #begin(at) {
    const [preset] = this.store.state.presets;
    const step = STEPS[at];
    const side = sideOf(step?.pair ?? (this.store.state.motion === 'psi' ? 1 : 0));
    if (step) this.store.edit(() => step.begin(preset, side));
    this.#go(at);
  }

  /** @param {number} at the step to show; after the last, the way on */
  #go(at) {
    this.#at = at;
    this.#poles = this.store.state.design?.poles ?? null;
    const step = STEPS[at];
    this.root.dataset.at = String(at);
    this.#show(step?.volts ? 'volts' : 'angle');
    if (step?.pair !== undefined) this.store.set({ motion: sideOf(step.pair).axis });
    this.#keep();
    this.render(this.store.state);
  }

  #keep() {
    remember(MEMORY, [this.#at, ...this.#done].join(' '));
  }

  /** @param {State} state */
  render(state) {
    const { design, reply, answered, view } = state;
    const pair = pairAlone(state);
    if (!design || pair === null || view !== 'explore') return;
    const side = sideOf(pair);
    this.pair.set(side.axis);
    document.documentElement.dataset.pair = side.axis;
    const step = STEPS[this.#at];
    this.#switch(state);
    if (reply) this.#gain(reply.gains.K[pair]);
    this.end.hidden = Boolean(step);
    if (!step) {
      setText(this.title, 'That is pole placement');
      setText(
        this.ask,
        'You put the poles, K followed, and the motors, their lag and their pairing had the last word.',
      );
      const open = STEPS.flatMap(({ name }, i) => (this.#done.has(name) ? [] : [i + 1]));
      setText(this.see, open.length ? say`Still to do: ${open.join(', ')}.` : '');
      setText(this.now, '');
    } else if (reply && answered === design) {
      this.#poles ??= design.poles;
      const moved = design.poles !== this.#poles;
      setText(this.ask, step.ask(side));
      const is = (reply.stable || Boolean(step.lost)) && step.done(state, side, moved);
      if (is && !this.#done.has(step.name)) {
        this.#done.add(step.name);
        this.#keep();
      }
      // beside "Done" nothing that is not
      setText(this.now, is || !this.#done.has(step.name) ? (step.now?.(state, side) ?? '') : '');
    }
    if (step) {
      setText(this.title, step.title);
      setText(this.see, step.see);
    }
    const done = Boolean(step && this.#done.has(step.name));
    setText(this.told, done ? '✓ Done' : '');
    this.next.hidden = !step;
    this.next.classList.toggle('later', !done);
    this.skip.hidden = !step || done;
    for (const [i, dot] of this.dots.entries()) {
      const [is, name] = [this.#done.has(STEPS[i].name), t(STEPS[i].title)];
      dot.classList.toggle('done', is);
      setAttr(dot, 'aria-label', is ? say`Step ${i + 1}, done: ${name}` : say`Step ${i + 1}: ${name}`);
      if (i === this.#at) dot.setAttribute('aria-current', 'step');
      else dot.removeAttribute('aria-current');
    }
  }

  /** What the motor of the pair does, by its row of K. @param {ArrayLike<number>} row */
  #gain(row) {
    if (this.motor.dataset.pair !== document.documentElement.dataset.pair) {
      this.motor.dataset.pair = document.documentElement.dataset.pair;
      const motor = this.motor.dataset.pair === 'psi' ? 'y' : 'p';
      this.motor.replaceChildren('K: ', symbol('V', motor), ' = ', symbol('v', motor));
    }
    this.volts.forEach(({ k }, i) => setText(k, ` ${row[i] > 0 ? '−' : '+'} ${significant(Math.abs(row[i]), 3)} `));
  }

  /** Those that the steps so far have brought. @param {State} state */
  #switch(state) {
    const seen = new Set(STEPS.slice(0, this.#at + 1).flatMap(({ switches }) => switches ?? []));
    this.seen.node.hidden = !STEPS.slice(0, this.#at + 1).some(({ volts }) => volts);
    for (const { name, node } of this.switches) {
      const on = SWITCHES[name].on(state);
      node.hidden = !on && !seen.has(name); // what is on can be switched off
      setAttr(node, 'aria-pressed', String(on));
    }
  }
}
