/**
 * Why a part of a link cannot be taken. Pure.
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {import('./link_values.js').Leaf} Leaf
 * @typedef {{methods: {name: string}[]}} Known
 */
import { allowed, QUANTITIES } from '../model/index.js';

const LIMITS = ['V_p', 'V_y', 'theta'];
const MACHINE = ['rotors', 'friction', 'observer', 'weights'];

/**
 * Why a leaf cannot be what the link says, or nothing.
 * @param {string} path
 * @param {Leaf|undefined} leaf
 * @param {unknown} base what the preset proposes there
 * @param {Known} known
 * @param {Preset} preset
 */
export function objection(path, leaf, base, { methods }, preset) {
  const [top, key] = path.split('.');
  if (typeof leaf === 'number' && !Number.isFinite(leaf)) return 'not a finite number';
  const quantity = Object.hasOwn(QUANTITIES, path) ? QUANTITIES[path] : undefined;
  const machine = MACHINE.includes(top);
  const needed = typeof base === 'number' && !machine && quantity?.standard === undefined; // a step, a loop's value
  if (needed && leaf === undefined) return 'empty';
  if (path === 'poles' || (base !== null && typeof base === 'object' && !Array.isArray(base))) return 'no single value';
  if (top === 'scenario') return experimentObjection(path, leaf, quantity);
  if (quantity?.words && (machine || !path.includes('.')))
    return quantity.words.some((word) => word === leaf) ? '' : `neither ${quantity.words.join(' nor ')}`;
  if (path === 'rig') return typeof leaf === 'string' && leaf && leaf.length <= 60 ? '' : 'no name of a rig';
  if (path === 'rotor_poles')
    return Array.isArray(leaf) && leaf.length === 2 && leaf.every(Number.isFinite) ? '' : 'not two real poles';
  if (machine && quantity && leaf !== undefined) return inRange(leaf, quantity) ? '' : 'not a number in its range';
  if (path === 'method')
    return !methods.length || methods.some((m) => m.name === leaf) ? '' : 'no method of this server';
  if (top === 'parameters')
    return !(key in preset.parameters) ? 'no parameter of this rig' : typeof leaf !== 'number' ? 'not a number' : '';
  if (top === 'limits')
    return !LIMITS.includes(key)
      ? 'no limit of this rig'
      : typeof leaf === 'number' || (leaf === null && key === 'theta')
        ? ''
        : 'not a number';
  if (path === 'theta0')
    return typeof leaf === 'number' && Math.abs(leaf) <= allowed('operating_point.theta').max
      ? ''
      : 'not an angle within ±85°';
  if (base !== undefined && base !== null && leaf !== undefined && typeof base !== typeof leaf)
    return `not a ${typeof base}`;
  return base !== undefined ? '' : 'unknown here';
}

/**
 * An experiment's fields must be known and of their kind. Ranges are the server's to judge: its word stands at the
 * field, where it can be put right.
 * @param {string} path
 * @param {Leaf|undefined} leaf
 * @param {import('../model/quantities.js').Quantity|undefined} quantity
 */
function experimentObjection(path, leaf, quantity) {
  if (!quantity) return 'no field of an experiment';
  if (leaf === undefined) return '';
  if (path === 'scenario.duration' && !(typeof leaf === 'number' && leaf > 0 && leaf <= 60))
    return 'not between 0 and 60 s';
  if (quantity.words)
    return quantity.words.some((word) => word === leaf) ? '' : `neither ${quantity.words.join(' nor ')}`;
  const kind = typeof quantity.standard === 'boolean' ? 'boolean' : 'number';
  return typeof leaf === kind ? '' : kind === 'number' ? 'not a number' : 'neither true nor false';
}

/** @param {Leaf} leaf @param {import('../model/quantities.js').Quantity} quantity */
const inRange = (leaf, { min = -Infinity, max = Infinity, standard }) =>
  leaf === null ? standard === undefined : typeof leaf === 'number' && leaf >= min && leaf <= max;
