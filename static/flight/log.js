/**
 * A flight's log: its design, its events by tick and some states on the way; from it the flight is made again
 * (heli2dof_core/flight/log.py). Pure.
 * @typedef {import('./designs.js').Body} Body
 * @typedef {import('./designs.js').Designs} Designs
 * @typedef {import('./designs.js').Aboard} Aboard
 * @typedef {import('./craft.js').LogEvent} LogEvent
 *
 * @typedef {object} FlightLog  as JSON
 * @property {number} flight  its version
 * @property {Body} design
 * @property {number} ticks
 * @property {LogEvent[]} events
 * @property {number} seed
 * @property {number[][]} checks  tick, θ, ψ, θ̇, ψ̇
 * @property {string} task
 * @property {string} checksum
 */
import { LOG } from '../kernel/index.js';
import { t } from '../text/index.js';
import { checksum } from './checksum.js';
import { Craft } from './craft.js';
import { DESIGN, requireEvent } from './events.js';

/** A log that is none, or was changed; its message is for people. */
export class LogError extends Error {}

/**
 * That of a flight; null before its first tick.
 * @param {Craft} craft @param {Body} design  with which it began @param {string} [task]
 * @returns {FlightLog|null}
 */
export function logOf(craft, design, task = '') {
  const { tick: ticks, events, seed, checks, check } = craft;
  if (!ticks) return null;
  const told = checks.at(-1)?.[0] === ticks ? checks : [...checks, check];
  const all = told.filter((own) => own.every(Number.isFinite));
  const log = JSON.parse(JSON.stringify({ flight: LOG.FORMAT, design, ticks, events, seed, checks: all, task }));
  return { ...log, checksum: checksum(log) };
}

/**
 * From what a file holds.
 * @param {unknown} value  JSON, or its text
 * @returns {FlightLog} throws a LogError where it is none or something in it was changed
 */
export function readLog(value) {
  const log = /** @type {FlightLog|null} */ (typeof value === 'string' ? parsed(value) : value);
  if (typeof log !== 'object' || log?.flight !== LOG.FORMAT)
    throw new LogError(t('This is no flight. Take the file of a flight as this version writes it.'));
  const { checksum: told, ...own } = log;
  if (told !== checksum(own))
    throw new LogError(t('This flight was damaged or edited. Take the file as the flight has written it.'));
  if (!isSound(log)) throw new LogError(t('This flight cannot be flown again: its log is not sound.'));
  return log;
}

/** @param {string} text */
function parsed(text) {
  try {
    return JSON.parse(text);
  } catch {
    return null;
  }
}

/** @param {FlightLog} log */
function isSound({ ticks, events, checks, design, seed, task }) {
  const whole = isCount(ticks, LOG.MOST_TICKS) && ticks > 0 && isCount(seed, 2 ** 32 - 1) && typeof task === 'string';
  if (!whole || !Array.isArray(events) || !Array.isArray(checks) || events.length > LOG.MOST_EVENTS) return false;
  if (events.filter((event) => event?.[1] === DESIGN).length > LOG.MOST_DESIGNS) return false;
  let before = 0;
  const good = events.every((event) => {
    if (!Array.isArray(event)) return false;
    const [tick, word, ...values] = event;
    const inOrder = isCount(tick, ticks) && tick >= before;
    before = tick;
    return inOrder && (word === DESIGN ? values.length === 1 && isBody(values[0]) : isEvent(word, values));
  });
  return good && isBody(design) && checks.every(isCheck);
}

/** @param {unknown} value @param {number} most */
const isCount = (value, most) => Number.isInteger(value) && Number(value) >= 0 && Number(value) <= most;

/** @param {unknown} value */
const isCheck = (value) => Array.isArray(value) && value.length === 5 && value.every(Number.isFinite);

/** @param {unknown} value */
const isBody = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);

/** @param {string} word @param {(number|Body)[]} values */
function isEvent(word, values) {
  try {
    requireEvent(word, /** @type {number[]} */ (values));
    return values.every((own) => typeof own === 'number');
  } catch {
    return false;
  }
}

/**
 * A log with all designs that it needs.
 * @param {FlightLog} log @param {Designs} designs
 * @returns {Promise<Script>}
 */
export async function scriptOf(log, designs) {
  const first = await designs.of(log.design);
  const changes = log.events.filter(([, word]) => word === DESIGN);
  for (const [, , body] of changes) await designs.of(/** @type {Body} */ (body));
  return new Script(log, first, designs);
}

/** A log that is ready to be flown again. */
export class Script {
  /** @param {FlightLog} log @param {Aboard} first @param {Designs} designs  which know all its designs */
  constructor(log, first, designs) {
    this.log = log;
    this.first = first;
    this.designs = designs;
  }

  /** A craft before its first tick. */
  begun() {
    return new Craft(this.designs.flights, this.first, this.log.seed);
  }

  /** The next event's tick, or the flight's end. @param {Craft} craft */
  until(craft) {
    const next = this.log.events[craft.events.length];
    return next ? next[0] : this.log.ticks;
  }

  /** Does what the log says of this tick. @param {Craft} craft @returns {LogEvent[]} that were done */
  act(craft) {
    const from = craft.events.length;
    for (let next = this.log.events[from]; next && next[0] <= craft.tick; next = this.log.events[craft.events.length])
      redo(craft, next, this.designs);
    return craft.events.slice(from);
  }

  /**
   * How far a craft has been from the log's own states, rad and rad/s; relative where they are large.
   * @param {Craft} craft
   */
  apart(craft) {
    const mine = new Map([...craft.checks, craft.check].map((check) => [check[0], check]));
    const far = this.log.checks.flatMap((told) =>
      (mine.get(told[0]) ?? []).map((own, i) => Math.abs(own - told[i]) / Math.max(1, Math.abs(told[i]))),
    );
    return far.reduce((worst, own) => (own <= worst ? worst : own), 0);
  }
}

/**
 * Does to a craft what an event of a log says.
 * @param {Craft} craft @param {LogEvent} event @param {Designs} designs
 */
export function redo(craft, [, word, ...values], designs) {
  if (word !== DESIGN) return craft.do(word, .../** @type {number[]} */ (values));
  const next = designs.here(/** @type {Body} */ (values[0]));
  if (!next) throw new LogError(t('A design of this flight is not known here.'));
  return craft.change(next);
}
