/**
 * Recordings of a rig: what is asked of the server about them, and its answers in words and curves. Pure.
 * @typedef {import('../types.js').Recorded} Recorded
 * @typedef {import('../types.js').RecordingColumns} RecordingColumns
 * @typedef {import('../contract.js').Preview} Preview
 * @typedef {import('../contract.js').Mapping} Mapping
 * @typedef {import('../contract.js').OverlayReply} OverlayReply
 * @typedef {[number[], ...(number|null)[][]]} Curves
 * @typedef {import('../contract.js').IdentificationReply} IdentificationReply
 */
import { count, DEGREE, fixed, say, significant } from '../text/index.js';
import { bodyOf, initialState } from '../model/index.js';

/** @type {{role: keyof Mapping, base: string, sub?: string, title: string, optional?: boolean}[]} */
export const ROLES = [
  { role: 'time', base: 't', title: 'time' },
  { role: 'theta', base: 'θ', title: 'pitch angle' },
  { role: 'psi', base: 'ψ', title: 'yaw angle' },
  { role: 'V_p', base: 'V', sub: 'p', title: 'pitch motor' },
  { role: 'V_y', base: 'V', sub: 'y', title: 'yaw motor' },
  { role: 'theta_ref', base: 'θ', sub: 'ref', title: 'pitch reference', optional: true },
  { role: 'psi_ref', base: 'ψ', sub: 'ref', title: 'yaw reference', optional: true },
];
export const IDENTIFIABLE = ['K_pp', 'K_py', 'K_yp', 'K_yy', 'B_p', 'B_y', 'K_s'];
/** What else can be found, by its place in a request. @type {Record<string, {symbol: string, title: string}>} */
export const ACTUATORS = {
  'rotors.pitch.tau': { symbol: 'τ_p', title: 'time constant of the pitch motor’s rotor' },
  'rotors.yaw.tau': { symbol: 'τ_y', title: 'time constant of the yaw motor’s rotor' },
  'friction.pitch.coulomb': { symbol: 'F_p', title: 'Coulomb friction in pitch' },
  'friction.yaw.coulomb': { symbol: 'F_y', title: 'Coulomb friction in yaw' },
};
/** Moments of inertia, which scale with thrust and damping of their axis. @type {Record<string, string>} */
export const INERTIAS = { J_p: 'moment of inertia about the pitch axis', J_y: 'moment of inertia about the yaw axis' };
export const DRIVERS = {
  segments: 'recorded voltages, in segments',
  voltages: 'recorded voltages, one run',
  references: 'recorded references, present loop',
};

/** @returns {Recorded} */
export const nothing = () => initialState().recorded;

export const TIME_UNITS = { s: 's', ms: 'ms', us: 'µs', ns: 'ns', min: 'min', h: 'h', d: 'days' };
export const SEPARATORS = { comma: 'comma', semicolon: 'semicolon', tab: 'tab', bar: 'bar |', blank: 'blanks' };
export const DECIMALS = { point: 'point', comma: 'comma' };

/**
 * What the server guessed, as the controls hold it; without a column of time the sample time is for the user to say.
 * @param {Preview} preview
 */
export const guessed = ({ guess }) =>
  /** @type {RecordingColumns} */ ({
    names: { ...guess.columns },
    time_unit: guess.time_unit ?? 's',
    unit: guess.unit,
    units: { ...guess.units },
    voltage_unit: guess.voltage_unit ?? 'V',
    signs: { theta: 1, psi: 1 },
    offsets: { theta: 0, psi: 0 },
    sample_time: null,
    decimate: 1,
  });

/**
 * The columns as the server takes them; the sample time only where no column is the time.
 * @param {RecordingColumns} columns
 */
export function columnsBody({ names, time_unit, unit, units, voltage_unit, signs, offsets, sample_time, decimate }) {
  const chosen = Object.fromEntries(Object.entries(names).filter(([, name]) => name));
  return /** @satisfies {Mapping} */ ({
    ...chosen,
    unit,
    units,
    voltage_unit,
    signs,
    offsets,
    decimate,
    ...(chosen.time ? { time_unit } : { sample_time }),
  });
}

/**
 * Whether all is chosen that is needed: the time too, as a column or as the time between two rows.
 * @param {RecordingColumns|null} columns
 * @returns {columns is RecordingColumns}
 */
export const isMapped = (columns) =>
  Boolean(columns) &&
  ROLES.every(({ role, optional }) => optional || columns?.names[role] || (role === 'time' && columns?.sample_time));

/**
 * @param {import('../types.js').Design} design
 * @param {Pick<Recorded, 'driver'> & {columns: RecordingColumns}} recorded
 */
export const overlayBody = (design, { columns, driver }) => ({
  ...bodyOf(design),
  columns: columnsBody(columns),
  driver,
});

/** Free from the start: stiffness only where the rig has one. @param {Record<string, number>} parameters of the rig */
export const freeAtFirst = (parameters) => IDENTIFIABLE.filter((name) => name !== 'K_s' || parameters.K_s);

