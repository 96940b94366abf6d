// Who is asked while a hand moves something: nobody, as long as the page's own kernel serves; and what is said where
// the server's numbers differ from the page's.
import assert from 'node:assert/strict';
import { beforeEach, test } from 'node:test';

import { Own } from '../../static/kernel/own.js';
import { AT, FIGURES, OUTCOMES } from '../../static/kernel/layout.js';
import { block } from '../../static/kernel/shapes.js';
import { designOf, Store } from '../../static/model/index.js';
import { PRESETS } from './presets.mjs';

const size = (shape) => shape.reduce((product, n) => product * n, 1);

/** A kernel whose K is the first pole asked for; of all else it says nothing. */
class Kernel {
  numbers = new Float64Array(AT.NUMBERS);
  outcome = OUTCOMES.DONE;
  updates = 0;
  offset = 0;

  update(n, samples) {
    if (this.outcome === 'trap') throw new Error('unreachable');
    this.updates += 1;
    this.onUpdate?.();
    const filled = Object.fromEntries(
      Object.entries(block(n, samples)).map(([name, [kind, ...shape]]) => [
        name,
        new Float64Array(size(shape) * (kind === 'c128' ? 2 : 1)),
      ]),
    );
    filled.outcome.set([this.outcome, 3]);
    filled.K[0] = this.numbers[AT.POLES] + this.offset;
    filled.figures[FIGURES.STABLE] = 1;
    return filled;
  }
}

let store, kernel, own, asked, now, timers;
const PRESET = { parameter_info: {}, limit_info: {}, encoders: { theta: 4096, psi: 8192 }, ...PRESETS[0] };
const finding = (code) => ({ code, severity: 'info', message: code });
const words = (...codes) => ({
  seq: 1,
  findings: codes.map(finding),
  gains: { findings: [], controllability_indices: [2, 2] },
  rga: { reason: 'because', findings: [] },
  step: { linear: { findings: [] }, nonlinear: { findings: [] } },
  axis_steps: {},
  open_loop_poles: [],
});

/** As the page does it: the newest design to the server, unless it is to wait. */
function edit(re, how = { gesture: 'drag-0' }) {
  store.edit((d) => ({ ...d, poles: [{ re, im: 0 }, ...d.poles.slice(1)] }), how);
}
const K = () => store.state.reply.gains.K[0][0];
const rest = () => timers.splice(0).forEach((timer) => timer.on && timer.act());

beforeEach(() => {
  store = new Store();
  store.set({ presets: [PRESET] });
  store.load(designOf(PRESET));
  const { design } = store.state;
  store.set({ reply: words('first'), answered: design, heard: design });
  kernel = new Kernel();
  asked = [];
  now = 0;
  timers = [];
  const ask = () => asked.push(store.state.design.poles[0].re);
  const later = (act) => timers[timers.push({ act, on: true }) - 1];
  own = new Own(store, kernel, ask, { now: () => now, later, cancel: (timer) => timer && (timer.on = false) });
  store.addEventListener('design', () => own.edited() || ask());
  kernel.updates = 0;
  now = 1000;
});

test('while a pole is dragged nobody is asked, and each frame computes the newest design once', () => {
  store.set({ dragging: true });
  const before = store.state.heard;
  for (const re of [-3, -4, -5]) {
    edit(re - 0.5);
    edit(re);
    own.frame();
    assert.equal(K(), re);
    assert.equal(store.state.answered, store.state.design);
    own.frame(); // nothing new
  }
  assert.equal(kernel.updates, 3);
  assert.equal(store.state.heard, before, 'the words are of the earlier design');
  assert.deepEqual(store.state.reply.findings, [finding('first')]);
  assert.deepEqual(asked, []);
  store.commit();
  own.frame();
  assert.deepEqual(asked, [], 'the hand still holds it');
  store.set({ dragging: false });
  own.frame();
  own.frame();
  assert.deepEqual(asked, [-5], 'asked once, for the newest');
});

test('a hand that rests without letting go asks after a moment, and goes on without asking', () => {
  store.set({ dragging: true });
  edit(-3);
  own.frame();
  rest();
  assert.deepEqual(asked, [-3]);
  edit(-4);
  own.frame();
  assert.deepEqual(asked, [-3]);
  assert.equal(timers.filter((timer) => timer.on).length, 1);
});

test('single edits ask at once and are shown at once', () => {
  edit(-3, {});
  edit(-4, { gesture: 'pole-field-0' }); // typed
  now += 500;
  edit(-5, { gesture: 'pole-field-0' });
  store.undo();
  assert.deepEqual(asked, [-3, -4, -5, -3]);
  own.frame();
  assert.equal(K(), -3);
});

test('edits in quick succession within one gesture wait: a key held down, a slider', () => {
  for (let i = 1; i <= 5; i++) {
    now += 30;
    edit(-i, { gesture: 'key-0' });
  }
  assert.deepEqual(asked, [-1]);
  own.frame();
  assert.equal(K(), -5);
  store.commit();
  own.frame();
  assert.deepEqual(asked, [-1, -5]);
});

