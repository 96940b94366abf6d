// The address follows the state: an entry of the history a gesture, never too many calls; Back brings the design back.
import assert from 'node:assert/strict';
import { beforeEach, test } from 'node:test';

import { Address, Budget } from '../../static/link/address.js';
import { Store } from '../../static/model/store.js';
import { KNOWN, PRESETS } from './presets.mjs';

/** A browser's history, with a clock that tests move. */
class FakeBrowser {
  entries = [''];
  at = 0;
  calls = [];
  time = 0;
  timers = [];
  hash = () => this.entries[this.at];
  push = (hash) => {
    this.calls.push(this.time);
    this.entries.splice(++this.at, Infinity, hash);
  };
  replace = (hash) => {
    this.calls.push(this.time);
    this.entries[this.at] = hash;
  };
  now = () => this.time;
  later = (f, ms) => {
    const timer = { f, at: this.time + ms };
    this.timers.push(timer);
    return timer;
  };
  cancel = (timer) => {
    this.timers = this.timers.filter((t) => t !== timer);
  };
  pass(ms) {
    const end = this.time + ms;
    for (;;) {
      const due = this.timers.filter((t) => t.at <= end).sort((a, b) => a.at - b.at)[0];
      if (!due) break;
      this.cancel(due);
      this.time = Math.max(this.time, due.at);
      due.f();
    }
    this.time = end;
  }
}

/** @type {FakeBrowser} */ let browser;
/** @type {Store} */ let store;
/** @type {Address} */ let address;
const pole = () => store.state.design.poles[0].re;
const move = (re, how) => {
  store.edit((d) => ({ ...d, poles: [{ re, im: 0 }, ...d.poles.slice(1)] }), how);
  address.render(store.state);
};
const go = (delta) => {
  browser.at += delta;
  address.navigated();
  address.render(store.state);
  browser.pass(1);
};
const opened = (hash) => {
  browser = new FakeBrowser();
  browser.entries = [hash];
  store = new Store();
  store.set({ presets: PRESETS, methods: KNOWN.methods });
  address = new Address(store, browser);
  return address.open();
};

beforeEach(() => opened(''));

test('the address holds the state from the beginning', () => {
  assert.deepEqual(browser.entries, ['#v1&preset=quanser-2dof-manual']);
});

test('each finished change is an entry, and Back and Forward walk through them', () => {
  for (const re of [-5, -6, -7]) {
    move(re);
    browser.pass(50);
  }
  assert.equal(browser.entries.length, 4);
  go(-1);
  assert.equal(pole(), -6);
  go(-2);
  assert.equal(pole(), -12);
  go(3);
  assert.equal(pole(), -7);
  assert.equal(browser.entries.length, 4); // walking writes nothing new
  store.undo();
  assert.equal(pole(), -12); // and can itself be undone
});

test('a gesture is one entry, rewritten as it goes on, and ends with its last state', () => {
  for (let k = 0; k < 300; k++) {
    move(-12 + k / 100, { gesture: 'drag' });
    browser.pass(16);
  }
  store.commit();
  browser.pass(1000);
  assert.equal(browser.entries.length, 2);
  assert.ok(browser.calls.length < 15, String(browser.calls.length));
  assert.ok(browser.entries[1].includes(`p=${pole()},`));
});

test('a new gesture leaves the one before as it ended', () => {
  move(-5, { gesture: 'a' });
  browser.pass(1);
  move(-5.5, { gesture: 'a' });
  store.commit();
  move(-4, { gesture: 'b' });
  store.commit();
  browser.pass(1000);
  assert.deepEqual(
    browser.entries.map((e) => e.match(/p=([^,]*)/)?.[1]),
    [undefined, '-5.5', '-4'],
  );
});

test('never more than a hundred calls in half a minute, and the last state is written', () => {
  for (let k = 0; k < 1200; k++) {
    move(-1 - k / 100);
    browser.pass(50);
  }
  browser.pass(2000);
  for (const start of browser.calls)
    assert.ok(browser.calls.filter((t) => t >= start && t < start + 30_000).length <= 100);
  assert.ok(browser.entries.at(-1).includes(`p=${pole()},`));
});

test('what is shown is rewritten without a new entry', () => {
  store.set({ motion: 'theta' });
  address.render(store.state);
  browser.pass(1);
  assert.deepEqual(browser.entries, ['#v1&preset=quanser-2dof-manual&motion=theta']);
});

test('a jump within the page keeps the design in the address, and an edit leaves the place', () => {
  move(-5);
  browser.pass(1);
  browser.push('#eq-13');
  address.navigated();
  assert.match(browser.hash(), /p=-5,.*&at=eq-13$/);
  assert.equal(pole(), -5);
  move(-6);
  browser.pass(1);
  assert.doesNotMatch(browser.hash(), /at=/);
  go(-1);
  assert.equal(pole(), -5);
});

test('going back takes no pin away', () => {
  move(-5);
  browser.pass(1);
  store.pin();
  address.render(store.state);
  browser.pass(1);
  assert.match(browser.hash(), /&pin=0~/);
  go(-1);
  assert.equal(store.state.pins.length, 1);
  go(1);
  assert.equal(store.state.pins.length, 1);
});

