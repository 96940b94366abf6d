/** To keep a flight: as a link, as a file, as a recording of the rig, as numbers and as a film; and to open one. */
import { count, fixed, messageOf, say, significant, t } from '../text/index.js';
import { bodyFrom, designFrom } from '../bodies/index.js';
import { linkOf } from '../link/index.js';
import { initialState } from '../model/index.js';
import { call, fileOf } from '../net/index.js';
import { button, closePopup, copyText, h, popupButton, saveFile, setText } from '../ui/index.js';
import { readLog } from './log.js';
import { canPack, packed, PLACE, unpacked } from './link_text.js';

/** @typedef {import('./flight.js').Flight} Flight */
/** @typedef {import('./log.js').FlightLog} FlightLog */

/** What the server makes of a log: its place, the button's words, what it is, and the file's ending. */
const FILES = /** @type {const} */ ([
  ['csv', 'CSV', 'Time, angles, rates, voltages, references and torques of every tick', 'csv'],
  ['mat', '.mat', 'The same for MATLAB and Octave', 'mat'],
  ['film', '3D film', 'One page that plays in any browser, without a network', 'html'],
]);
/** Samples that are asked for where only the flight's words are wanted. */
const FEW = 2;

export class FlightShare {
  /** Counts what was to be opened: a link that comes too late is dropped. */ #asked = 0;

  /** @param {Flight} flight @param {import('../model/store.js').Store} store */
  constructor(flight, store) {
    this.flight = flight;
    this.store = store;
    this.node = popupButton({
      label: 'Keep this flight, or open another',
      text: h('span', { class: 'export' }, 'Keep', ' ▾'),
      testid: 'fly-keep',
      kind: 'keep',
      content: () => this.#panel(),
    });
    this.file = h('input', {
      type: 'file',
      accept: '.json,.flight.json,application/json',
      class: 'sr',
      'aria-label': 'File of a flight',
      'data-testid': 'fly-file',
      onchange: () => this.#open(),
    });
    this.told = h('p', { class: 'caption', role: 'status', 'data-testid': 'fly-kept' });
  }

  #panel() {
    const log = this.flight.log();
    const tool = (
      /** @type {string} */ id,
      /** @type {string} */ text,
      /** @type {string} */ title,
      /** @type {() => unknown} */ act,
    ) => button({ 'data-testid': `fly-${id}`, title, onclick: () => this.#try(act) }, text);
    const open = button({ 'data-testid': 'fly-open', onclick: () => this.file.click() }, 'Open a flight…');
    setText(this.told, '');
    if (!log) return [h('h2', {}, 'A flight from a file'), h('div', { class: 'row' }, open), this.file, this.told];
    return [
      h('h2', {}, 'This flight'),
      h('p', { class: 'caption' }, this.#about(log)),
      h(
        'div',
        { class: 'row' },
        tool('link', 'Copy link', 'A link that flies this flight again', () => this.#link(log)),
        tool('save', 'Save file', 'Its log: whoever opens it flies it again', () => this.#save(log)),
        open,
      ),
      h('h2', {}, 'Of the server'),
      h('p', { class: 'caption' }, 'It flies the log again, by the same equations.'),
      h(
        'div',
        { class: 'row' },
        tool('check', 'Check', 'Whether the server’s flight is this one', () => this.#check(log)),
        tool('recording', 'As a recording', 'Identify the rig from your own flight: it opens in the view Rig', () =>
          this.#recording(log),
        ),
        FILES.map(([kind, text, title, ending]) => tool(kind, text, title, () => this.#made(log, kind, ending))),
      ),
      this.file,
      this.told,
    ];
  }

  /** @param {FlightLog} log */
  #about({ events }) {
    const changes = events.filter(([, word]) => word === 'design').length;
    const words = count(changes, '{0} change of the design in the air', '{0} changes of the design in the air');
    const time = fixed(this.flight.state.time, 1);
    return changes ? say`${time} s, ${words}.` : say`${time} s.`;
  }

  /** @param {() => unknown} act */
  async #try(act) {
    setText(this.told, 'A moment…');
    try {
      setText(this.told, String((await act()) ?? ''));
    } catch (error) {
      setText(this.told, messageOf(error));
    }
  }

  /** @param {FlightLog} log */
  async #link(log) {
    const { presets, methods } = this.store.state;
    const text = await packed(log);
    if (!canPack()) return t('This browser cannot pack a flight into a link. Take the file.');
    if (text === null) return t('This flight is too long for a link. Take the file.');
    const design = designFrom(log.design, presets);
    const link = linkOf({ ...initialState(), view: 'fly', design }, { presets, methods }, PLACE + text);
    const done = await copyText(`${location.origin}${location.pathname}${location.search}${link}`);
    return done ? t('Copied.') : t('The browser blocked copying. Take the file.');
  }

  /** @param {FlightLog} log */
  #save(log) {
    saveFile('heli2dof.flight.json', new Blob([JSON.stringify(log)], { type: 'application/json' }));
    return t('Saved.');
  }

  /** @param {FlightLog} log */
  async #check(log) {
    /** @type {{apart: number, hash: string}} */
    const { apart, hash } = await call('api/v1/flights', { flight: log, samples: FEW });
    return say`The server’s flight differs by at most ${significant(apart, 2)} rad. SHA-256 ${hash.slice(0, 16)}…`;
  }

  /** @param {FlightLog} log */
  async #recording(log) {
    const file = await fileOf('api/v1/flights/recording', { flight: log });
    document.dispatchEvent(new CustomEvent('recording', { detail: { file, name: 'flight.csv' } }));
    location.hash = 'recordings';
    closePopup();
  }

  /** @param {FlightLog} log @param {string} kind @param {string} ending */
  async #made(log, kind, ending) {
    saveFile(`heli2dof-flight.${ending}`, await fileOf(`api/v1/flights/${kind}`, { flight: log }));
    return t('Saved.');
  }

  #open() {
    const [file] = this.file.files ?? [];
    this.file.value = '';
    this.#asked += 1;
    if (file)
      this.#try(async () => {
        await this.show(readLog(await file.text()));
      });
  }

  /**
   * The flight of a link; one that is overtaken while it is unpacked is not shown.
   * @param {string} place on the page @returns {Promise<string>} why not; empty: it flies
   */
  async fromLink(place) {
    const asked = ++this.#asked;
    const log = await unpacked(place.slice(PLACE.length))
      .then(readLog)
      .catch(() => null);
    if (asked !== this.#asked) return '';
    if (!log) return t('The flight in this link is damaged, or of another version. Ask for it again.');
    return this.show(log).then(() => '', messageOf);
  }

  /** Flies a log again; the page shows the design with which it began. @param {FlightLog} log */
  async show(log) {
    await this.flight.replay(log, () => {
      const { design, presets } = this.store.state;
      const own = designFrom(log.design, presets);
      if (!design || JSON.stringify(bodyFrom(design)) !== JSON.stringify(bodyFrom(own))) this.store.restore(own);
    });
  }
}
