/** What the browser remembers of how this page was left; where it may not, nothing is remembered. */

const PREFIX = 'heli2dof.';

/** @param {string} name @returns {string|null} */
export function recall(name) {
  try {
    return localStorage.getItem(PREFIX + name);
  } catch {
    return null; // storage is switched off
  }
}

/** @param {string} name @param {string} value @returns {boolean} whether it does */
export function remember(name, value) {
  try {
    localStorage.setItem(PREFIX + name, value);
    return true;
  } catch {
    return false; // storage is switched off or full
  }
}
