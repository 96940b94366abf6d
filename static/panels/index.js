/** What other rooms may import of panels/. */
export { ExperimentPanel } from './experiment.js';
export { FindingsPanel } from './findings.js';
export { HeaderPanel } from './header.js';
export { LoopsPanel } from './loops.js';
export { MetricsPanel, motorText } from './metrics.js';
export { Notice } from './notice.js';
export { NumbersPanel } from './numbers.js';
export { badge, PinBar } from './pin_bar.js';
export { PairEditor, PolesPanel } from './poles.js';
export { FieldProblems } from './problems.js';
export { Remarks } from './remarks.js';
export { ScenarioPanel } from './scenario.js';
export { ViewSwitch } from './views.js';
