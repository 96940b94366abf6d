/** What other rooms may import of finder/. */
export { Finder } from './finder.js';
