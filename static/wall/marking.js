/** The form by which a person marks an answer. */
import { parseNumber, say, t } from '../text/index.js';
import { h } from '../ui/index.js';
import { reasonOf } from './calls.js';
import { actButton, labelled, outcome } from './modal.js';
import { pointsText, typed } from './words.js';

/**
 * @param {object} of
 * @param {string} of.testid
 * @param {number} of.most points
 * @param {import('./shapes.js').HandMark|undefined} of.mark as it stands
 * @param {string|undefined} of.sample a good answer, as the lab has it
 * @param {(points: number, comment: string) => Promise<void>} of.save
 */
export function markForm({ testid, most, mark, sample, save }) {
  const points = h('input', {
    class: 'number',
    inputmode: 'decimal',
    autocomplete: 'off',
    'data-testid': `${testid}-points`,
    value: mark ? pointsText(mark.points) : null,
  });
  const comment = h('textarea', { rows: 2, maxlength: 2000, 'data-testid': `${testid}-comment` });
  comment.value = mark?.comment ?? '';
  const told = outcome(`${testid}-told`);
  const send = actButton(
    { type: 'submit', class: 'primary', 'data-testid': `${testid}-save` },
    'Save mark',
    async () => {
      const given = parseNumber(points.value);
      const right = Number.isFinite(given) && given >= 0 && given <= most;
      points.setAttribute('aria-invalid', String(!right));
      if (!right) {
        told.say(say`Points are a number from 0 to ${pointsText(most)}.`, true);
        return points.focus();
      }
      told.say('');
      await save(given, comment.value.trim());
      told.say(t('Saved. The student sees it.'));
    },
    (error) => told.say(reasonOf(error), true),
  );
  return h(
    'form',
    { class: 'mark-form', 'data-testid': testid, onsubmit: (/** @type {Event} */ e) => e.preventDefault() },
    sample ? h('p', { class: 'sample' }, h('b', {}, 'A good answer'), ': ', typed(sample)) : null,
    labelled(say`Points, of ${pointsText(most)}`, points),
    labelled('Comment to the student', comment),
    send,
    told.node,
  );
}
