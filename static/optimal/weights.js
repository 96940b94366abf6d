/**
 * The weights of the quadratic methods: Q's and R's diagonals, and the largest values accepted for which they stand
 * (Bryson's rule: weight = 1/(largest accepted value)²). A design holds only what differs from its preset. Pure.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {import('../types.js').Weights} Weights
 * @typedef {'states'|'inputs'|'integrals'} Kind
 * @typedef {{kind: Kind, name: string, path: string, unit: string, scale: number, zero: boolean}} Weight scale: from SI
 *   to the unit of the largest value accepted; zero: whether the weight may be 0
 */
import { DEGREE } from '../text/index.js';
import { bodyOf, QUANTITIES } from '../model/index.js';

/** @param {Kind} kind @param {string} name @param {string} unit @param {number} scale @returns {Weight} */
const weight = (kind, name, unit, scale) => {
  const path = `weights.${kind}.${name}`;
  return { kind, name, path, unit, scale, zero: QUANTITIES[path]?.min === 0 };
};

export const WEIGHTS = [
  weight('states', 'theta', '°', DEGREE),
  weight('states', 'psi', '°', DEGREE),
  weight('states', 'theta_dot', '°/s', DEGREE),
  weight('states', 'psi_dot', '°/s', DEGREE),
  weight('integrals', 'theta', '°·s', DEGREE),
  weight('integrals', 'psi', '°·s', DEGREE),
  weight('inputs', 'V_p', 'V', 1),
  weight('inputs', 'V_y', 'V', 1),
];

/** How far R may be scaled as a whole, either way: as far as the server's locus goes. */
export const DEAREST = 1e4;

/** @typedef {Partial<Record<Kind, Record<string, number>>>} Known */
/** @param {Design|Preset} of @param {Weight} w @returns {number|undefined} */
const standing = (of, { kind, name }) => /** @type {Known|undefined} */ (of.weights)?.[kind]?.[name];

/** @param {Preset} preset @param {Weight} w */
export const proposedWeight = (preset, w) => standing(preset, w) ?? 1;

/** @param {Design} design @param {Preset} preset @param {Weight} w */
export const weightOf = (design, preset, w) => standing(design, w) ?? proposedWeight(preset, w);

/**
 * With one of them changed, or as the preset has it.
 * @param {Design} design @param {Preset} preset @param {Weight} w @param {number} v
 * @returns {Design}
 */
export function withWeight(design, preset, w, v) {
  const { min = 0, max = Infinity } = QUANTITIES[w.path] ?? {};
  const own = Math.min(Math.max(v, min), max);
  const { [w.name]: _old, ...others } = /** @type {Record<string, number>} */ (design.weights?.[w.kind] ?? {});
  const kind = own === proposedWeight(preset, w) ? others : { ...others, [w.name]: own };
  const { [w.kind]: _was, ...rest } = design.weights ?? {};
  const weights = Object.keys(kind).length ? { ...rest, [w.kind]: kind } : rest;
  if (Object.keys(weights).length) return { ...design, weights };
  return withoutWeights(design);
}

/** As the preset has them. @param {Design} design @returns {Design} */
export function withoutWeights(design) {
  if (!design.weights) return design;
  const { weights: _weights, ...others } = design;
  return others;
}

/** Largest value accepted, in the unit shown; NaN where the weight is 0: any. @param {Weight} w @param {number} v */
export const acceptedOf = (w, v) => (v === 0 ? NaN : Number((w.scale / Math.sqrt(v)).toPrecision(12)));

/** The weight that stands for it. @param {Weight} w @param {number} accepted NaN: any */
export const weightFor = (w, accepted) => (Number.isNaN(accepted) ? 0 : (w.scale / accepted) ** 2);

const INPUTS = WEIGHTS.filter((w) => w.kind === 'inputs');

/** R's factors over the preset's. @param {Design} design @param {Preset} preset */
const factors = (design, preset) => INPUTS.map((w) => weightOf(design, preset, w) / proposedWeight(preset, w));

/** The factor ρ on R as a whole, the geometric mean of both. @param {Design} design @param {Preset} preset */
export const rhoOf = (design, preset) => {
  const [p, y] = factors(design, preset);
  return Number(Math.sqrt(p * y).toPrecision(12));
};

/**
 * R scaled as a whole to this factor; how the motors' weights stand to one another stays.
 * @param {Design} design @param {Preset} preset @param {number} rho
 * @returns {Design}
 */
export function withRho(design, preset, rho) {
  const [p, y] = factors(design, preset);
  const tilt = Number(Math.sqrt(p / y).toPrecision(10));
  return INPUTS.reduce(
    (d, w, i) => withWeight(d, preset, w, proposedWeight(preset, w) * rho * (i ? 1 / tilt : tilt)),
    design,
  );
}

/**
 * What the root locus depends on: the same for every ρ.
 * @param {Design} design @param {Preset} preset
 */
export function locusBody(design, preset) {
  const own = withRho(design, preset, 1);
  const { loops: _loops, poles: _poles, observer: _observer, ...body } = bodyOf(own);
  return body;
}

/** Whether the method minimizes a quadratic cost. @param {import('../types.js').State} state */
export const isWeighted = ({ design, methods }) => methods.find((m) => m.name === design?.method)?.weighted === true;
