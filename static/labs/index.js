/** What other rooms may import of labs/. */
export { figureOf, judged, meets, valuesOf } from './goals.js';
export { Labs } from './labs.js';
export { LabPanel } from './panel.js';
export { Sheet } from './sheet.js';
export { startOf } from './starts.js';
