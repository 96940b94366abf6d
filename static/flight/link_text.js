/**
 * A flight's log as text for a link, and back: deflated, in the letters that an address may hold. Pure but for the
 * browser's own compression.
 */

/** The place on the page to which a flight's link leads begins so. */
export const PLACE = 'flight-';
/** Longest text in a link: browsers and mail programs take it, servers never see it. */
export const MOST_IN_LINK = 8000;
/** Largest log that is unpacked, bytes: what a few letters make large is none of ours. */
const MOST_BYTES = 2_000_000;
const FORMAT = 'deflate-raw';

/** Whether this browser can. */
export const canPack = () => typeof CompressionStream === 'function' && typeof DecompressionStream === 'function';

/** @param {Uint8Array} bytes */
function letters(bytes) {
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

/** @param {object} log @returns {Promise<string|null>} null: it is too long for a link, or cannot be packed here */
export async function packed(log) {
  if (!canPack()) return null;
  const stream = new Blob([JSON.stringify(log)]).stream().pipeThrough(new CompressionStream(FORMAT));
  const text = letters(new Uint8Array(await new Response(stream).arrayBuffer()));
  return text.length <= MOST_IN_LINK ? text : null;
}

/**
 * @param {string} text
 * @returns {Promise<string>} the log's JSON
 * @throws {Error} where it is none, or would be too large
 */
export async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream(FORMAT)).getReader();
  const decoder = new TextDecoder();
  let json = '';
  let size = 0;
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    size += part.value.length;
    if (size > MOST_BYTES) {
      await reader.cancel();
      throw new RangeError('this is larger than a flight');
    }
    json += decoder.decode(part.value, { stream: true });
  }
  return json + decoder.decode();
}
