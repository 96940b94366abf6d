/**
 * What a browser does on the way from a learning platform to a lab (app/lti/pages.py): has the platform's frame
 * keep a word, or asks it for the word (LTI postMessage Storage 0.1), where cookies in frames are blocked; or posts
 * a choice.
 */

/** Milliseconds after which a frame that has not answered will not. */
const PATIENCE = 3000;

/**
 * @param {string} id
 * @returns {HTMLElement}
 */
function element(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no ${id}`);
  return found;
}

const page = element('launch');
const said = page.dataset;

/** @returns {HTMLFormElement} */
function form() {
  return /** @type {HTMLFormElement} */ (element('form'));
}

/**
 * The platform's frame that keeps values, by the name that it has told.
 * @returns {Window | null}
 */
function keeper() {
  const platform = window.opener ?? window.parent;
  try {
    return said.target === '_parent' ? platform : (platform.frames[said.target ?? ''] ?? null);
  } catch {
    return null; // no frame of this name, as one of another origin tells it
  }
}

/**
 * Sends a message to the frame and waits for its answer.
 * @param {{subject: string, key: string, value?: string}} message
 * @returns {Promise<string>} the value that it has; empty where it has none or does not answer
 */
function asked(message) {
  const frame = keeper();
  const id = crypto.randomUUID();
  return new Promise((resolve) => {
    if (!frame || frame === window) return resolve('');
    const timer = setTimeout(() => resolve(''), PATIENCE);
    window.addEventListener('message', ({ origin, data }) => {
      if (origin !== said.origin || data?.message_id !== id || data.subject !== `${message.subject}.response`) return;
      clearTimeout(timer);
      resolve(typeof data.value === 'string' ? data.value : '');
    });
    frame.postMessage({ ...message, message_id: id }, said.origin ?? '');
  });
}

/** Has the frame keep the word, then goes on to the platform, whether it does or not: a cookie may do as well. */
async function put() {
  await asked({ subject: 'lti.put_data', key: said.key ?? '', value: said.value ?? '' });
  location.replace(said.following ?? '');
}

/** Asks for the word; without it the launch has to begin anew, in a window of its own. */
async function get() {
  const value = await asked({ subject: 'lti.get_data', key: said.key ?? '' });
  if (value) {
    /** @type {HTMLInputElement} */ (form().elements.namedItem('proof')).value = value;
    form().submit();
    return;
  }
  element('wait').hidden = true;
  element('elsewhere').hidden = false;
}

if (said.do === 'put') void put();
else if (said.do === 'get') void get();
else if (said.do === 'send') form().submit();

export {}; // a module, though nobody imports it
