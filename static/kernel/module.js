/** The kernel in WebAssembly. @returns {Promise<import('./own.js').Kernel>} */
export const loadModule = () => Promise.reject(new Error('This page has no kernel.'));
