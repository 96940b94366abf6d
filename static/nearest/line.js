/**
 * What would have to move, in words, below the s-plane: a button per move, which takes it; or that nothing near is
 * enough.
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../contract.js').NearestReply} Reply
 * @typedef {import('../contract.js').MoveReply} Move
 * @typedef {{on: (move: Move|null) => void, take: (move: Move) => void, ask: () => void}} Acts
 *   of moves: one is pointed at, or none; one is taken; they are asked for
 */
import { percent, say, t } from '../text/index.js';
import { button, h, setText } from '../ui/index.js';
import { whatMoves, wordsOf } from './moves.js';

/** Moves that are offered: more are no help. */
const MOST = 3;

export class Line {
  /** @param {Acts} acts */
  constructor(acts) {
    this.acts = acts;
    this.words = h('span', { class: 'nearest-words', role: 'status' });
    this.ask = button(
      {
        class: 'quiet',
        'data-testid': 'nearest-ask',
        title: 'The smallest move of poles or loops with which the design would meet all that is missed',
        onclick: () => acts.ask(),
        hidden: true,
      },
      'Why not?',
    );
    this.moves = h('span', { class: 'nearest-moves' });
    this.node = h(
      'div',
      {
        class: 'nearest',
        'data-testid': 'nearest',
        role: 'group',
        'aria-label': 'Nearest designs that meet what is required',
        hidden: true,
      },
      this.ask,
      this.words,
      this.moves,
    );
  }

  /** Nothing is missed, or nothing may be said. */
  clear() {
    this.node.hidden = true;
    this.#say('');
  }

  /** To be asked by a click. */
  offer() {
    this.node.hidden = false;
    this.ask.hidden = false;
    this.#say('');
  }

  /** The answer is under way. */
  wait() {
    this.node.hidden = false;
    this.ask.hidden = true;
    this.#say(t('Looking for the nearest design that meets all …'));
  }

  /** @param {Design} design @param {Reply} reply */
  show(design, reply) {
    this.node.hidden = reply.met;
    this.ask.hidden = true;
    if (!reply.moves.length) {
      this.#say(noneText(reply));
      return;
    }
    this.#say(t('Meet all:'));
    this.moves.replaceChildren(...reply.moves.slice(0, MOST).map((move, i) => this.#button(design, move, i)));
  }

  /** @param {string} words */
  #say(words) {
    setText(this.words, words);
    this.moves.replaceChildren();
  }

  /** @param {Design} design @param {Move} move @param {number} i */
  #button(design, move, i) {
    const words = wordsOf(design, move)
      .map(({ text }) => text)
      .join('; ');
    const far = percent(move.distance, move.distance < 0.1 ? 1 : 0);
    const figures = move.figures.map(({ text }) => text).join(', ');
    const node = button(
      {
        class: 'nearest-move',
        'data-testid': `nearest-move-${i}`,
        'aria-description': words,
        title: say`${words}. That is ${far} away and gives ${figures}. Click: move there; undo leads back`,
        onclick: () => this.acts.take(move),
      },
      whatMoves(move),
      h('span', { class: 'nearest-far', translate: 'no' }, far),
    );
    // one that comes to stand under a resting pointer is not pointed at: undo leads back to the design
    node.addEventListener('pointermove', (e) => {
      if (e.pointerType === 'mouse' && (e.movementX || e.movementY)) this.acts.on(move);
    });
    node.addEventListener('pointerleave', () => this.acts.on(null));
    node.addEventListener('focus', () => node.matches(':focus-visible') && this.acts.on(move));
    node.addEventListener('blur', () => this.acts.on(null));
    return node;
  }
}

/** Why there is none, and all that the closest misses. @param {Reply} reply */
function noneText({ requirements, out_of_reach: out, closest, excluding, summary }) {
  if (excluding) return summary;
  const missed = requirements.flatMap(({ words, limit }, i) => {
    const own = closest?.figures[i];
    return own && !own.met ? [say`${words} ${own.text} in place of ${limit}`] : [];
  });
  const why = out.length
    ? say`No design nearby meets ${out.map((i) => `${requirements[i].words} ${requirements[i].limit}`).join('; ')}.`
    : t('Each alone can be met nearby, but not all at once.');
  return missed.length ? `${why} ${say`The closest design found misses ${missed.join('; ')}.`}` : why;
}
