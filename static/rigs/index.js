/** What other rooms may import of rigs/. */
export { OwnRigs } from './panel.js';
export { freeName, rigOf } from './own_rigs.js';
export { shelf } from './shelf.js';
