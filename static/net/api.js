/**
 * The server, as the page sees it: a few REST calls and the live socket. All addresses are relative to the page and
 * name the tab's session, by which a proxy in front of several servers finds the one that knows this tab.
 * @typedef {import('../types.js').Connection} Connection
 * @typedef {import('../types.js').Reply} Reply
 * @typedef {import('../types.js').LiveReply} LiveReply
 * @typedef {import('../contract.js').Preview} Preview
 */
/**
 * A request's body.
 * @template T
 * @typedef {import('../types.js').Asked<T>} Asked
 */
import { LatestSocket } from './latest.js';
import { ofSession, session } from './session.js';
import { decodeFrame } from './wire.js';
import { t } from '../text/index.js';

const PROTOCOL = 'heli2dof.v1+binary';
const PATIENCE_MS = 10_000;
const UNUSUAL = /[^\w\-.~:/?#[\]@!$&'()*+,;=%]/gu; // what RFC 3986 knows in no address, and browsers leave in it

/**
 * What the browser says where no server answers, or where one stops amid its answer, differs from one to another, and
 * helps nobody.
 * @template T
 * @param {Promise<T>} answer
 * @returns {Promise<T>}
 */
async function reach(answer) {
  try {
    return await answer;
  } catch {
    throw new Error(t('No connection to the server. Your design stays here. Try again when the page says “live”.'));
  }
}

/** @param {string} path @returns {URL} */
const at = (path) => ofSession(new URL(path, document.baseURI), session());
/** What belongs to a scene names its session itself. @param {string} id @param {string} path @returns {URL} */
const sceneAt = (id, path) => new URL(`scene/${encodeURIComponent(id)}/${path}`, document.baseURI);

/** A problem object (RFC 9457) thrown as an error. */
export class ProblemError extends Error {
  /** @param {import('../types.js').Problem} problem */
  constructor(problem) {
    super(problem.detail ?? problem.title ?? 'The server refused the request.');
    this.problem = problem;
  }
}

/**
 * @param {string|URL} path
 * @param {{method?: string, body?: BodyInit, type?: string, secret?: string}} [options]
 * @returns {Promise<Response>} a good one
 */
async function answerOf(path, { method = 'GET', body, type = 'application/json', secret } = {}) {
  const headers = { ...(body && { 'Content-Type': type }), ...(secret && { 'Heli2dof-Secret': secret }) };
  const response = await reach(fetch(path instanceof URL ? path : at(path), { method, headers, body }));
  if (!response.ok)
    throw new ProblemError({
      title: response.statusText,
      status: response.status,
      ...(await response.json().catch(() => ({}))),
    });
  return response;
}

/**
 * @template T
 * @param {string|URL} path
 * @param {unknown} [body] makes it a POST
 * @param {string} [method]
 * @param {string} [secret] of who asks
 * @returns {Promise<T>} as the contract has it
 */
export async function call(path, body, method = body === undefined ? 'GET' : 'POST', secret) {
  const response = await answerOf(path, { method, body: body === undefined ? body : JSON.stringify(body), secret });
  const text = await reach(response.text());
  const json = text && (response.headers.get('content-type') ?? '').includes('json') ? JSON.parse(text) : {};
  return json;
}

/**
 * A file of the server's, or one that it makes of a design.
 * @param {string} path
 * @param {unknown} [design]
 * @param {string} [secret] of who asks
 */
export const fileOf = async (path, design, secret) => {
  const body = design === undefined ? undefined : JSON.stringify(design);
  const response = await answerOf(path, { method: body === undefined ? 'GET' : 'POST', body, secret });
  return reach(response.blob());
};

/** @returns {Promise<import('../types.js').Preset[]>} */
export const getPresets = () => call('api/v1/presets');
/** @returns {Promise<import('../types.js').Method[]>} */
export const getMethods = () => call('api/v1/methods');
/** @template T @param {Record<string, string>} query @returns {Promise<T>} */
export const getSymbolic = (query) => call(`api/v1/symbolic?${new URLSearchParams(query)}`);
/**
 * @param {Asked<import('../contract.js').DesignRequest>} design
 * @returns {Promise<import('../contract.js').Suggestion>}
 */
export const suggestLoops = (design) => call('api/v1/suggest', design);
/**
 * All that the page shows of a design.
 * @param {Asked<import('../contract.js').EvaluateRequest>} request
 * @returns {Promise<Reply>}
 */
export const evaluateDesign = (request) => call('api/v1/evaluate', request);
/**
 * The design's poles through every method.
 * @param {Asked<import('../contract.js').CompareRequest>} design
 * @returns {Promise<import('../contract.js').Comparison>}
 */
export const compareMethods = (design) => call('api/v1/compare', design);
/**
 * All ways to deal the poles to the two pairs.
 * @param {Asked<import('../contract.js').DesignRequest>} design
 * @returns {Promise<import('../contract.js').Split[]>}
 */
export const compareSplits = (design) => call('api/v1/splits', design);
/**
 * The relative gains, at the frequencies that it names too.
 * @param {Asked<import('../contract.js').RgaRequest>} design
 * @returns {Promise<import('../contract.js').Rga>}
 */
export const relativeGain = (design) => call('api/v1/rga', design);
/**
 * The loops opened at each motor, at the frequencies that it names.
 * @param {Asked<import('../contract.js').LoopsRequest>} design
 * @returns {Promise<import('../contract.js').OpenLoops>}
 */
export const openLoops = (design) => call('api/v1/loops', design);
/**
 * The paper as data: its equations, numbers, errata and figures, recomputed.
 * @returns {Promise<import('../contract.js').Paper>}
 */
export const getPaper = () => call('api/v1/paper');
/**
 * The derivation in numbers.
 * @param {Asked<import('../contract.js').DesignRequest>} design
 * @returns {Promise<import('../contract.js').Walkthrough>}
 */
export const walkThrough = (design) => call('api/v1/walkthrough', design);
/** @param {string} id of a session @param {string} rig */
export const putRig = (id, rig) => call(sceneAt(id, 'rig'), { rig }, 'PUT');
/** What cameras need to know of each rig. @returns {Promise<Record<string, import('../scene/cameras.js').RigView>>} */
export const getRigViews = () => call('scene/rigs');

/**
 * A recorded file, and how its text is to be read where that is not to be judged.
 * @param {Blob} file
 * @param {string} name
 * @param {Record<string, string>} [dialect]
 * @returns {Promise<Preview>}
 */
export const sendRecording = (file, name, dialect = {}) =>
  answerOf(`api/v1/recordings?${new URLSearchParams({ name, ...dialect })}`, {
    method: 'POST',
    body: file,
    type: 'application/octet-stream',
  }).then((response) => response.json());
/** Files of one run as one recording. @param {string[]} recordings their ids @returns {Promise<Preview>} */
export const joinRecordings = (recordings) =>
  call('api/v1/recordings/join', /** @satisfies {import('../contract.js').JoinRequest} */ ({ recordings }));
/**
 * Where the rotors' lag takes the loop's poles.
 * @param {Asked<import('../contract.js').StepRequest>} design
 * @returns {Promise<import('../contract.js').Lag>}
 */
export const lagTrack = (design) => call('api/v1/lag', design);
/**
 * The symmetric root locus of a quadratic method.
 * @param {Asked<import('../contract.js').DesignRequest>} design
 * @returns {Promise<import('../contract.js').RootLocus>}
 */
export const rootLocus = (design) => call('api/v1/locus', design);
/** A recording of a design's digital rig. @param {Asked<import('../contract.js').SampleRequest>} design */
export const sampleRecording = (design) => fileOf('api/v1/recordings/sample', design);
/**
 * @param {string} id
 * @param {Asked<import('../contract.js').OverlayRequest>} body
 * @returns {Promise<import('../contract.js').OverlayReply>}
 */
export const overlayRecording = (id, body) => call(`api/v1/recordings/${encodeURIComponent(id)}/overlay`, body);

/**
 * The motion of a design as a file.
 * @param {'html'|'viser'} format
 * @param {Asked<import('../contract.js').StepRequest>} design
 */
export const motionFile = (format, design) => fileOf(`api/v1/motion?format=${format}`, design);
/**
 * A design for another program or for print.
 * @param {string} format
 * @param {string} link that opens it
 * @param {Asked<import('../contract.js').StepRequest> & {pins?: Asked<import('../contract.js').PinnedDesign>[],
 *   required?: import('../types.js').Requirements, remarks?: boolean}} design
 */
export const exportDesign = (format, link, design) =>
  fileOf(`api/v1/export/${format}?${new URLSearchParams({ link: link.replace(UNUSUAL, encodeURIComponent) })}`, design);
/** The rig in a window of its own. @param {string} id of a session */
export const windowAddress = (id) => sceneAt(id, '').href;

/** @param {URL} url */
export function socketAddress(url) {
  url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
  return url.href;
}

/** The socket that answers in frames. @param {URL} [url] */
export const liveSocket = (url = at('api/v1/live')) => new WebSocket(socketAddress(url), [PROTOCOL]);
/** @param {string} id of a session */
export const hubAddress = (id) => socketAddress(sceneAt(id, 'hub?page=true'));
export const identifyAddress = () => socketAddress(at('api/v1/recordings/identify'));
export const findAddress = () => socketAddress(at('api/v1/find'));
export const cloudAddress = () => socketAddress(at('api/v1/robustness'));

/**
 * The live socket. One request is in flight at most; while it is, only the newest one waits. A lost connection is tried
 * again, ever more slowly, and what was last asked is asked again.
 */
export class Live {
  /** @type {LatestSocket<{seq: number}, ArrayBuffer|string>} */ #socket;

  /**
   * @param {{onReply: (reply: LiveReply) => void, onProblem: (problem: import('../types.js').Problem) => void,
   *   onStatus: (c: Connection) => void, open?: () => WebSocket}} handlers  `open` makes the socket
   */
  constructor({ onReply, onProblem, onStatus, open = liveSocket }) {
    this.onReply = onReply;
    this.onProblem = onProblem;
    this.#socket = new LatestSocket({
      open: () => open(),
      onOpen: () => onStatus('open'),
      onMessage: (data) => this.#receive(data),
      onLost: () => onStatus('lost'),
      retry: { first: 250, longest: 8000 },
      patience: PATIENCE_MS,
    });
  }

  /** @param {{seq: number}} request */
  send(request) {
    this.#socket.asks.put(request);
  }

  /** Tries again at once, as when the browser says that the network is back. */
  reconnect() {
    this.#socket.reconnect();
  }

  close() {
    this.#socket.close();
  }

  /** @param {ArrayBuffer|string} data */
  #receive(data) {
    const message = typeof data === 'string' ? JSON.parse(data) : decodeFrame(data);
    // An answer to something asked before the connection was lost, or asked by nobody, says nothing about the present.
    if (message.seq !== undefined && message.seq !== this.#socket.asks.underWay?.seq) return;
    this.#socket.done();
    if (message.status !== undefined && message.gains === undefined) this.onProblem(message);
    else this.onReply(message);
  }
}
