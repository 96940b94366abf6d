/**
 * Who marks and keeps a lab where there is no server: this page, by its kernels and the answers in its package, and the
 * LMS, which is told at each attempt and when the page is left.
 * @typedef {import('../labs/shapes.js').Desk} Desk
 * @typedef {import('../labs/shapes.js').Step} Step
 * @typedef {import('../labs/shapes.js').Goal & {share?: 'stable'|'within_limits'}} Goal
 * @typedef {import('../labs/shapes.js').Told} Told
 * @typedef {import('../labs/shapes.js').Marked} Marked
 * @typedef {import('../labs/shapes.js').Kept} Kept
 * @typedef {import('../labs/shapes.js').Standing} Standing
 * @typedef {import('../bodies/bodies.js').Body} Body
 * @typedef {import('./content.js').Content} Content
 * @typedef {import('../types.js').Reply} Reply
 * @typedef {import('../types.js').Design} Design
 * @typedef {ReturnType<import('./alone.js').Alone['answer']>} Answer
 * @typedef {(design: Design, drawn: Float64Array) => Promise<import('../types.js').Cloud|null>} Clouds
 */
import { percent, say, t } from '../text/index.js';
import { bodyFrom, designFrom } from '../bodies/index.js';
import { figureOf, judged, meets, startOf, valuesOf } from '../labs/index.js';
import { numbersIn } from './goal_clouds.js';
import { judgedAnswer } from './questions.js';
import { resume, suspend } from './suspended.js';

/** A draft is told to the LMS so long after the last change, ms; an attempt at once. */
const DRAFT_MS = 30_000;

/** A number that belongs to a name (FNV-1a). @param {string} name @param {number} count */
export function placeOf(name, count) {
  let hash = 0x811c9dc5;
  for (const byte of new TextEncoder().encode(name)) hash = Math.imul(hash ^ byte, 0x01000193) >>> 0;
  return hash % count;
}

/** @param {Kept} kept */
const hintsOf = ({ hints = [] }) => hints.map((hint) => (typeof hint === 'number' ? hint : hint.hint));

/** @implements {Desk} */
export class PackageDesk {
  link = null;
  who = '';
  /** Whether the LMS keeps what it is told. */ #keeps = false;
  #tell = () => {};
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #timer;
  /** @type {Standing} */ #standing = { kind: 'fine', words: '' };

  /**
   * @param {Content} content
   * @param {import('./lms.js').Lms} lms
   * @param {(design: Design) => Answer} answer  by the kernel
   * @param {Clouds} clouds
   */
  constructor(content, lms, answer, clouds) {
    this.content = content;
    this.lms = lms;
    this.answer = answer;
    this.clouds = clouds;
    this.lab = content.lab;
    const session = lms.begin();
    this.who = session?.name ?? '';
    this.#keeps = session?.kept === true;
    const rigs = content.rigs.length;
    this.place = rigAt(session?.suspended ?? '') ?? placeOf(session?.id ?? '', rigs);
    if (this.place >= rigs) this.place = placeOf(session?.id ?? '', rigs);
    this.rig = content.rigs[this.place].rig;
    const work = resume(session?.suspended ?? '', (name, designs) => this.#start(name, designs));
    this.at = work && this.#step(work.at) ? work.at : this.lab.steps[0].name;
    /** @type {Record<string, Kept>} */ this.kept = {};
    for (const [name, own] of Object.entries(work?.steps ?? {}))
      this.kept[name] = {
        design: /** @type {Body|undefined} */ (own.design) ?? null,
        answers: own.answers,
        attempts: own.attempts,
        hints: (own.hints ?? []).map((hint) => ({ ...this.content.hints[name][hint - 1], hint })),
        best: own.points === undefined ? null : this.#remembered(name, own.points, own.met ?? []),
      };
    this.#report(); // that the work has begun
  }

  /** @param {string} name */
  #step(name) {
    return this.lab.steps.find((step) => step.name === name);
  }

