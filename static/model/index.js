/** What other rooms may import of model/. */
export {
  best,
  dominanceWords,
  hardest,
  inOrder,
  largest,
  logSpaced,
  pairText,
  sameSplit,
  worseMargins,
} from './compare_math.js';
export {
  cloudCaveat,
  cloudScenario,
  DIGITAL,
  ENCODERS,
  experimentWords,
  isStandard,
  standard,
  STANDARD,
  withDigital,
  withDisturbance,
  withEncoder,
  withNoise,
  withOption,
  withStart,
} from './experiment.js';
export { AXIS, DESIGN, LOOP, MARGINS, MOTOR, RESPONSE, SENSITIVITY, STEP } from './figures.js';
export { figureIn, signOf, textOf, tipOf, valueIn } from './figure_texts.js';
export { placeOf, remarksOf } from './finding_places.js';
export {
  axisOf,
  dragHandle,
  fourOf,
  HANDLES,
  handlesOf,
  kindOf,
  nudgeHandle,
  numeralOf,
  observerPoles,
  placesObserver,
  withObserverPoles,
  withRotorPole,
} from './handles.js';
export { guarded, hides, hidesRemarks, lockNames, LOCKS, remarked } from './locks.js';
export { inverseOf, mixingOf } from './loop_values.js';
export { COUPLINGS, LEADS, STRUCTURES } from './method_names.js';
export { bringsIntegralAction, FULL_RANK, keyOf, nameOf, partOf, placesPoles } from './methods.js';
export { colorOf, COLORS, differenceTable, FIGURES, letterOf } from './pins.js';
export { MOST_PLANTS, plantDifference, plantOf, samePlant } from './plant_pins.js';
export { character, fromWire, isComplex, LIMIT, meets, partner, setComplex, setMode, setReal, tidy } from './poles.js';
export {
  asking,
  AXES,
  forbidden,
  guideWords,
  isAsked,
  leastDamping,
  missesLag,
  missing,
  NONE,
  RANGES,
  verdictOf,
} from './requirements.js';
export { OBSERVER_POLES, OUTER, QUANTITIES, ROTORS, STRUCTURE } from './quantities.js';
export {
  allowed,
  asProposed,
  changedWords,
  isChanged,
  isOfRig,
  lagOf,
  lags,
  proposedShown,
  quantities,
  standardOf,
  valueOf,
  without,
  withValue,
} from './rig.js';
export { bodyOf, designOf, evaluationOf, initialState, presetOf, requestOf, scenarioOf, Store } from './store.js';
export { niceStep, ticks } from './ticks.js';
export { extent, indexAt, isVoltage, motionOf, rangeOf, SIGNALS, trace, TRACES, tracesOf } from './traces.js';
export { isRead, isView, pairAlone, STANDARD_VIEW, viewOfPlace, VIEWS } from './views.js';
