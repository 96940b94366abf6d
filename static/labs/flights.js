/**
 * Flights of a step whose goals are of a task in the air: the best one of the design that is shown is kept in this
 * browser, and handed in with the next attempt. The view Fly tells of each task that was flown to its end by the
 * document's event "flown".
 * @typedef {import('./shapes.js').Goal} Goal
 * @typedef {import('./shapes.js').Step} Step
 * @typedef {import('./shapes.js').Log} Log
 * @typedef {import('./shapes.js').FlightValues} FlightValues
 * @typedef {import('../bodies/bodies.js').Body} Body
 * @typedef {{log: Log, values: FlightValues, design: Body}} Flown
 */
import { t } from '../text/index.js';
import { meets, worst, written } from './goals.js';
import { read, write } from './kept.js';

const AXES = /** @type {const} */ (['theta', 'psi']);
/** Parts of an experiment that a flight knows nothing of, as heli2dof_core/labs/flights.py has them. */
const NOT_FLOWN = ['initial', 'reference', 'duration', 'disturbance', 'model', 'samples', 'rtol'];
/** Share of a flight by hand in which the controller may be on, as heli2dof_core/labs/goals/flight.py has it. */
const SLIP = 0.02;

/**
 * What is flown in a step; null where nothing is.
 * @param {Pick<Step, 'goals'>|undefined} step
 * @returns {import('./shapes.js').FlightAsked|null}
 */
export function flightOf(step) {
  const goals = (step?.goals ?? []).filter(({ kind }) => kind === 'flight');
  if (!goals.length) return null;
  const [{ task = '', changes, seed }] = goals;
  const hands = goals.find((goal) => goal.hands)?.hands;
  return { task, ...(hands && { hands }), ...(changes && { changes }), ...(seed !== undefined && { seed }) };
}

/** What of a design is flown, as text. @param {Body} body */
function flownPart({ scenario, ...body }) {
  const rest = Object.entries(scenario ?? {}).filter(([name]) => !NOT_FLOWN.includes(name));
  return JSON.stringify([body, Object.fromEntries(rest)], (_name, value) =>
    value === null || typeof value !== 'object' || Array.isArray(value)
      ? value
      : Object.fromEntries(Object.entries(value).sort()),
  );
}

/** All designs of a flight. @param {Log} log @returns {Body[]} */
const designsOf = ({ design, events }) => [
  design,
  ...events.filter(([, word]) => word === 'design').map(([, , body]) => /** @type {Body} */ (body)),
];

/**
 * A figure of a flight, of each axis that is meant.
 * @param {Goal} goal @param {FlightValues} values @returns {(number|undefined)[]}
 */
function valuesOf({ figure = '', axis }, values) {
  const found = values[figure];
  if (found === undefined || typeof found === 'number') return [found];
  return AXES.filter((own) => axis === own || axis === 'both').map((own) => found[own]);
}

/**
 * How far a flight meets a goal.
 * @param {Goal} goal
 * @param {FlightValues} values
 * @returns {import('./goals.js').Now}
 */
export function judgedFlight(goal, values) {
  if (!goal.written) return { met: null, text: '' };
  const figure = { name: goal.figure ?? '', ...goal.written };
  const share = typeof values.by_hand === 'number' ? values.by_hand : 0;
  const value = worst(figure, valuesOf(goal, values), goal);
  const hands = goal.hands === 'on' ? share >= 1 - SLIP : goal.hands === 'off' ? share === 0 : true;
  return {
    met: hands && meets(figure, value, goal),
    text: value === undefined ? t('not reached') : written(figure, value),
  };
}

/** What a flight is worth, and the figures that decide among those worth the same. @param {Goal[]} goals */
const worthOf = (goals, /** @type {FlightValues} */ values) =>
  goals.reduce((sum, goal) => sum + (judgedFlight(goal, values).met ? goal.points : 0), 0);

/** How far a flight is from its goals' limits, the smaller the better. @param {Goal[]} goals */
const distanceOf = (goals, /** @type {FlightValues} */ values) =>
  goals.reduce((sum, goal) => {
    const limit = goal.max ?? goal.min ?? 0;
    const own = valuesOf(goal, values).map((value) => (value === undefined ? 1e6 : Math.abs(value - limit)));
    return sum + (Math.max(...own, 0) / Math.max(Math.abs(limit), 1e-6)) * (judgedFlight(goal, values).met ? -1 : 1);
  }, 0);

export class StepFlights {
  /** @type {Step|undefined} */ #step;
  /** @type {Flown|null} */ #kept = null;
  /** Whether the newest flight was not of the design that is shown alone, and does not count. */ changed = false;

  /**
   * @param {object} of
   * @param {(step: string) => string} of.nameOf of what is kept
   * @param {() => Body|null} of.design that is shown
   * @param {(body: Body) => Body} of.whole a flight's design with all that its preset says anyway
   * @param {() => void} of.told of a flight
   */
  constructor({ nameOf, design, whole, told }) {
    this.nameOf = nameOf;
    this.design = design;
    this.whole = whole;
    this.told = told;
  }

  /** @param {AbortSignal} signal */
  listen(signal) {
    document.addEventListener('flown', (e) => this.#flown(/** @type {CustomEvent} */ (e).detail), { signal });
  }

  /** @param {Step|undefined} step */
  show(step) {
    this.#step = step;
    this.changed = false;
    this.#kept = flightOf(step) && step ? read(this.nameOf(step.name), /** @type {Flown|null} */ (null)) : null;
  }

  get #goals() {
    return (this.#step?.goals ?? []).filter(({ kind }) => kind === 'flight');
  }

  /** The best flight that counts with the design that is shown; null where there is none. */
  get best() {
    const design = this.design();
    return this.#kept && design && this.#counts(this.#kept, design) ? this.#kept : null;
  }

  /** Whether there is one of another design. */
  get stale() {
    return this.#kept !== null && this.best === null;
  }

  /** @param {Flown} flown @param {Body} design */
  #counts(flown, design) {
    return flightOf(this.#step)?.changes === 'allowed' || flownPart(flown.design) === flownPart(design);
  }

  /** @param {{log: Log, values: FlightValues}} detail */
  #flown({ log, values }) {
    const [step, design] = [this.#step, this.design()];
    const asked = flightOf(step);
    if (!step || !design || log.task !== asked?.task || log.seed !== (asked.seed ?? log.seed)) return;
    const own = flownPart(design);
    this.changed = asked.changes !== 'allowed' && designsOf(log).some((body) => flownPart(this.whole(body)) !== own);
    if (this.changed) return this.told();
    const { best } = this;
    const goals = this.#goals;
    const [now, before] = [worthOf(goals, values), best ? worthOf(goals, best.values) : -1];
    const nearer = now === before && best && distanceOf(goals, values) < distanceOf(goals, best.values);
    if (now > before || nearer) {
      this.#kept = { log, values, design };
      write(this.nameOf(step.name), this.#kept);
    }
    this.told();
  }
}
