/**
 * The binary frame of the live socket: uint32 header length, JSON header, float32 arrays, all little endian. Pure.
 * In the header an array is `{"$f32": [offset, length]}`, counted in elements from the start of the data.
 */

const LITTLE = new Uint8Array(new Uint16Array([1]).buffer)[0] === 1;

/** @param {ArrayBuffer} buffer @param {number} at @param {number} length @returns {Float32Array} */
function floats(buffer, at, length) {
  if (LITTLE && at % 4 === 0) return new Float32Array(buffer, at, length);
  const view = new DataView(buffer);
  return Float32Array.from({ length }, (_, i) => view.getFloat32(at + 4 * i, true));
}

/** @param {ArrayBuffer} buffer @returns {unknown} the reply, its long arrays as views on the buffer */
export function decodeFrame(buffer) {
  const size = new DataView(buffer).getUint32(0, true);
  const data = 4 + size;
  if (data > buffer.byteLength) throw new RangeError('the frame is shorter than its header says');
  const text = new TextDecoder().decode(new Uint8Array(buffer, 4, size));
  const filled = (/** @type {Record<string, unknown>} */ value) => {
    if (Array.isArray(value.$f32)) return floats(buffer, data + 4 * value.$f32[0], value.$f32[1]);
    for (const key of Object.keys(value))
      if (typeof value[key] === 'object' && value[key] !== null)
        value[key] = filled(/** @type {Record<string, unknown>} */ (value[key]));
    return value;
  };
  return filled(JSON.parse(text)); // a reviver would be called for each number: several times slower
}

/** @param {unknown} value @returns {ArrayBuffer} the counterpart, for tests and recordings */
export function encodeFrame(value) {
  /** @type {Float32Array[]} */ const arrays = [];
  let offset = 0;
  const json = JSON.stringify(value, (_key, v) => {
    if (!(v instanceof Float32Array)) return v;
    arrays.push(v);
    const place = { $f32: [offset, v.length] };
    offset += v.length;
    return place;
  });
  const bytes = new TextEncoder().encode(json);
  const size = Math.ceil(bytes.length / 4) * 4;
  const buffer = new ArrayBuffer(4 + size + 4 * offset);
  const view = new DataView(buffer);
  view.setUint32(0, size, true);
  new Uint8Array(buffer, 4, size).fill(0x20).set(bytes);
  let at = 4 + size;
  for (const array of arrays)
    for (const v of array) {
      view.setFloat32(at, v, true);
      at += 4;
    }
  return buffer;
}
