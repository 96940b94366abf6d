/**
 * The search on the server, over a socket: one at a time, with progress, called off by closing.
 * @typedef {import('./shapes.js').Found} Found
 * @typedef {import('./shapes.js').Progress} Progress
 * @typedef {import('../types.js').Problem} Problem
 * @typedef {{busy: boolean, progress: Progress|null, problem: Problem|null, cancelled: boolean}} Standing
 */
import { findAddress } from '../net/index.js';

/** @type {Standing} */
export const IDLE = { busy: false, progress: null, problem: null, cancelled: false };
const AWAY = {
  detail: 'The server cannot be reached.',
  hint: 'Find again when the page says “live”. What was found before stays here.',
};

export class FindFeed {
  /** @type {WebSocket|null} */ #socket = null;
  standing = IDLE;

  /**
   * @param {{changed: () => void, found: (found: Found) => void}} tell
   * @param {() => WebSocket} [open]
   */
  constructor({ changed, found }, open = () => new WebSocket(findAddress())) {
    this.changed = changed;
    this.found = found;
    this.open = open;
  }

  /** @param {Partial<Standing>} standing */
  #set(standing) {
    this.standing = { ...IDLE, ...standing };
    this.changed();
  }

  /** @param {object} request */
  ask(request) {
    this.#close();
    const socket = this.open();
    this.#socket = socket;
    this.#set({ busy: true });
    socket.onopen = () => socket.send(JSON.stringify(request));
    socket.onmessage = ({ data }) => {
      if (socket !== this.#socket) return; // it was called off, or asked anew
      const message = JSON.parse(data);
      if (message.done === false) return this.#set({ busy: true, progress: message });
      this.#close();
      if (message.done) this.found(message);
      this.#set(message.done ? IDLE : { problem: message });
    };
    socket.onclose = () => {
      if (socket !== this.#socket) return;
      this.#socket = null;
      this.#set({ problem: AWAY });
    };
  }

  cancel() {
    if (!this.#socket) return;
    this.#close();
    this.#set({ cancelled: true });
  }

  #close() {
    const socket = this.#socket;
    this.#socket = null;
    socket?.close();
  }
}
