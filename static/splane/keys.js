/**
 * What a press of a key does in an s-plane, at a pole that has the focus: arrows and page keys move it, Shift finely;
 * Ctrl and an arrow move the view, plus, minus and F zoom. Pure.
 * @typedef {import('./math.js').View} View
 * @typedef {{by: import('../types.js').Complex}|{view: View}|{fit: true}} Act
 */
import { keyStep, zoom } from './math.js';

const PAN = 40; // px per press
const CLOSER = 1.4; // per press
/** @type {Record<string, [number, number]>} direction in the plane, in keyboard steps */
const WAYS = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
  PageUp: [10, 0],
  PageDown: [-10, 0],
};

/**
 * @param {Pick<KeyboardEvent, 'key'|'altKey'|'ctrlKey'|'metaKey'|'shiftKey'>} e @param {View} v
 * @returns {Act|null} null where the plane has no use for it
 */
export function actOf({ key, altKey, ctrlKey, metaKey, shiftKey }, v) {
  if (altKey || (metaKey && !ctrlKey)) return null;
  const way = Object.hasOwn(WAYS, key) ? WAYS[key] : null;
  if (way && ctrlKey) {
    const [x, y] = way;
    return { view: { ...v, cx: v.cx + (Math.sign(x) * PAN) / v.scale, cy: v.cy + (y * PAN) / v.scale } };
  }
  if (ctrlKey) return null;
  if (way) {
    const step = keyStep(v) * (shiftKey ? 0.1 : 1);
    return { by: { re: way[0] * step, im: way[1] * step } };
  }
  if (key === '+' || key === '-')
    return { view: zoom(v, key === '+' ? CLOSER : 1 / CLOSER, v.width / 2, v.height / 2) };
  return key.toLowerCase() === 'f' ? { fit: true } : null;
}
