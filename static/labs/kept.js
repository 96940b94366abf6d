/**
 * What this browser keeps of labs: JSON under names of its own; where a browser keeps nothing, the page does while it
 * is open.
 */
import { recall, remember } from '../ui/index.js';

/** What the browser did not take, which is newer than what it has. @type {Map<string, string>} */ const here =
  new Map();

/**
 * @template T
 * @param {string} name @param {T} otherwise
 * @returns {T}
 */
export function read(name, otherwise) {
  const text = here.get(name) ?? recall(name);
  if (!text) return otherwise;
  try {
    return JSON.parse(text) ?? otherwise;
  } catch {
    return otherwise; // somebody else's
  }
}

/** @param {string} name @param {unknown} value */
export function write(name, value) {
  const text = JSON.stringify(value);
  if (remember(name, text)) here.delete(name);
  else here.set(name, text);
}

/** Whether what was written is gone with this page. */
export const isForgetful = () => here.size > 0;

/** A name for an attempt that no other has. */
export function newId() {
  const bytes = crypto.getRandomValues(new Uint8Array(16)); // randomUUID is for secure pages only
  bytes[6] = (bytes[6] & 0x0f) | 0x40;
  bytes[8] = (bytes[8] & 0x3f) | 0x80;
  const hex = Array.from(bytes, (b) => b.toString(16).padStart(2, '0')).join('');
  return [hex.slice(0, 8), hex.slice(8, 12), hex.slice(12, 16), hex.slice(16, 20), hex.slice(20)].join('-');
}
