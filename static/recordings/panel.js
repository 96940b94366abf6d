/**
 * A recording of a real rig: file and columns, the simulation over it with its fit, and the rig's parameters identified
 * from it.
 */
import { significant } from '../text/index.js';
import { button, check, h, head, setText, symbol, wide } from '../ui/index.js';
import { RecordingFeed } from './feed.js';
import {
  ACTUATORS,
  adopted,
  curves,
  DRIVERS,
  estimateRows,
  fitText,
  freeAtFirst,
  IDENTIFIABLE,
  isMapped,
  missingWords,
  overlayWords,
  previewWords,
  progressWords,
} from './recordings.js';
import { RecordingMapping } from './mapping.js';
import { RecordingPlot } from './plot.js';

const sym = (/** @type {string} */ name) => {
  const [base, sub] = (ACTUATORS[name]?.symbol ?? name).split('_');
  return symbol(base, sub);
};
const AXES = /** @type {const} */ (['theta', 'psi']);

export class RecordingsPanel {
  /** @type {unknown[]} */ #seen = [];
  /** @type {import('../contract.js').Preview|null} */ #preview = null;
  /** @type {string} */ #preset = '';

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.feed = new RecordingFeed(store);
    const tool = (/** @type {string} */ id, /** @type {string} */ text, /** @type {() => void} */ act, title = '') =>
      button({ 'data-testid': `recording-${id}`, title: title || undefined, onclick: act }, text);
    this.file = h('input', {
      type: 'file',
      multiple: true,
      accept: '.csv,.txt,.tsv,.dat,.log,.asc,.gz,.xlsx,.mat,.h5,.hdf5,.json,.jsonl',
      title: 'One file, or one for each signal',
      'data-testid': 'recording-file',
      onchange: () => this.#send(),
    });
    this.sample = tool(
      'sample',
      'Try with a sample',
      () => this.#sample(),
      'Thirty seconds of the present design on a digital rig whose parameters are off by up to 15 %',
    );
    this.save = h(
      'a',
      { class: 'button', hidden: true, download: 'heli2dof-recording.csv', 'data-testid': 'recording-save' },
      'Save the sample',
    );
    this.status = h('p', { class: 'caption', role: 'status', 'data-testid': 'recording-status' });
    this.problem = h('p', { class: 'status failure', role: 'alert', hidden: true, 'data-testid': 'recording-problem' });
    this.mapping = new RecordingMapping(this.feed, store);
    this.noted = h('ul', { class: 'recording-remarks', 'data-testid': 'recording-findings' });
    this.plots = AXES.map((axis, i) => new RecordingPlot(axis, i ? 'yaw' : 'pitch'));
    this.driver = h(
      'select',
      {
        'data-testid': 'recording-driver',
        onchange: () => this.feed.drive(/** @type {import('../types.js').Driver} */ (this.driver.value)),
      },
      Object.entries(DRIVERS).map(([value, text]) => h('option', { value }, text)),
    );
    this.again = tool('overlay', 'Simulate again', () => this.feed.overlay(), 'The design has changed since');
    this.about = h('p', { class: 'caption' });
    this.free = h('div', { class: 'lock-list' });
    this.run = tool('identify', 'Identify', () => this.feed.identify(this.#free()));
    this.cancel = tool('cancel', 'Cancel', () => this.feed.cancel());
    this.progress = h('p', { class: 'caption', role: 'status', 'data-testid': 'recording-progress' });
    this.rows = h('tbody');
    this.table = h(
      'table',
      { class: 'compare-table', hidden: true, 'data-testid': 'recording-estimates' },
      head(['Parameter', 'Unit', 'Before', 'Found', '95 %', 'Interval']),
      this.rows,
    );
    this.adopt = tool('adopt', 'Adopt', () => this.#adopt(), "Make these the rig's parameters; Undo takes them back");
    this.remarks = h('ul', { class: 'recording-remarks' });
    const card = (/** @type {string} */ title, /** @type {string} */ kind, /** @type {Node[]} */ ...content) =>
      h('div', { class: `card ${kind}` }, h('h3', {}, title), content);
    this.overlayCard = card(
      'Over the simulation',
      'wide',
      h('div', { class: 'row' }, h('label', { class: 'row' }, h('span', {}, 'Driven by'), this.driver), this.again),
      this.about,
      this.noted,
      h(
        'div',
        { class: 'frequency-plots' },
        this.plots.map((p) => p.node),
      ),
    );
    this.identifyCard = card(
      'Identification',
      'wide',
      h(
        'p',
        { class: 'caption' },
        'Least squares on the nonlinear model under the recorded voltages. Intervals allow for correlated ' +
          'residuals. J, m and l are held fixed.',
      ),
      h(
        'div',
        { class: 'row', role: 'group', 'aria-label': 'Free parameters' },
        h('span', {}, 'Free'),
        this.free,
        this.run,
        this.cancel,
      ),
      this.progress,
      wide('Identified parameters', this.table),
      this.remarks,
      this.adopt,
    );
    root.append(
      h(
        'div',
        { class: 'row recording-file' },
        h('label', { class: 'row' }, h('span', {}, 'File (CSV, .xlsx, .mat, HDF5)'), this.file),
        this.sample,
        this.save,
      ),
      this.status,
      this.problem,
      this.mapping.text,
      h(
        'div',
        { class: 'recording-body' },
        (this.columnsCard = card('Columns', 'wide', this.mapping.node)),
        this.overlayCard,
        this.identifyCard,
      ),
    );
  }

  #send() {
    const files = [...(this.file.files ?? [])].map((file) => ({ file, name: file.name }));
    this.save.hidden = true;
    if (files.length) this.feed.send(files);
  }

  async #sample() {
    this.file.value = '';
    const file = await this.feed.sample();
    if (!file) return;
    URL.revokeObjectURL(this.save.href);
    this.save.href = URL.createObjectURL(file);
    this.save.hidden = false;
  }

