/**
 * The whole state as the fragment of an address, and back:
 * `#v1&preset=quanser-aero&p=-5,-4,-3+2j,-3-2j&step.theta=5deg`. Pure.
 *
 * Written is what differs from the preset's proposal. `p`: the four poles, `q`: the observer's. `pi`: k_p, T_i of
 * pitch, k_p, T_i of yaw. `rig`: the name of a rig of one's own; `set.…`: parameters; `limits.…`; `step.…`: references;
 * other fields of the design under their dotted path, an empty value where one is gone. `motion`, `linear`, `marks`,
 * `lag`, `spread`, `map`, `track`, `req.…`: what is shown. `lock`: what is locked. `pin`: a pinned design, its parts
 * parted by `~`. `find`: what the finder is asked for. `plant`: any system; `plant.pin`: another that is kept, by what
 * differs from it. `view`: the view, `at`: the place on the page. A part that cannot be read is named and left out; the
 * rest is restored.
 *
 * The format is part of the page's contract: a change that an old reader would misread takes a new version, and the
 * reader of the old one stays.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {import('./link_values.js').Leaf} Leaf
 * @typedef {{part: string, why: string}} Trouble
 * @typedef {{index: number, name: string, design: Design}} PinnedDesign
 * @typedef {Pick<State, 'view'|'motion'|'showLinear'|'showMarks'|'showLag'|'spread'|'map'|'track'|'requirements'|
 *   'locks'> & Partial<Pick<State, 'plant'|'find'>>} Shown
 * @typedef {{index: number, plant: string}} PinnedPlant
 * @typedef {{design?: Design, shown?: Shown, pins?: PinnedDesign[], plantPins?: PinnedPlant[], place?: string,
 *   trouble: Trouble[]}} Link
 * @typedef {{presets: Preset[], methods: {name: string}[]}} Known
 */
import { objection } from './objections.js';
import {
  at,
  differences,
  escaped,
  leafOf,
  polesLink,
  polesOf,
  polesTrouble,
  setLeaf,
  unescaped,
} from './link_values.js';
import {
  asking,
  designOf,
  isView,
  LOCKS,
  MOST_PLANTS,
  NONE,
  observerPoles,
  plantDifference,
  plantOf,
  STANDARD_VIEW,
  viewOfPlace,
} from '../model/index.js';

const VERSION = 1;
/** Longer links are cut by some mail programs; pins that make it longer are left out. */
export const MOST = 2000;
const MOTIONS = ['both', 'theta', 'psi'];
const OUTER = ['loops.pitch.kp', 'loops.pitch.ti', 'loops.yaw.kp', 'loops.yaw.ti'];
const SHORT = /** @type {const} */ ([
  ['scenario.reference.', 'step.'],
  ['scenario.duration', 'duration'],
  ['parameters.', 'set.'],
]);
/** @param {string} path */
const shortened = (path) =>
  SHORT.reduce((key, [long, short]) => (key.startsWith(long) ? short + key.slice(long.length) : key), path);
/** @param {string} key */
const lengthened = (key) =>
  SHORT.reduce(
    (path, [long, short]) =>
      path.startsWith(short) && (short.endsWith('.') || path === short) ? long + path.slice(short.length) : path,
    key,
  );

/** @param {Design} design @param {Preset[]} presets @returns {[string, string][]} */
function designParts(design, presets) {
  const preset = presets.find((p) => p.name === design.preset);
  const base = preset && designOf(preset);
  /** @type {[string, string][]} */ const parts = [['preset', design.preset]];
  if (!base) return parts;
  if (polesLink(design.poles) !== polesLink(base.poles)) parts.push(['p', polesLink(design.poles)]);
  const { poles: q, ...observer } = design.observer ?? {};
  if (q) parts.push(['q', polesLink(q)]);
  const changed = differences({ ...design, poles: [], observer }, { ...base, poles: [] });
  if (changed.some(([path]) => OUTER.includes(path)))
    parts.push(['pi', [design.loops.pitch.kp, design.loops.pitch.ti, design.loops.yaw.kp, design.loops.yaw.ti].join()]);
  return [
    ...parts,
    ...changed
      .filter(([path]) => path !== 'preset' && !OUTER.includes(path))
      .map(([path, text]) => /** @type {[string, string]} */ ([shortened(path), text])),
  ];
}

/** @param {[string, string][]} parts @param {string} separator */
const joined = (parts, separator) => parts.map(([key, text]) => `${key}=${escaped(text)}`).join(separator);

/**
 * @param {State} state
 * @param {Known} known
 * @param {string|null} [place]
 * @param {number} [most] the length that pins may make it
 * @returns {string} with its #; empty while there is no design
 */
