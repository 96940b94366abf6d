/** The labs there are, in the course's order, and the way into a class. */
import { count, say, t } from '../text/index.js';
import { h } from '../ui/index.js';
import { getLabs } from './alone.js';
import { pointsText } from './goals.js';
import { read } from './kept.js';

/** What this browser knows of a lab that was done alone. @param {import('./shapes.js').Listed} lab */
function begun({ name, points }) {
  const steps = Object.values(
    read(`lab.${name}`, /** @type {{steps?: Record<string, import('./shapes.js').Kept>}} */ ({})).steps ?? {},
  );
  if (!steps.length) return '';
  const sum = steps.reduce((all, { best }) => all + (best?.points ?? 0), 0);
  return say`begun: ${pointsText(sum)} of ${pointsText(points)} points`;
}

/** @param {import('./shapes.js').Listed} lab */
function card(lab) {
  const { name, number, title, minutes, points, summary } = lab;
  const facts = [
    minutes ? count(minutes, '{0} minute', '{0} minutes') : '',
    count(points, '{0} point', '{0} points').replace(String(points), pointsText(points)),
    begun(lab),
  ].filter(Boolean);
  return h(
    'li',
    {},
    h(
      'a',
      { href: `#lab=${name}`, 'data-testid': `lab-${name}` },
      h('span', { class: 'lab-number-of', 'aria-hidden': 'true' }, number ? String(number) : '·'),
      h('strong', { translate: 'no' }, title),
    ),
    h('p', { class: 'lab-facts' }, facts.join(' · ')),
    h('p', { translate: 'no' }, summary ?? ''),
  );
}

/**
 * @param {(hash: string) => void} go
 * @returns {Promise<(Node|string)[]>}
 */
export async function labList(go) {
  const labs = await getLabs();
  const place = (/** @type {import('./shapes.js').Listed} */ { number }) => number ?? Infinity;
  labs.sort((a, b) => place(a) - place(b) || a.title.localeCompare(b.title));
  const code = h('input', {
    class: 'lab-code',
    name: 'code',
    autocomplete: 'off',
    autocapitalize: 'characters',
    spellcheck: 'false',
    maxlength: 12,
    required: true,
    'aria-label': 'Class code',
    'data-testid': 'lab-code',
  });
  const form = h(
    'form',
    {
      class: 'lab-to-class',
      onsubmit: (/** @type {Event} */ e) => {
        e.preventDefault();
        const text = code.value.replace(/[^0-9a-z]/gi, '').toUpperCase();
        if (text) go(`#class=${text}`);
      },
    },
    h('label', {}, h('span', {}, 'Class code'), code),
    h('button', { class: 'primary', 'data-testid': 'lab-to-class' }, 'Join'),
  );
  return [
    h('h2', { tabindex: -1 }, 'Labs'),
    h('p', {}, 'Steps with goals that tick as you drag. Alone here, or in a class by its code.'),
    form,
    h('p', {}, h('a', { href: 'class', 'data-testid': 'lab-instructors' }, 'For instructors: make a class')),
    labs.length
      ? h('ol', { class: 'lab-list', 'data-testid': 'lab-list' }, labs.map(card))
      : h('p', {}, t('This server has no labs.')),
  ];
}
