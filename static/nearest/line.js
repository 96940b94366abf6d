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
import { button, h, setAttr, setText } from '../ui/index.js';
import { whatMoves, wordsOf } from './moves.js';

/** A window that has room for all that the moves do in words; in others a button shows them. */
const ROOMY = '(min-height: 900px), (max-width: 1179px)';
/** Moves that are offered: more are no help. */
const MOST = 3;

export class Line {
  /** Whether what the moves do is shown in words; null: as there is room. @type {boolean|null} */ #open = null;

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
    this.how = button(
      {
        class: 'quiet nearest-how',
        'data-testid': 'nearest-how',
        title: 'What each of them moves, how far that is from the present design, and what it gives',
        hidden: true,
        onclick: () => this.#unfold(Boolean(this.all.hidden)),
      },
      'What moves',
    );
    this.all = h('ul', { class: 'nearest-all', 'data-testid': 'nearest-all', hidden: true });
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
      this.how,
      this.all,
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

  /** One of them is the present design now. @param {string} words  what it has moved */
  taken(words) {
    this.node.hidden = false;
    this.ask.hidden = true;
    this.#say(say`✓ Taken: ${words}. Undo leads back.`);
  }

  /** @param {boolean} open  by hand */
  #unfold(open) {
    this.#open = open;
    this.#fold();
  }

  #fold() {
    const open = this.#open ?? matchMedia(ROOMY).matches;
    this.all.hidden = this.how.hidden || !open;
    setAttr(this.how, 'aria-expanded', String(open));
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
    const moves = reply.moves.slice(0, MOST);
    this.moves.replaceChildren(...moves.map((move, i) => this.#button(design, move, i)));
    this.all.replaceChildren(
      ...moves.map((move) => h('li', {}, h('b', {}, whatMoves(move)), ' ', doneBy(design, move))),
    );
    this.how.hidden = false;
    this.#fold();
  }

  /** @param {string} words */
  #say(words) {
    setText(this.words, words);
    this.moves.replaceChildren();
    this.all.replaceChildren();
    this.all.hidden = this.how.hidden = true;
  }

  /** @param {Design} design @param {Move} move @param {number} i */
  #button(design, move, i) {
    const node = button(
      {
        class: 'nearest-move',
        'data-testid': `nearest-move-${i}`,
        'aria-description': inWords(design, move),
        title: say`${doneBy(design, move)} Click: move there; undo leads back`,
        onclick: () => this.acts.take(move),
      },
      whatMoves(move),
      h('span', { class: 'nearest-far', translate: 'no' }, farText(move)),
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

/** How far away a move leads. @param {Pick<Move, 'distance'>} move */
const farText = ({ distance }) => percent(distance, distance < 0.1 ? 1 : 0);

/** What it moves where. @param {Design} design @param {Move} move */
export const inWords = (design, move) =>
  wordsOf(design, move)
    .map(({ text }) => text)
    .join('; ');

/** What a move does, in a sentence. @param {Design} design @param {Move} move */
export const doneBy = (design, move) =>
  say`${farText(move)} away: ${inWords(design, move)}. It gives ${move.figures.map(({ text }) => text).join(', ')}.`;

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