  /**
   * What a step starts with, as a whole.
   * @param {string} name @param {Record<string, object>} designs  of the steps before
   * @returns {Record<string, unknown>|undefined}
   */
  #start(name, designs) {
    const step = this.#step(name);
    if (!step) return undefined;
    const kept = Object.fromEntries(Object.entries(designs).map(([own, design]) => [own, { design }]));
    return { ...bodyFrom(startOf(this.lab, step, this.rig, kept, this.content.presets)) };
  }

  /** A best attempt, of which the LMS has kept points and what was met. */
  /** @param {string} name @param {number} points @param {(boolean|null)[]} met @returns {Marked} */
  #remembered(name, points, met) {
    const { goals = [], questions = [], points: of = 0 } = this.#step(name) ?? {};
    const all = [...goals, ...questions.map((own) => ({ ...own, label: own.text }))];
    const told = all.map((own, i) =>
      toldOf(own, { met: met[i] === undefined ? false : met[i], value_text: '', message: '' }),
    );
    return { goals: told.slice(0, goals.length), questions: told.slice(goals.length), points, of };
  }

  /** @returns {Standing} */
  get standing() {
    return this.#standing;
  }

  /** @type {Desk['mark']} */
  async mark(name, body, answers) {
    const step = /** @type {Step} */ (this.#step(name));
    const design = designFrom(body, this.content.presets);
    const found = this.answer(design);
    const reply = 'reply' in found ? found.reply : null;
    const why = 'reply' in found ? '' : (found.problem.detail ?? '');
    const goals = [];
    for (const goal of step.goals) goals.push(toldOf(goal, await this.#goal(name, goal, design, reply, why)));
    const right = this.content.answers[name];
    const known = this.content.rigs[this.place].right[name] ?? {};
    const questions = step.questions.map((question) =>
      toldOf(
        { ...question, label: question.text },
        judgedAnswer(right[question.name], answers[question.name], {
          choices: question.choices ?? [],
          known: known[question.name],
          reply,
          body: { ...body },
          figure: (asked, own) => figureAsked(asked, own, design.theta0),
          stable: (other) => this.#stable(other),
        }),
      ),
    );
    const kept = this.kept[name] ?? {};
    const cost = hintsOf(kept).reduce((sum, hint) => sum + (step.hints[hint - 1]?.cost ?? 0), 0);
    const points = Math.max(0, [...goals, ...questions].reduce((sum, own) => sum + own.points, 0) - cost);
    const marked = { goals, questions, points, of: step.points, stable: reply?.stable ?? false };
    const { best, attempts = 0 } = kept;
    this.at = name;
    this.#put(name, {
      design: body,
      answers,
      attempts: attempts + 1,
      best: best && best.points >= points ? best : { ...marked, answers },
    });
    this.#report();
    this.#tell();
    return marked;
  }

  /**
   * @param {string} step @param {Goal} goal @param {Design} design @param {Reply|null} reply
   * @param {string} why  there is no reply
   * @returns {Promise<Outcome>}
   */
  async #goal(step, goal, design, reply, why) {
    if (!reply) return { met: false, value_text: t('no design'), message: why };
    if (!reply.stable && !goal.unstable)
      return {
        met: false,
        value_text: t('unstable'),
        message: t('The loop is unstable: no step comes to rest, so nothing is reached.'),
      };
    if (goal.kind === 'cloud') {
      const cloud = await this.clouds(design, numbersIn(this.content.clouds[step][goal.name]));
      if (!cloud) return { met: false, value_text: '', message: t('This page could not compute the rigs.') };
      const value = goal.share === 'stable' ? cloud.share_stable : cloud.share_within_limits;
      const shown = Math.floor(1000 * value + 1e-9) / 10; // rounded down: 99.96 % are not all
      return { met: shown >= 100 * (goal.min ?? 0) - 1e-9, value_text: `${shown} %`, message: '' };
    }
    const { met, text } = judged(goal, { reply, design });
    return { met: met ?? false, value_text: text, message: '' };
  }

  /** Whether the whole loop of a design is stable. @param {Record<string, unknown>} body */
  #stable(body) {
    const found = this.answer(designFrom(/** @type {Body} */ (/** @type {unknown} */ (body)), this.content.presets));
    return 'reply' in found && found.reply.stable;
  }

  /** @type {Desk['hint']} */
  async hint(step, hint) {
    const text = this.content.hints[step][hint - 1];
    const taken = this.kept[step]?.hints ?? [];
    if (!hintsOf({ hints: taken }).includes(hint)) this.#put(step, { hints: [...taken, { ...text, hint }] });
    this.#report();
    this.#tell();
    return text;
  }

  /** @type {Desk['keep']} */
  keep(step, design, answers) {
    this.at = step;
    this.#put(step, { design, answers });
    this.#timer ??= setTimeout(() => this.#report(), DRAFT_MS);
  }

  /** @param {string} step @param {Kept} part */
  #put(step, part) {
    this.kept = { ...this.kept, [step]: { ...this.kept[step], ...part } };
  }

  /** How far the work is, for the LMS. @returns {{status: import('./lms.js').Status, score?: number}} */
  get progress() {
    const own = this.lab.steps.map(({ name }) => this.kept[name] ?? {});
    const tried = own.filter(({ best }) => best);
    if (!tried.length) return { status: 'incomplete' };
    const points = tried.reduce((sum, { best }) => sum + (best?.points ?? 0), 0);
    const share = this.lab.points ? points / this.lab.points : 1;
    const done = tried.length === own.length;
    return { status: !done ? 'incomplete' : share >= this.content.pass ? 'passed' : 'completed', score: 100 * share };
  }

  /** Tells the LMS, and has it say here what it keeps. */
  #report() {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    const { status, score } = this.progress;
    const work = { rig: this.place, at: this.at, steps: this.#work() };
    const { text, whole } = suspend(work, (name, designs) => this.#start(name, designs));
    const taken = this.#keeps && this.lms.tell({ status, score, suspended: text });
    this.#standing = { kind: taken && whole ? 'fine' : 'away', words: this.#wordsOn(taken, whole, score) };
  }

  #work() {
    const found = this.lab.steps.flatMap(({ name }) => {
      const { design, answers, attempts, best, ...kept } = this.kept[name] ?? {};
      if (!this.kept[name]) return [];
      const met = [...(best?.goals ?? []), ...(best?.questions ?? [])].map((told) => told.met);
      /** @type {import('./suspended.js').StepKept} */
      const own = {
        ...(design && { design: { ...design } }),
        answers,
        attempts,
        hints: hintsOf(kept),
        ...(best && { points: best.points, met }),
      };
      return [/** @type {[string, typeof own]} */ ([name, own])];
    });
    return Object.fromEntries(found);
  }

  /** @param {boolean} taken @param {boolean} whole @param {number} [score] */
  #wordsOn(taken, whole, score) {
    if (!this.lms.found) return t('No course has opened this page: nothing is kept.');
    if (!this.lms.open) return t('Nothing is kept any more: close this page, and open it in your course again.');
    if (!this.#keeps) return t('Opened for review: nothing is kept.');
    if (!taken) return say`Your course does not keep this. It says: ${this.lms.trouble || t('no reason')}`;
    if (!whole) return t('Your course has little room: of long answers it keeps only the beginning and the end.');
    return score === undefined ? t('Kept in your course.') : say`Kept in your course: ${percent(score / 100)}.`;
  }

  /** @param {() => void} told */
  onChange(told) {
    this.#tell = told;
  }

  /** The page may be left without a word: it is out of sight. */
  rest() {
    if (this.lms.open) this.#report();
  }

  /** The page is left. */
  leave() {
    if (!this.lms.open) return;
    this.#report();
    this.lms.end();
  }
}

