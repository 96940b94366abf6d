/** What other rooms may import of kernel/. */
export { Block, compiled, instantiated, KernelError, Kernels, MODULE } from './module.js';