export function linkOf(state, { presets }, place = null, most = MOST) {
  const {
    design,
    view,
    motion,
    showLinear,
    showMarks,
    showLag,
    spread,
    map,
    track,
    requirements,
    locks,
    plant,
    task,
    find,
  } = state;
  if (!design) return '';
  const parts = designParts(design, presets);
  if (motion !== 'both') parts.push(['motion', motion]);
  if (!showLinear) parts.push(['linear', 'false']);
  if (!showMarks) parts.push(['marks', 'false']);
  if (showLag !== null) parts.push(['lag', String(showLag)]);
  if (spread) parts.push(['spread', String(spread)]);
  if (map) parts.push(['map', map]);
  if (track) parts.push(['track', track]);
  for (const [path, text] of differences(requirements, NONE)) parts.push([`req.${path}`, text]);
  if (locks.length && !task) parts.push(['lock', locks.join()]);
  if (find) parts.push(['find', find]);
  if (plant) parts.push(['plant', plant]);
  if (view !== STANDARD_VIEW) parts.push(['view', view]);
  if (place) parts.push(['at', place]);
  const link = `#v${VERSION}&${joined(parts, '&')}`;
  const pinned = state.pins.map(
    (pin) => `&pin=${pin.index}~${escaped(pin.name)}~${joined(designParts(pin.design, presets), '~')}`,
  );
  const plants = state.plantPins.map(
    (pin) => `&plant.pin=${pin.index}~${escaped(plantDifference(pin.plant, plant ?? ''))}`,
  );
  const kept = [pinned, plants].map((pins) => pins.join(''));
  if (view === 'plant') kept.reverse(); // where not all have room, those that are seen come first
  return kept.reduce((all, pins) => (all.length + pins.length <= most ? all + pins : all), link);
}

/**
 * @param {[string, string][]} parts those of a design
 * @param {Known} known
 * @param {Trouble[]} trouble
 * @param {string} [where]
 * @returns {Design}
 */
function readDesign(parts, known, trouble, where = '') {
  const complain = (/** @type {string} */ part, /** @type {string} */ why) => trouble.push({ part: where + part, why });
  const name = parts.find(([key]) => key === 'preset')?.[1];
  const preset = known.presets.find((p) => p.name === name) ?? known.presets[0];
  if (name !== undefined && preset.name !== name) complain('preset', `no rig “${name}” here`);
  const base = designOf(preset);
  const design = designOf(preset);
  const rest = parts.filter(([key]) => key !== 'preset');
  rest.sort(([, a], [, b]) => Number(a !== '') - Number(b !== '')); // what is gone makes room for what comes
  for (const [key, text] of rest) {
    if (key === 'p') {
      const poles = polesOf(text);
      if (poles) design.poles = poles;
      else complain('p', polesTrouble(text));
    } else if (key === 'q') {
      const poles = polesOf(text);
      if (poles) design.observer = { ...design.observer, poles };
      else complain('q', polesTrouble(text));
    } else if (key === 'pi') {
      const [a, b, c, d] = text.split(',').map((v) => (v.trim() === '' ? NaN : Number(v)));
      const right =
        text.split(',').length === 4 && [a, b, c, d].every(Number.isFinite) && a >= 0 && c >= 0 && b > 0 && d > 0;
      if (right)
        Object.assign(design.loops, {
          pitch: { ...design.loops.pitch, kp: a, ti: b },
          yaw: { ...design.loops.yaw, kp: c, ti: d },
        });
      else complain('pi', 'not four PI values');
    } else {
      const path = lengthened(key);
      /** @type {Leaf|undefined} */ let leaf;
      try {
        leaf = leafOf(text);
      } catch {
        complain(key, 'not readable');
        continue;
      }
      const why =
        ['poles', 'preset', 'loops'].includes(path.split('.')[0]) && at(base, path) === undefined
          ? 'unknown here'
          : objection(path, leaf, at(base, path), known, preset);
      if (why) complain(key, why);
      else if (!setLeaf(design, path, leaf)) complain(key, 'unknown here');
    }
  }
  if (design.observer) design.observer = { ...design.observer, poles: observerPoles(design) };
  return design;
}

/** @param {string} text @param {string|RegExp} separator @returns {[string, string][]} */
const split = (text, separator) =>
  text
    .split(separator)
    .filter(Boolean)
    .map((part) => {
      const i = part.indexOf('=');
      return i < 0 ? [unescaped(part), ''] : [unescaped(part.slice(0, i)), unescaped(part.slice(i + 1))];
    });

/**
 * @param {string} raw
 * @param {Known} known
 * @param {Trouble[]} trouble
 * @param {number} order
 * @returns {PinnedDesign[]}
 */
function readPin(raw, known, trouble, order) {
  const [index, name, ...parts] = raw.split('~');
  if (!/^\d{1,3}$/.test(index) || name === undefined) {
    trouble.push({ part: `pin ${order + 1}`, why: 'not readable' });
    return [];
  }
  return [
    {
      index: Number(index),
      name: unescaped(name).slice(0, 60),
      design: readDesign(split(parts.join('~'), '~'), known, trouble, `pin “${unescaped(name)}”, `),
    },
  ];
}

