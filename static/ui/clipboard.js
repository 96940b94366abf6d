/**
 * Text into the clipboard. Browsers give `navigator.clipboard` to secure pages only; a laboratory's server on plain
 * HTTP takes the older way.
 */
import { h } from './dom.js';

/** @param {string} text @returns {Promise<boolean>} whether it is there */
export async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return copySelected(text);
  }
}

/** @param {string} text */
function copySelected(text) {
  const focused = /** @type {HTMLElement|null} */ (document.activeElement);
  const host = focused?.closest('[popover]') ?? document.body; // outside an open popover nothing can be selected
  const area = h('textarea', { class: 'sr', 'aria-hidden': 'true', tabindex: -1 });
  area.value = text;
  host.append(area);
  area.select();
  let done;
  try {
    done = document.execCommand('copy');
  } catch {
    done = false;
  }
  area.remove();
  focused?.focus({ preventScroll: true });
  return done;
}

/** Hands a file to the reader's downloads. @param {string} name @param {Blob} blob */
export function saveFile(name, blob) {
  const address = URL.createObjectURL(blob);
  const link = h('a', { href: address, download: name, hidden: true });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
