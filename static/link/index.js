/** What other rooms may import of link/. */
export { Address } from './address.js';
export { LockedControls } from './locked_controls.js';
export { MOST, placeIn } from './permalink.js';
export { PinKeeper } from './pin_keeper.js';
