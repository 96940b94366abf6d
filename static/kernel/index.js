/** What other rooms may import of kernel/. */
export { Own } from './own.js';
export { loadModule } from './updates.js';
