/** What other rooms may import of kernel/. */
export { Block, compiled, instantiated, KernelError, Kernels, MODULE } from './module.js';
export { OUTCOMES } from './layout.js';
export { fill, serves, sizeOf } from './numbers.js';
export { Own } from './own.js';
export { replyOf } from './reply.js';
export { loadRigs, Rigs } from './rigs.js';
export { Updates } from './updates.js';
