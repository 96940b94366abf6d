/** What other rooms may import of compare/. */
export { ComparePanel } from './panel.js';
export { PinsPanel } from './pins.js';
