/** What other rooms may import of kernel/. */
export { Block, compiled, instantiated, KernelError, Kernels, MODULE } from './module.js';
export { Own } from './own.js';
export { loadRigs, Rigs } from './rigs.js';
export { Updates } from './updates.js';
