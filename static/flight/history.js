/**
 * Where a flight may be taken back to: a snapshot in each second, from which it is flown again. Pure.
 * @typedef {import('./craft.js').Craft} Craft
 * @typedef {import('./craft.js').Snapshot} Snapshot
 * @typedef {import('./designs.js').Designs} Designs
 */
import { redo } from './log.js';

/** Between two snapshots, s of flight. */
const SNAPSHOTS = 1;

export class History {
  /** @type {Snapshot[]} */ #snapshots;
  /** When they were made, s. */ #times = [0];

  /** @param {Craft} craft  before its first tick */
  constructor(craft) {
    this.#snapshots = [craft.snapshot()];
  }

  /** It has flown on, and nothing has happened since. @param {Craft} craft */
  flown(craft) {
    if (craft.time < (this.#times.at(-1) ?? 0) + SNAPSHOTS) return;
    this.#snapshots.push(craft.snapshot());
    this.#times.push(craft.time);
  }

  /**
   * Takes it back to the tick next to a time, before all that happened there; it forgets what came after.
   * @param {Craft} craft @param {number} target  s @param {Designs} designs  which know all that it has flown
   */
  back(craft, target, designs) {
    const at = Math.max(
      this.#times.findLastIndex((own) => own <= target),
      0,
    );
    const done = craft.events.slice(this.#snapshots[at].events);
    craft.restore(this.#snapshots[at]);
    this.#snapshots.length = this.#times.length = at + 1;
    const left = () => Math.round((target - craft.time) / craft.step);
    for (let n = 0; !craft.ended && left() > 0;) {
      for (; n < done.length && done[n][0] <= craft.tick; n++) redo(craft, done[n], designs);
      craft.settle(); // and a tick at least is flown: what happens here later would come before it
      const ticks = Math.min(Math.max(left(), 1), (done[n]?.[0] ?? Infinity) - craft.tick);
      craft.fly(Math.min(ticks, craft.waiting ? craft.untilSample : Infinity));
    }
  }
}
