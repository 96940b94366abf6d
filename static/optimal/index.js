/** What other rooms may import of optimal/. */
export { Optimal } from './optimal.js';
