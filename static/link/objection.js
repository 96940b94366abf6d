/**
 * What a link may say of a design. Pure.
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {import('./link_values.js').Leaf} Leaf
 */
import { allowed, QUANTITIES } from '../model/index.js';

const LIMITS = ['V_p', 'V_y', 'theta'];
const MACHINE = ['rotors', 'friction', 'observer', 'weights'];

/**
 * Why a leaf cannot be what the link says, or nothing.
 * @param {string} path
 * @param {Leaf|undefined} leaf
 * @param {unknown} base what the preset proposes there
 * @param {{methods: {name: string}[]}} known
 * @param {Preset} preset
 */
export function objection(path, leaf, base, { methods }, preset) {
  const [top, key] = path.split('.');
  if (typeof leaf === 'number' && !Number.isFinite(leaf)) return 'not a finite number';
  const quantity = QUANTITIES[path];
  const machine = MACHINE.includes(top);
  if (quantity?.words && (machine || !path.includes('.')))
    // the scenario's are the server's to judge
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
  if (path === 'scenario.duration')
    return typeof leaf === 'number' && leaf > 0 && leaf <= 60 ? '' : 'not between 0 and 60 s';
  if (base !== undefined && base !== null && leaf !== undefined && leaf !== null && typeof base !== typeof leaf)
    return `not a ${typeof base}`;
  return base !== undefined || top === 'scenario' ? '' : 'unknown here';
}

/** @param {Leaf} leaf @param {import('../model/quantities.js').Quantity} quantity */
const inRange = (leaf, { min = -Infinity, max = Infinity }) =>
  leaf === null || (typeof leaf === 'number' && leaf >= min && leaf <= max);
