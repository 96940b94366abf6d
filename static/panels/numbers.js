/** K and the RGA as matrices, what the RGA says, in words, and the one step that heeds it. */
import { fixed, messageOf, significant } from '../text/index.js';
import { bodyOf, bringsIntegralAction } from '../model/index.js';
import { suggestLoops } from '../net/index.js';
import { button, GAIN, gainMatrix, h, recall, relativeGains, remember, setAttr, setText } from '../ui/index.js';

/** @typedef {'diagonal'|'cross'} Pairing */

const OPEN = 'rga';

const NAMES = { diagonal: 'Diagonal', cross: 'Crosswise' };

/** @param {import('../types.js').Reply|null} reply @returns {Pairing|undefined} */
export function advisedPairing(reply) {
  if (!reply?.rga?.pairing) return undefined;
  return reply.rga.pairing[0]?.[1] === 'V_y' ? 'cross' : 'diagonal';
}

/**
 * What the RGA and the Niederlinski index mean for the pairing in use.
 * @param {import('../types.js').Reply} reply
 * @param {Pairing} pairing
 */
export function pairingWords(reply, pairing) {
  const { rga } = reply;
  const advised = advisedPairing(reply);
  if (!rga?.rga) return { level: 'info', text: 'A pole lies at 0: there is no steady state, so no RGA.' };
  const n = pairing === 'cross' ? rga.niederlinski_cross : rga.niederlinski;
  const told = pairing === 'diagonal' && /Niederlinski/.test(rga.reason ?? '');
  const index =
    n === undefined || told ? '' : ` Niederlinski ${fixed(n)}${n > 0 ? '' : ': unstable with integral action'}.`;
  const verdict =
    advised === pairing
      ? `${NAMES[pairing]} pairing is right`
      : `${advised === 'cross' ? 'Crosswise' : 'Diagonal'} pairing is advised`;
  return { level: advised === pairing ? 'good' : 'warning', text: `${verdict}: ${rga.reason ?? ''}${index}` };
}

/**
 * What of the present design can be copied.
 * @param {import('../types.js').State} state
 * @returns {import('../ui/copy_formats.js').Item[]}
 */
export function copied({ reply, design }) {
  if (!reply || !design) return [];
  const { K, A, B } = reply.gains;
  const six = K[0].length === 6;
  const note = six
    ? GAIN.note.replace('theta_dot, psi_dot] in rad, rad/s', 'theta_dot, psi_dot, v_p, v_y] in rad, rad/s, V')
    : GAIN.note;
  /** @type {import('../ui/copy_formats.js').Item[]} */ const items = [{ ...GAIN, note, matrix: K }];
  if (reply.rga?.rga)
    items.push({
      name: 'RGA',
      note: 'relative gain array at s = 0, rows theta, psi, columns v_p, v_y',
      matrix: reply.rga.rga,
    });
  if (A && B)
    items.push(
      { name: 'A', note: 'dx/dt = A x + B u, x = [theta, psi, theta_dot, psi_dot]', matrix: A },
      { name: 'B', note: 'u = [V_p, V_y], deviations from trim in V', matrix: B },
    );
  items.push(
    { name: 'poles', note: 'of A - B K, rad/s', poles: reply.gains.closed_loop_poles },
    { name: 'loop_poles', note: 'of the whole loop, rad/s', poles: reply.loop_poles },
  );
  return items;
}

export class NumbersPanel {
  /** @type {import('../types.js').Design|null} */ #told = null;

  /** @param {HTMLElement} root @param {import('../model/store.js').Store} store */
  constructor(root, store) {
    this.store = store;
    this.k = gainMatrix('k-matrix', () => copied(store.state));
    this.rga = relativeGains('rga-matrix');
    const opener = button(
      {
        class: 'quiet rga-opener',
        'aria-expanded': String(recall(OPEN) === 'open'),
        'data-testid': 'rga-opener',
        title: 'The relative gain array: how much the two loops interact at rest',
        onclick: () => show(opener.getAttribute('aria-expanded') !== 'true'),
      },
      'RGA',
    );
    const show = (/** @type {boolean} */ open) => {
      opener.setAttribute('aria-expanded', String(open));
      remember(OPEN, open ? 'open' : 'folded');
    };
    this.words = h('span', { class: 'pairing-words', 'data-testid': 'pairing-words' });
    this.pair = button({
      class: 'pair-advised',
      hidden: true,
      'data-testid': 'pair-advised',
      title: 'Pairs as the RGA advises, with PI values that suit the new pairs',
      onclick: () => this.#pair(),
    });
    this.note = h('p', { class: 'note', 'data-testid': 'pairing-note', role: 'status' });
    root.append(
      h('div', { class: 'matrices' }, this.k.node, opener, this.rga.node),
      h('p', { class: 'advice' }, this.words, ' ', this.pair),
      this.note,
    );
  }

  /** The PI values belong to the pairing, so both change in one step; where none are found, the pairing alone. */
  async #pair() {
    const { design, reply } = this.store.state;
    const pairing = advisedPairing(reply);
    if (!design || !pairing) return;
    this.pair.disabled = true;
    /** @type {Partial<import('../types.js').Design>} */ let part = { pairing };
    let trouble = '';
    try {
      const { loops } = await suggestLoops(bodyOf({ ...design, pairing }));
      part = { pairing, loops };
    } catch (error) {
      trouble = `Paired, but the PI values are the old ones: ${messageOf(error)}`;
    }
    this.pair.disabled = false;
    if (this.store.state.design?.preset !== design.preset) return;
    this.store.edit((d) => ({ ...d, ...part }));
    this.#tell(trouble);
  }

  /** Says something of the present design; the next change takes it away. @param {string} text */
  #tell(text) {
    this.#told = this.store.state.design;
    setText(this.note, text);
  }

  /** @param {import('../types.js').State} state */
  render(state) {
    const { reply, design } = state;
    this.k.render(reply?.gains.K, (v) => significant(v, 4));
    this.rga.render(reply?.rga?.rga, (v) => fixed(v, 3));
    if (design !== this.#told) this.#tell('');
    if (!reply || !design) return;
    const { level, text } = pairingWords(reply, design.pairing);
    this.words.className = `pairing-words ${level}`;
    setText(this.words, text);
    setAttr(this.words, 'title', text);
    const advised = advisedPairing(reply);
    this.pair.hidden = level !== 'warning' || design.outer === 'none' || bringsIntegralAction(state);
    setText(this.pair, advised === 'cross' ? 'Pair crosswise' : 'Pair diagonally');
  }
}
