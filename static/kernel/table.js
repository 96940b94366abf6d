/**
 * What the functions of kernels.wasm take and return, in order. Made with it by `python -m wasm`; not to be changed by
 * hand.
 *
 * @typedef {'f64' | 'i64' | 'c128' | 'bool'} Scalar  c128: two f64, in arrays alone
 * @typedef {object} Parameter
 * @property {string} name
 * @property {Scalar} type  of an array's elements, or of the value
 * @property {number} [dimensions]  of an array, rows first
 * @typedef {object} Signature
 * @property {Parameter[]} takes
 * @property {Scalar} [returns]
 */

/** @type {Record<string, Signature>} */
export const SIGNATURES = {
  run_experiments: {
    takes: [
      { name: 'size', type: 'f64', dimensions: 1 },
      { name: 'rig', type: 'f64', dimensions: 1 },
      { name: 'trim', type: 'f64', dimensions: 1 },
      { name: 'theta_0', type: 'f64' },
      { name: 'law', type: 'f64', dimensions: 2 },
      { name: 'by_reference', type: 'f64', dimensions: 2 },
      { name: 'integral', type: 'f64', dimensions: 2 },
      { name: 'whole', type: 'f64', dimensions: 2 },
      { name: 'driven', type: 'f64', dimensions: 2 },
      { name: 'poles', type: 'c128', dimensions: 1 },
      { name: 'experiments', type: 'f64', dimensions: 2 },
      { name: 'more', type: 'f64', dimensions: 1 },
      { name: 'inner', type: 'f64', dimensions: 3 },
      { name: 't', type: 'f64', dimensions: 1 },
      { name: 'rtol', type: 'f64' },
      { name: 'atol', type: 'f64' },
      { name: 'most_steps', type: 'i64' },
      { name: 'w', type: 'f64', dimensions: 2 },
      { name: 'v', type: 'f64', dimensions: 2 },
      { name: 'ladder', type: 'f64', dimensions: 3 },
      { name: 'nodes', type: 'f64', dimensions: 2 },
      { name: 'f', type: 'f64', dimensions: 2 },
      { name: 'c', type: 'f64', dimensions: 1 },
      { name: 'm', type: 'i64', dimensions: 1 },
      { name: 'raw', type: 'f64', dimensions: 2 },
      { name: 'grid', type: 'f64', dimensions: 1 },
      { name: 'zeros', type: 'f64', dimensions: 1 },
      { name: 'linear', type: 'f64', dimensions: 3 },
      { name: 'nonlinear', type: 'f64', dimensions: 3 },
      { name: 'voltages', type: 'f64', dimensions: 4 },
      { name: 'axes', type: 'f64', dimensions: 4 },
      { name: 'motors', type: 'f64', dimensions: 4 },
      { name: 'courses', type: 'f64', dimensions: 3 },
    ],
  },
  run_nonlinear: {
    takes: [
      { name: 'size', type: 'f64', dimensions: 1 },
      { name: 'c', type: 'f64', dimensions: 1 },
      { name: 'm', type: 'i64', dimensions: 1 },
      { name: 'poles', type: 'c128', dimensions: 1 },
      { name: 'x', type: 'f64', dimensions: 1 },
      { name: 'inner', type: 'f64', dimensions: 1 },
      { name: 't', type: 'f64', dimensions: 1 },
      { name: 'since', type: 'f64' },
      { name: 'rtol', type: 'f64' },
      { name: 'atol', type: 'f64' },
      { name: 'most_steps', type: 'i64' },
      { name: 'rest', type: 'f64', dimensions: 1 },
      { name: 'w', type: 'f64', dimensions: 2 },
      { name: 'raw', type: 'f64', dimensions: 2 },
      { name: 'grid', type: 'f64', dimensions: 1 },
      { name: 'f', type: 'f64', dimensions: 2 },
      { name: 'states', type: 'f64', dimensions: 2 },
      { name: 'voltages', type: 'f64', dimensions: 2 },
      { name: 'axes', type: 'f64', dimensions: 2 },
      { name: 'motors', type: 'f64', dimensions: 2 },
      { name: 'course', type: 'f64', dimensions: 1 },
    ],
  },
  run_digital: {
    takes: [
      { name: 'size', type: 'f64', dimensions: 1 },
      { name: 'y', type: 'f64', dimensions: 1 },
      { name: 't', type: 'f64', dimensions: 1 },
      { name: 'c', type: 'f64', dimensions: 1 },
      { name: 'm', type: 'i64', dimensions: 1 },
      { name: 'd', type: 'f64', dimensions: 1 },
      { name: 'estimator', type: 'f64', dimensions: 2 },
      { name: 'poles', type: 'c128', dimensions: 1 },
      { name: 'x', type: 'f64', dimensions: 1 },
      { name: 'noise', type: 'f64', dimensions: 2 },
      { name: 'disturbed_from', type: 'f64' },
      { name: 'rtol', type: 'f64' },
      { name: 'atol', type: 'f64' },
      { name: 'most_steps', type: 'i64' },
      { name: 'rest', type: 'f64', dimensions: 1 },
      { name: 'w', type: 'f64', dimensions: 2 },
      { name: 'plant', type: 'f64', dimensions: 1 },
      { name: 'free', type: 'i64', dimensions: 1 },
      { name: 'grid', type: 'f64', dimensions: 1 },
      { name: 'course', type: 'f64', dimensions: 2 },
      { name: 'f', type: 'f64', dimensions: 2 },
      { name: 'states', type: 'f64', dimensions: 2 },
      { name: 'voltages', type: 'f64', dimensions: 2 },
      { name: 'axes', type: 'f64', dimensions: 2 },
      { name: 'motors', type: 'f64', dimensions: 2 },
      { name: 'known', type: 'f64', dimensions: 1 },
    ],
  },
  polynomial_matrices: {
    takes: [
      { name: 'A', type: 'f64', dimensions: 2 },
      { name: 'inputs', type: 'f64', dimensions: 2 },
      { name: 'law', type: 'f64', dimensions: 2 },
      { name: 'f', type: 'f64', dimensions: 3 },
    ],
  },
  whole_polynomials: {
    takes: [
      { name: 'A', type: 'f64', dimensions: 2 },
      { name: 'inputs', type: 'f64', dimensions: 2 },
      { name: 'tau', type: 'f64', dimensions: 1 },
      { name: 'controller', type: 'f64', dimensions: 2 },
      { name: 'rows', type: 'f64', dimensions: 4 },
      { name: 'minors', type: 'f64', dimensions: 3 },
      { name: 'f', type: 'f64', dimensions: 3 },
    ],
  },
  is_stable: {
    takes: [
      { name: 'f', type: 'f64', dimensions: 3 },
      { name: 'p', type: 'f64', dimensions: 2 },
    ],
    returns: 'bool',
  },
  margins: {
    takes: [
      { name: 'f', type: 'f64', dimensions: 3 },
      { name: 'g', type: 'f64', dimensions: 3 },
      { name: 'p', type: 'f64', dimensions: 2 },
      { name: 'table', type: 'f64', dimensions: 2 },
    ],
  },
  sensitivity_peaks: {
    takes: [
      { name: 'f', type: 'f64', dimensions: 3 },
      { name: 'poles', type: 'c128', dimensions: 1 },
      { name: 'grid', type: 'f64', dimensions: 2 },
      { name: 'both', type: 'f64', dimensions: 1 },
    ],
  },
  lag_margin: {
    takes: [
      { name: 'f', type: 'f64', dimensions: 3 },
      { name: 'start', type: 'f64' },
      { name: 'p', type: 'f64', dimensions: 2 },
    ],
    returns: 'f64',
  },
  eigenvalues: {
    takes: [
      { name: 'a', type: 'f64', dimensions: 2 },
      { name: 'real', type: 'f64', dimensions: 1 },
      { name: 'imaginary', type: 'f64', dimensions: 1 },
      { name: 'v', type: 'f64', dimensions: 1 },
    ],
    returns: 'bool',
  },
};

/** Checksums of what it was made from, and of kernels.wasm. */
export const SOURCES = 'a809b06916467f4d83e98c8dc43130ebc76fd1e9e536c6bbb398afeeee2f92c7';
export const MODULE = '0131a297c4567287fb88f101d29b21646b3882361e89fb48b0b48971fd4e3b46';

/** What made it. */
export const TOOLS = {
  llvmlite: '0.50.0',
  numba: '0.68.1',
  ziglang: '0.17.1',
};
