// The state in an address: what goes in comes out, links of old open, bad ones are told and lose only what is bad.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { linkOf, MOST, placeIn, readLink } from '../../static/link/permalink.js';
import { troubleWords } from '../../static/link/trouble.js';
import {
  differences,
  escaped,
  leafOf,
  leafText,
  leaves,
  polesLink,
  polesOf,
  polesTrouble,
  setLeaf,
} from '../../static/link/link_values.js';
import { LOCKS } from '../../static/model/locks.js';
import { samePlant } from '../../static/model/plant_pins.js';
import { QUANTITIES } from '../../static/model/quantities.js';
import { NONE } from '../../static/model/requirements.js';
import { designOf, initialState } from '../../static/model/store.js';
import { VIEWS } from '../../static/model/views.js';
import { KNOWN, PRESETS } from './presets.mjs';

/** What the link's code knows of by this list alone. */
const OF_EXPERIMENTS = Object.entries(QUANTITIES).filter(
  ([path]) => path.startsWith('scenario.') && path !== 'scenario.duration',
);

/** Numbers from 0 to 1, the same at every run (mulberry32). */
function seeded(seed) {
  let a = seed;
  return () => {
    a = (a + 0x6d2b79f5) | 0;
    let t = Math.imul(a ^ (a >>> 15), 1 | a);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

function generator(seed) {
  const random = seeded(seed);
  const pick = (list) => list[Math.floor(random() * list.length)];
  const chance = (p) => random() < p;
  const number = (low, high) =>
    pick([
      () => low + (high - low) * random(),
      () => Number((low + (high - low) * random()).toFixed(2)),
      () => Math.round(low + (high - low) * random()),
    ])() + 0;
  const positive = () => pick([number(0.01, 9), 10 ** number(-3, 3)]) || 1;
  const pair = () => {
    if (chance(0.5))
      return [
        { re: number(-40, 2), im: 0 },
        { re: -number(1, 1e5), im: 0 },
      ];
    const [re, im] = [number(-20, 1), positive()];
    return [
      { re, im },
      { re, im: -im },
    ];
  };
  const words = () =>
    pick(['slow', 'A & B = 100 %?', "#~,;:/'()!*", 'größer λ₁₁', 'dot.', '10', 'true', '', '2 + 2', '~p=1,2']);
  const valueOf = ({ words: some, standard }) =>
    some ? pick(some) : typeof standard === 'boolean' ? chance(0.5) : number(-9, 9);
  const design = () => {
    const preset = pick(PRESETS);
    const d = designOf(preset);
    if (chance(0.7)) d.poles = [...pair(), ...pair()];
    if (chance(0.5)) d.loops = { pitch: { kp: positive(), ti: positive() }, yaw: { kp: positive(), ti: positive() } };
    if (chance(0.4)) d.parameters = { K_pp: number(-1, 1), ...(chance(0.5) ? { B_y: positive() } : {}) };
    if (chance(0.4)) d.theta0 = pick([number(-1.3, 1.3), Math.round(number(-70, 70)) / (180 / Math.PI)]) + 0;
    if (chance(0.5))
      Object.assign(d, {
        method: pick(['full-rank', 'tits-yang', 'lqr']),
        coupling: pick(['triangular', 'input-diagonal', 'axis-decoupled']),
        lead: pick(['pitch', 'yaw']),
      });
    if (chance(0.5))
      Object.assign(d, { outer: pick(['pi', 'none']), pairing: pick(['diagonal', 'cross']), decoupler: chance(0.5) });
    if (chance(0.5))
      d.scenario = { reference: { theta: number(-1, 1), psi: number(-1, 1) }, duration: positive() % 60 || 1 };
    if (chance(0.4)) d.rotors = { pitch: { tau: number(0, 9) }, ...(chance(0.5) && { yaw: { curve: 'quadratic' } }) };
    if (chance(0.3)) d.friction = { yaw: { coulomb: positive(), static: pick([null, 3]) } };
    if (chance(0.4)) Object.assign(d, { place_rotors: true, rotor_poles: [number(-40, 2), -positive()] });
    if (chance(0.4))
      d.observer = { poles: [...pair(), ...pair()], method: pick(['full-rank', 'kalman']), angle_noise: positive() };
    d.scenario = structuredClone(d.scenario);
    for (const [path, quantity] of OF_EXPERIMENTS) if (chance(0.1)) setLeaf(d, path, valueOf(quantity));
    return d;
  };
  const state = () => ({
    ...initialState(),
    presets: PRESETS,
    design: design(),
    view: pick(Object.keys(VIEWS)),
    motion: pick(['both', 'theta', 'psi']),
    showLinear: chance(0.7),
    showMarks: chance(0.7),
    spread: pick([0, 0.05, 0.2]),
    map: pick([null, 'overshoot', 'settling_time,both,linear,yaw-pair']),
    track: pick([null, 'gain', 'loops.pitch.kp,1,1e+2,log']),
    requirements: { settling: pick([null, 1.5]), overshoot: pick([null, 10]), lag: pick([null, 0.2]) },
    find: pick([null, 'settling_time:theta:max:0.8:better::V_peak:linear::free:poles,loops']),
    showLag: pick([null, true, false]),
    locks: Object.keys(LOCKS).filter(() => chance(0.3)),
    pins: Array.from({ length: chance(0.5) ? 0 : 3 }, (_, i) => ({
      id: i,
      index: i * 2,
      name: words(),
      design: design(),
      reply: null,
    })),
  });
  return { state, pick, random };
}

const shownOf = ({ view, motion, showLinear, showMarks, showLag, spread, map, track, find, requirements, locks }) => ({
  view,
  motion,
  showLinear,
  showMarks,
  showLag,
  spread,
  map,
  track,
  find,
  requirements,
  locks,
});
const clean = (value) => JSON.parse(JSON.stringify(value));

test('whatever the state, its link gives it back exactly', () => {
  const { state } = generator(20260101);
  let pinned = 0;
  for (let k = 0; k < 800; k++) {
    const s = state();
    const link = linkOf(s, KNOWN);
    const read = readLink(link, KNOWN);
    assert.deepEqual(read.trouble, [], link);
    assert.deepEqual(clean(read.design), clean(s.design), link);
    assert.deepEqual(read.shown, shownOf(s), link);
    const fits = link.includes('&pin=');
    pinned += fits;
    assert.deepEqual(
      read.pins.map(({ index, name, design }) => clean({ index, name, design })),
      fits ? s.pins.map(({ index, name, design }) => clean({ index, name, design })) : [],
    );
    assert.match(link, /^#[\w\-.~%&=,:/+]+$/);
    assert.doesNotMatch(link, /[.,:]$/);
  }
  assert.ok(pinned > 100);
});

test('links with pieces torn out or doubled never throw, and always give a whole design', () => {
  const { state, pick, random } = generator(7);
  for (let k = 0; k < 500; k++) {
    const link = linkOf(state(), KNOWN);
    const [i, j] = [Math.floor(random() * link.length), Math.floor(random() * link.length)].sort((a, b) => a - b);
    const torn = pick([
      link.slice(0, j),
      link.slice(0, i) + link.slice(j),
      `${link.slice(0, j)}%${link.slice(j)}`,
      link.slice(0, j) + link.slice(i),
      link.replaceAll('=', pick(['=x', '=-', '=[', '=1e999,'])),
    ]);
    const { design } = readLink(torn.startsWith('#v1&') ? torn : `#v1&${torn.slice(1)}`, KNOWN);
    assert.equal(design.poles.length, 4);
    assert.ok(design.poles.every((p) => Number.isFinite(p.re) && Number.isFinite(p.im)));
    assert.ok(PRESETS.some((p) => p.name === design.preset));
    assert.ok([design.loops.pitch, design.loops.yaw].every(({ kp, ti }) => kp >= 0 && ti > 0));
  }
});

test('links of version 1 open as they did', () => {
  for (const { link, design, shown, place, pins } of JSON.parse(
    readFileSync(new URL('fixtures/links_v1.json', import.meta.url), 'utf8'),
  )) {
    const read = readLink(link, KNOWN);
    const preset = PRESETS.find((p) => p.name === (design.preset ?? PRESETS[0].name));
    assert.deepEqual(read.trouble, []);
    assert.deepEqual(read.design, designOf(preset, design));
    const view = place ? 'derivation' : 'design'; // there was one page then; the places named are in the paper
    const later = { showMarks: true, showLag: null, map: null, track: null, find: null }; // younger than those links
    if (shown) assert.deepEqual(read.shown, { view, requirements: NONE, ...later, ...shown });
    assert.equal(read.place, place);
    if (pins)
      assert.deepEqual(
        read.pins.map((p) => ({ index: p.index, name: p.name, poles: p.design.poles.map((z) => z.re) })),
        pins,
      );
  }
});

test('a link of another version says why it does not open', () => {
  const read = readLink('#v2&preset=quanser-aero', KNOWN);
  assert.equal(read.design, undefined);
  assert.match(troubleWords(read.trouble), /cannot be opened: made by a newer heli2dof/);
  assert.match(troubleWords(readLink('#v0', KNOWN).trouble), /no such version/);
});

test('only what differs from the proposal is written, in plain words and short', () => {
  const design = designOf(PRESETS[0]);
  assert.equal(linkOf({ ...initialState(), design }, KNOWN), '#v1&preset=quanser-2dof-manual');
  const typical = {
    ...design,
    poles: [
      { re: -6.5, im: 4.25 },
      { re: -6.5, im: -4.25 },
      { re: -9.25, im: 0 },
      { re: -8, im: 0 },
    ],
    loops: { pitch: { kp: 15.6, ti: 0.2 }, yaw: { kp: 47.6, ti: 0.167 } },
    method: 'tits-yang',
    theta0: 10 / (180 / Math.PI),
    parameters: { m: 1.5, K_pp: 0.21 },
    scenario: { reference: { theta: 5 / (180 / Math.PI), psi: 0.3490658503988659 }, duration: 8 },
  };
  const link = linkOf({ ...initialState(), design: typical, motion: 'theta', spread: 0.1 }, KNOWN);
  assert.ok(
    link.startsWith('#v1&preset=quanser-2dof-manual&p=-6.5+4.25j,-6.5-4.25j,-9.25,-8&pi=15.6,0.2,47.6,0.167&'),
    link,
  );
  assert.equal(link.split('&').length, 12);
  for (const part of [
    'set.m=1.5',
    'set.K_pp=0.21',
    'theta0=10deg',
    'method=tits-yang',
    'step.theta=5deg',
    'duration=8',
    'motion=theta',
    'spread=0.1',
  ])
    assert.ok(link.includes(`&${part}`), part);
  assert.ok(link.length < 300);
});

test('what cannot be read is named, and the rest is restored', () => {
  const bad = readLink(
    '#v1&preset=nowhere&p=-1,-2,-3+1j,-4&pi=1,2,0,0&motion=psi&spread=9' +
      '&lock=poles,moon&method=magic&outer=maybe&set.X=1&duration=-1' +
      '&theta0=200deg&foo=1&scenario.digital=[1&step.psi=ten',
    KNOWN,
  );
  assert.deepEqual(bad.trouble.map((t) => t.part).sort(), [
    'duration',
    'foo',
    'lock',
    'method',
    'outer',
    'p',
    'pi',
    'preset',
    'scenario.digital',
    'set.X',
    'spread',
    'step.psi',
    'theta0',
  ]);
  assert.deepEqual(bad.design, designOf(PRESETS[0]));
  assert.equal(bad.shown.motion, 'psi');
  assert.deepEqual(bad.shown.locks, ['poles']);
  assert.match(
    troubleWords(bad.trouble),
    /^Not taken from this link: .*preset \(no rig “nowhere” here\).*and 10 more\. The rest is restored\.$/,
  );
  assert.equal(troubleWords([]), null);
});

test('requirements are part of a link, and only such as the page can ask', () => {
  const state = { ...initialState(), design: designOf(PRESETS[0]), requirements: { ...NONE, settling: 0.4 } };
  const link = linkOf(state, KNOWN);
  assert.equal(link, '#v1&preset=quanser-2dof-manual&req.settling=0.4');
  assert.deepEqual(readLink(link, KNOWN).shown.requirements, { ...NONE, settling: 0.4 });
  const mixed = readLink('#v1&req.settling=-1&req.overshoot=5', KNOWN);
  assert.deepEqual(
    mixed.trouble.map((t) => t.part),
    ['req.settling'],
  );
  assert.deepEqual(mixed.shown.requirements, { ...NONE, overshoot: 5 });
  for (const part of [
    'settling=',
    'settling=0',
    'settling=soon',
    'settling=1e4',
    'settling=true',
    'settling=[1',
    'overshoot=101',
    'overshoot=1e999',
    'rise=1',
    '__proto__.x=1',
  ]) {
    const { trouble, shown } = readLink(`#v1&req.${part}`, KNOWN);
    assert.equal(trouble.length, 1, part);
    assert.deepEqual(shown.requirements, NONE, part);
  }
  assert.deepEqual(NONE, { settling: null, overshoot: null, lag: null }); // it was not written into
});

test('what mail programs do to a link does not matter', () => {
  const wanted = readLink('#v1&preset=quanser-aero&p=-5,-4,-3+2j,-3-2j', KNOWN).design;
  for (const link of [
    '#v1&amp;preset=quanser-aero&amp;p=-5,-4,-3+2j,-3-2j',
    '#v1&preset=quanser-aero&p=-5%2C-4%2C-3%2B2j%2C-3-2j',
    '#v1&preset=quanser-aero&p=-5,-4,-3 2j,-3-2j',
    '#v1%26preset%3Dquanser-aero%26p%3D-5,-4,-3%2B2j,-3-2j',
  ]) {
    const read = readLink(link, KNOWN);
    assert.deepEqual([read.trouble, read.design], [[], wanted], link);
  }
});

test('a link cannot reach what every object inherits', () => {
  for (const path of [
    '__proto__.x',
    'scenario.__proto__.polluted',
    'scenario.constructor.prototype.polluted',
    'scenario.toString.polluted',
  ])
    readLink(`#v1&${path}=1`, KNOWN);
  assert.equal({}.polluted, undefined);
  assert.equal(Object.prototype.toString.polluted, undefined);
  assert.equal(setLeaf({}, 'a.__proto__.b', 1), false);
});

test('a place on the page is no design, and a design can name one', () => {
  assert.deepEqual(readLink('#eq-13', KNOWN), { place: 'eq-13', trouble: [] });
  assert.equal(placeIn('#v1&preset=x&at=eq-13'), 'eq-13');
  assert.equal(placeIn('#v1&preset=x'), undefined);
  assert.equal(placeIn(''), undefined);
});

test('pins that make the link too long are left out, the design stays', () => {
  const design = designOf(PRESETS[0]);
  const pins = Array.from({ length: 60 }, (_, i) => ({
    id: i,
    index: i,
    name: 'a name of some length',
    design,
    reply: null,
  }));
  const link = linkOf({ ...initialState(), design, pins }, KNOWN);
  assert.equal(link, '#v1&preset=quanser-2dof-manual');
  assert.equal(readLink(linkOf({ ...initialState(), design, pins }, KNOWN, null, Infinity), KNOWN).pins.length, 60);
  assert.ok(linkOf({ ...initialState(), design, pins: pins.slice(0, 10) }, KNOWN).length <= MOST);
});

const PLANT = 'A:0,1:-k/m,-b/m::B:0:1/m::C:1,0::.k:3::.m:2::.b:1';
const kept = (...plants) => plants.map((plant, index) => ({ id: index, index, plant, design: null }));
const withPlants = (plantPins, plant = `${PLANT}::p:-3,-4`, more = {}) => ({
  ...initialState(),
  design: designOf(PRESETS[0]),
  plant,
  plantPins,
  ...more,
});

test('pinned plants travel by what differs from the present one, and come back whole', () => {
  const pins = kept(
    `${PLANT}::p:-1+2j,-1-2j`,
    `${PLANT}::p:-3,-4::q:-8,-9::by:lqr::Q:1,1::R:0.1::x:0,1`,
    'A:0,1:0,0::B:0:1::p:-1,-~&2',
    PLANT,
  );
  const told = (plant) => readLink(linkOf(withPlants(pins, plant), KNOWN), KNOWN);
  for (const plant of [`${PLANT}::p:-3,-4`, 'A:1::B:1::by:lqr', null]) {
    const { plantPins, trouble, shown } = told(plant);
    assert.deepEqual(trouble, []);
    assert.equal(shown.plant ?? null, plant);
    assert.deepEqual(
      plantPins.map(({ index }) => index),
      [0, 1, 2, 3],
    );
    for (const [i, pin] of plantPins.entries()) assert.ok(samePlant(pin.plant, pins[i].plant), pin.plant);
  }
  const link = linkOf(withPlants(pins.slice(0, 1)), KNOWN);
  assert.match(link, /&plant\.pin=0~p:-1\+2j,-1-2j$/);
  assert.deepEqual(readLink(link.replaceAll('&', '&amp;'), KNOWN).plantPins, [{ index: 0, plant: pins[0].plant }]);
});

test('a pinned plant that cannot be read is named, and the rest is restored', () => {
  const read = readLink(`#v1&plant=A:1::B:1&plant.pin=x~p:1&plant.pin=9~p:-1&plant.pin&plant.pin=1~p:-2`, KNOWN);
  assert.deepEqual(read.plantPins, [{ index: 1, plant: 'A:1::B:1::p:-2' }]);
  assert.ok(read.trouble.length === 3 && read.trouble.every(({ part }) => part === 'plant.pin'));
});

test('where not all pins have room in a link, those of the view come first', () => {
  const large = (k) => `A:${Array(120).fill(k).join()}`;
  const plants = kept(large(123456), large(234567));
  const pins = Array.from({ length: 14 }, (_, i) => ({
    id: i,
    index: i,
    name: 'a name of some length',
    design: designOf(PRESETS[0]),
    reply: null,
  }));
  const has = (more) => {
    const link = linkOf(withPlants(plants, 'A:1', { pins, ...more }), KNOWN);
    assert.ok(link.length <= MOST);
    return ['&pin=', '&plant.pin='].map((part) => link.includes(part));
  };
  assert.deepEqual(has({ view: 'plant' }), [false, true]);
  assert.deepEqual(has({ view: 'design' }), [true, false]);
  assert.deepEqual(has({ pins: pins.slice(0, 3) }), [true, true]);
  assert.deepEqual(has({ view: 'plant', plantPins: kept(large(1e12), large(2e12)) }), [true, false]);
});

test('values: exact numbers, degrees where exact, poles only as pairs', () => {
  for (const v of [0, -1e-9, 0.1 + 0.2, 1e21, '10', 'ten', 'true', true, null, [1, { a: ',' }], '5deg'])
    assert.deepEqual(leafOf(leafText('x', v)), v);
  assert.equal(leafText('theta0', 10 / (180 / Math.PI)), '10deg');
  assert.equal(leafOf(leafText('theta0', 0.1)), 0.1);
  assert.equal(leafText('kp', 10 / (180 / Math.PI)), '0.17453292519943295');
  const poles = [
    { re: -1e-7, im: 2e-8 },
    { re: -1e-7, im: -2e-8 },
    { re: -0.5, im: 0 },
    { re: 3, im: 0 },
  ];
  assert.deepEqual(polesOf(polesLink(poles)), poles);
  for (const text of [
    '-1,-2,-3',
    '-1,-2,-3,-4,-5',
    '-1,-2+1j,-2-1j,-3',
    '-1,-2,x,-3',
    '-1,,-2,-3',
    '-1,-2,-3,-2e5',
    '',
  ])
    assert.equal(polesOf(text), undefined, text);
  for (const [text, why] of [
    ['-1,-2,-3', 'four poles are needed, not 3'],
    ['-1,-2,x,-3', '“x” is no pole'],
    ['-1,,-2,-3', 'a pole is missing'],
    ['-1,-2,-3,-2e5', '-2e5 lies beyond ±100000 rad/s'],
    ['-1,-2+1j,-2-1j,-3', 'a complex pole needs its conjugate beside it'],
  ])
    assert.equal(polesTrouble(text), why);
  assert.deepEqual(leaves({ a: { b: 1, c: [1] }, d: undefined, e: null }), [
    ['a.b', 1],
    ['a.c', [1]],
    ['e', null],
  ]);
  assert.deepEqual(differences({ a: 1 }, { a: 1, b: { c: 2 } }), [['b.c', '']]);
  assert.equal(escaped('a&b=c~d.'), 'a%26b%3Dc%7Ed%2E');
});