test('a pointer that is down moves something from the first edit on', () => {
  const page = new EventTarget();
  own.watch(page);
  page.dispatchEvent(new Event('pointerdown'));
  edit(-3, { gesture: 'kp-pitch' });
  assert.deepEqual(asked, []);
  page.dispatchEvent(new Event('pointerup'));
  store.commit();
  own.frame();
  assert.deepEqual(asked, [-3]);
});

test('what the kernel does not serve goes to the server, as does what it does not find', () => {
  store.edit((d) => ({ ...d, method: 'lqr' }));
  store.set({ dragging: true });
  edit(-3);
  own.frame();
  assert.deepEqual(asked, [-12, -3]);
  assert.equal(kernel.updates, 0);
  store.edit((d) => ({ ...d, method: 'full-rank' }));
  kernel.outcome = OUTCOMES.EXACT;
  edit(-4);
  assert.deepEqual(asked.slice(2), []);
  own.frame();
  assert.deepEqual(asked.slice(2), [-4]);
  assert.notEqual(store.state.answered, store.state.design);
});

test('a kernel that fails is not called again', (t) => {
  const told = t.mock.method(console, 'error', () => {});
  store.set({ dragging: true });
  kernel.outcome = 'trap';
  edit(-3);
  own.frame();
  kernel.outcome = OUTCOMES.DONE;
  edit(-4);
  own.frame();
  assert.deepEqual(asked, [-3, -4]);
  assert.equal(kernel.updates, 0);
  assert.equal(told.mock.callCount(), 1);
});

test('where an update takes long, the rest of the gesture goes by the server', () => {
  store.set({ dragging: true });
  kernel.onUpdate = () => (now += 100);
  edit(-3);
  own.frame();
  assert.equal(K(), -3);
  edit(-4);
  assert.deepEqual(asked, [-4]);
  store.commit();
  edit(-5, { gesture: 'drag-1' });
  assert.deepEqual(asked, [-4]);
});

/** What the server says of the present design: what the page says, but for a change. */
function answered(change) {
  const { design, reply } = store.state;
  const said = structuredClone(reply);
  change?.(said);
  store.set(own.heard({ ...said, seq: 2, findings: [finding('second')] }, design));
}

test('the server’s answer holds; where its numbers differ it is told which, and counted', () => {
  store.set({ dragging: true });
  edit(-3);
  own.frame();
  answered((said) => (said.gains.K[0][0] = -3 + 1e-12));
  assert.equal(K(), -3 + 1e-12);
  assert.equal(store.state.heard, store.state.design);
  assert.deepEqual([store.state.differences, store.state.notice], [0, null]);
  edit(-4);
  own.frame();
  answered((said) => (said.gains.K[0][0] = -4.001));
  assert.equal(K(), -4.001);
  assert.equal(store.state.differences, 1);
  assert.match(store.state.notice, /gains\.K is -4\.001; here it was -4\. /);
});

test('an answer to an earlier design brings its words alone, and takes no numbers back', () => {
  store.set({ dragging: true });
  edit(-3);
  own.frame();
  rest();
  const asked = store.state.design;
  const said = { ...structuredClone(store.state.reply), seq: 2, findings: [finding('second')] };
  edit(-4);
  own.frame();
  store.set(own.heard(said, asked));
  assert.equal(K(), -4);
  assert.deepEqual(store.state.reply.findings, [finding('second')]);
  assert.deepEqual([store.state.answered, store.state.heard], [store.state.design, asked]);
  edit(-5);
  own.frame();
  assert.deepEqual(store.state.reply.findings, [finding('second')]);
});

test('an answer that comes between a move and its frame takes no numbers back either', () => {
  store.set({ dragging: true });
  edit(-3);
  own.frame();
  rest();
  const asked = store.state.design;
  const said = { ...structuredClone(store.state.reply), seq: 2, findings: [finding('second')] };
  edit(-4);
  own.frame();
  const drawn = store.state.design;
  edit(-5); // the hand has gone on; its frame is still to come
  store.set(own.heard(said, asked));
  assert.equal(K(), -4);
  assert.deepEqual([store.state.answered, store.state.heard], [drawn, asked]);
  assert.deepEqual(store.state.reply.findings, [finding('second')]);
  own.frame();
  assert.equal(K(), -5);
});

test('what only the server can answer is shown though the hand has gone on', () => {
  store.edit((d) => ({ ...d, method: 'lqr' }));
  store.set({ dragging: true });
  edit(-3);
  const { design } = store.state;
  edit(-4);
  store.set(own.heard({ ...words('second'), gains: { ...words().gains, K: [[-3]] } }, design));
  assert.deepEqual([K(), store.state.answered], [-3, design]);
});

test('an answer that is quicker than the frame is not computed again; a step back is', () => {
  edit(-3, {});
  store.set(own.heard({ ...words('second'), gains: { ...words().gains, K: [[-3]] } }, store.state.design));
  own.frame();
  assert.equal(kernel.updates, 0);
  edit(-4, {});
  own.frame();
  store.undo();
  own.frame();
  assert.equal(K(), -3);
  assert.equal(store.state.answered, store.state.design);
});

test('what has begun before the kernel came goes on by the server', () => {
  store.set({ dragging: true });
  edit(-3);
  asked.length = 0;
  own = new Own(store, kernel, () => {}, { now: () => now, later: () => null, cancel: () => {} });
  edit(-4);
  assert.deepEqual(asked, [-4]);
});
