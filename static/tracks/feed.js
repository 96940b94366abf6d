/**
 * The tracks, asked of the server when the hand rests. What has no figures there is asked for once more without.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../contract.js').TrackReply} TrackReply
 * @typedef {import('./numbers.js').Swept} Swept
 * @typedef {{design: Design, swept: Swept, measures: readonly import('../kernel/found.js').Measure[]}} Wanted
 * @typedef {{track: TrackReply|null, problem: string, wanted: Wanted}} Told
 */
import { bodyOf, scenarioOf } from '../model/index.js';
import { call, fileOf, ProblemError } from '../net/index.js';
import { messageOf } from '../text/index.js';

const REST_MS = 150;
const POINTS = 200;

/** @param {Wanted} wanted */
export const requestOf = ({ design, swept, measures }) => ({
  ...bodyOf(design),
  scenario: scenarioOf(design),
  track: {
    path: swept.path,
    points: POINTS,
    ...(swept.over && { over: swept.over }),
    ...(swept.log && { scale: /** @type {const} */ ('log') }),
    ...(swept.kept && { kept: true }),
    measures: measures.map(({ name, ...where }) => ({ measure: name, ...where })),
  },
});

/** The track as a file. @param {Wanted} wanted @param {'csv'|'svg'} kind */
export const trackFile = (wanted, kind) => fileOf(`api/v1/track/${kind}`, requestOf(wanted));

/**
 * @param {Wanted} wanted @param {(path: string, body: ReturnType<typeof requestOf>) => Promise<TrackReply>} [ask]
 * @returns {Promise<TrackReply>}
 */
export async function fromServer(wanted, ask = call) {
  try {
    return await ask('api/v1/track', requestOf(wanted));
  } catch (error) {
    const field = error instanceof ProblemError ? (error.problem.field ?? '') : '';
    if (!wanted.measures.length || !field.startsWith('track.measures')) throw error;
    return fromServer({ ...wanted, measures: [] }, ask);
  }
}

/** @param {() => void} act */
const atRest = (act) => setTimeout(act, REST_MS);

export class TrackFeed {
  #key = '';
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #timer;

  /**
   * @param {(told: Told) => void} tell
   * @param {(wanted: Wanted) => Promise<TrackReply>} [ask]
   * @param {(act: () => void) => ReturnType<typeof setTimeout>} [later]
   */
  constructor(tell, ask = (wanted) => fromServer(wanted), later = atRest) {
    this.tell = tell;
    this.ask = ask;
    this.later = later;
  }

  /** Asks unless it was asked for already. @param {Wanted|null} wanted null: nobody wants any */
  want(wanted) {
    const key = wanted ? JSON.stringify(requestOf(wanted)) : '';
    if (key === this.#key) return;
    this.#key = key;
    clearTimeout(this.#timer);
    if (wanted) this.#timer = this.later(() => void this.#ask(key, wanted));
  }

  /** @param {string} key @param {Wanted} wanted */
  async #ask(key, wanted) {
    const told = await this.ask(wanted).then(
      (track) => ({ track, problem: '', wanted }),
      (error) => ({ track: null, problem: messageOf(error), wanted, away: !(error instanceof ProblemError) }),
    );
    if (key !== this.#key) return;
    if ('away' in told && told.away) this.#key = ''; // it is asked for again once the server is back
    this.tell(told);
  }
}
