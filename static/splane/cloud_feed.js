/**
 * The cloud of uncertain rigs: the same controller on rigs whose parameters differ a little. A few rigs while something
 * moves, many once the hand rests; none while the page computes itself what moves, since then the server is not asked.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Design} Design
 * @typedef {ReturnType<typeof cloudRequest>} CloudRequest
 */
import { bodyOf, cloudCaveat, cloudScenario, lagOf } from '../model/index.js';
import { cloudAddress, LatestSocket } from '../net/index.js';

export const SPREADS = [0, 0.05, 0.1, 0.2];
const FEW = 200;
const MANY = 2000;
const REST_MS = 500;

/**
 * What is asked of the server.
 * @param {Design} design
 * @param {number} spread
 * @param {import('../types.js').Motion} motion
 * @param {string[]} names of what is uncertain, g apart
 * @param {number} samples
 */
export function cloudRequest(design, spread, motion, names, samples) {
  const scenario = cloudScenario(design.scenario);
  const played = motion === 'both' ? scenario.reference : { [motion]: scenario.reference[motion] };
  return /** @satisfies {import('../types.js').Asked<import('../contract.js').RobustnessRequest>} */ ({
    ...bodyOf(design),
    scenario: { ...scenario, reference: played },
    uncertainty: Object.fromEntries(names.filter((n) => n !== 'g').map((n) => [n, spread])),
    samples,
  });
}

/**
 * What the cloud's rigs differ in: the parameters, and the lag of each rotor that has one.
 * @param {Design} design
 * @param {import('../types.js').Preset|undefined} preset
 */
export const uncertain = (design, preset) => [
  ...Object.keys(preset?.parameters ?? {}),
  ...(lagOf(design, preset, 'pitch') > 0 ? ['tau_p'] : []),
  ...(lagOf(design, preset, 'yaw') > 0 ? ['tau_y'] : []),
];

/**
 * The cloud in words.
 * @param {import('../types.js').Cloud|null} cloud
 * @param {import('../types.js').Scenario} [scenario]
 */
export function cloudWords(cloud, scenario) {
  if (!cloud) return '';
  const percent = (/** @type {number} */ share) => `${Math.floor(100 * share)} %`; // 99.9 % is not all
  const caveat = cloudCaveat(scenario);
  return (
    `${cloud.done} rigs${caveat && ` (${caveat})`}: ${percent(cloud.share_stable)} stable, ` +
    `${percent(cloud.share_within_limits)} within limits`
  );
}

export class CloudFeed {
  #key = '';
  /** @type {LatestSocket<CloudRequest, string>|null} */ #socket = null;
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #timer;

  /** @param {import('../model/store.js').Store} store @param {() => WebSocket} [open] */
  constructor(store, open = () => new WebSocket(cloudAddress())) {
    this.store = store;
    this.open = open;
  }

  /** @param {State} state */
  render({ design, answered, heard, spread, motion, dragging, connection, cloud }) {
    if (!design || !spread) {
      if (this.#socket || this.#key || cloud) this.#stop();
      return;
    }
    const own = heard !== answered;
    if (own && cloud && (dragging || connection === 'lost')) this.store.set({ cloud: null }); // it is of another design
    if (own || connection === 'lost') {
      clearTimeout(this.#timer);
      this.#timer = undefined;
      this.#key = ''; // asked again when the hand rests, or the server is back
      return;
    }
    const names = uncertain(design, this.store.preset);
    const key = JSON.stringify([design, spread, motion]);
    if (key !== this.#key) {
      this.#key = key;
      this.#ask(cloudRequest(design, spread, motion, names, FEW));
    } else if (dragging || this.#timer) return;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      if (this.store.state.dragging)
        this.#timer = undefined; // asked when the hand lets go
      else this.#ask(cloudRequest(design, spread, motion, names, MANY));
    }, REST_MS);
  }

  #stop() {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    this.#key = '';
    this.#socket?.close();
    this.#socket = null;
    this.store.set({ cloud: null });
  }

  /** One request is computed at a time; meanwhile only the newest one waits. @param {CloudRequest} request */
  #ask(request) {
    this.#socket ??= new LatestSocket({
      open: this.open,
      onMessage: (data) => this.#receive(JSON.parse(data)),
      onLost: () => (this.#socket = null),
    });
    this.#socket.asks.put(request);
  }

  /** A cloud, or a problem, which has a status. @param {import('../types.js').Cloud & {status?: number}} message */
  #receive(message) {
    const refused = message.status !== undefined;
    // A few rigs of a larger cloud say less than the last whole one; they only tell that it is coming. What comes
    // while nothing is asked is of a design that is no more.
    if (this.#key && (refused || message.done >= Math.min(FEW, message.samples)))
      this.store.set({ cloud: refused ? null : message });
    if (refused || message.done === message.samples) this.#socket?.done();
  }
}
