import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { Block, KernelError, Kernels, MODULE, compiled, instantiated } from '../../static/kernel/module.js';
import { SIGNATURES } from '../../static/kernel/table.js';

const bytes = readFileSync(MODULE);
const module = await compiled(bytes);

/** Eigenvalues of a matrix of n rows, by the kernel. */
function eigenvalues(kernels, n, matrix) {
  const [real, imaginary, v] = Array.from({ length: 3 }, () => kernels.array('f64', n));
  const a = kernels.array('f64', n, n);
  const found = kernels.bound('eigenvalues', { a, real, imaginary, v });
  a.floats.set(matrix);
  assert.equal(found(), true);
  return Array.from(real.floats, (re, k) => [re, imaginary.floats[k]]).sort((x, y) => x[0] - y[0] || x[1] - y[1]);
}

test('a kernel is called with arrays', async () => {
  const kernels = await instantiated(module);
  const oscillator = [0, 1, -4, 0];
  const diagonal = [3, 0, 0, 0, -1, 0, 0, 0, 2];
  assert.deepEqual(eigenvalues(kernels, 2, oscillator), [
    [0, -2],
    [0, 2],
  ]);
  assert.deepEqual(
    eigenvalues(kernels, 3, diagonal).map(([re]) => re),
    [-1, 2, 3],
  );
});

test('what is not finite is told, and stops nothing', async () => {
  const kernels = await instantiated(module);
  const [real, imaginary, v] = Array.from({ length: 3 }, () => kernels.array('f64', 2));
  const a = kernels.array('f64', 2, 2);
  const found = kernels.bound('eigenvalues', { a, real, imaginary, v });
  a.floats.set([1, NaN, 0, 1]);
  assert.equal(found(), false);
  a.floats.set([1, 0, 0, 1]);
  assert.equal(found(), true);
});

test('the memory grows, and views follow it', async () => {
  const kernels = await instantiated(module);
  const first = kernels.array('f64', 3);
  first.floats.set([1, 2, 3]);
  const { buffer } = kernels.memory;
  const large = kernels.array('f64', 1000, 1000);
  assert.notEqual(kernels.memory.buffer, buffer);
  assert.deepEqual([...first.floats], [1, 2, 3]);
  assert.equal(large.floats.length, 1_000_000);
  assert.ok(large.floats.every((x) => x === 0));
  assert.equal(first.floats, first.floats, 'a view is made once');
});

test('memory that is given back is used again, and zero', async () => {
  const kernels = await instantiated(module);
  const mark = kernels.mark;
  const before = kernels.array('f64', 100);
  before.floats.fill(7);
  kernels.release(mark);
  const after = kernels.array('i64', 100);
  assert.equal(after.at, before.at);
  assert.ok(after.integers.every((x) => x === 0n));
  for (let k = 0; k < 1000; k++) {
    kernels.release(mark);
    kernels.array('c128', 1000);
  }
  assert.ok(kernels.memory.buffer.byteLength < 2e6);
});

test('arrays do not overlap and are aligned', async () => {
  const kernels = await instantiated(module);
  const blocks = [[3], [1, 1], [0], [5, 7]].map((shape) => kernels.array('f64', ...shape));
  blocks.forEach((block, k) => block.floats.fill(k + 1));
  blocks.forEach((block, k) => assert.ok(block.floats.every((x) => x === k + 1) && block.at % 16 === 0));
  assert.deepEqual(
    blocks.map(({ items }) => items),
    [3, 1, 0, 35],
  );
});

test('an array is told as Numba has it: owner, items, bytes, address, shape, strides', async () => {
  const kernels = await instantiated(module);
  const block = kernels.array('c128', 2, 3, 4);
  assert.deepEqual(block.flat(), [0, 0, 24n, 16n, block.at, 2n, 3n, 4n, 192n, 64n, 16n]);
});

test('what a kernel cannot take is refused before it could write anywhere', async () => {
  const kernels = await instantiated(module);
  const [a, f, whole] = [kernels.array('f64', 4, 4), kernels.array('f64', 2, 2, 20), kernels.array('i64', 4, 4)];
  const v = kernels.array('f64', 4);
  for (const wrong of [f, whole, 3, undefined])
    assert.throws(() => kernels.bound('eigenvalues', { a: wrong, real: v, imaginary: v, v }), TypeError);
  assert.throws(() => kernels.bound('lag_margin', { f, start: a, p: a }), TypeError);
  assert.throws(() => kernels.bound('nothing', {}), TypeError);
});

test('a kernel that gives up is an error', () => {
  const memory = new WebAssembly.Memory({ initial: 1 });
  const given = { memory, __heap_base: { value: 1024 }, eigenvalues: () => 2 };
  const kernels = new Kernels(/** @type {any} */ (given));
  const [a, v] = [kernels.array('f64', 2, 2), kernels.array('f64', 2)];
  assert.throws(() => kernels.bound('eigenvalues', { a, real: v, imaginary: v, v })(), KernelError);
});

test('the module comes as a response of either media type', async () => {
  for (const type of ['application/wasm', 'application/octet-stream']) {
    const response = new Response(bytes, { headers: { 'Content-Type': type } });
    assert.ok((await compiled(response)) instanceof WebAssembly.Module, type);
  }
  await assert.rejects(compiled(new Response('no', { status: 404 })), KernelError);
  await assert.rejects(compiled(new Response('not a module')), WebAssembly.CompileError);
});

test('it imports functions of numbers alone, and exports what the table tells', () => {
  for (const { module: from, kind } of WebAssembly.Module.imports(module))
    assert.deepEqual([from, kind], ['env', 'function']);
  const functions = WebAssembly.Module.exports(module).filter(({ kind }) => kind === 'function');
  assert.deepEqual(functions.map(({ name }) => name).sort(), Object.keys(SIGNATURES).sort());
});

test('instances share nothing', async () => {
  const [one, other] = [await instantiated(module), await instantiated(module)];
  const [mine, theirs] = [one.array('f64', 4), other.array('f64', 4)];
  mine.floats.fill(1);
  assert.ok(theirs.floats.every((x) => x === 0) && mine instanceof Block);
});
