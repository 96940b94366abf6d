/**
 * The socket on which the windows of one session tell one another what is shown and how time runs. A page sends nothing
 * while nobody else listens; of what is shown, the newest waits until the server has taken the last. Each window plays
 * by itself: the server's clock says how long ago a snapshot was taken.
 * @typedef {import('./clock.js').Snapshot} Snapshot
 * @typedef {import('./panel.js').Edits} Edits
 * @typedef {{others: number, leads: boolean, count: number}} Windows  count: of the panel's messages so far
 * @typedef {{pitch: number, yaw: number}} Sticks  what is asked of a flight, −1 … 1: nose up, nose to the right
 */
import { decodeFrame, encodeFrame, LatestSocket } from '../net/index.js';

const PINGS = 4; // at first, to find the shortest way
const LONG_TRIP = 0.05; // seconds: by half of it two windows may differ
const MORE_PINGS = 24; // where none was shorter
const SOON_MS = 250;
const PING_MS = 20_000;
const RETRY_MS = { first: 500, longest: 10_000 };

export class Hub {
  /** @type {LatestSocket<unknown, ArrayBuffer|string>} */ #socket;
  #others = 0;
  /** The server's clock less ours, and how well it is known; seconds. @type {{offset: number, trip: number}|null} */
  #clock = null;
  /** @type {(() => void)[]} What needs the server's time. */ #later = [];
  /** Others fly along. @type {(sticks: Sticks) => void} */ onSticks = () => {};
  #pings = 0;
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #timer;

  /**
   * @param {object} how
   * @param {() => WebSocket} how.open
   * @param {boolean} [how.always]  send even if there is no other window: where the panel listens
   * @param {(shown: unknown) => void} how.onShown  what another window shows
   * @param {(snapshot: Snapshot, elapsed: number) => void} how.onTransport  how time ran so many seconds ago
   * @param {(edits: Edits, count: number) => void} how.onEdits what was set at the panel, for the window that leads
   * @param {(windows: Windows) => void} how.onWindows  also after every new connection
   * @param {(error: number) => void} [how.onClock]  how well the server's clock is known by now, ± seconds
   * @param {() => number} [how.now]  seconds
   */
  constructor({
    open,
    always = false,
    onShown,
    onTransport,
    onEdits,
    onWindows,
    onClock = () => {},
    now = () => performance.now() / 1000,
  }) {
    this.always = always;
    this.onShown = onShown;
    this.onTransport = onTransport;
    this.onEdits = onEdits;
    this.onWindows = onWindows;
    this.onClock = onClock;
    this.now = now;
    this.#socket = new LatestSocket({
      open,
      onOpen: () => this.#opened(),
      onMessage: (data) => this.#receive(data),
      onLost: () => this.#lost(),
      encode: encodeFrame,
      retry: RETRY_MS,
    });
  }

  /** How many other windows there are. */
  get others() {
    return this.#others;
  }

  get #heard() {
    return this.#others > 0 || (this.always && this.#socket.alive);
  }

  /** Shows the others a design and its motion: float32 arrays in plain objects. @param {unknown} shown */
  show(shown) {
    if (this.#heard) this.#socket.asks.put(shown);
  }

  /** Tells the others how time runs from now on. @param {Snapshot} snapshot */
  run({ playing, time, speed, loop }) {
    if (!this.#heard) return;
    const since = this.now();
    this.#timed((offset) =>
      this.#socket.send(JSON.stringify({ type: 'transport', playing, time, speed, loop, at: since + offset })),
    );
  }

  /** Flies along in another window. @param {Sticks} sticks */
  steer({ pitch, yaw }) {
    this.#socket.send(JSON.stringify({ type: 'sticks', pitch, yaw }));
  }

  close() {
    clearTimeout(this.#timer);
    this.#socket.close();
  }

  #opened() {
    this.#clock = null;
    this.#pings = 0;
    this.#ping();
  }

  #lost() {
    this.#others = 0;
    this.onSticks({ pitch: 0, yaw: 0 });
    this.#socket.asks.drop();
    this.#later = [];
    clearTimeout(this.#timer);
  }

  #ping() {
    this.#pings += 1;
    this.#socket.send(JSON.stringify({ type: 'clock', sent: this.now() }));
  }

  /** @param {number} sent @param {number} server */
  #pong(sent, server) {
    const here = this.now();
    const trip = here - sent;
    // An old measurement is trusted ever less: clocks drift.
    if (!this.#clock || trip <= this.#clock.trip * 1.2) this.#clock = { offset: server - (sent + here) / 2, trip };
    else this.#clock.trip *= 1.2;
    const waiting = this.#later;
    this.#later = [];
    for (const act of waiting) act();
    this.onClock(this.#clock.trip / 2);
    if (this.#pings < PINGS) return this.#ping();
    const soon = this.#clock.trip > LONG_TRIP && this.#pings < MORE_PINGS;
    this.#timer = setTimeout(() => this.#ping(), soon ? SOON_MS : PING_MS);
    return undefined;
  }

  /** Does what needs the server's time, as soon as that is known. @param {(offset: number) => void} act */
  #timed(act) {
    if (this.#clock) act(this.#clock.offset);
    else this.#later.push(() => act(this.#clock?.offset ?? 0));
  }

  /** @param {ArrayBuffer|string} data */
  #receive(data) {
    if (typeof data !== 'string') return this.onShown(decodeFrame(data));
    const message = JSON.parse(data);
    if (message.type === 'clock') this.#pong(message.sent, message.now);
    else if (message.type === 'taken') this.#socket.done();
    else if (message.type === 'transport') {
      const { playing, time, speed, loop, at } = message;
      this.#timed((offset) => this.onTransport({ playing, time, speed, loop }, Math.max(0, this.now() + offset - at)));
    } else if (message.type === 'panel') this.onEdits(message.edits, message.count);
    else if (message.type === 'sticks') this.onSticks(message);
    else if (message.type === 'windows') {
      this.#others = message.others;
      this.onWindows(message);
    }
    return undefined;
  }
}

/** Tells tests and scripts how well this window knows the server's clock. @param {number} error ± seconds */
export function publishClock(error) {
  document.documentElement.dataset.clockError = error.toFixed(4);
}
