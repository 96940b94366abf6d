/** What other rooms may import of flight/. */
export { Flight } from './flight.js';
export { FlyView } from './view.js';