/** @param {string} raw @param {string} base @param {Trouble[]} trouble @returns {PinnedPlant[]} */
function readPlantPin(raw, base, trouble) {
  const [index, difference] = raw.split('~');
  const plant = plantOf(unescaped(difference ?? ''), base);
  if (/^\d$/.test(index) && Number(index) < MOST_PLANTS && plant) return [{ index: Number(index), plant }];
  trouble.push({ part: 'plant.pin', why: 'not readable' });
  return [];
}

/** @param {string} body @param {Known} known @returns {Link} */
function readFirst(body, known) {
  /** @type {Trouble[]} */ const trouble = [];
  /** @type {Shown} */ const shown = {
    view: STANDARD_VIEW,
    motion: 'both',
    showLinear: true,
    showMarks: true,
    showLag: null,
    spread: 0,
    map: null,
    track: null,
    requirements: NONE,
    locks: [],
    find: null,
  };
  /** @type {[string, string][]} */ const design = [];
  /** @type {PinnedDesign[]} */ const pins = [];
  let place;
  /** @type {State['view']|undefined} */ let view;
  const raw = body.split(/&(?:amp;)?/).filter(Boolean);
  for (const text of raw.filter((part) => part.startsWith('pin=')))
    pins.push(...readPin(text.slice(4), known, trouble, pins.length));
  const others = raw.filter((part) => !/^(plant\.)?pin=/.test(part));
  for (const [key, value] of others.flatMap((part) => split(part, '&'))) {
    const refuse = (/** @type {string} */ why) => trouble.push({ part: key, why });
    if (key === 'motion')
      MOTIONS.includes(value)
        ? (shown.motion = /** @type {State['motion']} */ (value))
        : refuse(`neither ${MOTIONS.join(' nor ')}`);
    else if (key === 'linear') shown.showLinear = value !== 'false';
    else if (key === 'marks') shown.showMarks = value !== 'false';
    else if (key === 'lag') shown.showLag = value !== 'false';
    else if (key === 'spread')
      Number(value) >= 0 && Number(value) <= 0.5 ? (shown.spread = Number(value)) : refuse('not between 0 and 0.5');
    else if (key === 'map') /^[\w,-]{1,60}$/.test(value) ? (shown.map = value) : refuse('no map of this page');
    else if (key === 'track') /^[\w.,+-]{1,90}$/.test(value) ? (shown.track = value) : refuse('no track of this page');
    else if (key === 'lock') {
      shown.locks = value.split(',').filter((name) => Object.hasOwn(LOCKS, name));
      for (const name of value.split(','))
        if (!Object.hasOwn(LOCKS, name)) refuse(`“${name}” is nothing that can be locked`);
    } else if (key === 'plant') shown.plant = value;
    else if (key === 'find') shown.find = value;
    else if (key === 'at') place = value;
    else if (key === 'view') isView(value) ? (view = value) : refuse('no view of this page');
    else if (key.startsWith('req.')) {
      const asked = asking(shown.requirements, key.slice(4), /^["[{]/.test(value) ? undefined : leafOf(value));
      if (asked) shown.requirements = asked;
      else refuse('no requirement of this page, or out of its range');
    } else design.push([key, value]);
  }
  shown.view = view ?? viewOfPlace(place) ?? STANDARD_VIEW;
  const plantPins = raw
    .filter((part) => part.startsWith('plant.pin='))
    .flatMap((part) => readPlantPin(part.slice(10), shown.plant ?? '', trouble));
  return { design: readDesign(design, known, trouble), shown, pins, plantPins, place, trouble };
}

/** @type {Record<number, (body: string, known: Known) => Link>} a reader for every version that ever was */
const READERS = { 1: readFirst };

/**
 * What an address holds. Without a design where the fragment is none of ours: then it is a place on the page, or
 * nothing.
 * @param {string} hash @param {Known} known @returns {Link}
 */
export function readLink(hash, known) {
  const text = hash.replace(/^#/, '');
  const whole = /^v\d+%26/i.test(text) ? unescaped(text) : text; // some programs escape every ampersand
  const found = /^v(\d+)(?:&(?:amp;)?|$)/.exec(whole);
  if (!found) return { place: placeIn(hash), trouble: [] };
  const version = Number(found[1]);
  if (READERS[version]) return READERS[version](whole.slice(found[0].length), known);
  return {
    trouble: [
      {
        part: `v${version}`,
        why:
          version > VERSION
            ? `made by a newer heli2dof; this one reads links up to v${VERSION}`
            : 'no such version of links',
      },
    ],
  };
}

/** The place on the page to which an address leads. @param {string} hash @returns {string|undefined} */
export function placeIn(hash) {
  const text = hash.replace(/^#/, '');
  if (/^v\d+(&|%26|$)/i.test(text)) return split(text, '&').find(([key]) => key === 'at')?.[1];
  return text ? unescaped(text) : undefined;
}