  #free() {
    return [...this.free.querySelectorAll('input:checked')].map((box) => /** @type {HTMLInputElement} */ (box).value);
  }

  #adopt() {
    const { found } = this.store.state.recorded;
    if (!found) return;
    this.store.edit((d) => adopted(d, found));
    this.feed.overlay();
  }

  /** @param {import('../types.js').State} state */
  render({ recorded, design, presets }) {
    const { preview, columns, driver, busy, problem, overlay, overlaid, progress, found, foundFor } = recorded;
    const now = [recorded, design];
    if (!design || now.every((v, i) => v === this.#seen[i])) return;
    this.#seen = now;
    this.#freeOf(design, presets);
    const mapped = isMapped(columns);
    setText(
      this.status,
      busy ||
        (preview
          ? [previewWords(preview), missingWords(columns)].filter(Boolean).join('. ')
          : 'A recording stays on the server for half an hour after its last use.'),
    );
    this.problem.hidden = !problem;
    setText(this.problem, problem ? [problem.detail, problem.hint].filter(Boolean).join(' ') : '');
    this.columnsCard.hidden = !preview;
    this.overlayCard.hidden = !overlay;
    this.identifyCard.hidden = !mapped;
    if (preview && preview !== this.#preview && columns) this.mapping.show(preview, columns);
    this.#preview = preview;
    if (columns) this.mapping.render(columns);
    this.mapping.dialect(this.feed.dialect(recorded));
    for (const option of this.driver.options)
      option.disabled = option.value === 'references' && !(columns?.names.theta_ref && columns.names.psi_ref);
    this.driver.value = driver;
    this.again.hidden = overlaid === design;
    if (overlay) {
      setText(this.about, overlayWords(overlay));
      this.noted.replaceChildren(...overlay.findings.map((f) => h('li', {}, f.message)));
      AXES.forEach((axis, i) => this.plots[i].show(curves(overlay, axis), fitText(overlay.fit[axis])));
    }
    const searching = busy === 'Identifying…';
    this.run.disabled = searching;
    this.cancel.hidden = !searching;
    setText(
      this.progress,
      searching
        ? progressWords(progress)
        : found
          ? `${found.evaluations} simulations in ${significant(found.seconds, 2)} s`
          : '',
    );
    this.table.hidden = this.adopt.hidden = this.remarks.hidden = !found;
    this.adopt.disabled = Boolean(found) && foundFor?.preset !== design.preset;
    if (found) this.#show(found);
  }

  /** @param {import('../types.js').Design} design @param {import('../types.js').Preset[]} presets */
  #freeOf(design, presets) {
    if (design.preset === this.#preset) return;
    const preset = presets.find((p) => p.name === design.preset);
    if (!preset) return;
    this.#preset = design.preset;
    const first = freeAtFirst({ ...preset.parameters, .../** @type {Record<string, number>} */ (design.parameters) });
    const box = (/** @type {string} */ name) =>
      check(
        {
          value: name,
          checked: first.includes(name),
          'data-testid': `recording-free-${name}`,
          title: ACTUATORS[name]?.title,
        },
        sym(name),
      ).node;
    this.free.replaceChildren(
      ...IDENTIFIABLE.map(box),
      h(
        'div',
        { class: 'lock-list', role: 'group', 'aria-label': 'Rotors and friction' },
        h('span', {}, 'Rotors and friction'),
        Object.keys(ACTUATORS).map(box),
      ),
    );
  }

  /** @param {import('../contract.js').IdentificationReply} found */
  #show(found) {
    this.rows.replaceChildren(
      ...estimateRows(found).map((e) =>
        h(
          'tr',
          { 'data-testid': `recording-estimate-${e.name}` },
          h('th', { scope: 'row' }, sym(e.name)),
          h('td', { translate: 'no' }, e.unit),
          h('td', {}, e.before),
          h('td', { class: 'best' }, e.value),
          h('td', {}, e.width),
          h('td', {}, e.interval),
        ),
      ),
    );
    this.remarks.replaceChildren(...found.findings.map((f) => h('li', {}, f.message)));
  }
}
