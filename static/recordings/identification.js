/** Which parameters are free, the search for them, and what it found: both fits, curves, residuals, intervals. */
import { say, significant, t } from '../text/index.js';
import { presetOf } from '../model/index.js';
import { freeName, rigOf, shelf } from '../rigs/index.js';
import { button, check, h, head, setText, symbol, wide } from '../ui/index.js';
import { estimateRows, partRows } from './found.js';
import { FitPlot } from './fit_plot.js';
import { ACTUATORS, adopted, freeAtFirst, IDENTIFIABLE, INERTIAS, progressWords } from './recordings.js';

const sym = (/** @type {string} */ name) => {
  const [base, sub] = (ACTUATORS[name]?.symbol ?? name).split('_');
  return symbol(base, sub);
};

export class IdentificationCard {
  /** @type {string} */ #preset = '';
  /** @type {import('../contract.js').IdentificationReply|null} */ #shown = null;

  /** @param {import('../model/store.js').Store} store @param {import('./feed.js').RecordingFeed} feed */
  constructor(store, feed) {
    this.store = store;
    this.feed = feed;
    const tool = (/** @type {string} */ id, /** @type {string} */ text, /** @type {() => void} */ act, title = '') =>
      button({ 'data-testid': `recording-${id}`, title: title || undefined, onclick: act }, text);
    this.free = h('div', { class: 'lock-list', onchange: () => this.#scaled() });
    this.held = check({ checked: true, 'data-testid': 'recording-hold' }, 'hold the last third out for validation');
    this.run = tool('identify', 'Identify', () => feed.identify(this.#free(), !this.held.box.checked));
    this.cancel = tool('cancel', 'Cancel', () => feed.cancel());
    this.scaled = h(
      'p',
      { class: 'caption', hidden: true, 'data-testid': 'recording-scaled' },
      'Thrust, damping and inertia of an axis that grow together leave its motion as it is. Gravity’s torque, with m ' +
        'and l held, tells J_p. J_y is told only by how the distance of the mass from the yaw axis changes, which is ' +
        'weak: hold it, or a thrust constant of yaw, where you know it otherwise.',
    );
    this.progress = h('p', { class: 'caption', role: 'status', 'data-testid': 'recording-progress' });
    this.plots = [new FitPlot('theta', 'pitch'), new FitPlot('psi', 'yaw')];
    this.parts = h('tbody');
    this.rows = h('tbody');
    const table = (/** @type {string} */ id, /** @type {string[]} */ cells, /** @type {Node} */ rows) =>
      h('table', { class: 'compare-table', 'data-testid': `recording-${id}` }, head(cells), rows);
    this.adopt = tool('adopt', 'Adopt', () => this.#adopt(), "Make these the rig's parameters; Undo takes them back");
    this.keep = tool(
      'keep',
      'Adopt and keep as an own rig',
      () => this.#keep(),
      'Keeps it in this browser, in the menu of rigs under “Own rigs”',
    );
    this.kept = h('span', { role: 'status', 'data-testid': 'recording-kept' });
    this.remarks = h('ul', { class: 'recording-remarks' });
    this.title = h('h4', { tabindex: -1, 'data-testid': 'recording-found' }, 'What was found');
    this.result = h(
      'div',
      { class: 'fit-result', hidden: true },
      this.title,
      h(
        'div',
        { class: 'fit-plots' },
        this.plots.map((p) => p.node),
      ),
      wide(
        'Fit of both parts',
        table(
          'parts',
          ['Part', 'Axis', 'Fit before', 'found', 'Variance before', 'found', 'Residuals before', 'found'],
          this.parts,
        ),
      ),
      h(
        'p',
        { class: 'caption' },
        'Fit: 100 (1 − ‖y − ŷ‖/‖y − ȳ‖). Variance accounted for: 100 (1 − var(y − ŷ)/var y). Each segment starts ' +
          'from the state that fits it best, before and found alike.',
      ),
      wide(
        'Identified parameters',
        table('estimates', ['Parameter', 'Unit', 'Before', 'Found', '95 %', 'Interval', 'Noise alone'], this.rows),
      ),
      h(
        'p',
        { class: 'caption' },
        '95 % allows for correlated residuals, for lag, dry friction, dead bands, offsets and curved thrust as far ' +
          'as the residuals bound them, and for what the part that is held out would change. It does not allow for ' +
          'wrong units, columns, m or l. Noise alone: the interval of a model that leaves nothing out.',
      ),
      this.remarks,
      h('div', { class: 'row' }, this.adopt, this.keep, this.kept),
    );
    this.node = h(
      'div',
      { class: 'card wide' },
      h('h3', {}, 'Identification'),
      h(
        'p',
        { class: 'caption' },
        'Least squares on the nonlinear model under the recorded voltages. What is not free is held; m and l always ' +
          'are.',
      ),
      h('div', { class: 'row', role: 'group', 'aria-label': 'Free parameters' }, h('span', {}, 'Free'), this.free),
      this.scaled,
      h('div', { class: 'row' }, this.held.node, this.run, this.cancel),
      this.progress,
      this.result,
    );
  }

  #free() {
    return [...this.free.querySelectorAll('input:checked')].map((box) => /** @type {HTMLInputElement} */ (box).value);
  }

  #scaled() {
    this.scaled.hidden = !this.#free().some((name) => name in INERTIAS);
  }

  /** @param {string} [rig] its name, where it is kept */
  #adopt(rig) {
    const { found } = this.store.state.recorded;
    if (!found) return;
    this.store.edit((d) => ({ ...adopted(d, found), ...(rig !== undefined && { rig }) }));
    this.feed.overlay();
  }

  #keep() {
    const { recorded, design } = this.store.state;
    const preset = presetOf(this.store.state);
    if (!recorded.found || !design || !preset) return;
    const own = shelf();
    const name = freeName(own.rigs, recorded.preview?.name.replace(/\.\w+$/, '') || t('identified rig'));
    own.keep(rigOf(adopted(design, recorded.found), preset, name));
    this.#adopt(name);
    setText(this.kept, own.refused || say`${name} is kept. Rename it under Parameters.`);
  }

  /** @param {import('../types.js').State} state @param {boolean} mapped whether the columns are known */
  render({ recorded, design, presets }, mapped) {
    if (!design) return;
    const { busy, progress, found, foundFor } = recorded;
    this.#freeOf(design, presets);
    this.node.hidden = !mapped;
    const led = [this.run, this.cancel].includes(/** @type {HTMLButtonElement} */ (document.activeElement));
    const searching = busy === 'Identifying…';
    this.run.disabled = searching;
    this.cancel.hidden = !searching;
    const spent = found && say`${found.evaluations} simulations in ${significant(found.seconds, 2)} s`;
    setText(this.progress, searching ? progressWords(progress) : (spent ?? ''));
    this.result.hidden = !found;
    this.adopt.disabled = this.keep.disabled = Boolean(found) && foundFor?.preset !== design.preset;
    const fresh = found !== null && found !== this.#shown;
    if (fresh) this.#show(found);
    this.#shown = found;
    // Who began it by a key goes on from there: to what stops it, to what it found, or to begin again.
    if (led && searching) this.cancel.focus();
    else if (led && fresh) this.title.focus();
    else if (led && document.activeElement !== this.run) this.run.focus();
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
          title: ACTUATORS[name]?.title ?? INERTIAS[name],
        },
        sym(name),
      ).node;
    const group = (/** @type {string} */ name, /** @type {string[]} */ names) =>
      h('div', { class: 'lock-list', role: 'group', 'aria-label': name }, h('span', {}, name), names.map(box));
    this.free.replaceChildren(
      ...IDENTIFIABLE.map(box),
      group('Rotors and friction', Object.keys(ACTUATORS)),
      group('Inertia', Object.keys(INERTIAS)),
    );
    this.#scaled();
  }

  /** @param {import('../contract.js').IdentificationReply} found */
  #show(found) {
    for (const plot of this.plots) plot.show(found, t('held out'));
    this.parts.replaceChildren(
      ...partRows(found).map((row) =>
        h(
          'tr',
          { 'data-testid': `recording-part-${row.id}` },
          h('th', { scope: 'row' }, row.part),
          h('td', {}, row.axis),
          [row.fit, row.variance, row.rms].flatMap(([before, after]) => [
            h('td', {}, before),
            h('td', { class: 'best' }, after),
          ]),
        ),
      ),
    );
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
          h('td', {}, e.noise),
        ),
      ),
    );
    this.remarks.replaceChildren(
      ...found.findings.filter((f) => f.code !== 'synthetic').map((f) => h('li', { class: f.severity }, f.message)),
    );
  }
}
