/**
 * How the experiment is run: where it starts, what limits it, which controller, what disturbs it. Folded away; one line
 * says what differs from the standard.
 */
import { bringsIntegralAction, experimentWords, isStandard, presetOf, remarked, standard } from '../model/index.js';
import { button, byId, h, setAttr, setText } from '../ui/index.js';
import {
  AccuracyPart,
  DigitalPart,
  DisturbancePart,
  LimitsPart,
  ScenarioFields,
  StartPart,
} from './experiment_parts.js';
import { folded } from './folded.js';

/** Findings that are told at the fields that they speak of, too. */
const TOLD_HERE = ['slow_sampling', 'fast_tracking'];
const WIDE = '(min-width: 1180px)';
const CONCERNED = /^scenario\.(?!reference|duration|samples)/;

export class ExperimentPanel {
  /** @type {StartPart|undefined} */ start;

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    const fields = new ScenarioFields(store);
    this.limits = new LimitsPart(fields);
    this.digital = new DigitalPart(fields);
    this.disturbance = new DisturbancePart(fields);
    this.accuracy = new AccuracyPart(fields);
    this.words = h('span', { class: 'experiment-words', 'data-testid': 'experiment-words' });
    this.reset = button(
      {
        class: 'quiet',
        'data-testid': 'experiment-reset',
        title: 'Back to the standard experiment; the steps stay',
        onclick: () => this.#reset(fields),
      },
      'Standard',
    );
    this.summary = h('summary', { 'data-testid': 'experiment' }, 'Experiment');
    const how = { testid: 'experiment', kind: 'experiment', summary: this.summary, what: 'experiment' };
    const details = folded(how, (close) => {
      this.start = new StartPart(fields, close);
      return [this.start, this.limits, this.digital, this.disturbance, this.accuracy].map((part) => part.node);
    });
    /** Takes parts that come later. */
    this.body = /** @type {HTMLElement} */ (details.lastElementChild);
    // beside its button, in the column's flow: the plots make room, and show what an option does
    const plots = byId('plots');
    details.addEventListener('toggle', () =>
      plots.classList.toggle('two-columns', details.open && matchMedia(WIDE).matches),
    );
    root.append(h('div', { class: 'row experiment-row' }, details, this.words, this.reset));
  }

  /** @param {ScenarioFields} fields */
  #reset(fields) {
    fields.edit(standard);
    this.summary.focus();
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    const { presets, design, problem } = state;
    if (!design) return;
    const words = experimentWords(design.scenario).join(' · ');
    const findings = remarked(state).filter((f) => TOLD_HERE.includes(f.code) && !problem);
    setText(this.words, `${findings.length ? '▲ ' : ''}${words || 'continuous controller, undisturbed'}`);
    setAttr(this.words, 'title', [words, ...findings.map((f) => f.message)].join('\n'));
    this.words.classList.toggle('warning', findings.length > 0);
    this.reset.hidden = isStandard(design.scenario);
    this.summary.classList.toggle('refused', CONCERNED.test(problem?.field ?? ''));
    this.start?.render(design);
    const hasStops = presetOf({ presets, design })?.limits.theta !== undefined;
    this.limits.render(design, { hasStops, own: bringsIntegralAction(state) });
    this.digital.render(design, findings);
    this.disturbance.render(design);
    this.accuracy.render(design);
  }
}
