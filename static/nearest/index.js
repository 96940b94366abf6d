/** What other rooms may import of nearest/. */
export { Nearest } from './nearest.js';
