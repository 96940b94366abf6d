/**
 * Asks the server about a recording and keeps its answers in the store: file, overlay, identification with progress and
 * cancel.
 */
import { bodyOf } from '../model/index.js';
import {
  identifyAddress,
  joinRecordings,
  overlayRecording,
  ProblemError,
  sampleRecording,
  sendRecording,
} from '../net/index.js';
import { guessed, identifyBody, isMapped, nothing, overlayBody } from './recordings.js';

/** @typedef {import('../types.js').Recorded} Recorded */

export class RecordingFeed {
  #file = 0;
  #overlay = 0;
  /** @type {WebSocket|null} */ #socket = null;

  /** @param {import('../model/store.js').Store} store @param {() => WebSocket} [open] */
  constructor(store, open = () => new WebSocket(identifyAddress())) {
    this.store = store;
    this.open = open;
  }

  /** @param {Partial<Recorded>} part */
  #set(part) {
    this.store.set({ recorded: { ...this.store.state.recorded, ...part } });
  }

  /** @param {unknown} error */
  #fail(error) {
    const problem =
      error instanceof ProblemError
        ? error.problem
        : { detail: 'The server cannot be reached.', hint: 'Try again when the connection is back.' };
    this.#set({ busy: '', problem });
  }

  /** @type {{file: Blob, name: string}[]} */ #files = [];

  /**
   * Another recording, of one file or of one per signal; its columns are guessed.
   * @param {{file: Blob, name: string}[]} files
   * @param {Record<string, string>} [dialect]
   */
  async send(files, dialect = {}) {
    const mine = ++this.#file;
    this.cancel();
    this.#files = files;
    this.#set({ ...nothing(), busy: 'Reading the file…' });
    try {
      const previews = [];
      for (const { file, name } of files) {
        previews.push(await sendRecording(file, name, dialect));
        if (mine !== this.#file) return;
      }
      const preview = previews.length > 1 ? await joinRecordings(previews.map(({ id }) => id)) : previews[0];
      if (mine !== this.#file) return;
      this.#set({ preview, columns: guessed(preview), busy: '' });
      if (isMapped(this.store.state.recorded.columns)) await this.overlay();
    } catch (error) {
      if (mine === this.#file) this.#fail(error);
    }
  }

  #refused = { separator: '', decimal: '' };

  /**
   * How the text of what was sent may be read otherwise: as it was, or, where nothing was read, as was said.
   * @param {Recorded} recorded
   * @returns {import('../contract.js').Dialect|null}
   */
  dialect({ preview, problem }) {
    if (preview) return preview.dialect;
    return problem && this.#files.length ? this.#refused : null;
  }

  /** The same files, their text read in another way. @param {Record<string, string>} dialect */
  reread(dialect) {
    this.#refused = { separator: '', decimal: '', ...dialect };
    return this.send(this.#files, dialect);
  }

  /** A recording of the present design's digital rig. @returns {Promise<Blob|null>} its file */
  async sample() {
    const { design } = this.store.state;
    if (!design) return null;
    const mine = ++this.#file;
    this.#set({ ...nothing(), busy: 'Recording the digital rig…' });
    try {
      const file = await sampleRecording(bodyOf(design));
      if (mine === this.#file) await this.send([{ file, name: 'heli2dof-recording.csv' }]);
      return file;
    } catch (error) {
      if (mine === this.#file) this.#fail(error);
      return null;
    }
  }

  /** @param {Partial<import('../types.js').RecordingColumns>} part */
  change(part) {
    const { columns } = this.store.state.recorded;
    if (!columns) return;
    this.cancel();
    const after = { ...columns, ...part };
    const driver = after.names.theta_ref && after.names.psi_ref ? this.store.state.recorded.driver : 'segments';
    this.#set({ columns: after, driver, overlay: null, found: null, problem: null });
    if (isMapped(this.store.state.recorded.columns)) this.overlay();
  }

  /** @param {import('../types.js').Driver} driver */
  drive(driver) {
    this.#set({ driver });
    return this.overlay();
  }

  async overlay() {
    const { design, recorded } = this.store.state;
    if (!design || !recorded.preview || !isMapped(recorded.columns)) return;
    const mine = ++this.#overlay;
    this.#set({ busy: 'Simulating…', problem: null });
    try {
      const overlay = await overlayRecording(
        recorded.preview.id,
        overlayBody(design, { driver: recorded.driver, columns: recorded.columns }),
      );
      if (mine === this.#overlay) this.#set({ overlay, overlaid: design, busy: '' });
    } catch (error) {
      if (mine !== this.#overlay) return;
      this.#set({ overlay: null });
      this.#fail(error);
    }
  }

  /** @param {string[]} free @param {boolean} [all] whether nothing is held out */
  identify(free, all = false) {
    const { design, recorded } = this.store.state;
    const { preview, columns } = recorded;
    if (!design || !preview || !isMapped(columns)) return;
    this.cancel();
    const socket = this.open();
    this.#socket = socket;
    this.#set({ busy: 'Identifying…', progress: null, found: null, problem: null });
    socket.onopen = () => socket.send(JSON.stringify(identifyBody(design, { preview, columns }, free, all)));
    socket.onmessage = ({ data }) => {
      if (socket !== this.#socket) return;
      const message = JSON.parse(data);
      if (message.done === false) return void this.#set({ progress: message });
      this.#socket = null;
      socket.close();
      if (message.done) this.#set({ busy: '', progress: null, found: message, foundFor: design });
      else this.#set({ busy: '', progress: null, problem: message });
    };
    socket.onclose = () => {
      if (socket !== this.#socket) return;
      this.#socket = null;
      this.#set({ progress: null });
      this.#fail(null);
    };
  }

  cancel() {
    if (!this.#socket) return;
    const socket = this.#socket;
    this.#socket = null;
    socket.close(); // the server stops with the connection
    this.#set({ busy: '', progress: null });
  }
}
