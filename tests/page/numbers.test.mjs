// What the RGA says of the pairing in use.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { advisedPairing, pairingWords } from '../../static/panels/numbers.js';

const reply = (pairing, reason = 'λ₁₁ = 0.3.') => ({
  rga: {
    rga: [
      [0.3, 0.7],
      [0.7, 0.3],
    ],
    pairing:
      pairing === 'cross'
        ? [
            ['theta', 'V_y'],
            ['psi', 'V_p'],
          ]
        : [
            ['theta', 'V_p'],
            ['psi', 'V_y'],
          ],
    reason,
    niederlinski: 3.34,
    niederlinski_cross: 1.43,
  },
});

test("the words are the server's reason, with the index of the pairing in use", () => {
  assert.deepEqual(pairingWords(reply('cross'), 'diagonal'), {
    level: 'warning',
    text: 'Crosswise pairing is advised: λ₁₁ = 0.3. Niederlinski 3.34.',
  });
  assert.deepEqual(pairingWords(reply('cross'), 'cross'), {
    level: 'good',
    text: 'Crosswise pairing is right: λ₁₁ = 0.3. Niederlinski 1.43.',
  });
  assert.deepEqual(pairingWords(reply('diagonal'), 'diagonal'), {
    level: 'good',
    text: 'Diagonal pairing is right: λ₁₁ = 0.3. Niederlinski 3.34.',
  });
});

test('the index of the diagonal pairing is not said twice', () => {
  const { text } = pairingWords(reply('cross', 'Niederlinski index 3.34, positive.'), 'diagonal');
  assert.equal(text.match(/Niederlinski/g).length, 1);
});

test('a negative index is unstable with integral action', () => {
  const negative = reply('diagonal');
  negative.rga.niederlinski_cross = -5;
  assert.match(pairingWords(negative, 'cross').text, /Niederlinski −5\.00: unstable with integral action\.$/);
});

test('without a steady state there is no advice', () => {
  assert.equal(advisedPairing({ rga: {} }), undefined);
  assert.equal(advisedPairing(null), undefined);
  assert.equal(pairingWords({}, 'diagonal').level, 'info');
});
