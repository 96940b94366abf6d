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
  update: {
    takes: [
      { name: 'size', type: 'f64', dimensions: 1 },
      { name: 'numbers', type: 'f64', dimensions: 1 },
      { name: 'noise', type: 'f64', dimensions: 2 },
      { name: 'outcome', type: 'f64', dimensions: 1 },
      { name: 'A', type: 'f64', dimensions: 2 },
      { name: 'B', type: 'f64', dimensions: 2 },
      { name: 'trim', type: 'f64', dimensions: 1 },
      { name: 'actuators', type: 'f64', dimensions: 1 },
      { name: 'K', type: 'f64', dimensions: 2 },
      { name: 'inverse', type: 'f64', dimensions: 2 },
      { name: 'closed', type: 'c128', dimensions: 1 },
      { name: 'own_poles', type: 'c128', dimensions: 1 },
      { name: 'figures', type: 'f64', dimensions: 1 },
      { name: 'proportional', type: 'f64', dimensions: 2 },
      { name: 'integral', type: 'f64', dimensions: 2 },
      { name: 'feedforward', type: 'f64', dimensions: 2 },
      { name: 'by_reference', type: 'f64', dimensions: 2 },
      { name: 'law', type: 'f64', dimensions: 2 },
      { name: 'whole', type: 'f64', dimensions: 2 },
      { name: 'driven', type: 'f64', dimensions: 2 },
      { name: 'poles', type: 'c128', dimensions: 1 },
      { name: 'connected', type: 'c128', dimensions: 1 },
      { name: 'L', type: 'f64', dimensions: 2 },
      { name: 'estimator_poles', type: 'c128', dimensions: 1 },
      { name: 'margins', type: 'f64', dimensions: 2 },
      { name: 'sensitivity', type: 'f64', dimensions: 1 },
      { name: 't', type: 'f64', dimensions: 1 },
      { name: 'experiments', type: 'f64', dimensions: 2 },
      { name: 'linear', type: 'f64', dimensions: 3 },
      { name: 'nonlinear', type: 'f64', dimensions: 3 },
      { name: 'voltages', type: 'f64', dimensions: 4 },
      { name: 'axes', type: 'f64', dimensions: 4 },
      { name: 'motors', type: 'f64', dimensions: 4 },
      { name: 'courses', type: 'f64', dimensions: 3 },
      { name: 'calm_axes', type: 'f64', dimensions: 3 },
      { name: 'calm_courses', type: 'f64', dimensions: 2 },
      { name: 'w', type: 'f64', dimensions: 2 },
      { name: 'v', type: 'f64', dimensions: 2 },
      { name: 'ladder', type: 'f64', dimensions: 3 },
      { name: 'nodes', type: 'f64', dimensions: 2 },
      { name: 'followed', type: 'f64', dimensions: 2 },
      { name: 'c', type: 'f64', dimensions: 1 },
      { name: 'm', type: 'i64', dimensions: 1 },
      { name: 'plant', type: 'f64', dimensions: 1 },
      { name: 'free', type: 'i64', dimensions: 1 },
      { name: 'raw', type: 'f64', dimensions: 2 },
      { name: 'grid', type: 'f64', dimensions: 1 },
      { name: 'sampled', type: 'f64', dimensions: 2 },
      { name: 'held', type: 'f64', dimensions: 2 },
      { name: 'f', type: 'f64', dimensions: 3 },
      { name: 'opened', type: 'f64', dimensions: 3 },
      { name: 'f_whole', type: 'f64', dimensions: 3 },
      { name: 'inner_whole', type: 'f64', dimensions: 3 },
      { name: 'rows', type: 'f64', dimensions: 4 },
      { name: 'minors', type: 'f64', dimensions: 3 },
      { name: 'p', type: 'f64', dimensions: 2 },
      { name: 'lag', type: 'f64', dimensions: 2 },
      { name: 'frequencies', type: 'f64', dimensions: 2 },
      { name: 'controller', type: 'f64', dimensions: 2 },
      { name: 'more', type: 'f64', dimensions: 1 },
      { name: 'inner', type: 'f64', dimensions: 2 },
      { name: 'settings', type: 'f64', dimensions: 1 },
      { name: 'estimator', type: 'f64', dimensions: 2 },
      { name: 'estimated', type: 'f64', dimensions: 2 },
      { name: 'squares', type: 'f64', dimensions: 3 },
      { name: 'column', type: 'f64', dimensions: 2 },
      { name: 'motor_columns', type: 'f64', dimensions: 3 },
      { name: 'polynomial_law', type: 'f64', dimensions: 2 },
      { name: 'inputs', type: 'f64', dimensions: 2 },
      { name: 'nothing', type: 'f64', dimensions: 1 },
      { name: 'rig', type: 'f64', dimensions: 1 },
      { name: 'gains', type: 'f64', dimensions: 2 },
      { name: 'vectors', type: 'c128', dimensions: 3 },
      { name: 'exponential', type: 'f64', dimensions: 2 },
      { name: 'size_of_exponential', type: 'f64', dimensions: 1 },
      { name: 'start', type: 'f64', dimensions: 1 },
      { name: 'work', type: 'f64', dimensions: 1 },
    ],
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
export const SOURCES = '81b7cb8bad4882b7e0f6cf5b360c09b401543e3ee033c4edf8f62297b5f89a4f';
export const MODULE = '0ebe80aab6e8efc60618db71f8f0a8043ad18473a30218eb71097a55cfd77e7a';

/** What made it. */
export const TOOLS = {
  llvmlite: '0.50.0',
  numba: '0.68.1',
  ziglang: '0.17.1',
};
