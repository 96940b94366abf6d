/** Bode plots of the loop opened at each motor, the other closed, with the margins drawn where they are measured. */
import { decibel, DEGREE, degrees, fixed, say, significant } from '../text/index.js';
import { logSpaced } from '../model/index.js';
import { openLoops } from '../net/index.js';
import { symbol } from '../ui/index.js';
import { decibels, marginPlaces } from './margins_math.js';
import { FrequencyCard } from './frequency_card.js';

const FREQUENCIES = logSpaced(0.1, 1000, 241);
const AXES = /** @type {const} */ (['pitch', 'yaw']);
const NAMES = { pitch: 'pitch motor', yaw: 'yaw motor' };
const TITLE = 'loop opened at this motor’s input, all else closed';

/** Rounded to steps around what is seen. @param {number} step @param {number} low @param {number} high */
const around = (step, low, high) => (/** @type {number[][]} */ data) => {
  const seen = data.flat().filter(Number.isFinite);
  return /** @type {[number, number]} */ ([
    Math.max(low, step * Math.floor(Math.min(-step, ...seen) / step)),
    Math.min(high, step * Math.ceil(Math.max(0, ...seen) / step)),
  ]);
};

/**
 * @typedef {import('../contract.js').OpenLoops} OpenLoops
 * @typedef {import('../types.js').Margins} Margins
 */

/** @param {'phase'|'gain'} kind @param {(m: Margins) => string} label */
const spans = (kind, label) => (/** @type {OpenLoops} */ reply) =>
  AXES.flatMap((axis) => {
    const margins = reply.margins[axis];
    const place = marginPlaces(reply.frequencies, reply[axis], margins)[kind];
    return place && margins ? [{ kind: axis, ...place, label: label(margins) }] : [];
  });

/** @param {(own: import('../contract.js').FrequencyResponse) => number[]} of */
const series = (of) =>
  AXES.map((axis) => ({
    kind: axis,
    name: () => [NAMES[axis]],
    plain: NAMES[axis],
    title: TITLE,
    of: (/** @type {OpenLoops} */ r) => of(r[axis]),
  }));

/** @type {import('./frequency_plot.js').About<OpenLoops>[]} */
const CHARTS = [
  {
    id: 'loop-gain',
    title: 'Gain',
    full: 'Gain of the loop opened at each motor',
    unit: ' dB',
    steps: [10, 20, 40, 60, 100],
    range: around(20, -100, 120),
    rule: { value: 0, label: 'crossover', above: false },
    spans: spans('gain', (m) => decibel(m.gain_margin)),
    series: series((own) => decibels(own.gain)),
  },
  {
    id: 'loop-phase',
    title: 'Phase',
    full: 'Phase of the loop opened at each motor',
    unit: '°',
    steps: [15, 30, 45, 90, 180, 360],
    range: around(45, -1080, 360),
    rule: { value: -180, every: 360, label: 'critical', above: false },
    spans: spans('phase', (m) => degrees(m.phase_margin, 0)),
    series: series((own) => own.phase.map((v) => v * DEGREE)),
  },
];

/** One motor's margins in words. @param {OpenLoops} reply @param {'pitch'|'yaw'} axis */
function words(reply, axis) {
  const margins = reply.margins[axis];
  const place = marginPlaces(reply.frequencies, reply[axis], margins);
  const phase = place.phase
    ? say`${degrees(margins?.phase_margin, 0)} at ${significant(place.phase.at, 3)} rad/s`
    : degrees(margins?.phase_margin, 0);
  const gain =
    margins?.gain_margin === undefined
      ? '∞'
      : place.gain
        ? say`${decibel(margins.gain_margin)} at ${significant(place.gain.at, 3)} rad/s`
        : decibel(margins.gain_margin);
  const lower =
    margins?.gain_reduction_margin === undefined ? '' : say`, down to × ${fixed(margins.gain_reduction_margin)}`;
  return axis === 'pitch'
    ? say`Pitch motor: phase margin ${phase}, gain margin ${gain}${lower}.`
    : say`Yaw motor: phase margin ${phase}, gain margin ${gain}${lower}.`;
}

/** @extends {FrequencyCard<OpenLoops>} */
export class OpenLoopsCard extends FrequencyCard {
  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    const caption = ['The loop opened at one motor, all else closed, PI loops included; ', symbol('ω'), ' in rad/s.'];
    const tell = (/** @type {OpenLoops} */ reply) =>
      reply.stable
        ? { text: AXES.map((axis) => words(reply, axis)).join(' ') }
        : { text: 'The whole loop is unstable: it has no margins.', warning: true };
    super(root, store, {
      charts: CHARTS,
      frequencies: FREQUENCIES,
      caption,
      words: tell,
      testid: 'margin-words',
      wait: 'Computing the open loops…',
      ask: openLoops,
    });
  }
}
