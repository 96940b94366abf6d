// The symbols of a formula: which signs they are, what they mean where they stand, what they are worth.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { inverseOf, mixingOf } from '../../static/model/loop_values.js';
import { assumedWords, lagWords } from '../../static/paper/beyond_words.js';
import { Glossary, signOf, symbolsIn, toldOf, worthOf } from '../../static/paper/symbols.js';

/** A little of an element: what the server's MathML needs. @param {string} source */
function parsed(source) {
  const root = { localName: 'root', children: [], textContent: '', nextElementSibling: null };
  const stack = [root];
  for (const [, close, name, , empty, text] of source.matchAll(/<(\/?)(\w+)([^>]*?)(\/?)>|([^<]+)/g)) {
    if (text !== undefined)
      for (const e of stack)
        e.textContent += text.replace(/&#x([0-9A-F]+);/gi, (_, hex) => String.fromCodePoint(parseInt(hex, 16)));
    else if (close) stack.pop();
    else {
      const element = { localName: name, children: [], textContent: '', nextElementSibling: null };
      const parent = stack.at(-1);
      if (parent.children.length) parent.children.at(-1).nextElementSibling = element;
      parent.children.push(element);
      if (!empty) stack.push(element);
    }
  }
  return root.children[0];
}

const K_pp = '<math><mrow><msub><mi>K</mi><mrow><mtext>pp</mtext></mrow></msub></mrow></math>';
const TERMS = [
  { name: 'K_pp', mathml: K_pp, meaning: 'thrust', unit: 'N·m/V' },
  { name: 'p_1', mathml: '<math><msub><mi>p</mi><mn>1</mn></msub></math>', meaning: 'pole', unit: 'rad/s' },
  {
    name: 'theta_dot',
    mathml: '<math><mover><mi>&#x003B8;</mi><mo>&#x002D9;</mo></mover></math>',
    meaning: 'rate',
    unit: 'rad/s',
  },
  { name: 'theta', mathml: '<math><mi>&#x003B8;</mi></math>', meaning: 'angle', unit: 'rad' },
  { name: 'g', mathml: '<math><mi>g</mi></math>', meaning: 'gravitation', unit: 'm/s²' },
  {
    name: 'gravity',
    mathml: '<math><mrow><mi>g</mi><mo>(</mo></mrow></math>',
    latex: 'g(',
    meaning: 'gravity torque',
    unit: 'N·m',
    chapters: ['mechanics'],
  },
  { name: 'kinetic', mathml: '<math><mi>T</mi></math>', meaning: 'energy', unit: 'J', chapters: ['mechanics'] },
  { name: 'T', mathml: '<math><mi>T</mi></math>', meaning: 'transformation', unit: '', chapters: ['feedback'] },
];
const glossary = new Glossary(/** @type {any} */ (TERMS), /** @type {any} */ (parsed));
const names = (source, chapter = '') =>
  symbolsIn(parsed(source), (sign, applied) => glossary.find(sign, applied, chapter)).map(({ term }) => term.name);

test('a sign is its letter with its index and its accent, however the index is written', () => {
  assert.equal(signOf(parsed('<msub><mi>K</mi><mrow><mi>p</mi><mi>p</mi></mrow></msub>')), 'K_pp');
  assert.equal(signOf(parsed('<msub><mi>K</mi><mrow><mtext>pp</mtext></mrow></msub>')), 'K_pp');
  assert.equal(signOf(parsed('<mover><mi>A</mi><mo>¯</mo></mover>')), 'A¯');
  assert.equal(signOf(parsed('<mn>2</mn>')), '');
  assert.equal(signOf(parsed('<mrow><mi>a</mi><mi>b</mi></mrow>')), '');
});

test('symbols are found once each; exponents and the parts of a symbol are none', () => {
  assert.deepEqual(
    names(
      '<math><mrow><msub><mi>K</mi><mrow><mi>p</mi><mi>p</mi></mrow></msub>' +
        '<msup><mover><mi>θ</mi><mo>˙</mo></mover><mn>2</mn></msup><mi>θ</mi></mrow></math>',
    ),
    ['K_pp', 'theta_dot', 'theta'],
  );
  assert.deepEqual(names('<math><msubsup><mi>p</mi><mn>1</mn><mn>2</mn></msubsup></math>'), ['p_1']);
  assert.deepEqual(names('<math><msup><mo>]</mo><mi>T</mi></msup></math>', 'mechanics'), []);
});

test('the chapter decides what a letter means, and so does a bracket after it', () => {
  assert.deepEqual(names('<math><mi>T</mi></math>', 'mechanics'), ['kinetic']);
  assert.deepEqual(names('<math><mi>T</mi></math>', 'feedback'), ['T']);
  assert.deepEqual(names('<math><mi>T</mi></math>'), []);
  assert.deepEqual(names('<math><mrow><mi>g</mi><mo>(</mo><mi>q</mi><mo>)</mo></mrow></math>', 'mechanics'), [
    'gravity',
  ]);
  assert.deepEqual(names('<math><mrow><mi>m</mi><mi>g</mi><mi>l</mi></mrow></math>', 'mechanics'), ['g']);
});

test('what a symbol is worth comes from the rig, the design and the derivation', () => {
  const walk = {
    asked: {
      poles: [
        { re: -3, im: 4 },
        { re: -3, im: -4 },
        { re: -9, im: 0 },
        { re: -8, im: 0 },
      ],
      loops: { pitch: { kp: 30, ti: 0.1 }, yaw: { kp: 20, ti: 0.2 } },
      operating_point: { theta: 0.1 },
    },
    constants: { alpha: 0.0865 },
    coefficients: { d_10: 25, d_11: 6, d_20: 72, d_21: -17 },
    K: [
      [1, 2, 3, 4],
      [5, 6, 7, 8],
    ],
    rga: [
      [1.5, -0.5],
      [-0.5, 1.5],
    ],
    trim: { V_p: 12.5, V_y: -3.8 },
    controllability_indices: [2, 2],
    T: [
      [1, 0],
      [0, 1],
    ],
  };
  const now = { parameters: { K_pp: 0.204, J_y: 0.04, m: 1, l: 0.2 }, components: { R_p: 0.83 }, walk };
  const text = (/** @type {string} */ name) => worthOf(name, now).text;
  assert.equal(text('K_pp'), '0.204');
  assert.equal(text('R_p'), '0.83');
  assert.equal(text('beta'), '0.08');
  assert.equal(text('alpha'), '0.0865');
  assert.match(text('p_1') ?? '', /3\.000 \+ 4\.000j/);
  assert.equal(text('kp'), '30, 20');
  assert.equal(text('theta_0'), '0.1');
  assert.equal(text('k_23'), '7');
  assert.equal(text('lambda_11'), '1.5');
  assert.equal(text('sigma_2'), '2');
  assert.equal(text('d_2'), 's² − 17 s + 72');
  assert.equal(text('theta'), 'varies in time');
  assert.deepEqual(worthOf('T', now).matrix, [
    [1, 0],
    [0, 1],
  ]);
  assert.deepEqual(worthOf('A_bar', now), {}); // another method has none
  assert.deepEqual(worthOf('alpha', { ...now, walk: { asked: walk.asked, refused: 'no' } }), {});
});

test('the pairing crosses with the signs of the channels, and the decoupler makes Ĝ(0) diagonal', () => {
  const G = [
    [2, -0.5],
    [0.25, 1],
  ];
  assert.deepEqual(mixingOf(undefined, 'diagonal', false), [
    [1, 0],
    [0, 1],
  ]);
  assert.deepEqual(mixingOf(G, 'cross', false), [
    [0, 1],
    [-1, 0],
  ]);
  assert.equal(mixingOf(undefined, 'cross', false), undefined);
  const D = /** @type {number[][]} */ (mixingOf(G, 'diagonal', true));
  const product = G.map((row) => [0, 1].map((j) => row[0] * D[0][j] + row[1] * D[1][j]));
  for (const [i, j, expected] of [
    [0, 0, 2],
    [0, 1, 0],
    [1, 0, 0],
    [1, 1, 1],
  ])
    assert.ok(Math.abs(product[i][j] - expected) < 1e-12);
  assert.equal(
    inverseOf([
      [1, 2],
      [2, 4],
    ]),
    undefined,
  );
});

test('an entry of A or B is worth its own number, not the matrix', () => {
  const walk = {
    constants: {},
    A: [
      [0, 0, 1, 0],
      [0, 0, 0, 1],
      [0, 0, -9.25, 0],
      [0, 0, 0, -3.49],
    ],
    B: [
      [0, 0],
      [0, 0],
      [2.36, 0.08],
      [0.24, 0.79],
    ],
  };
  const now = { parameters: {}, components: {}, walk };
  assert.equal(worthOf('A_44', now).text, '−3.49');
  assert.equal(worthOf('B_31', now).text, '2.36');
  assert.equal(worthOf('A', now).matrix.length, 4);
});

test('beyond the paper’s model a symbol is worth what it is in that part', () => {
  const walk = /** @type {any} */ ({
    asked: { poles: [{ re: -1, im: 0 }], shift: 0.3 },
    constants: { a: 2, alpha: 0.08 },
    K: [[1, 2, 3, 4]],
    rotors: {
      names: { d_10: 7, h_1: 1.5, nu_p: 9, s_p: 0, s_y: 0, v_d_p: 0, v_d_y: 0 },
      rotor_poles: [-15, -16],
      K: [[1, 2, 3, 4, 5, 6]],
    },
    observer: { L: [[70, 0]], asked: [{ re: -40, im: 0 }], poles: [] },
    coefficients: { d_10: 3 },
    controllability_indices: [2, 2],
  });
  const now = { parameters: { K_pp: 0.2 }, components: {}, walk };
  const text = (/** @type {string} */ name, /** @type {any} */ part) => worthOf(name, now, part).text;
  assert.equal(text('d_10', 'rotors'), '7'); // a cubic’s
  assert.equal(text('d_10'), '3');
  assert.equal(text('k_16', 'rotors'), '6');
  assert.equal(text('h_1', 'rotors'), '1.5');
  assert.deepEqual(worthOf('h_9', now, 'rotors'), {}); // of another structure
  assert.equal(text('p_6', 'rotors'), '−16');
  assert.equal(text('K_pp', 'rotors'), '0.2');
  assert.equal(text('a', 'rotors'), '2');
  assert.equal(text('c', 'rotors'), '0.3');
  assert.equal(text('s_j', 'rotors'), 'both curves are linear');
  const curved = { ...walk, rotors: { ...walk.rotors, names: { ...walk.rotors.names, s_p: 0.5, v_d_p: 1 } } };
  assert.equal(worthOf('v_d', { ...now, walk: curved }, 'rotors').text, '1, 0');
  assert.equal(text('l_11', 'observer'), '70');
  assert.match(text('q_1', 'observer') ?? '', /^−40/);
  assert.equal(text('nu_p', 'observer'), '9');
  assert.deepEqual(worthOf('L', now, 'observer').matrix, [[70, 0]]);
  assert.deepEqual(worthOf('l_11', { ...now, walk: { ...walk, observer: undefined } }, 'observer'), {});
});

test('what the lag margin says of a design', () => {
  const said = (/** @type {any} */ reply) => lagWords({ stable: true, gains: { K: [[1, 2, 3, 4]] }, ...reply });
  assert.match(said({ lag_margin: 0.1648 }), /0\.165 s.*at the edge/);
  assert.match(said({ lag_margin: 0.05 }), /lives by rotors that do not lag/);
  assert.match(said({ lag_margin: 1.2 }), /1\.2 s\. A real rig’s are 0\.16 s/);
  assert.match(said({ lag_margin: 0.05, gains: { K: [[1, 2, 3, 4, 5, 6]] } }), /has the rotors in it/);
  assert.match(said({}), /however slow/);
  assert.match(said({ stable: false, lag_margin: 0.1 }), /not stable/);
  assert.equal(assumedWords([]), '');
  assert.match(assumedWords(['yaw']), /for yaw’s rotor/);
  assert.match(assumedWords(['pitch', 'yaw']), /for pitch’s and yaw’s rotor/);
});

test('what a step of a lab keeps back is no symbol’s worth', () => {
  const walk = { asked: {}, constants: {}, K: [[2]], rga: [[0.75]] };
  const worth = (hidden, name) =>
    worthOf(name, { parameters: {}, components: {}, walk: toldOf(walk, { task: { free: [], hidden } }) }).text;
  assert.deepEqual([worth([], 'lambda_11'), worth([], 'k_11')], ['0.75', '2']);
  assert.deepEqual([worth(['rga'], 'lambda_11'), worth(['rga'], 'k_11')], [undefined, '2']);
  assert.equal(toldOf(null, { task: { free: [], hidden: ['rga'] } }), null);
});
