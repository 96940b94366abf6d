/** What other rooms may import of link/. */
export { Address } from './address.js';
export { LockedControls } from './locked_controls.js';
export { differences, leafOf, polesLink, polesOf, setLeaf } from './link_values.js';
export { linkOf, MOST, placeIn } from './permalink.js';
export { PinKeeper } from './pin_keeper.js';
