/** What other rooms may import of tour/. */
export { Tour } from './tour.js';
