/**
 * Where the rotors' lag takes the poles of the whole loop, as it grows from nothing to what it is: a path for each pole
 * in the s-plane, with an arrow, and a ring where it crosses the imaginary axis. Asked for while the hand rests.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../contract.js').Lag} Lag
 */
import { say, significant, t } from '../text/index.js';
import { bodyOf, lags, pairAlone, presetOf } from '../model/index.js';
import { lagTrack } from '../net/index.js';
import { button, h, setAttr, setText, svg } from '../ui/index.js';
import { toPixel } from '../splane/index.js';
import { crossings } from './crossings.js';
import { trackOf } from './track.js';

const REST_MS = 150;
const AERO = 0.16;

export class LagPaths {
  /** @type {Lag|null} */ #lag = null;
  /** @type {Lag|null} */ #drawn = null;
  #key = '';
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #timer;

  /** @param {import('../splane/splane.js').SPlane} plane @param {import('../model/store.js').Store} store */
  constructor(plane, store) {
    this.plane = plane;
    this.store = store;
    this.layer = svg('g', { class: 'lag-paths', 'data-testid': 'lag-paths', 'aria-hidden': 'true' });
    plane.svg.prepend(this.layer);
    this.words = h('div', { class: 'cloud-words lag-words', 'data-testid': 'lag-words', role: 'status' });
    const title = [
      t('Where the poles of the loop go as the rotors’ lag τ grows from nothing to the rig’s own'),
      say`or to ${AERO} s, a real Aero’s, where the rig has none. A ring: there the loop becomes unstable`,
    ].join(', ');
    this.toggle = button(
      {
        'data-testid': 'show-lag',
        'aria-label': 'Track of the rotors’ lag',
        title,
        onclick: () => store.set({ showLag: !isShown(store.state) }),
      },
      h('i', {}, 'τ'),
    );
    plane.more.replaceWith(this.toggle);
    plane.svg.after(this.words);
    plane.over = (fresh) => this.#draw(fresh);
  }

  /** @param {State} state */
  render(state) {
    const { design, heard, problem, dragging, connection, preview } = state;
    setAttr(this.layer, 'visibility', preview ? 'hidden' : 'visible'); // it is the present design's
    this.words.hidden = preview !== null;
    if (!design || preview) return;
    const shown = isShown(state);
    setAttr(this.toggle, 'aria-pressed', String(shown));
    const key = shown ? JSON.stringify(asked(design)) : '';
    if (!shown || key !== this.#key) {
      this.#key = '';
      this.#put(null); // it is of another design
    }
    // what the server has refused has no track, and what it has not answered yet may be refused
    if (!shown || dragging || problem || design !== heard || connection === 'lost' || key === this.#key) return;
    this.#key = key;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#ask(key), REST_MS);
  }

  /** @param {string} key */
  async #ask(key) {
    const { design, dragging } = this.store.state;
    if (key !== this.#key || !design) return;
    if (dragging) {
      this.#key = ''; // asked when the hand has let go
      return;
    }
    const lag = await lagTrack(asked(design)).catch(() => null); // what is wrong is told where it is asked for
    if (key === this.#key) this.#put(lag);
  }

  /** @param {Lag|null} lag */
  #put(lag) {
    if (lag === this.#lag) return;
    this.#lag = lag;
    this.#draw(false);
    const tau = `${significant(Math.max(...(lag?.tau ?? [0])), 3)} s`;
    setText(
      this.words,
      !lag ? '' : lag.assumed ? say`dashed: rotors’ lag up to ${tau} (Aero)` : say`dashed: rotors’ lag up to ${tau}`,
    );
  }

  /** @param {boolean} fresh whether the view changed */
  #draw(fresh) {
    const lag = this.#lag;
    if (!fresh && lag === this.#drawn) return;
    this.#drawn = lag;
    setAttr(this.layer, 'data-assumed', String(lag?.assumed ?? ''));
    this.layer.replaceChildren(...(lag ? lag.poles.flatMap((path) => this.#path(path)) : []));
  }

  /** @param {import('../types.js').Complex[]} path */
  #path(path) {
    const { view } = this.plane;
    const bad = path[path.length - 1].re >= 0 ? ' bad' : '';
    return [
      ...trackOf(view, path, { line: `lag-path${bad}`, arrow: `lag-arrow${bad}` }),
      ...crossings(path).map((p) => {
        const [cx, cy] = toPixel(view, p);
        return svg('circle', { class: 'lag-crossing', 'data-testid': 'lag-crossing', cx, cy, r: 4.5 });
      }),
    ];
  }
}

/** What the track depends on. @param {import('../types.js').Design} design */
const asked = (design) => ({
  ...bodyOf(design),
  ...(design.scenario.measured && { scenario: { measured: design.scenario.measured } }),
});

/** Unless someone has said so, where the rotors lag or the design lives by their not lagging. @param {State} state */
export function isShown({ showLag, design, presets, reply, view, motion }) {
  if (showLag !== null || !design) return showLag === true;
  const matters =
    pairAlone({ view, motion }) === null &&
    reply?.findings.some((f) => f.code === 'lives_by_fast_rotors' || f.code === 'rotors_unstable');
  return lags(design, presetOf({ presets, design })) || matters === true;
}
