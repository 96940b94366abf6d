/**
 * Values as they stand in a link: exact, readable, and safe in mails. Pure.
 *
 * A design is compared with its preset's proposal leaf by leaf, so that fields which this module has never heard of are
 * carried too.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {import('../types.js').Poles} Poles
 * @typedef {string|number|boolean|null|unknown[]} Leaf
 */
import { complexIn, DEGREE, say, t } from '../text/index.js';
import { LIMIT } from '../model/index.js';

const NUMBER = String.raw`[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?`;
const IS_NUMBER = new RegExp(`^${NUMBER}$`);
const IS_DEGREES = new RegExp(`^(${NUMBER})deg$`);
const IS_COMPLEX = new RegExp(`^(${NUMBER})?(?:([+-](?:\\d+\\.?\\d*|\\.\\d+)(?:[eE][+-]?\\d+)?)[ij])?$`);
const BARE = /^[A-Za-z][\w/-]*$/;
const WORDS = new Set(['true', 'false', 'null']);
const SEGMENT = /^[A-Za-z]\w*$/;
const ANGLE = /(^|\.)(theta0?|psi)$/;

/**
 * For a part of a link: nothing that separates parts, nor what mail programs take for the end of an address.
 * @param {string} text
 */
export const escaped = (text) =>
  encodeURIComponent(text)
    .replace(/%(?:2C|3A|2F|2B)/g, (code) => decodeURIComponent(code))
    .replace(/[!'()*~]|[.,:]$/g, (c) => `%${c.charCodeAt(0).toString(16).toUpperCase()}`);

/** @param {string} text @returns {string} as it stands where its escapes are broken */
export function unescaped(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** Angles are written in degrees where that is exact. @param {string} path @param {Leaf} value */
export function leafText(path, value) {
  if (typeof value === 'number' && ANGLE.test(path)) {
    const degrees = Number((value * DEGREE).toPrecision(9));
    if (degrees !== 0 && degrees / DEGREE === value) return `${degrees}deg`;
  }
  if (typeof value === 'string') return BARE.test(value) && !WORDS.has(value) ? value : JSON.stringify(value);
  return typeof value === 'object' && value !== null ? JSON.stringify(value) : String(value);
}

/** @param {string} text @returns {Leaf|undefined} undefined: a field that is not there */
export function leafOf(text) {
  if (text === '') return undefined;
  if (IS_NUMBER.test(text)) return Number(text);
  const degrees = IS_DEGREES.exec(text);
  if (degrees) return Number(degrees[1]) / DEGREE;
  if (WORDS.has(text)) return JSON.parse(text);
  return /^["[{]/.test(text) ? JSON.parse(text) : text;
}

/** @param {readonly Complex[]} poles */
export const polesLink = (poles) => poles.map((p) => complexIn(p, { number: String, minus: '-', gap: '' })).join(',');

/** @param {string} part @returns {Complex|null} */
function poleOf(part) {
  const found = part ? IS_COMPLEX.exec(part.trim().replace(' ', '+')) : null; // where a plus was taken for a space
  return found ? { re: Number(found[1] ?? 0), im: Number(found[2] ?? 0) } : null;
}

/** @param {Complex} p */
const isNear = (p) => Math.abs(p.re) <= LIMIT && Math.abs(p.im) <= LIMIT;

/** What is wrong with what are no four poles. @param {string} text */
export function polesTrouble(text) {
  const parts = text.split(',');
  if (parts.length !== 4) return say`four poles are needed, not ${parts.length}`;
  const wrong = parts.find((part) => !poleOf(part));
  if (wrong !== undefined) return wrong.trim() ? say`“${wrong.trim()}” is no pole` : t('a pole is missing');
  const far = parts.find((part) => !isNear(/** @type {Complex} */ (poleOf(part))));
  return far ? say`${far.trim()} lies beyond ±${LIMIT} rad/s` : t('a complex pole needs its conjugate beside it');
}

/** @param {string} text @returns {Poles|undefined} undefined unless two pairs, real or conjugate */
export function polesOf(text) {
  const poles = text.split(',').map((part) => poleOf(part) ?? { re: NaN, im: NaN });
  const near = poles.every(isNear);
  const closed = [0, 2].every((i) =>
    poles[i]?.im === 0
      ? poles[i + 1]?.im === 0
      : poles[i]?.re === poles[i + 1]?.re && poles[i]?.im === -poles[i + 1]?.im,
  );
  return poles.length === 4 && near && closed ? /** @type {Poles} */ (poles) : undefined;
}

/**
 * Every leaf of an object under its dotted path; arrays are leaves.
 * @param {unknown} value
 * @param {string} [path]
 * @returns {[string, Leaf][]}
 */
export function leaves(value, path = '') {
  if (value === undefined) return [];
  if (value === null || typeof value !== 'object' || Array.isArray(value)) return [[path, /** @type {Leaf} */ (value)]];
  return Object.entries(value).flatMap(([key, inner]) => leaves(inner, path ? `${path}.${key}` : key));
}

/** @param {Leaf|undefined} a @param {Leaf|undefined} b */
const same = (a, b) => Object.is(a, b) || (typeof a === 'object' && JSON.stringify(a) === JSON.stringify(b));

/**
 * What must be written so that `base` becomes `value`: leaves that differ, and empty ones that are gone.
 * @param {unknown} value
 * @param {unknown} base
 * @returns {[string, string][]} path, text
 */
export function differences(value, base) {
  const [own, old] = [new Map(leaves(value)), new Map(leaves(base))];
  const gone = [...old.keys()]
    .filter((path) => !own.has(path))
    .map((path) => /** @type {[string, string]} */ ([path, '']));
  return [
    ...gone,
    ...[...own]
      .filter(([path, leaf]) => !same(leaf, old.get(path)))
      .map(([path, leaf]) => /** @type {[string, string]} */ ([path, leafText(path, leaf)])),
  ];
}

/**
 * Sets a leaf, or takes it away with the parents that it leaves empty.
 * @param {object} target changed in place
 * @param {string} path
 * @param {Leaf|undefined} leaf
 * @returns {boolean} whether the path can be one
 */
export function setLeaf(target, path, leaf) {
  const own = /** @type {Record<string, unknown>} */ (target);
  const [key, ...rest] = path.split('.');
  if (!SEGMENT.test(key)) return false;
  const inner = Object.hasOwn(own, key) ? own[key] : undefined;
  if (!rest.length) {
    if (leaf === undefined) delete own[key];
    else Object.defineProperty(own, key, { value: leaf, writable: true, enumerable: true, configurable: true });
    return true;
  }
  if (leaf === undefined && (inner === undefined || inner === null || typeof inner !== 'object'))
    return rest.every((part) => SEGMENT.test(part));
  const nested = inner !== null && typeof inner === 'object' && !Array.isArray(inner) ? inner : {};
  if (!setLeaf(nested, rest.join('.'), leaf)) return false;
  if (leaf === undefined && !Object.keys(nested).length) delete own[key];
  else Object.defineProperty(own, key, { value: nested, writable: true, enumerable: true, configurable: true });
  return true;
}

/** What stands there. @param {unknown} object @param {string} path @returns {unknown} */
export const at = (object, path) =>
  path
    .split('.')
    .reduce(
      (/** @type {unknown} */ inner, key) =>
        inner !== null && typeof inner === 'object' && Object.hasOwn(inner, key)
          ? /** @type {Record<string, unknown>} */ (inner)[key]
          : undefined,
      object,
    );
