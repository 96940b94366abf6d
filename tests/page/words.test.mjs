// Words: English is the key, what a language does not know stays English.
import assert from 'node:assert/strict';
import { afterEach, test } from 'node:test';

import pseudo from '../../static/text/languages/pseudo.js';
import { count, languageOf, loadWords, say, t, useWords } from '../../static/text/words.js';

afterEach(() => useWords(null));

test('without a catalogue all is English', () => {
  assert.equal(t('Undo'), 'Undo');
  assert.equal(say`${3} of ${5}`, '3 of 5');
  assert.equal(count(1, '{0} limit', '{0} limits'), '1 limit');
  assert.equal(count(2, '{0} limit', '{0} limits'), '2 limits');
});

test('a catalogue replaces key by key, keeps spaces, and may turn the order of values', () => {
  useWords(
    new Map([
      ['Undo', 'Zurück'],
      ['{0} of {1}', 'von {1} das {0}.'],
    ]),
    'de',
  );
  assert.equal(t(' Undo '), ' Zurück ');
  assert.equal(t('Redo'), 'Redo');
  assert.equal(say`${3} of ${5}`, 'von 5 das 3.');
  assert.equal(say`${'$&'} more`, '$& more');
});

test('a catalogue may hold all the forms of a number that its language has', () => {
  useWords(
    new Map([['{0} limits', { one: '{0} limit', few: '{0} limity', many: '{0} limitów', other: '{0} limitu' }]]),
    'pl',
  );
  assert.deepEqual(
    [1, 2, 5, 22].map((n) => count(n, '{0} limit', '{0} limits')),
    ['1 limit', '2 limity', '5 limitów', '22 limity'],
  );
});

test('the address decides, then the browser, then English', () => {
  const known = ['de', 'pt-br', 'qps-ploc'];
  assert.equal(languageOf('', ['fr', 'de-AT', 'en'], known), 'de');
  assert.equal(languageOf('', ['en-GB', 'de'], known), 'en');
  assert.equal(languageOf('?lang=pt-BR', ['de'], known), 'pt-br');
  assert.equal(languageOf('?projector&lang=xx', ['de'], known), 'en');
  assert.equal(languageOf('', [], known), 'en');
});

test('the pseudo-locale marks words once, and leaves symbols and numbers', async () => {
  assert.equal(await loadWords('qps-ploc'), true);
  assert.match(t('Undo'), /^⟦Ündö·⟧$/);
  assert.equal(t(t('Undo')), t('Undo'));
  for (const text of ['V', 'θ', '−3.20', ' · ', '']) assert.equal(t(text), text);
  for (const text of ['settles in 0.85 s', 'at limit 35 V']) assert.equal(t(text), text); // these are for `say`
  assert.match(t('Rise from 10 % to 90 % (Ogata, 2010, section 5.3)'), /^⟦/);
  assert.match(say`${3} of ${5}`, /^⟦3 öf 5·+⟧$/);
  assert.equal(await loadWords('constructor'), false);
  assert.equal(typeof pseudo.get, 'function');
});
