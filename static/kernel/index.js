/** What other rooms may import of kernel/. */
export { DesignRows } from './design_rows.js';
export { Designs, loadDesigns } from './designs.js';
export { Block, compiled, instantiated, KernelError, Kernels, MODULE } from './module.js';
export { AT, OUTCOMES } from './layout.js';
export { MEASURED_FIGURES, SHARES } from './measured.js';
export { fill, serves, sizeOf } from './numbers.js';
export { Own } from './own.js';
export { replyOf } from './reply.js';
export { loadRigs, Rigs, spreadsOf } from './rigs.js';
export { Updates } from './updates.js';