/**
 * @param {import('../types.js').Design} design
 * @param {{preview: Preview, columns: RecordingColumns}} recorded
 * @param {string[]} free
 * @param {boolean} all whether nothing is held out
 */
export const identifyBody = (design, { preview, columns }, free, all = false) =>
  /** @satisfies {import('../types.js').Asked<import('../contract.js').IdentifyRequest>} */ ({
    ...bodyOf(design),
    recording: preview.id,
    columns: columnsBody(columns),
    free: /** @type {NonNullable<import('../contract.js').IdentifyRequest['free']>} */ (free),
    ...(all && { held_out: 0 }),
  });

/**
 * Measured and simulated, in degrees.
 * @param {OverlayReply} overlay
 * @param {'theta'|'psi'} axis
 * @returns {Curves} t, measured, simulated, reference
 */
export function curves(overlay, axis) {
  const shown = (/** @type {(number|null)[]|undefined} */ values) =>
    overlay.t.map((_t, i) => {
      const v = values?.[i];
      return typeof v === 'number' ? v * DEGREE : null;
    });
  return [overlay.t, shown(overlay.measured[axis]), shown(overlay.simulated[axis]), shown(overlay.references?.[axis])];
}

/**
 * Room for what was measured; what runs away is cut off.
 * @param {Curves} data
 * @returns {[number, number]}
 */
export function rangeOfCurves([, measured, , reference]) {
  const seen = [...measured, ...reference].filter((v) => v !== null);
  const [low, high] = [Math.min(...seen), Math.max(...seen)];
  const room = Math.max(0.15 * (high - low), 0.5);
  return [low - room, high + room];
}

/** @param {number|null} fit % */
export const fitText = (fit) =>
  fit === null ? 'no fit: the axis never moves' : fit < -100 ? 'fit below −100 %' : `fit ${fixed(fit, 1)} %`;

/** A time in the unit in which it has one to three digits before the point. @param {number} seconds */
const duration = (seconds) =>
  seconds < 1 ? say`${significant(1e3 * seconds, 3)} ms` : say`${significant(seconds, 3)} s`;

/** @param {Preview} preview */
export function previewWords(preview) {
  const columns = count(preview.columns.length, '{0} column', '{0} columns');
  const about = say`${preview.name || 'Recording'}: ${preview.rows} rows, ${columns}`;
  const apart = preview.guess.sample_time ?? 0;
  return apart > 0 ? say`${about}, ${duration(apart)} apart` : about;
}

/** What still has to be chosen, in words; empty where nothing is. @param {RecordingColumns|null} columns */
export function missingWords(columns) {
  const missing = ROLES.filter(
    ({ role, optional }) => !optional && !columns?.names[role] && !(role === 'time' && columns?.sample_time),
  ).map(({ role, title }) => (role === 'time' ? 'the time, or the sample time' : `the ${title}`));
  return missing.length ? say`Choose the column of ${missing.join(', ')}.` : '';
}

/** @param {OverlayReply} overlay */
export function overlayWords(overlay) {
  const { samples, sample_time } = overlay;
  const about = say`${samples} samples in ${fixed(overlay.duration, 1)} s, ${duration(sample_time)} apart`;
  return overlay.segments > 1
    ? say`${about}, ${overlay.segments} segments, each from the state that fits it best`
    : about;
}

/** @param {import('../types.js').Progress|null} progress */
export function progressWords(progress) {
  if (!progress) return 'Identifying…';
  const [pitch, yaw] = [progress.rms.theta, progress.rms.psi].map((v) => significant((v ?? 0) * DEGREE, 3));
  return say`Simulation ${progress.evaluations}: residuals ${pitch}° in pitch, ${yaw}° in yaw`;
}

/** As many digits as a link needs. @param {number} v */
const brief = (v) => Number(v.toPrecision(7));

/**
 * What was found of both axes' rotors or friction, as a request takes it.
 * @template {object} T
 * @param {{pitch: T, yaw: T}} found
 */
const machine = ({ pitch, yaw }) => {
  const own = (/** @type {T} */ part) =>
    /** @type {T} */ (
      Object.fromEntries(Object.entries(part).map(([k, v]) => [k, typeof v === 'number' ? brief(v) : v]))
    );
  return { pitch: own(pitch), yaw: own(yaw) };
};

/**
 * The design on the rig that was found. Rotors and friction are said where they were looked for, or where their curves
 * would be matched elsewhere on the new rig.
 * @param {import('../types.js').Design} design
 * @param {IdentificationReply} found
 * @returns {import('../types.js').Design}
 */
export function adopted(design, { estimates, rotors, friction }) {
  const own = estimates.filter(({ name }) => !(name in ACTUATORS));
  const curved = [rotors.pitch, rotors.yaw].some(({ curve }) => curve !== 'linear');
  return {
    ...design,
    parameters: { ...design.parameters, ...Object.fromEntries(own.map((e) => [e.name, brief(e.adopted)])) },
    ...((curved || own.length < estimates.length) && { rotors: machine(rotors), friction: machine(friction) }),
  };
}
