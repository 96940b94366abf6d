/**
 * The numbers of a page without any server: each design is computed by the page's kernel, in the animation frame of its
 * event. What the kernel does not serve is refused, with the reason; remarks, which are the server's words, are missing
 * and said to be.
 * @typedef {import('../types.js').Reply} Reply
 * @typedef {import('../types.js').Design} Design
 */
import { t } from '../text/index.js';
import { presetOf, scenarioOf } from '../model/index.js';
import { fill, OUTCOMES, replyOf, serves, sizeOf } from '../kernel/index.js';

/** In place of a server's last reply, of which the kernel's takes the words. */
const words = () =>
  /** @type {Reply} */ (
    /** @type {unknown} */ ({
      gains: { controllability_indices: [2, 2], findings: [] },
      rga: { findings: [] },
      axis_steps: {},
      open_loop_poles: [],
      findings: [
        {
          code: 'without_server',
          severity: 'info',
          message: t('Remarks on a design need a server. Verdict, responses and figures are computed on this page.'),
        },
      ],
    })
  );

/** @typedef {import('../types.js').Problem} Problem */
/** Why there are no numbers, by how the kernel ended. @param {number} outcome @returns {Problem} */
function problemOf(outcome) {
  if (outcome === OUTCOMES.UNCONTROLLABLE)
    return {
      code: 'uncontrollable',
      detail: t('This rig cannot be controlled: both motors push alike.'),
    };
  if (outcome === OUTCOMES.NO_STRUCTURE)
    return {
      code: 'structure_unavailable',
      detail: t('No gain of this structure places these poles.'),
      hint: t('Choose another structure, or move a pole.'),
    };
  return { code: 'needs_server', detail: t('This design cannot be computed without a server.'), hint: t('Undo it.') };
}

export class Alone {
  /** @type {Design|null} */ #seen = null;
  #words = words();

  /**
   * @param {import('../model/store.js').Store} store
   * @param {import('../kernel/index.js').Updates} kernel
   */
  constructor(store, kernel) {
    this.store = store;
    this.kernel = kernel;
  }

  /** Before anything is drawn. */
  frame() {
    const { design } = this.store.state;
    if (!design || design === this.#seen) return;
    this.#seen = design;
    this.store.set({ heard: design, ...this.answer(design) });
  }

  /**
   * What there is to say of any design.
   * @param {Design} design
   * @returns {{reply: Reply, answered: Design, problem: null}|{problem: Problem}}
   */
  answer(design) {
    const preset = presetOf({ presets: this.store.state.presets, design });
    if (!preset || !serves(design, preset)) return { problem: problemOf(NaN) };
    const how = { size: sizeOf(design, preset), samples: scenarioOf(design).samples };
    fill(this.kernel.numbers, design, preset);
    const block = this.kernel.update(how.size, how.samples); // its memory may have moved
    const reply = replyOf(block, this.kernel.numbers, design, how, { reply: this.#words, design: null });
    return reply ? { reply, answered: design, problem: null } : { problem: problemOf(block.outcome[0]) };
  }
}