/** @typedef {import('./questions.js').Outcome} Outcome */
/**
 * The value of a figure that a question asks for: of several the least good one, as the core has it.
 * @param {import('./questions.js').AskedFigure} asked @param {Reply} reply @param {number} theta0
 */
function figureAsked(asked, reply, theta0) {
  const goal = { ...asked, name: '', kind: 'figure', label: '', points: 0, required_text: '' };
  const figure = figureOf(goal);
  const values = (figure && valuesOf(goal, reply, theta0)) ?? [];
  const known = values
    .filter((v) => v !== undefined)
    .map((v) => (figure?.signed && values.length > 1 ? Math.abs(v) : v));
  const unlimited = figure && meets(figure, undefined, {}); // none says that there is no limit
  if (!known.length || (known.length < values.length && !unlimited)) return undefined;
  return figure?.better === 'higher' ? Math.min(...known) : Math.max(...known);
}

/**
 * @param {{name: string, label: string, points: number, required_text?: string}} of @param {Outcome} outcome
 * @returns {Told}
 */
const toldOf = ({ name, label, points, required_text = '' }, { met, value_text, message }) => ({
  name,
  label,
  met,
  value_text,
  required_text,
  points: met ? points : 0,
  of: points,
  message,
});

/** Which rig the work was done on. @param {string} suspended @returns {number|null} */
function rigAt(suspended) {
  try {
    const { r } = JSON.parse(suspended);
    return Number.isInteger(r) && r >= 0 ? r : null;
  } catch {
    return null;
  }
}
