/**
 * One thing is under way at a time; of what comes meanwhile only the newest waits. Over a call, or over a socket that
 * comes back when it is lost.
 */
import { backoff } from './backoff.js';

/** @template T */
export class Latest {
  /** @type {T|null} */ #waiting = null;
  /** @type {T|null} */ #underWay = null;

  /** @param {(item: T) => unknown} send false: it cannot go now and is sent by the next `pump` */
  constructor(send) {
    this.send = send;
  }

  get underWay() {
    return this.#underWay;
  }

  /** Whether something newer waits. */
  get overtaken() {
    return this.#waiting !== null;
  }

  /** @param {T} item */
  put(item) {
    this.#waiting = item;
    this.pump();
  }

  /** What was under way has been answered: the next one's turn. */
  done() {
    this.#underWay = null;
    this.pump();
  }

  /** What was under way has not arrived: it goes again, or what is newer. */
  lost() {
    this.#waiting ??= this.#underWay;
    this.#underWay = null;
  }

  drop() {
    this.#waiting = null;
    this.#underWay = null;
  }

  pump() {
    if (this.#waiting === null || this.#underWay !== null) return;
    this.#underWay = this.#waiting;
    this.#waiting = null;
    if (this.send(this.#underWay) === false) this.lost();
  }
}

/**
 * @template T what is asked
 * @template {string|ArrayBuffer} D what comes
 */
export class LatestSocket {
  /** @type {WebSocket|null} */ #socket = null;
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #retry;
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #patience;
  #attempt = 0;
  #closed = false;

  /**
   * @param {object} how
   * @param {() => WebSocket} how.open
   * @param {(data: D) => void} how.onMessage
   * @param {() => void} [how.onOpen]
   * @param {() => void} [how.onLost]
   * @param {(item: T) => string|ArrayBuffer} [how.encode]
   * @param {{first: number, longest: number}} [how.retry] ms; without, a lost connection stays lost
   * @param {number} [how.patience] ms; who does not answer for as long is taken for lost
   */
  constructor(how) {
    this.how = how;
    const { encode = JSON.stringify, patience } = how;
    this.asks = new Latest((item) => {
      const sent = this.send(encode(item));
      if (sent && patience) this.#patience = setTimeout(() => this.#give(), patience);
      return sent;
    });
    this.#connect();
  }

  /** Whether there is a connection, or the beginning of one. */
  get alive() {
    return this.#socket !== null;
  }

  /** Besides what waits for answers. @param {string|ArrayBuffer} message @returns {boolean} whether it could go */
  send(message) {
    if (this.#socket?.readyState !== 1) return false;
    this.#socket.send(message);
    return true;
  }

  /** What was asked has been answered. */
  done() {
    clearTimeout(this.#patience);
    this.asks.done();
  }

  /** Tries again at once, as when the browser says that the network is back. */
  reconnect() {
    if (this.#socket || this.#closed) return;
    clearTimeout(this.#retry);
    this.#connect();
  }

  close() {
    this.#closed = true;
    clearTimeout(this.#retry);
    clearTimeout(this.#patience);
    this.#socket?.close();
    this.#socket = null;
  }

  #connect() {
    const socket = this.how.open();
    socket.binaryType = 'arraybuffer';
    this.#socket = socket;
    socket.onopen = () => {
      this.#attempt = 0;
      this.how.onOpen?.();
      this.asks.pump();
    };
    socket.onmessage = ({ data }) => socket === this.#socket && this.how.onMessage(data);
    socket.onclose = () => this.#lost(socket);
  }

  #give() {
    const socket = this.#socket;
    socket?.close();
    this.#lost(socket); // a dead peer never completes the closing handshake
  }

  /** @param {WebSocket|null} socket */
  #lost(socket) {
    if (!socket || socket !== this.#socket || this.#closed) return;
    clearTimeout(this.#patience);
    this.#socket = null;
    this.asks.lost();
    this.how.onLost?.();
    const { retry } = this.how;
    if (retry) this.#retry = setTimeout(() => this.#connect(), backoff(this.#attempt++, retry.first, retry.longest));
  }
}
