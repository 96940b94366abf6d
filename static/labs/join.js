/**
 * Who joins a class: a name, as the instructor knows it, and what a grade book may want.
 * @typedef {import('./class.js').About} About
 * @typedef {{name: string, email?: string}} Who
 */
import { messageOf, say, t } from '../text/index.js';
import { ProblemError } from '../net/index.js';
import { h, setText } from '../ui/index.js';

/**
 * @param {About} about
 * @param {(who: Who) => Promise<void>} join
 * @returns {(Node|string)[]}
 */
export function joinForm({ title, lab, minutes, open }, join) {
  const name = h('input', {
    name: 'name',
    required: true,
    maxlength: 80,
    autocomplete: 'name',
    'data-testid': 'join-name',
  });
  const email = h('input', {
    name: 'email',
    type: 'email',
    maxlength: 254,
    autocomplete: 'email',
    'data-testid': 'join-email',
  });
  const told = h('p', { class: 'lab-trouble', role: 'alert', 'data-testid': 'join-told' });
  const go = h('button', { class: 'primary', 'data-testid': 'join' }, 'Join');
  const form = h(
    'form',
    {
      class: 'lab-join',
      onsubmit: async (/** @type {Event} */ e) => {
        e.preventDefault();
        go.disabled = true;
        setText(told, '');
        try {
          await join({ name: name.value.trim(), ...(email.value.trim() && { email: email.value.trim() }) });
        } catch (error) {
          const hint = error instanceof ProblemError ? (error.problem.hint ?? '') : '';
          setText(told, `${messageOf(error)} ${hint}`.trim());
          go.disabled = false;
        }
      },
    },
    h('label', {}, h('span', {}, 'Your name'), name),
    h('label', {}, h('span', {}, 'E-mail, for the grade book (optional)'), email),
    told,
    go,
  );
  const facts = [lab.title, minutes ? say`${minutes} minutes` : ''].filter(Boolean).join(' · ');
  return [
    h('h2', { translate: 'no', 'data-testid': 'join-title' }, title),
    h('p', { translate: 'no' }, facts),
    h('p', { class: 'lab-standing closed', hidden: open }, t('This class is closed: nobody can join now.')),
    form,
    h(
      'p',
      { class: 'lab-fine' },
      'Your instructor sees your name, your answers and your designs. Have you joined before? Open your personal link.',
    ),
  ];
}
