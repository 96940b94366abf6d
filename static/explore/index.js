/** What other rooms may import of explore/. */
export { Explore } from './explore.js';
