/**
 * The arrays of the kernels `update`, `run_rigs` and `run_designs` for a loop of n states: kinds and shapes.
 * Made of heli2dof_core/kernels/update_layout.py by `python -m tests.page_kernel`; not to be changed by hand.
 *
 * @typedef {['f64' | 'i64' | 'c128', ...number[]]} Kind  c128: two f64
 */

/** What it fills. @param {number} n @param {number} samples @returns {Record<string, Kind>} */
export const block = (n, samples) => ({
  outcome: ['f64', 2],
  A: ['f64', 4, 4],
  B: ['f64', 4, 2],
  trim: ['f64', 2],
  actuators: ['f64', 12],
  K: ['f64', 2, 6],
  inverse: ['f64', 2, 2],
  closed: ['c128', 6],
  open: ['c128', 4],
  figures: ['f64', 12],
  proportional: ['f64', 2, 2],
  integral: ['f64', 2, 2],
  feedforward: ['f64', 2, 2],
  by_reference: ['f64', 2, 2],
  law: ['f64', 2, n],
  whole: ['f64', n, n],
  driven: ['f64', n, 2],
  poles: ['c128', n],
  connected: ['c128', n],
  L: ['f64', 4, 2],
  estimator_poles: ['c128', 4],
  margins: ['f64', 2, 4],
  sensitivity: ['f64', 4],
  t: ['f64', samples],
  experiments: ['f64', 3, 17],
  linear: ['f64', 3, n + 1, samples],
  nonlinear: ['f64', 3, n, samples],
  voltages: ['f64', 3, 2, 2, samples],
  axes: ['f64', 3, 2, 2, 10],
  motors: ['f64', 3, 2, 2, 2],
  courses: ['f64', 3, 2, 8],
  calm_axes: ['f64', 3, 2, 10],
  calm_courses: ['f64', 3, 8],
});

/** What it writes into besides. @param {number} n @param {number} samples @returns {Record<string, Kind>} */
export const scratch = (n, samples) => ({
  w: ['f64', 24, 16],
  v: ['f64', 8 * n + 12, n + 1],
  ladder: ['f64', 80, n + 1, n + 1],
  nodes: ['f64', n + 3, 257],
  followed: ['f64', 8, 14],
  c: ['f64', n === 6 ? 38 : 174],
  m: ['i64', n === 6 ? 8 : 12],
  plant: ['f64', n === 6 ? 38 : 174],
  free: ['i64', n === 6 ? 8 : 12],
  raw: ['f64', samples + 2, n],
  grid: ['f64', samples + 2],
  sampled: ['f64', samples, n],
  held: ['f64', samples, 2],
  f: ['f64', 2, 2, 20],
  opened: ['f64', 2, 2, 20],
  f_whole: ['f64', 8, 2, 16],
  inner_whole: ['f64', 8, 2, 16],
  rows: ['f64', 12, 4, 2, 8],
  minors: ['f64', 14, 2, 16],
  p: ['f64', 17, 16],
  lag: ['f64', 29, 32],
  frequencies: ['f64', 3, 6000],
  controller: ['f64', 5, 10],
  more: ['f64', 136],
  inner: ['f64', 2, 8],
  settings: ['f64', 14],
  estimator: ['f64', 6, 18],
  estimated: ['f64', 6, 11],
  squares: ['f64', 4, 14, 14],
  column: ['f64', 4, n],
  motor_columns: ['f64', 2, n, 2],
  polynomial_law: ['f64', 2, 6],
  inputs: ['f64', 4, 2],
  nothing: ['f64', 2],
  rig: ['f64', 11],
  gains: ['f64', 2, 2],
  vectors: ['c128', 3, 7, 6],
  exponential: ['f64', 80, 10],
  size_of_exponential: ['f64', 10],
  start: ['f64', n],
  work: ['f64', 18],
});

/**
 * What `run_rigs` takes behind these.
 * @param {number} n @param {number} rigs @param {number} times @returns {Record<string, Kind>}
 */
export const many = (n, rigs, times) => ({
  times: ['f64', times],
  rig_A: ['f64', 4, 4],
  rig_B: ['f64', 4, 2],
  rig_trim: ['f64', 2],
  rig_actuators: ['f64', 12],
  rig_whole: ['f64', n, n],
  rig_driven: ['f64', n, 2],
  own: ['f64', n === 6 ? 38 : 174],
  modes: ['i64', n === 6 ? 8 : 12],
  y: ['f64', n],
  one: ['f64', 122],
  x: ['f64', 17],
  course_of_rig: ['f64', times, n],
  rig_poles: ['c128', rigs, n],
  angles: ['f64', rigs, 2, times],
  stable: ['f64', rigs],
  within: ['f64', rigs],
});

/** What `run_designs` takes behind these. @param {number} n @param {number} designs @returns {Record<string, Kind>} */
export const designs = (n, designs) => ({
  found_poles: ['c128', designs, n],
  found: ['f64', designs, 236],
});
