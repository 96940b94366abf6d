/** What other rooms may import of kernel/. */
export { loadModule } from './module.js';
export { Own } from './own.js';
