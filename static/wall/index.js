/** What static/class.js may import of wall/. */
export { JoinSheet } from './join.js';
export { hashOf, keep, keptClass, placeOf } from './kept.js';
export { Maker } from './make.js';
export { Wall } from './wall.js';
