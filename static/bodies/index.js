/** What other rooms may import of bodies/. */
export { bodyFrom, designFrom, merged } from './bodies.js';
