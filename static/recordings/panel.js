/**
 * A recording of a rig: file and columns, the simulation over it with its fit, the rig's parameters identified from it,
 * and itself beside the design.
 */
import { button, h, setText } from '../ui/index.js';
import { Beside } from './beside.js';
import { RecordingFeed } from './feed.js';
import { IdentificationCard } from './identification.js';
import { curves, DRIVERS, fitText, isMapped, missingWords, overlayWords, previewWords } from './recordings.js';
import { RecordingMapping } from './mapping.js';
import { RecordingPlot } from './plot.js';

const AXES = /** @type {const} */ (['theta', 'psi']);

export class RecordingsPanel {
  /** @type {unknown[]} */ #seen = [];
  /** @type {import('../contract.js').Preview|null} */ #preview = null;
  /** Whether the recording that is awaited was handed over elsewhere on the page. */ #handed = false;

  /**
   * @param {HTMLElement} root
   * @param {import('../model/store.js').Store} store
   * @param {import('../plots/plots.js').Plots} plots in which the recording is shown beside the design
   */
  constructor(root, store, plots) {
    this.store = store;
    this.feed = new RecordingFeed(store);
    this.root = root;
    // a lab has fetched the recording of a student's rig, or a flight has become one
    document.addEventListener('recording', (e) => {
      this.#handed = true;
      this.feed.send([/** @type {CustomEvent} */ (e).detail]);
    });
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
    this.identification = new IdentificationCard(store, this.feed);
    this.synthetic = h('p', { class: 'synthetic', role: 'note', hidden: true, 'data-testid': 'recording-synthetic' });
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
    this.beside = new Beside(store, plots);
    root.append(
      h(
        'div',
        { class: 'row recording-file' },
        h('label', { class: 'row' }, h('span', {}, 'File (CSV, .xlsx, .mat, HDF5)'), this.file),
        this.sample,
        this.save,
      ),
      this.synthetic,
      this.status,
      this.problem,
      this.mapping.text,
      h(
        'div',
        { class: 'recording-body' },
        (this.columnsCard = card('Columns', 'wide', this.mapping.node)),
        this.overlayCard,
        this.identification.node,
        this.beside.node,
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

  /** @param {import('../types.js').State} state */
  render(state) {
    const { recorded, design } = state;
    this.beside.render(state);
    const { preview, columns, driver, busy, problem, overlay, overlaid } = recorded;
    const now = [recorded, design];
    if (!design || now.every((v, i) => v === this.#seen[i])) return;
    this.#seen = now;
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
    this.identification.render(state, mapped);
    const made = preview?.findings.find((f) => f.code === 'synthetic');
    this.synthetic.hidden = !made;
    setText(this.synthetic, made ? `Synthetic. ${made.message}` : '');
    if (preview && preview !== this.#preview) {
      if (columns) this.mapping.show(preview, columns);
      if (this.#handed) this.root.scrollIntoView(); // there is room for it only now
      this.#handed = false;
    }
    this.#preview = preview;
    if (columns) this.mapping.render(columns);
    this.mapping.dialect(this.feed.dialect(recorded));
    for (const option of this.driver.options)
      option.disabled = option.value === 'references' && !(columns?.names.theta_ref && columns.names.psi_ref);
    this.driver.value = driver;
    this.again.hidden = overlaid === design;
    if (overlay) {
      setText(this.about, overlayWords(overlay));
      this.noted.replaceChildren(
        ...overlay.findings.filter((f) => f.code !== 'synthetic').map((f) => h('li', {}, f.message)),
      );
      AXES.forEach((axis, i) => this.plots[i].show(curves(overlay, axis), fitText(overlay.fit[axis])));
    }
  }
}
