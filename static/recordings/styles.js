/** This room's style sheet, fetched with the room: the first view does without it. */
import { h } from '../ui/index.js';

let wanted = false;

export function styled() {
  if (wanted) return;
  wanted = true;
  document.head.append(h('link', { rel: 'stylesheet', href: new URL('../css/recordings.css', import.meta.url).href }));
}
