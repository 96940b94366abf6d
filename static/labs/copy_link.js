/** A student's personal link, to be copied. */
import { button, copyText, setText } from '../ui/index.js';

/** @param {string} link */
export function copyLink(link) {
  const copy = button(
    {
      class: 'quiet',
      'data-testid': 'lab-link',
      title: 'Your personal link: it opens your work on another machine. Who has it is you.',
      onclick: async () => {
        setText(copy, (await copyText(link)) ? 'Copied' : 'Not copied');
      },
    },
    'Copy my link',
  );
  return copy;
}
