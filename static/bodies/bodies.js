/**
 * Designs as the server takes and keeps them, and back: a request's body (docs/api.md), in which what is absent is as
 * the preset or the standard experiment has it, and the page's Design. Pure.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {import('../types.js').Scenario} Scenario
 * @typedef {import('../types.js').Asked<import('../contract.js').DesignRequest>} DesignRequest
 * @typedef {DesignRequest & {scenario?: import('../contract.js').ScenarioChanges}} Body
 */
import {
  bodyOf,
  designOf,
  DIGITAL,
  fromWire,
  observerPoles,
  OUTER,
  ROTORS,
  scenarioOf,
  STANDARD,
  STRUCTURE,
} from '../model/index.js';

/** Of a body, one value each. */
const CHOICES = /** @type {const} */ ([...STRUCTURE, ...OUTER, ...ROTORS]);

/** @param {unknown} value @returns {value is Record<string, unknown>} */
const isPlain = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);

/**
 * One body over another, leaf by leaf; lists and a reference are replaced as a whole, and null takes away what was
 * there.
 * @template {object} T
 * @param {T} under @param {object|null} [over]
 * @returns {T}
 */
export function merged(under, over) {
  const out = /** @type {Record<string, unknown>} */ ({ ...under });
  for (const [key, value] of Object.entries(over ?? {})) {
    const own = out[key];
    if (value === null) delete out[key];
    else out[key] = isPlain(own) && isPlain(value) && key !== 'reference' ? merged(own, value) : value;
  }
  return /** @type {T} */ (out);
}

/**
 * What is said: neither null nor what is so anyway.
 * @param {object|null|undefined} values @param {Record<string, unknown>} [standard]
 */
const said = (values, standard = {}) =>
  Object.fromEntries(
    Object.entries(values ?? {}).filter(([name, v]) => v !== null && v !== undefined && v !== standard[name]),
  );

const values = (/** @type {unknown} */ of) => /** @type {Record<string, unknown>} */ (of ?? {});

/** What differs from the preset's, of pitch and of yaw. @param {object|null|undefined} own @param {unknown} preset */
const byAxis = (own, preset) =>
  Object.fromEntries(
    Object.entries(own ?? {})
      .map(([axis, part]) => [axis, said(part, values(values(preset)[axis]))])
      .filter(([, part]) => Object.keys(part).length),
  );

/** @param {object|null|undefined} values @param {string} name @param {Record<string, unknown>} [standard] */
const part = (values, name, standard) =>
  values && Object.keys(said(values, standard)).length ? { [name]: said(values, standard) } : {};

/**
 * @param {import('../contract.js').ScenarioChanges|undefined} body @param {Scenario} base @param {number} theta0
 * @returns {Scenario}
 */
function scenarioFrom(body, base, theta0) {
  if (!body) return base;
  const { reference, duration, initial, noise, digital, disturbance, samples: _s, model: _m, ...options } = body;
  return /** @type {Scenario} */ ({
    .../** @type {object} */ (said(options, { ...STANDARD, measured: 'states' })),
    // an axis of which a reference says nothing is not stepped
    reference: reference ? { theta: theta0, psi: 0, ...said(reference) } : base.reference,
    duration: duration ?? base.duration,
    ...part(initial, 'initial', { theta_dot: 0, psi_dot: 0 }),
    ...part(noise, 'noise', { theta: 0, psi: 0 }),
    ...(digital && { digital: said(digital, DIGITAL) }),
    ...(disturbance && { disturbance: { V_p: 0, V_y: 0, time: 0, ...said(disturbance) } }),
  });
}

/**
 * @param {Body} body
 * @param {Preset[]} presets those of the server
 * @returns {Design}
 */
export function designFrom(body, presets) {
  const preset = presets.find(({ name }) => name === body.preset) ?? presets[0];
  const base = designOf(preset);
  const choices = said(Object.fromEntries(CHOICES.map((name) => [name, body[name]])));
  const { observer, weights } = body;
  const [pitch, yaw] = body.rotor_poles ? fromWire(body.rotor_poles) : fromWire(base.rotor_poles);
  const design = /** @type {Design} */ ({
    ...base,
    ...choices,
    method: body.method ?? base.method,
    parameters: said(body.parameters, values(preset.parameters)),
    limits: { ...said(body.limits, values(preset.limits)), ...(body.limits?.theta === null && { theta: null }) },
    rotors: byAxis(body.rotors, preset.rotors),
    friction: byAxis(body.friction, preset.friction),
    theta0: body.operating_point?.theta ?? base.theta0,
    poles: body.poles ? fromWire(body.poles) : base.poles,
    rotor_poles: [pitch.re, yaw.re],
    loops: merged(base.loops, { pitch: said(body.loops?.pitch), yaw: said(body.loops?.yaw) }),
    scenario: scenarioFrom(body.scenario, base.scenario, body.operating_point?.theta ?? base.theta0),
    ...part(weights, 'weights'),
  });
  if (!observer) return design;
  const own = said(observer);
  const poles = observer.poles ? fromWire(observer.poles) : observerPoles(design);
  return { ...design, observer: /** @type {import('../types.js').Observer} */ ({ ...own, poles }) };
}

/** The inverse: all that the server needs to know of a design. @param {Design} design @returns {Body} */
export function bodyFrom(design) {
  const { samples: _samples, rtol: _rtol, ...scenario } = scenarioOf(design); // as exact as the server likes
  const { rtol } = design.scenario;
  return { ...bodyOf(design), scenario: { ...scenario, ...(rtol !== undefined && { rtol }) } };
}
