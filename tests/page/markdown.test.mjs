// Markdown of labs: what is read, and that nothing else gets through.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { inline, parse } from '../../static/markdown/parse.js';

const text = (words) => ({ kind: 'text', text: words });
const code = (words) => ({ kind: 'code', text: words });
const math = (latex) => ({ kind: 'math', text: latex });

test('emphasis, code, formulas and links stand in a line', () => {
  assert.deepEqual(inline('Move **both** poles *left*, `p`.'), [
    text('Move '),
    { kind: 'strong', inside: [text('both')] },
    text(' poles '),
    { kind: 'em', inside: [text('left')] },
    text(', '),
    code('p'),
    text('.'),
  ]);
  assert.deepEqual(inline('where $K_{pp} = 0.2$ and $x_1$'), [
    text('where '),
    math('K_{pp} = 0.2'),
    text(' and '),
    math('x_1'),
  ]);
  assert.deepEqual(inline('see [the paper](https://example.org/a_b) or [here](#design)'), [
    text('see '),
    { kind: 'link', to: 'https://example.org/a_b', inside: [text('the paper')] },
    text(' or '),
    { kind: 'link', to: '#design', inside: [text('here')] },
  ]);
  assert.deepEqual(inline('**bold with $a*b$**'), [{ kind: 'strong', inside: [text('bold with '), math('a*b')] }]);
});

test('what only looks like it is text', () => {
  for (const plain of ['2 * 3 * 4', 'K_pp and K_yy', 'costs $5 and $6', 'a ** b', 'snake_case_name', '$ 5 $'])
    assert.deepEqual(inline(plain), [text(plain)]);
  assert.deepEqual(inline('\\*no\\* \\$x\\$'), [text('*no* $x$')]);
});

test('HTML and addresses of other kinds are text', () => {
  const html = '<img src=x onerror="alert(1)"> <b>b</b>';
  assert.deepEqual(parse(html), [{ kind: 'paragraph', inside: [text(html)] }]);
  for (const to of ['javascript:alert(1)', 'data:text/html,x', '//evil.example', 'JaVaScript:x', 'file:///etc']) {
    const source = `[x](${to})`;
    assert.ok(
      inline(source).every((part) => part.kind === 'text'),
      source,
    );
  }
});

test('blocks', () => {
  const tree = parse(
    [
      '# Title',
      'Two lines  ',
      'of one.',
      '',
      '- first',
      '  goes on',
      '- second',
      '  1. inner',
      '  2. more',
      '',
      '> said',
      '',
      '$$A = \\begin{pmatrix} 0 & 1 \\end{pmatrix}$$',
      '',
      '| a | b |',
      '|---|--:|',
      '| 1 | $x$ |',
      '',
      '```',
      '# no heading',
      '```',
    ].join('\n'),
  );
  assert.deepEqual(
    tree.map(({ kind }) => kind),
    ['heading', 'paragraph', 'list', 'quote', 'math', 'table', 'code'],
  );
  assert.deepEqual(tree[1].inside, [text('Two lines'), { kind: 'break' }, text('of one.')]);
  assert.deepEqual(tree[2].items[0], [{ kind: 'paragraph', inside: [text('first\ngoes on')] }]);
  const [, inner] = tree[2].items[1];
  assert.equal(inner.ordered, true);
  assert.equal(inner.items.length, 2);
  assert.equal(tree[4].text, 'A = \\begin{pmatrix} 0 & 1 \\end{pmatrix}');
  assert.deepEqual(tree[5].rows, [[[text('1')], [math('x')]]]);
  assert.equal(tree[6].text, '# no heading');
});

test('loose lists, numbers that go on, paragraphs after lists', () => {
  const [numbers, after] = parse('3. three\n\n4. four\n\nThen.');
  assert.deepEqual([numbers.start, numbers.items.length], [3, 2]);
  assert.equal(after.kind, 'paragraph');
  assert.equal(parse('In 2019. Nothing\n1990) is no list').length, 1);
});

test('long texts without an end are read, and no depth is too deep', { timeout: 60_000 }, () => {
  for (const part of ['*a ', '**a', '$a', '[a](', '`a', '> ', '- ', '_a ', '| a ', '\\'])
    assert.ok(parse(part.repeat(5000)).length, part);
});