test('a link opens design, pins, locks and place; a bad part is told and stays until the next change', () => {
  opened('#v1&preset=quanser-aero&p=-5,-4,-3,-2&lock=poles&pin=1~x~preset=quanser-aero&at=eq-13');
  assert.deepEqual([address.place, store.state.view], ['eq-13', 'derivation']);
  assert.equal(pole(), -5);
  assert.equal(store.state.pins[0].name, 'x');
  move(-9);
  assert.equal(pole(), -5); // locked
  opened('#v1&p=1&motion=psi');
  assert.equal(store.state.motion, 'psi');
  assert.match(store.state.notice, /p \(four poles are needed/);
  assert.equal(browser.hash(), '#v1&p=1&motion=psi');
  move(-9);
  browser.pass(1);
  assert.match(browser.hash(), /^#v1&preset=quanser-2dof-manual&p=-9/);
});

test('a browser that refuses a call does not stop the page', () => {
  browser.push = () => {
    throw new Error('too many calls');
  };
  move(-5);
  browser.pass(1);
  assert.equal(pole(), -5);
});

test('the budget gives twenty at once and one more every 0.4 s', () => {
  const budget = new Budget(0);
  let now = 0;
  const taken = () => {
    let n = 0;
    while (budget.take(now)) n += 1;
    return n;
  };
  assert.equal(taken(), 20);
  now = 399;
  assert.equal(taken(), 0);
  now = 1200;
  assert.equal(taken(), 3);
  now = 1e6;
  assert.equal(taken(), 20);
});

test('a view has an address: links, Back and Forward know it, and no step of undo comes of it', () => {
  opened('');
  const steps = store.step;
  for (const [place, view] of [
    ['compare', 'compare'],
    ['recordings', 'rig'],
    ['erratum-Eq-13', 'derivation'],
    ['explore', 'explore'],
    ['design', 'design'],
    ['nowhere', 'design'], // stays where it is
  ]) {
    browser.push(`#${place}`); // as a link in the page does
    address.navigated();
    assert.equal(store.state.view, view);
    assert.equal(browser.hash().includes(`&view=${view}`), view !== 'design');
  }
  assert.equal(address.place, 'nowhere');
  go(-2);
  assert.deepEqual([store.state.view, store.state.motion], ['explore', 'theta']); // one axis at a time
  go(-1);
  assert.deepEqual([store.state.view, store.state.motion, address.place], ['derivation', 'both', 'erratum-Eq-13']);
  go(1);
  assert.equal(store.state.view, 'explore');
  assert.deepEqual([store.step, store.state.canUndo], [steps, false]);
});

test('an address without a design opens the view that is wanted first; the first minute without PI', () => {
  const first = (hash, view) => {
    browser.entries = [hash];
    browser.at = 0;
    address = new Address(store, browser);
    address.open(view);
    return [store.state.view, store.state.design.outer];
  };
  assert.deepEqual(first('', 'explore'), ['explore', 'none']);
  assert.deepEqual(first('', 'rig'), ['rig', 'pi']);
  assert.deepEqual(first('#compare', 'explore'), ['compare', 'pi']);
  assert.equal(address.toTop, true);
  assert.deepEqual(first('#v1', 'explore'), ['design', 'pi']); // links of the time before views
  assert.deepEqual(first('#v1&view=explore', 'design'), ['explore', 'pi']);
  assert.deepEqual(first('#v1&view=nonsense', 'explore'), ['design', 'pi']);
  assert.match(store.state.notice, /view \(no view of this page\)/);
});

test('changes of the plant are entries, Back and Forward walk through them, and the design is none the wiser', () => {
  opened('#v1&plant=A:1&view=plant');
  const edit = (plant) => {
    store.editPlant(plant);
    address.render(store.state);
    browser.pass(1);
  };
  const { design } = store.state;
  edit('A:2');
  edit('A:3');
  store.addPlantPins([{ plant: 'A:3::p:-1' }]);
  address.render(store.state);
  browser.pass(1);
  assert.equal(browser.entries.length, 3);
  assert.match(browser.hash(), /plant=A:3&view=plant&plant\.pin=0~p:-1$/);
  go(-1);
  assert.deepEqual([store.state.plant, store.state.plantPins.length], ['A:2', 1]);
  go(-1);
  assert.equal(store.state.plant, 'A:1');
  go(2);
  assert.deepEqual([store.state.plant, store.state.plantPins.length, browser.entries.length], ['A:3', 1, 3]);
  assert.equal(store.state.design, design);
  store.undo();
  assert.equal(store.state.plant, 'A:1');
  store.set({ view: 'design' });
  assert.equal(store.state.canUndo, false);
});

test('a link without a plant has none, and what was there comes back by undo', () => {
  opened('#v1&plant=A:1&view=plant');
  browser.push('#v1&preset=quanser-2dof-manual&view=plant');
  address.navigated();
  assert.equal(store.state.plant, null);
  store.undo();
  assert.equal(store.state.plant, 'A:1');
});
