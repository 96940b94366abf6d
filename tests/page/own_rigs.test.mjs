/** Rigs of one's own: to a design and back, in files and links, in a browser that keeps them or refuses to. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { linkOf, readLink } from '../../static/link/permalink.js';
import { guarded } from '../../static/model/locks.js';
import { asProposed } from '../../static/model/rig.js';
import { bodyOf, designOf, initialState } from '../../static/model/store.js';
import {
  fileName,
  fileOf,
  freeName,
  keptText,
  LONGEST_NAME,
  readFile,
  readKept,
  rigOf,
  sameRig,
  tidyName,
  withOne,
  withRig,
} from '../../static/rigs/own_rigs.js';
import { Shelf } from '../../static/rigs/shelf.js';
import { KNOWN, PRESETS } from './presets.mjs';

const [preset] = PRESETS;
const design = {
  ...designOf(preset),
  parameters: { K_pp: 0.25 },
  limits: { V_p: 20, theta: null },
  rotors: { yaw: { tau: 0.1 } },
  friction: { pitch: { coulomb: 0.01 } },
  theta0: -0.1,
};

test('a design’s rig says all values, and makes the design again', () => {
  const rig = rigOf(design, preset, '  My   rig ');
  assert.equal(rig.name, 'My rig');
  assert.deepEqual(rig.parameters, { ...preset.parameters, K_pp: 0.25 });
  assert.deepEqual(rig.limits, { ...preset.limits, V_p: 20, theta: null });
  assert.equal(rig.rotors.yaw.tau, 0.1);
  assert.equal(rig.rotors.pitch.curve, 'linear');
  const again = withRig(rig, preset);
  const { limits, ...others } = again;
  assert.equal(again.rig, 'My rig');
  assert.deepEqual(others, (({ limits: _l, ...rest }) => ({ ...rest, rig: 'My rig' }))(design));
  assert.equal(limits.V_p, 20);
  assert.ok(sameRig(rigOf(again, preset, 'other name'), rig));
  assert.ok(!sameRig(rigOf({ ...again, parameters: {} }, preset, 'My rig'), rig));
});

test('a rig on another preset’s values than it was made from keeps its own', () => {
  const rig = rigOf(design, preset, 'a');
  const moved = { ...preset, parameters: { ...preset.parameters, m: 9 } };
  assert.equal(withRig(rig, moved).parameters.m, preset.parameters.m);
});

test('the present poles and loops stay where they are asked to', () => {
  const other = { ...designOf(preset), method: 'lqr' };
  assert.equal(withRig(rigOf(design, preset, 'a'), preset, other).method, 'lqr');
});

test('its name is in the link, not in what is asked of the server', () => {
  for (const name of ['Labor 3', '10', 'true', 'größer ~&=#', '"x"', 'my-rig']) {
    const own = { ...design, rig: name };
    const link = linkOf({ ...initialState(), presets: PRESETS, design: own }, KNOWN);
    const read = readLink(link, KNOWN);
    assert.deepEqual(read.trouble, []);
    assert.deepEqual(read.design, own);
    assert.ok(!('rig' in bodyOf(own)));
  }
  const old = readLink('#v1&preset=quanser-2dof-manual&set.K_pp=0.25', KNOWN);
  assert.deepEqual([old.trouble, old.design.rig], [[], undefined]);
  for (const bad of ['7', 'true', `"${'x'.repeat(61)}"`, '[1]'])
    assert.equal(
      readLink(`#v1&preset=quanser-2dof-manual&rig=${encodeURIComponent(bad)}`, KNOWN).trouble[0].part,
      'rig',
    );
});

test('back to the preset’s, the name is gone; where the rig is locked, it stays', () => {
  assert.ok(!('rig' in asProposed({ ...design, rig: 'a' })));
  const before = { ...design, rig: 'a' };
  assert.equal(guarded(before, { ...before, rig: 'b' }, ['preset']), before);
});

test('a file comes back as it was; what is none is told by its field', () => {
  const rig = rigOf(design, preset, 'Größe 1/2');
  const read = readFile(`\uFEFF${fileOf(rig)}`);
  assert.deepEqual(read.rig, rig);
  assert.ok(!('name' in read.body) && !('kind' in read.body));
  assert.match(fileName(rig), /^gro-e-1-2\.heli2dof-rig\.json$|^gro[\w-]*1-2\.heli2dof-rig\.json$/);
  assert.equal(fileName({ ...rig, name: '北' }), 'own.heli2dof-rig.json');
  const bad = (change) => readFile(JSON.stringify({ ...JSON.parse(fileOf(rig)), ...change })).refused;
  assert.match(readFile('K_pp = 1').refused, /no JSON/);
  assert.match(readFile('[]').refused, /no rig/);
  assert.match(bad({ kind: 'other' }), /no rig/);
  assert.match(bad({ version: 2 }), /version 2/);
  assert.match(bad({ name: ' ' }), /^name/);
  assert.match(bad({ preset: 1 }), /^preset/);
  assert.match(bad({ parameters: null }), /^parameters/);
  assert.match(bad({ rotors: { pitch: {} } }), /^rotors\.yaw/);
  assert.match(bad({ operating_point: {} }), /^operating_point\.theta/);
  assert.deepEqual(readFile(fileOf({ ...rig, colour: 1 })).body.colour, 1, 'what the server is to refuse is sent on');
});

test('names are tidy, unique and short', () => {
  const rigs = ['a', 'a 2'].map((name) => ({ ...rigOf(design, preset, name) }));
  assert.equal(freeName(rigs, 'a'), 'a 3');
  assert.equal(freeName(rigs, 'b'), 'b');
  assert.equal(tidyName(`${'x'.repeat(99)}`).length, LONGEST_NAME);
  const long = 'y'.repeat(LONGEST_NAME);
  assert.ok(freeName([{ name: long }], long).length <= LONGEST_NAME);
  assert.deepEqual(
    withOne(rigs, { ...rigs[0], theta: 1 }).map((rig) => rig.name),
    ['a', 'a 2'],
  );
});

class Kept {
  text = null;
  full = false;
  getItem() {
    return this.text;
  }
  setItem(_key, text) {
    if (this.full) throw new DOMException('full', 'QuotaExceededError');
    this.text = text;
  }
}

test('two tabs see the same rigs, and neither takes away what the other has kept', () => {
  const storage = new Kept();
  const windows = [new EventTarget(), new EventTarget()];
  const [one, two] = windows.map((window) => new Shelf(storage, window));
  const changed = (window) => window.dispatchEvent(Object.assign(new Event('storage'), { key: 'heli2dof.rigs' }));
  one.keep(rigOf(design, preset, 'a'));
  two.keep(rigOf(design, preset, 'b')); // before it has heard of the first
  assert.deepEqual(
    two.rigs.map((rig) => rig.name),
    ['a', 'b'],
  );
  let told = 0;
  one.addEventListener('change', () => (told += 1));
  changed(windows[0]);
  changed(windows[0]);
  assert.deepEqual([one.rigs.length, told], [2, 1]);
  assert.equal(two.remove('a').name, 'a');
  assert.equal(two.remove('a'), undefined);
  assert.equal(two.rename('b', 'c'), true);
  changed(windows[0]);
  assert.deepEqual(
    one.rigs.map((rig) => rig.name),
    ['c'],
  );
  one.keep(rigOf(design, preset, 'd'));
  assert.equal(one.rename('d', 'c'), false, 'another rig has that name');
  assert.equal(one.rename('d', ''), false);
});

test('a storage that is full, switched off or broken is told, and what it held stays', () => {
  const full = Object.assign(new Kept(), { full: true });
  const shelf = new Shelf(full, new EventTarget());
  shelf.keep(rigOf(design, preset, 'a'));
  assert.match(shelf.refused, /does not keep it/);
  assert.equal(shelf.named('a').name, 'a', 'it lives as long as the page');
  shelf.keep(rigOf(design, preset, 'b'));
  assert.equal(shelf.rigs.length, 2);
  full.full = false;
  shelf.keep(rigOf(design, preset, 'c'));
  assert.deepEqual([shelf.refused, readKept(full.text).length], ['', 3], 'and is kept once there is room');
  const off = new Shelf(null, new EventTarget());
  off.keep(rigOf(design, preset, 'a'));
  assert.match(off.refused, /switched off/);
  const broken = Object.assign(new Kept(), { text: '{"version": 7}' });
  const odd = new Shelf(broken, new EventTarget());
  assert.match(odd.refused, /cannot be read/);
  assert.equal(broken.text, '{"version": 7}');
  assert.equal(readKept(keptText([{ name: 'no rig' }])).length, 0);
});
