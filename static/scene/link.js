// The page's end of the channel to the scene's frame: says what the frame shows, and sends it viser's messages.
import { slotOf } from './pose.js';

/** @typedef {import("./pose.js").SceneMessage} SceneMessage */
/** @typedef {Pick<HTMLIFrameElement, 'contentWindow'|'clientWidth'|'clientHeight'>} Frame */

const CHANNEL = 'heli2dof-scene';

export class SceneLink {
  /**
   * @param {Frame} iframe shows /scene/{session}/ of the same origin
   * @param {{onRebuilt: () => void, onState: () => void}} hooks onRebuilt is called when the scene
   *   was built anew and has forgotten what it was told; onState when `ready` or `reason` may differ
   */
  constructor(iframe, { onRebuilt, onState }) {
    this.#iframe = iframe;
    this.#onRebuilt = onRebuilt;
    this.#onState = onState;
    window.addEventListener('message', this.#listen);
    this.post({ kind: 'hello' }); // The scene may have been ready before the page.
  }

  /** @type {Frame} */
  #iframe;
  /** @type {() => void} */
  #onRebuilt;
  /** @type {() => void} */
  #onState;
  /** Whether the scene shows the rig and is connected. */
  ready = false;
  /** Why it does not, where the server said so. */
  reason = '';
  /** Whether the scene holds the rig's nodes: also while its connection is lost. */
  #drawn = false;
  /** @type {Map<string, string>} What each node was told last. */
  #sent = new Map();

  /** Width by height of the picture; NaN while it is not laid out. */
  get aspect() {
    return this.#iframe.clientWidth / this.#iframe.clientHeight;
  }

  /**
   * At once rather than by postMessage: the frame's own animation callbacks come after the page's in each frame, so
   * that the scene draws a pose in the frame that it was sampled for.
   * @param {object} message
   */
  post(message) {
    const data = { channel: CHANNEL, ...message };
    const { origin } = location;
    this.#iframe.contentWindow?.dispatchEvent(new MessageEvent('message', { data, origin, source: window }));
  }

  /**
   * Sends viser's messages as far as the scene does not show what they say already.
   * @param {SceneMessage[]} all @param {{again?: boolean}} [how] again: whatever was said before
   */
  send(all, { again = false } = {}) {
    if (!this.#drawn) return;
    const messages = all.filter((message) => {
      const slot = slotOf(message);
      const value = JSON.stringify(message);
      if (!again && this.#sent.get(slot) === value) return false;
      this.#sent.set(slot, value);
      return true;
    });
    if (messages.length > 0) this.post({ kind: 'pose', messages });
  }

  /** Lets go of the page's events. */
  destroy() {
    window.removeEventListener('message', this.#listen);
  }

  /** @param {MessageEvent} event */
  #listen = (event) => {
    const ours = event.source === this.#iframe.contentWindow && event.origin === location.origin;
    if (!ours || event.data?.channel !== CHANNEL || event.data.state === undefined) return;
    const { state, reason } = event.data;
    this.ready = state === 'ready';
    this.#drawn = this.ready || (this.#drawn && state === 'closed');
    this.reason = reason ?? '';
    if (this.ready) {
      this.#sent.clear();
      this.#onRebuilt();
    }
    this.#onState();
  };
}
