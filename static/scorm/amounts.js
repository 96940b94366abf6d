/**
 * Values with a unit, as people write them: 5 %, 0,8 s, −3.2·10^2. As heli2dof_core/labs/amounts.py reads them. Pure.
 */

const NUMBER = String.raw`[-+−–]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:\s?(?:[eE]|[·x×*]\s?10\^?)\s?[-+−–]?\d{1,3})?`;
const IS_NUMBER = new RegExp(`^\\s*${NUMBER}\\s*$`);
const IS_AMOUNT = new RegExp(`^\\s*(${NUMBER})\\s*(\\S.{0,30})?$`);
const LONGEST = 80;

/** @param {string} text @returns {number|null} null where it is none, decimal commas and true minus signs are */
export function plainNumber(text) {
  if (!IS_NUMBER.test(text)) return null;
  const plain = text
    .trim()
    .replace(/\s?[·x×*]\s?10\^?\s?/, 'e')
    .replace(/[−–]/g, '-')
    .replaceAll(',', '.')
    .replaceAll(' ', '');
  const value = Number(plain);
  return Number.isFinite(value) ? value : null;
}

/** @param {string} text @returns {{value: number, unit: string}|null} null where it does not begin with a number */
export function splitAmount(text) {
  const found = text.length > LONGEST ? null : IS_AMOUNT.exec(text);
  const value = found && plainNumber(found[1]);
  return found && value !== null ? { value, unit: (found[2] ?? '').trim() } : null;
}

/** A unit in one of its notations, without what differs in typing. @param {string} unit */
export const typedUnit = (unit) =>
  unit
    .replaceAll('*', '·')
    .replaceAll('⋅', '·')
    .replace(/[º˚]/g, '°')
    .replaceAll('^2', '²')
    .replace(/(?<=[sm])2/g, '²')
    .replace(/\s+/g, unit.startsWith('°') ? '' : '·')
    .replace(/^deg(ree)?\//, '°/');
