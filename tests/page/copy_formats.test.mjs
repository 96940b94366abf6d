// Texts for other programs: full precision, one syntax each. The Python ones are executed in
// tests/app/test_copied_python.py.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { allOf, namesIn, textOf } from '../../static/ui/copy_formats.js';

const K = {
  name: 'K',
  note: 'V/rad',
  matrix: [
    [0.1 + 0.2, -3e-7],
    [1e21, 0],
  ],
};
const POLES = {
  name: 'poles',
  poles: [
    { re: -3, im: 4.5 },
    { re: -3, im: -4.5 },
    { re: -10, im: 0 },
  ],
};
const FORMULA = {
  name: 'T',
  latex: '\\frac{\\alpha}{K_{pp}}',
  sympy: 'Matrix([[alpha/K_pp, -sin(theta_0)], [B_p**2*(a + p_1), 0]])',
  definitions: { alpha: 'J_p + l**2*m', unused: 'x' },
};

test('numbers keep every digit', () => {
  assert.equal(
    textOf(K, 'Python'),
    'import numpy as np\n\n# V/rad\nK = np.array([\n    [0.30000000000000004, -3e-7],\n    [              1e+21,   ' +
      '  0],\n])',
  );
  assert.equal(
    textOf(K, 'MATLAB'),
    '% V/rad\nK = [ ...\n    0.30000000000000004, -3e-7; ...\n                  1e+21,     0 ...\n];',
  );
  assert.equal(
    textOf(K, 'LaTeX'),
    'K = \\begin{bmatrix}\n  0.30000000000000004 & -3 \\times 10^{-7} \\\\\n     1 \\times 10^{21} &               ' +
      '  0\n\\end{bmatrix}',
  );
  assert.equal(textOf(K, 'Text'), 'K: V/rad\n0.30000000000000004  -3e-7\n              1e+21      0');
});

test('poles are complex numbers of each language', () => {
  assert.equal(textOf(POLES, 'Python'), 'import numpy as np\n\npoles = np.array([-3 + 4.5j, -3 - 4.5j, -10])');
  assert.equal(textOf(POLES, 'MATLAB'), 'poles = [-3 + 4.5i, -3 - 4.5i, -10];');
  assert.equal(textOf(POLES, 'LaTeX'), 'p = \\{-3 + 4.5\\mathrm{j},\\; -3 - 4.5\\mathrm{j},\\; -10\\}');
});

test('formulas declare their symbols and say what the short ones stand for', () => {
  assert.equal(
    textOf(FORMULA, 'Python'),
    'from sympy import Matrix, sin, symbols\n\nalpha, K_pp, theta_0, B_p, a, p_1 = symbols("alpha K_pp theta_0 B_p ' +
      'a p_1")\n# alpha = J_p + l**2*m\nT = Matrix([[alpha/K_pp, -sin(theta_0)], [B_p**2*(a + p_1), 0]])',
  );
  assert.equal(
    textOf(FORMULA, 'MATLAB'),
    'syms alpha K_pp theta_0 B_p a p_1\n% alpha = J_p + l^2*m\nT = [alpha/K_pp, -sin(theta_0); ...\n    B_p^2*(a + ' +
      'p_1), 0];',
  );
  assert.equal(textOf(FORMULA, 'LaTeX'), 'T = \\frac{\\alpha}{K_{pp}}');
  assert.equal(
    textOf({ name: 'A', sympy: '2*A' }, 'Python'),
    'from sympy import symbols\n\nA = symbols("A")\nA_ = 2*A',
  );
  assert.equal(textOf({ name: 'Eq. 13', latex: 'x = 1', text: 'x = 1' }, 'LaTeX'), 'x = 1');
  assert.equal(textOf({ name: 'Eq. 13', latex: 'x' }, 'Python'), undefined);
  assert.deepEqual(namesIn('cos(theta_0)*K_pp + pi'), ['theta_0', 'K_pp']);
});

test("brackets of MATLAB's texts are balanced, and no Python power is left", () => {
  for (const item of [K, POLES, FORMULA]) {
    const text = textOf(item, 'MATLAB');
    for (const [open, close] of ['()', '[]']) assert.equal(text.split(open).length, text.split(close).length);
    assert.doesNotMatch(text, /\*\*|np\.|Matrix/);
    // a statement that goes on says so
    for (const line of text.split('\n').slice(0, -1)) assert.match(line, /^(%|syms )|\.\.\.$/, line);
    assert.match(text, /;$/);
  }
});

test('several items share one import', () => {
  const text = allOf([K, POLES], 'Python');
  assert.equal(text.split('import numpy').length, 2);
  assert.match(text, /\]\)\n\npoles = /);
  assert.match(allOf([K, FORMULA], 'Python'), /import numpy as np[\s\S]*from sympy import/);
});

test('four digits where they are wanted, with a note that they are', () => {
  const gain = {
    name: 'K',
    note: 'V/rad',
    matrix: [
      [51.17012345678, -0.0034559999],
      [1e21 / 3, -1e-300],
    ],
  };
  assert.equal(textOf(gain, 'MATLAB', 4).split('\n')[0], '% V/rad; rounded to 4 digits');
  assert.match(
    textOf(gain, 'LaTeX', 4),
    /51\.17 & +-0\.003456 \\\\\n +3\.333 \\times 10\^\{20\} & -1 \\times 10\^\{-300\}/,
  );
  assert.match(textOf(POLES, 'Python', 4), /# rounded to 4 digits\npoles = np\.array\(\[-3 \+ 4\.5j, -3 - 4\.5j, -10/);
  assert.match(textOf({ name: 'M', matrix: [[-0, 99999.6]] }, 'Text', 4), /\n0 {2}100000$/);
  assert.equal(textOf(gain, 'MATLAB'), textOf(gain, 'MATLAB', undefined));
  assert.ok(!textOf(gain, 'MATLAB').includes('rounded'));
  assert.equal(textOf(FORMULA, 'LaTeX', 4), textOf(FORMULA, 'LaTeX'));
  assert.equal(allOf([gain, POLES], 'Python', 4).match(/rounded to 4 digits/g).length, 2);
});
