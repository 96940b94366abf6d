/**
 * The hot loops of heli2dof_core/kernels in WebAssembly (kernels.wasm, made by `make wasm`), called with arrays. Pure.
 *
 *     const kernels = await instantiated(await compiled(await fetch(MODULE)));
 *     const a = kernels.array('f64', 4, 4);
 *     const solve = kernels.bound('eigenvalues', { a, real, imaginary, v });
 *     a.floats.set(matrix);
 *     solve();
 *
 * A function takes arrays as Numba has it: each as its address, shape and strides, one argument after the other. That
 * list is made once, when arrays are bound, so that a call costs nothing but itself.
 */
import { SIGNATURES } from './table.js';

/** @typedef {import('./table.js').Scalar} Scalar @typedef {import('./table.js').Parameter} Parameter */
/** @typedef {Record<string, Block | number>} Values  of a function's parameters, by their names */
/** @typedef {(...flat: (number | bigint)[]) => number} Exported */

/** Where the module is. */
export const MODULE = new URL('./kernels.wasm', import.meta.url);

/** Bytes of an element. */
const BYTES = { f64: 8, i64: 8, c128: 16, bool: 1 };
const ALIGNED = 16;
const PAGE = 65536;

/** C's functions where JavaScript's have other names, or other words on 1 and on infinite powers. */
const { atan2, cos, exp, hypot, log, log2, sin, tan } = Math;
const env = {
  ...{ atan2, cos, exp, hypot, log, log2, sin, tan },
  exp2: (/** @type {number} */ x) => 2 ** x,
  fmod: (/** @type {number} */ x, /** @type {number} */ y) => x % y,
  pow: (/** @type {number} */ x, /** @type {number} */ y) =>
    x === 1 || (x === -1 && (y === Infinity || y === -Infinity)) ? 1 : x ** y,
};

/** A kernel gave up; its status is Numba's. */
export class KernelError extends Error {}

/**
 * Compiles while the file still arrives, where its media type allows that.
 * @param {Response | BufferSource} source @returns {Promise<WebAssembly.Module>} which workers can be sent, too
 */
export async function compiled(source) {
  if (!(source instanceof Response)) return WebAssembly.compile(source);
  if (!source.ok) throw new KernelError(`kernels.wasm: ${source.status}`);
  try {
    return await WebAssembly.compileStreaming(source.clone());
  } catch {
    return WebAssembly.compile(await source.arrayBuffer());
  }
}

/** @param {WebAssembly.Module} module @returns {Promise<Kernels>} with a memory of their own */
export async function instantiated(module) {
  return new Kernels((await WebAssembly.instantiate(module, { env })).exports);
}

/** Numbers in the module's memory, row by row. */
export class Block {
  /** @type {Float64Array | undefined} */ #floats;
  /** @type {BigInt64Array | undefined} */ #integers;

  /** @param {WebAssembly.Memory} memory @param {number} at @param {Scalar} type @param {readonly number[]} shape */
  constructor(memory, at, type, shape) {
    this.memory = memory;
    this.at = at;
    this.type = type;
    this.shape = shape;
    this.items = shape.reduce((product, n) => product * n, 1);
  }

  /** Its numbers, complex ones as pairs. To be asked for anew once other arrays were made: memory may have moved. */
  get floats() {
    const { buffer } = this.memory;
    if (this.#floats?.buffer !== buffer)
      this.#floats = new Float64Array(buffer, this.at, (this.items * BYTES[this.type]) / 8);
    return this.#floats;
  }

  /** The same of integers. */
  get integers() {
    const { buffer } = this.memory;
    if (this.#integers?.buffer !== buffer) this.#integers = new BigInt64Array(buffer, this.at, this.items);
    return this.#integers;
  }

  /** As Numba has it: no owner, items, bytes of one, address, shape, strides. @returns {(number | bigint)[]} */
  flat() {
    const size = BYTES[this.type];
    const strides = this.shape.map((_, k) => this.shape.slice(k + 1).reduce((bytes, n) => bytes * n, size));
    return [0, 0, BigInt(this.items), BigInt(size), this.at, ...[...this.shape, ...strides].map(BigInt)];
  }
}

/** An instance of the module: its functions, and the memory that they share. */
export class Kernels {
  #exports;
  #free;
  #returned;
  #error;

  /** @param {WebAssembly.Exports} exports */
  constructor(exports) {
    this.#exports = /** @type {Record<string, Exported>} */ (/** @type {unknown} */ (exports));
    this.memory = /** @type {WebAssembly.Memory} */ (exports.memory);
    this.#free = /** @type {WebAssembly.Global} */ (exports.__heap_base).value;
    this.#returned = this.#reserved(ALIGNED);
    this.#error = this.#reserved(ALIGNED);
  }

  /**
   * @param {'f64' | 'i64' | 'c128'} type @param {number[]} shape
   * @returns {Block} zeros
   */
  array(type, ...shape) {
    const block = new Block(
      this.memory,
      this.#reserved(shape.reduce((bytes, n) => bytes * n, BYTES[type])),
      type,
      shape,
    );
    new Uint8Array(this.memory.buffer, block.at, block.items * BYTES[type]).fill(0);
    return block;
  }

  /** What `release` needs to give back all arrays that are made from now on. */
  get mark() {
    return this.#free;
  }

  /** @param {number} mark  arrays made since then must not be used again, nor what they were bound to */
  release(mark) {
    this.#free = mark;
  }

  /**
   * A kernel with its arguments. Numbers are those of now, arrays those that they hold when it is called.
   * @param {string} name  in table.js @param {Values} values
   * @returns {() => number | boolean | undefined} what the kernel returns
   */
  bound(name, values) {
    const { takes, returns } = SIGNATURES[name];
    const run = this.#exports[name];
    const flat = [this.#returned, this.#error, ...takes.flatMap((parameter) => flattened(parameter, values))];
    return () => {
      const status = run(...flat);
      if (status !== 0) throw new KernelError(`${name}: status ${status}`);
      return returns && this.#read(returns);
    };
  }

  /** @param {Scalar} type */
  #read(type) {
    const view = new DataView(this.memory.buffer, this.#returned);
    if (type === 'bool') return view.getUint8(0) !== 0;
    return type === 'i64' ? Number(view.getBigInt64(0, true)) : view.getFloat64(0, true);
  }

  /** @param {number} bytes */
  #reserved(bytes) {
    const at = Math.ceil(this.#free / ALIGNED) * ALIGNED;
    const missing = at + bytes - this.memory.buffer.byteLength;
    if (missing > 0) this.memory.grow(Math.ceil(missing / PAGE));
    this.#free = at + bytes;
    return at;
  }
}

/** @param {Parameter} parameter @param {Values} values @returns {(number | bigint)[]} */
function flattened({ name, type, dimensions }, values) {
  const value = values[name];
  if (dimensions === undefined) {
    if (typeof value !== 'number') throw new TypeError(`${name} is a number`);
    return [type === 'i64' ? BigInt(value) : value];
  }
  if (!(value instanceof Block) || value.type !== type || value.shape.length !== dimensions)
    throw new TypeError(`${name} is an array of ${type} with ${dimensions} dimensions`);
  return value.flat();
}
