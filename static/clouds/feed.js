/**
 * The feed of the cloud, the same controller on rigs whose parameters differ a little. The page computes it itself
 * where its kernel serves, all rigs for every move of the hand. Else the server is asked: a few rigs while something
 * moves, many once the hand rests; none while the page computes itself what moves, since then nobody is asked.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Cloud} Cloud
 * @typedef {import('../types.js').Motion} Motion
 * @typedef {import('../contract.js').RobustnessReply} Reply
 * @typedef {ReturnType<typeof cloudRequest>} CloudRequest
 * @typedef {import('../kernel/index.js').Rigs} Rigs
 */
import { bodyOf, cloudCaveat, cloudScenario, lagOf } from '../model/index.js';
import { cloudAddress, LatestSocket } from '../net/index.js';

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
export const cloudRequest = (design, spread, motion, names, samples) =>
  /** @satisfies {import('../types.js').Asked<import('../contract.js').RobustnessRequest>} */ ({
    ...bodyOf(design),
    scenario: played(design, motion),
    uncertainty: spreads(names, spread),
    samples,
  });

/**
 * The experiment of the motion in sight.
 * @param {Design} design @param {Motion} motion
 * @returns {import('../types.js').Scenario} perhaps without the other axis' step
 */
function played(design, motion) {
  const scenario = cloudScenario(design.scenario);
  const reference = motion === 'both' ? scenario.reference : { [motion]: scenario.reference[motion] };
  return { ...scenario, reference: /** @type {typeof scenario.reference} */ (reference) };
}

/** @param {string[]} names @param {number} spread @returns {Record<string, number>} */
const spreads = (names, spread) => Object.fromEntries(names.filter((n) => n !== 'g').map((n) => [n, spread]));

/** The server's cloud as the page keeps it. @param {Reply} reply @returns {Cloud} */
const cloudOf = ({ done, loop_poles, t, envelopes, share_stable, share_within_limits }) => ({
  done,
  judged: done,
  poles: Float64Array.from(loop_poles.flat().flatMap(({ re, im }) => [re, im])),
  t,
  envelopes,
  share_stable,
  share_within_limits,
});

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
 * @param {Omit<Cloud, 'poles'|'t'|'envelopes'>|null} cloud
 * @param {import('../types.js').Scenario} [scenario]
 */
export function cloudWords(cloud, scenario) {
  if (!cloud) return '';
  const { done, judged } = cloud;
  const percent = (/** @type {number} */ share) => `${Math.floor(100 * share)} %`; // 99.9 % is not all
  const caveat = cloudCaveat(scenario);
  return (
    `${done} rigs${caveat && ` (${caveat})`}: ${percent(cloud.share_stable)} stable, ` +
    `${percent(cloud.share_within_limits)}${judged < done ? ` of ${judged}` : ''} within limits`
  );
}

export class CloudFeed {
  /** @type {Rigs|null} */ #rigs = null;
  /** What the page computes: a design, how uncertain, which motion. @type {[Design, number, Motion]|null} */ #own =
    null;
  /** Designs that the kernel has not found. @type {WeakSet<Design>} */ #unfound = new WeakSet();
  /** What the server was asked. */ #key = '';
  /** @type {LatestSocket<CloudRequest, string>|null} */ #socket = null;
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #timer;

  /** @param {import('../model/store.js').Store} store @param {() => WebSocket} [open] */
  constructor(store, open = () => new WebSocket(cloudAddress())) {
    this.store = store;
    this.open = open;
  }

  /** From now on the page computes what it can. @param {Rigs} rigs */
  take(rigs) {
    this.#rigs = rigs;
    this.render(this.store.state);
  }

  /** @param {State} state */
  render(state) {
    const { design, spread } = state;
    if (!design || !spread) {
      if (this.#own || this.#socket || this.#key || state.cloud) this.#stop();
    } else if (!this.#compute(design, spread, state.motion)) {
      this.#forgetOwn();
      this.#askServer(design, state);
    }
  }

  /** @param {Design} design @param {number} spread @param {Motion} motion @returns {boolean} whether the page can */
  #compute(design, spread, motion) {
    const { preset } = this.store;
    if (!this.#rigs || !preset || this.#unfound.has(design)) return false;
    const what = /** @type {const} */ ([design, spread, motion]);
    if (this.#own?.every((own, i) => own === what[i])) return true;
    const asked = { ...design, scenario: played(design, motion) };
    if (!this.#rigs.serves(asked, preset)) return false;
    this.#forgetServer();
    this.#own = [...what];
    this.#rigs.ask(asked, preset, spreads(uncertain(design, preset), spread), MANY, (cloud) => {
      if (cloud) return this.store.set({ cloud });
      this.#unfound.add(design);
      this.render(this.store.state);
    });
    return true;
  }

  /** @param {Design} design @param {State} state */
  #askServer(design, { answered, heard, spread, motion, dragging, connection, cloud }) {
    const own = heard !== answered;
    if (own && cloud && (dragging || connection === 'lost')) this.store.set({ cloud: null }); // it is of another design
    if (own || connection === 'lost') {
      this.#unask(); // asked again when the hand rests, or the server is back
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
    this.#forgetOwn();
    this.#forgetServer();
    this.store.set({ cloud: null });
  }

  #forgetOwn() {
    if (this.#own) this.#rigs?.forget();
    this.#own = null;
  }

  #forgetServer() {
    this.#unask();
    this.#socket?.close();
    this.#socket = null;
  }

  #unask() {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    this.#key = '';
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

  /** A cloud, or a problem, which has a status. @param {Reply & {status?: number}} message */
  #receive(message) {
    const refused = message.status !== undefined;
    // A few rigs of a larger cloud say less than the last whole one; they only tell that it is coming. What comes
    // while nothing is asked is of a design that is no more.
    if (this.#key && (refused || message.done >= Math.min(FEW, message.samples)))
      this.store.set({ cloud: refused ? null : cloudOf(message) });
    if (refused || message.done === message.samples) this.#socket?.done();
  }
}
