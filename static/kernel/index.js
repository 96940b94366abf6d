/** What other rooms may import of kernel/. */
export { DesignRows } from './design_rows.js';
export { Designs, loadDesigns } from './designs.js';
export { CONSTANT, CONTROLLER, INPUT, LOG, MEMORY, MODE, ROW, TAKEN_OVER, WITHIN, WORDS } from './flight_layout.js';
export { BY_AXIS, FLIGHT, NEAR, TASKS } from './flight_tasks.js';
export { flyable, Flights, MOST_AT_ONCE } from './flights.js';
export { Block, compiled, instantiated, KernelError, Kernels, MODULE } from './module.js';
export { AT, ENDS, OUTCOMES } from './layout.js';
export { MEASURED_FIGURES, SHARES } from './measured.js';
export { fill, serves, sizeOf } from './numbers.js';
export { Own } from './own.js';
export { uniform } from './random.js';
export { replyOf } from './reply.js';
export { loadRigs, Rigs, spreadsOf } from './rigs.js';
export { Updates } from './updates.js';
