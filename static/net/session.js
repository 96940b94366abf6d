/**
 * This tab's session: whose scene it shows, and what a proxy in front of several servers keeps together. And whether
 * the browser can show a scene.
 */

const KEY = 'heli2dof-scene';

/** A name that nobody guesses: whoever knows it sees this tab's rig. */
function newSession() {
  const bytes = crypto.getRandomValues(new Uint8Array(18));
  return btoa(String.fromCharCode(...bytes))
    .replaceAll('+', '-')
    .replaceAll('/', '_');
}

/** Kept over a reload; a duplicated tab inherits the storage but not the navigation type, and gets its own. */
function keptOrNew() {
  try {
    const [navigation] = /** @type {PerformanceNavigationTiming[]} */ (performance.getEntriesByType('navigation'));
    const kept = navigation?.type === 'reload' ? sessionStorage.getItem(KEY) : null;
    const id = kept ?? newSession();
    sessionStorage.setItem(KEY, id);
    return id;
  } catch {
    return newSession(); // storage is switched off
  }
}

/** @type {string|undefined} */ let own;

/** The same for as long as the page is open. */
export const session = () => (own ??= keptOrNew());

/** The address with the session that its server is chosen by. @param {URL} url @param {string} id */
export function ofSession(url, id) {
  url.searchParams.set('session', id);
  return url;
}

export function hasWebGl() {
  try {
    const context = document.createElement('canvas').getContext('webgl2');
    context?.getExtension('WEBGL_lose_context')?.loseContext();
    return context !== null;
  } catch {
    return false;
  }
}
