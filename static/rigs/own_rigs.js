/**
 * Rigs of one's own: parameters, limits, rotors, friction and operating point under a name, as they are kept, as they
 * stand in a file, and as a design. Pure.
 *
 * A rig says all its values, in the contract's names and SI units, and the preset from which it stems: a design on it
 * names that preset and what differs from it.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {import('../types.js').OwnRig} OwnRig
 */
import { say, t } from '../text/index.js';
import { designOf } from '../model/index.js';

export const LONGEST_NAME = 60;
const KIND = 'heli2dof-rig';
const VERSION = 1;
const VALUES = /** @type {const} */ (['parameters', 'limits', 'rotors', 'friction']);
const PAIRS = /** @type {const} */ (['rotors', 'friction']);
const AXES = /** @type {const} */ (['pitch', 'yaw']);

/** @param {unknown} v @returns {v is Record<string, unknown>} */
const isObject = (v) => typeof v === 'object' && v !== null && !Array.isArray(v);

/** What a name is kept as: without blanks around it, nor twice within it. @param {string} name */
export const tidyName = (name) => name.replace(/\s+/g, ' ').trim().slice(0, LONGEST_NAME).trim();

/** @param {object} base @param {object} own */
const over = (base, own) =>
  Object.fromEntries(Object.entries({ ...base, ...own }).filter(([, v]) => v !== undefined && v !== null));

/**
 * The rig of a design.
 * @param {Design} design
 * @param {Preset} preset its own
 * @param {string} name
 * @returns {OwnRig}
 */
export function rigOf(design, preset, name) {
  const pair = (/** @type {'rotors'|'friction'} */ key) =>
    Object.fromEntries(AXES.map((axis) => [axis, over(preset[key][axis], design[key][axis] ?? {})]));
  const travel = design.limits.theta === undefined ? preset.limits.theta : design.limits.theta;
  return /** @type {OwnRig} */ ({
    name: tidyName(name),
    preset: preset.name,
    parameters: over(preset.parameters, design.parameters),
    limits: { ...over(preset.limits, design.limits), theta: travel ?? null }, // null: it is free
    rotors: pair('rotors'),
    friction: pair('friction'),
    operating_point: { theta: design.theta0 },
  });
}

/** What differs; null is none. @param {object} own @param {object} base */
const differing = (own, base) => {
  const known = /** @type {Record<string, unknown>} */ (base);
  return Object.fromEntries(Object.entries(own).filter(([key, v]) => (v ?? null) !== (known[key] ?? null)));
};

/**
 * A design on a rig.
 * @param {OwnRig} rig
 * @param {Preset} preset from which it stems
 * @param {Design} [design] whose poles, loops and experiment stay; by default the preset's
 * @returns {Design}
 */
export function withRig(rig, preset, design = designOf(preset)) {
  const pair = (/** @type {'rotors'|'friction'} */ key) =>
    Object.fromEntries(
      AXES.map((axis) => [axis, differing(rig[key][axis] ?? {}, preset[key][axis])]).filter(
        ([, own]) => Object.keys(own).length,
      ),
    );
  return /** @type {Design} */ ({
    ...design,
    preset: preset.name,
    rig: rig.name,
    parameters: differing(rig.parameters, preset.parameters),
    limits: differing({ theta: null, ...rig.limits }, preset.limits),
    rotors: pair('rotors'),
    friction: pair('friction'),
    theta0: rig.operating_point.theta,
  });
}

/** In one order of keys. @param {unknown} v @returns {unknown} */
const ordered = (v) =>
  isObject(v)
    ? Object.fromEntries(
        Object.keys(v)
          .sort()
          .map((key) => [key, ordered(v[key])]),
      )
    : v;

/** Whether two rigs are the same, but for their names. @param {OwnRig} a @param {OwnRig} b */
export const sameRig = (a, b) =>
  JSON.stringify(ordered({ ...a, name: '' })) === JSON.stringify(ordered({ ...b, name: '' }));

/** @param {OwnRig} rig */
export const fileOf = (rig) => `${JSON.stringify({ kind: KIND, version: VERSION, ...rig }, null, 2)}\n`;

/** @param {OwnRig} rig */
export const fileName = ({ name }) =>
  `${
    name
      .normalize('NFKD')
      .replace(/[^\w-]+/g, '-')
      .replace(/^-+|-+$/g, '')
      .toLowerCase() || 'own'
  }.heli2dof-rig.json`;

/**
 * What a file holds, as far as it is told by its shape; its values are the server's to judge.
 * @param {string} text
 * @returns {{rig: OwnRig, body: Record<string, unknown>, refused?: undefined}|{refused: string}} body: what the server
 *   is to judge, with whatever else the file says
 */
export function readFile(text) {
  let read;
  try {
    read = JSON.parse(text.replace(/^\uFEFF/, ''));
  } catch {
    return { refused: t('This is no JSON file. Open one that was saved here.') };
  }
  if (!isObject(read) || read.kind !== KIND)
    return { refused: t('This file is no rig. Open one that was saved here.') };
  if (read.version !== VERSION)
    return { refused: say`This file has version ${String(read.version)}; this page reads version ${VERSION}.` };
  const name = typeof read.name === 'string' ? tidyName(read.name) : '';
  if (!name) return { refused: t('name: the file gives the rig none.') };
  if (typeof read.preset !== 'string') return { refused: t('preset: the file does not say from which the rig stems.') };
  for (const key of VALUES) if (!isObject(read[key])) return { refused: say`${key}: not an object with values.` };
  for (const key of PAIRS)
    for (const axis of AXES)
      if (!isObject(/** @type {Record<string, unknown>} */ (read[key])[axis]))
        return { refused: say`${`${key}.${axis}`}: not an object with values.` };
  if (!isObject(read.operating_point) || typeof read.operating_point.theta !== 'number')
    return { refused: t('operating_point.theta: not a number.') };
  const { kind: _kind, version: _version, name: _name, ...body } = read;
  return { rig: /** @type {OwnRig} */ ({ ...body, name }), body };
}

/**
 * What a browser keeps.
 * @param {string|null} text
 * @returns {OwnRig[]|null} null where it cannot be read
 */
export function readKept(text) {
  if (!text) return [];
  try {
    const { version, rigs } = JSON.parse(text);
    if (version !== VERSION || !Array.isArray(rigs)) return null;
    const read = rigs.map((rig) => readFile(JSON.stringify({ kind: KIND, version: VERSION, ...rig })));
    return read.flatMap((own) => (own.refused === undefined ? [own.rig] : []));
  } catch {
    return null;
  }
}

/** @param {OwnRig[]} rigs */
export const keptText = (rigs) => JSON.stringify({ version: VERSION, rigs });

/** With one more, in the place of one of that name. @param {OwnRig[]} rigs @param {OwnRig} rig */
export function withOne(rigs, rig) {
  const at = rigs.findIndex((own) => own.name === rig.name);
  return at < 0 ? [...rigs, rig] : rigs.with(at, rig);
}

/** A name that none has yet. @param {OwnRig[]} rigs @param {string} wish */
export function freeName(rigs, wish) {
  const taken = new Set(rigs.map((own) => own.name));
  const name = tidyName(wish);
  for (let i = 1; ; i++) {
    const tried = i === 1 ? name : `${name.slice(0, LONGEST_NAME - 5)} ${i}`;
    if (!taken.has(tried)) return tried;
  }
}
