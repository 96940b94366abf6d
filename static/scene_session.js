/** Whose scene this tab shows, and whether the browser can show one. */

const KEY = 'heli2dof-scene';

/** A name that nobody guesses: whoever knows it sees this tab's rig. */
function newSession() {
  const bytes = crypto.getRandomValues(new Uint8Array(18));
  return btoa(String.fromCharCode(...bytes)).replaceAll('+', '-').replaceAll('/', '_');
}

/** Kept over a reload; a duplicated tab inherits the storage but not the navigation type, and gets its own. */
export function session() {
  const [navigation] = /** @type {PerformanceNavigationTiming[]} */ (performance.getEntriesByType('navigation'));
  const kept = navigation?.type === 'reload' ? sessionStorage.getItem(KEY) : null;
  const id = kept ?? newSession();
  sessionStorage.setItem(KEY, id);
  return id;
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
