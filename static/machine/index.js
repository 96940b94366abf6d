/** What other rooms may import of machine/. */
export { LagPaths } from './lag_paths.js';
export { MeasuredPart } from './measured.js';
export { RotorPoles } from './rotor_poles.js';
export { trackOf } from './track.js';
