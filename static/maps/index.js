/** What other rooms may import of maps/. */
export { Maps } from './maps.js';
