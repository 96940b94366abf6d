/** The findings' list: what more there is opens and closes. */
import assert from 'node:assert/strict';
import { afterEach, test } from 'node:test';

import { FindingsPanel } from '../../static/panels/findings.js';
import { smallDocument } from './small_dom.mjs';

afterEach(() => {
  delete globalThis.document;
});

test('the rest opens on its button, and closes on it, on Escape and on a press beside', () => {
  const document = smallDocument();
  const root = document.createElement('section');
  const panel = new FindingsPanel(root, { state: {} });
  const isOpen = () => {
    assert.equal(
      panel.more.getAttribute('aria-expanded'),
      String(!panel.all.hidden),
      'as it is told to a screen reader',
    );
    return !panel.all.hidden;
  };
  const press = () => panel.more.send('click');
  assert.equal(isOpen(), false);
  press();
  assert.equal(isOpen(), true);
  press();
  assert.equal(isOpen(), false);
  press();
  root.send('keydown', { key: 'Enter' });
  assert.equal(isOpen(), true);
  root.send('keydown', { key: 'Escape' });
  assert.equal(isOpen(), false);
  press();
  document.send('pointerdown');
  assert.equal(isOpen(), false);
});
